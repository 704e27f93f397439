# SPDX-License-Identifier: GPL-3.0-or-later
"""The reader of printed Nastran results, on pages of our own."""
import unittest

import f06

PAGES = """\
0    BEAM                                                                                         SUBCASE 2

                                             D I S P L A C E M E N T   V E C T O R

      POINT ID.   TYPE          T1             T2             T3             R1             R2             R3
             1      G      0.0            0.0            0.0            0.0            0.0            0.0
             2      G     -1.250000E-05   2.500000E-03   0.0            0.0            0.0            1.000000E+00
1    BEAM                                                                          JANUARY   1, 2000   PAGE     9
0    BEAM                                                                                         SUBCASE 2

                                             D I S P L A C E M E N T   V E C T O R

      POINT ID.   TYPE          T1             T2             T3             R1             R2             R3
            10      G      3.000000E-05   0.0            0.0            0.0            0.0            0.0
1    BEAM                                                                          JANUARY   1, 2000   PAGE    10
0                                                                                                 SUBCASE 3

                               F O R C E S   O F   S I N G L E - P O I N T   C O N S T R A I N T

      POINT ID.   TYPE          T1             T2             T3             R1             R2             R3
             1      G      4.000000E+00   0.0            0.0            0.0            0.0            0.0
      FREQUENCY =  5.000000E-01
                                       C O M P L E X   D I S P L A C E M E N T   V E C T O R
                                                          (REAL/IMAGINARY)

      POINT ID.   TYPE          T1             T2             T3             R1             R2             R3
0            12      G      2.000000E+00   0.0            0.0            0.0            0.0            0.0
                          -3.000000E+00   0.0            0.0            0.0            0.0            0.0
                                              R E A L   E I G E N V A L U E S
   MODE    EXTRACTION      EIGENVALUE            RADIANS             CYCLES            GENERALIZED         GENERALIZED
    NO.       ORDER                                                                       MASS              STIFFNESS
        1         1        3.947842E+01        6.283185E+00        1.000000E+00        1.000000E+00        3.947842E+01
                      S T R E S S E S   I N   H E X A H E D R O N   S O L I D   E L E M E N T S   ( H E X A )
0                CORNER        ------CENTER AND CORNER POINT STRESSES---------       DIR.  COSINES       MEAN
  ELEMENT-ID    GRID-ID        NORMAL              SHEAR             PRINCIPAL       -A-  -B-  -C-     PRESSURE
0       100           0GRID CS  8 GP
0                CENTER  X   1.000000E+00  XY   4.000000E+00   A   1.776357E-15  LX 0.0  0.00 0.0    8.800000E+00
                         Y   2.000000E+00  YZ   5.000000E+00   B  -2.640000E+01  LY 0.0  0.00 0.0
                         Z   3.000000E+00  ZX   6.000000E+00   C   1.776357E-15  LZ 0.0  1.00 0.0
0                     7  X   7.000000E+00  XY   0.0            A   1.776357E-15  LX 0.0  0.00 0.0    8.800000E+00
                         Y   0.0           YZ   0.0            B  -2.640000E+01  LY 0.0  0.00 0.0
                         Z   0.0           ZX   0.0            C   1.776357E-15  LZ 0.0  1.00 0.0
"""


def numbers(row):
    return [one.number for one in row]


class PrintedResults(unittest.TestCase):
    def setUp(self):
        self.tables = f06.read(PAGES.splitlines())

    def test_pages_of_a_table_are_joined_and_subcases_kept_apart(self):
        first = self.tables[0]
        self.assertEqual((first.title, first.subcase, sorted(first.rows)), ("DISPLACEMENT VECTOR", 2, [1, 2, 10]))
        self.assertEqual(numbers(first.rows[2]), [-1.25e-5, 2.5e-3, 0, 0, 0, 1])
        forces = self.tables[1]
        self.assertEqual((forces.title, forces.subcase), ("FORCES OF SINGLE-POINT CONSTRAINT", 3))
        self.assertEqual(numbers(forces.rows[1])[0], 4.0)

    def test_the_unit_is_one_in_the_last_printed_digit(self):
        self.assertAlmostEqual(self.tables[0].rows[2][0].unit, 1e-11, delta=1e-20)
        self.assertAlmostEqual(self.tables[0].rows[2][1].unit, 1e-9, delta=1e-18)

    def test_complex_rows_have_their_imaginary_parts_after_the_real_ones(self):
        table = self.tables[2]
        self.assertEqual((table.title, table.frequency), ("COMPLEX DISPLACEMENT VECTOR", 0.5))
        self.assertEqual(numbers(table.rows[12])[::6], [2.0, -3.0])

    def test_eigenvalues_are_listed_by_mode(self):
        self.assertEqual(numbers(self.tables[3].rows[1])[:3], [39.47842, 6.283185, 1.0])

    def test_stresses_are_xx_yy_zz_xy_yz_zx_by_element_and_grid(self):
        rows = self.tables[4].rows
        self.assertEqual(numbers(rows[100, 0]), [1, 2, 3, 4, 5, 6])
        self.assertEqual(numbers(rows[100, 7])[0], 7)


if __name__ == "__main__":
    unittest.main(verbosity=2)
