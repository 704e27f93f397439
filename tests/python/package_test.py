# SPDX-License-Identifier: GPL-3.0-or-later
"""The package clatter: documentation of what it exports, what it loads, and its version."""
import inspect
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest

import clatter
import numpy as np
from clatter import coordinates, films, model, rom

SOURCE = pathlib.Path(__file__).resolve().parents[2]
UNIT = re.compile(r"\[[^\]]+\]")  # [N/m], [1], [index]
TUPLES = (coordinates.Set, coordinates.MassProperties, rom.Eigenmodes, model.Csr)
CLASSES = [one for one in map(lambda name: getattr(clatter, name), clatter.__all__)
           if inspect.isclass(one) and not issubclass(one, Exception)] + [films.Film]


def members(one):
    """(name, function) of the public methods and properties of a class."""
    for name, own in inspect.getmembers(one):
        if not name.startswith("_") or name == "__getitem__":
            function = own.fget if isinstance(own, property) else getattr(own, "func", own)
            if inspect.isfunction(function):
                yield f"{one.__name__}.{name}", function


def returns_array(function):
    """Whether it is annotated to return an array, a matrix, or a tuple with arrays."""
    return function.__annotations__.get("return") in (np.ndarray, tuple, *TUPLES)


class Documentation(unittest.TestCase):
    def test_every_public_name_says_what_it_is_and_arrays_say_their_units(self):
        found = [one for own in CLASSES for one in members(own)]
        self.assertGreater(len(found), 80)
        lacking = [name for name, function in found if not (function.__doc__ or "").strip()]
        self.assertEqual(lacking, [], "public names without documentation")
        self.assertEqual([name for name, function in found if returns_array(function) and not UNIT.search(function.__doc__)], [],
                         "arrays without a unit in brackets")
        for name in clatter.__all__:
            self.assertTrue((getattr(clatter, name).__doc__ or "").strip(), name)

    def test_every_public_name_states_what_it_returns_so_that_arrays_are_known(self):
        # attribute() returns text or a number, table() a DataFrame or an array, dataset() an xarray.Dataset, which their documentation says.
        free = {f"{one.__name__}.attribute" for one in CLASSES} | {"Run.table", "Run.dataset"}
        unstated = [name for own in CLASSES for name, function in members(own)
                    if "return" not in function.__annotations__ and name not in free]
        self.assertEqual(unstated, [])

    def test_fields_of_tuples_have_units(self):
        for one in TUPLES:
            source = inspect.getsource(one)
            for field, kind in one.__annotations__.items():
                if kind is np.ndarray:
                    with self.subTest(field=f"{one.__name__}.{field}"):
                        self.assertRegex(source, rf"{field}: np\.ndarray +# [^\n]*\[[^\]]+\]")


class Package(unittest.TestCase):
    def test_errors_and_pipeline_load_neither_numpy_nor_h5py(self):
        # The build writes schemas by clatter_tools.keys, on machines that have Python alone.
        code = "import clatter.pipeline, clatter_tools.keys.files, sys; sys.exit(bool({'numpy', 'h5py'} & set(sys.modules)))"
        self.assertEqual(subprocess.run([sys.executable, "-B", "-c", code], check=False).returncode, 0)

    def test_names_that_do_not_exist_are_refused_as_in_any_module(self):
        with self.assertRaisesRegex(AttributeError, "module clatter has no Romm"):
            clatter.Romm
        self.assertIn("Rom", dir(clatter))

    def test_the_versions_of_the_package_and_the_programs_are_the_same(self):
        project = tomllib.loads((SOURCE / "pyproject.toml").read_text())
        programs = re.search(r"project\(clatter VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertEqual(project["project"]["version"], programs)
        packages = [path.parent.name for path in (SOURCE / "python").glob("*/__init__.py")]
        self.assertEqual(project["tool"]["setuptools"]["packages"], packages)

    def test_numpy_and_h5py_are_all_that_the_package_needs(self):
        allowed = {"numpy", "h5py", "scipy", "pandas", "xarray"} | set(sys.stdlib_module_names)
        optional = {"scipy", "pandas", "xarray"}
        for path in (SOURCE / "python/clatter").glob("*.py"):
            for line in path.read_text().splitlines():
                if (found := re.match(r"( *)(?:from|import) (\w+)", line)):
                    self.assertIn(found[2], allowed, f"{path.name}: {line}")
                    self.assertTrue(found[2] not in optional or found[1], f"{path.name}: {line}: found it required, expected it in try")


INSTALLING = """cmake_minimum_required(VERSION 3.25)
project(installing LANGUAGES NONE)
include(GNUInstallDirs)
add_subdirectory({source}/python python)
install(DIRECTORY {source}/tools/clatter_tools DESTINATION ${{CMAKE_INSTALL_DATADIR}}/clatter FILES_MATCHING PATTERN "*.py")
"""


@unittest.skipIf(shutil.which("cmake") is None, "cmake is not installed")
class Installation(unittest.TestCase):
    def install(self, prefix):
        """The root below which a project with this package was installed with that prefix."""
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        folder = pathlib.Path(scratch.name)
        (folder / "CMakeLists.txt").write_text(INSTALLING.format(source=SOURCE))
        for arguments in (["-S", folder, "-B", folder / "build", f"-DCMAKE_INSTALL_PREFIX={prefix}"], ["--install", folder / "build"]):
            done = subprocess.run(["cmake", *arguments], env={**os.environ, "DESTDIR": str(folder / "root")}, capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
        return folder / "root"

    def imported(self, path, code="import clatter"):
        """The file of the package that Python finds with one folder in its path."""
        done = subprocess.run([sys.executable, "-B", "-c", f"{code}; print(clatter.Rom.__module__, clatter.__file__)"], cwd="/",
                              env={"PYTHONPATH": str(path)}, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.split()[1]

    def test_python_finds_the_package_of_an_installation_and_so_do_the_tools(self):
        root = self.install("/usr")
        own = root / "usr/share/clatter"
        self.assertEqual(self.imported(own, "import clatter_tools.report, clatter"), f"{own}/clatter/__init__.py")
        link = root / "usr/lib/python3/dist-packages/clatter"
        self.assertEqual(link.resolve(), (own / "clatter").resolve())
        self.assertEqual(self.imported(link.parent), f"{link}/__init__.py")

    def test_below_another_prefix_the_link_is_in_the_folder_of_the_release_of_python(self):
        root = self.install("/usr/local")
        found = list(root.glob("usr/local/lib/python3.*/dist-packages/clatter"))
        self.assertEqual([one.resolve() for one in found], [(root / "usr/local/share/clatter/clatter").resolve()])


if __name__ == "__main__":
    unittest.main(verbosity=2)
