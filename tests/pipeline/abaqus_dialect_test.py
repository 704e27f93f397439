# SPDX-License-Identifier: GPL-3.0-or-later
"""The bar of abaqus_dialects.py in every way of writing it has the frequencies that CalculiX finds for the plain one."""
import pathlib
import shutil
import sys
import tempfile
import unittest

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "cli"), str(TESTS / "validate")]
import abaqus_decks  # noqa: E402
import abaqus_dialects  # noqa: E402
import h5py  # noqa: E402
import numpy as np  # noqa: E402
import stages  # noqa: E402

# CalculiX 2.20, seven digits [Hz]: `ccx plain` of abaqus_dialects.plain(), `ccx mass` of with_mass(BODIES["rigid_body"]).
PLAIN = (5429.477, 5429.477, 20080.09, 28172.24)
MASS = (2557.241, 2557.241, 18844.63, 18844.63)
# `ccx link` of linked(LINKS["equation"]).
LINK = (5429.477, 5617.893, 20258.90, 28172.24)
PRINTED = 3e-7  # half of the last digit of seven
FOOT = "\n[[support]]\nname = \"foot\"\nnode_set = \"{}\"\ndirections = [\"x\", \"y\", \"z\"]\n"
STEEL = "\n[material.steel]\nregions = [\"bar\"]\nE = 210e9\nnu = 0.3\nrho = 7850\nhex8 = \"full\"\n"


class Dialects(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        stages.require_stages()
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="clatter-dialects-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)

    def stage(self, *arguments):
        done = stages.run_stage(*arguments, folder=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stderr

    def frequencies(self, name, text, more=""):
        """Frequencies, and what clatter-mesh says."""
        (self.folder / name).write_text(text)
        said = self.stage("mesh", name, "--units", "mm-t-s", "-o", "a.mesh.h5", "--recipe", "a.fe.toml")
        with open(self.folder / "a.fe.toml", "a") as file:
            file.write(more)
        self.stage("assembly", "a.mesh.h5", "-c", "a.fe.toml", "-o", "a.fe.h5")
        self.stage("modal", "a.fe.h5", "--count", "4", "-o", "a.modes.h5")
        with h5py.File(self.folder / "a.modes.h5") as file:
            return file["frequency_hz"][()], said

    def expect(self, found, expected):
        self.assertLess(np.abs(found[0] / expected - 1).max(), PRINTED)

    def test_every_deck_of_the_bar_has_calculix_s_frequencies(self):
        for name, text in abaqus_dialects.FILES.items():
            with self.subTest(name):
                self.expect(self.frequencies("a.inp", text()), PLAIN)

    def test_a_rigid_link_in_a_skew_direction_is_a_rod(self):
        for name, link in abaqus_dialects.LINKS.items():
            with self.subTest(name):
                self.expect(self.frequencies("a.inp", abaqus_dialects.linked(link)), LINK)

    def test_every_rigid_body_with_a_mass_has_calculix_s_frequencies(self):
        for name, body in abaqus_dialects.BODIES.items():
            with self.subTest(name):
                self.expect(self.frequencies("a.inp", abaqus_dialects.with_mass(body)), MASS)

    def test_a_universal_file_has_the_same_frequencies(self):
        self.expect(self.frequencies("a.unv", abaqus_dialects.universal(), FOOT.format("foot") + STEEL), PLAIN)

    def test_an_ansys_archive_has_the_same_frequencies_and_says_what_it_left_out(self):
        found = self.frequencies("a.cdb", abaqus_dialects.ansys(), FOOT.format("FOOT"))
        self.expect(found, PLAIN)
        self.assertIn("left out are D (1): write [[support]]", found[1])

    def test_what_is_assumed_is_one_line_each(self):
        for name, line in (("skinned", "16 M3D4: faces of solids, now the surface SKIN"),
                           ("skinned", "*MEMBRANE SECTION gives stiffness to faces of solids, 1e-09 thick"),
                           ("as_gmsh", "4 CPS4: faces of solids, now the surfaces lid, Surface2"),
                           ("hybrid", "C3D8H is read as C3D8"),
                           ("passed_over", "passed over, since neither stiffness nor mass depends on it: "
                                           "contact, beyond whether it is bonded: *SURFACE INTERACTION, *FRICTION; "
                                           "damping: *MODAL DAMPING; damping, offered to the recipe: *DAMPING; of a "
                                           "nonlinear analysis: *PLASTIC, *CONTACT CONTROLS; of heat transfer: "
                                           "*CONDUCTIVITY; of modal steps: *SELECT EIGENMODES")):
            (self.folder / "b.inp").write_text(abaqus_dialects.FILES[name]())
            said = self.stage("mesh", "b.inp", "--units", "mm-t-s", "-o", "b.mesh.h5")
            self.assertEqual(said.count(line), 1, said)

    def test_files_of_other_programs_are_called_what_they_are(self):
        for name, what in (("a.k", "is an LS-DYNA keyword deck"), ("a.pch", "is a Nastran punch file"),
                           ("a.odb", "is an Abaqus result file"), ("a.stl", "is a triangulated surface")):
            (self.folder / name).write_text("*KEYWORD\n")
            done = stages.run_stage("mesh", name, "--units", "mm-t-s", "-o", "c.mesh.h5", folder=self.folder)
            self.assertEqual(done.returncode, 2)
            self.assertIn(what, done.stderr)
            self.assertNotIn("TOML", done.stderr)


# What is refused, with the way out.
REFUSED = {
    "cae_contact_that_opens": "opens and slides, which is not linear; expected TIED",
    "cae_shell_stiffener": "of shell S4R 101 on nodes of solids, which do not turn: a hinge",
}


class Decks(unittest.TestCase):
    """All decks of abaqus_programs.py."""

    @classmethod
    def setUpClass(cls):
        stages.require_stages()

    def test_every_deck_has_calculix_s_figures_or_is_refused_with_the_way_out(self):
        for deck in abaqus_decks.DECKS:
            with self.subTest(deck.name):
                row, said = abaqus_decks.rows_of(deck)
                if deck.name in REFUSED:
                    self.assertIn(REFUSED[deck.name], said)
                else:
                    self.assertEqual(row.verdict, "agrees", row)

    def test_a_wrong_model_differs(self):
        deck = next(one for one in abaqus_decks.DECKS if one.name == "cae_springs_and_dashpots")
        stiffer = {name: text.replace("3000.", "3300.") for name, text in deck.files.items()}
        self.assertEqual(abaqus_decks.rows_of(deck._replace(files=stiffer))[0].verdict, "differs")


if __name__ == "__main__":
    unittest.main()
