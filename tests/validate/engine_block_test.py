# SPDX-License-Identifier: GPL-3.0-or-later
"""HardG2: the spline-skinned engine block of the shared data becomes a valid quadratic mesh.

Its skin is one wavy spline with ridges of 0.9 mm radius and 1.5 mm walls to bolt holes; OpenCASCADE
integrates its volume to 185 cm3, while the area within the outline, summed along 400 000 chords
of it, gives 317.860 cm3: 6934.46 mm2 of outline, two bores of radius 25 and six holes of radius
2.5, 110 mm high.
"""
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

HERE = pathlib.Path(__file__).resolve()
BLOCK = next((p / "shared/data/engine_block/EngineBlock_Common.brep" for p in HERE.parents
              if (p / "shared/data/engine_block").exists()), None)
OUTLINE = 6934.46e-6  # m2
VOLUME = (OUTLINE - 2 * math.pi * 0.025**2 - 6 * math.pi * 0.0025**2) * 0.110

PART = """name = "engine"
kind = "cad"
[cad]
source = "{}"
expected_box = [135.6, 68.0, 110]
[mesh]
element_size_mm = {}
"""


def smallest_det(nodes, cells, points):
    """Smallest det J over its mean at points (barycentric) of each tet10."""
    edges = [(0, 1), (1, 2), (0, 2), (0, 3), (2, 3), (1, 3)]
    x = nodes[cells]
    dets = []
    for l in points:
        d = np.zeros((10, 4))
        for i in range(4):
            d[i, i] = 4 * l[i] - 1
        for e, (a, b) in enumerate(edges):
            d[4 + e, a], d[4 + e, b] = 4 * l[b], 4 * l[a]
        g = np.einsum("cnk,nl->ckl", x, d)
        dets.append(np.linalg.det(g[:, :, 1:] - g[:, :, :1]))
    return np.min(dets)


@unittest.skipUnless(BLOCK, "shared/data/engine_block is not here")
class HardG2EngineBlock(unittest.TestCase):
    def mesh(self, size_mm):
        folder = pathlib.Path(tempfile.mkdtemp())
        (folder / "engine.toml").write_text(PART.format(BLOCK, size_mm))
        done = subprocess.run([os.environ["CLATTER_BIN"] + "/clatter-mesh", folder / "engine.toml", "-o",
                               folder / "engine.h5"], capture_output=True, text=True)
        return done, folder / "engine.h5"

    def check(self, path, min_scaled_jacobian, volume_error):
        with h5py.File(path) as file:
            proof = dict(file["certificate"].attrs)
            nodes, cells = file["nodes"][:], file["cells/0/nodes"][:]
        self.assertGreater(proof["min_scaled_jacobian"], min_scaled_jacobian)
        self.assertAlmostEqual(proof["volume_m3"] / VOLUME, 1.0, delta=volume_error)
        corners = list(np.eye(4))
        random = np.random.default_rng(3).dirichlet(np.ones(4), 40)
        self.assertGreater(smallest_det(nodes, cells, corners + list(random)), 0.0)
        return proof

    def test_meshes_into_cells_proved_valid(self):
        done, path = self.mesh(4)
        self.assertEqual(done.returncode, 0, done.stderr)
        # 4 mm chords of the ridges and of quadratic facets cut off less than 1e-3 of the volume.
        proof = self.check(path, 0.05, 1e-3)
        self.assertGreaterEqual(proof["min_dihedral_deg"], 8.0)
        self.assertLess(proof["largest_distance_off_geometry_m"], 1e-4)

    def test_huge_cells_follow_the_skin_or_are_refused_with_the_faces_to_blame(self):
        # Gmsh's HighOrder, the last remedy but one, differs from run to run: with luck the mesh becomes valid.
        done, path = self.mesh(60)
        if done.returncode == 0:
            self.check(path, 0.02, 0.01)  # the floor below which a mesh is refused, and the tolerance against CAD
            return
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertRegex(done.stderr, r"face \d+ ")
        self.assertFalse(path.exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
