"""The dependency arrows of the design hold: in #include lines, in CMake, and in what is linked."""
import json
import os
import pathlib
import re
import subprocess
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CLATTER_BUILD", SOURCE / "build/release"))

# core <- mesh <- assembly <- modal <- condense; core <- dynamics <- recover
BELOW = {
    "core": set(),
    "mesh": {"core"},
    "assembly": {"core", "mesh"},
    "modal": {"core", "mesh", "assembly"},
    "condense": {"core", "mesh", "assembly", "modal"},
    "dynamics": {"core"},
    "recover": {"core", "dynamics"},
}
# A foreign library's headers may be included in files of one name only (h5_file, h5_impl, ...).
HEADER_OWNERS = {
    r"gmsh\.h": ["mesh/gmsh_"],
    r"cholmod\.h": ["modal/factor/cholmod_", "modal/cholmod_"],
    r"hdf5\.h|H5\w*\.h": ["core/h5_"],
    r"toml\+\+/.*|toml\+\+\.h": ["core/config"],
    r"CLI/.*": ["core/command_line"],
    r"metis\.h": ["modal/factor/metis_", "modal/metis_", "mesh/metis_"],
}
HEAVY = ("libgmsh", "libcholmod", "libarpack", "libmetis")


def folder_of_library(library):
    """The folder in which a library target of ours is made."""
    return "mesh" if library == "meshing" else library


def sources(folder):
    return [p for p in (SOURCE / folder).rglob("*") if p.suffix in (".cpp", ".hpp", ".h")]


def wrong_includes(folder, text):
    """Folders that `text`, a source of `folder`, includes although the design forbids it."""
    included = re.findall(r'^\s*#\s*include\s+["<](\w+)/', text, re.M)
    return [name for name in included if name in BELOW and name != folder and name not in BELOW[folder]]


def wrong_links(folder, cmake_text):
    """Libraries that a folder's CMakeLists.txt links although the design forbids it."""
    used = map(folder_of_library, re.findall(r"\bclatter(?:::|_)(\w+)", re.sub(r"#.*", "", cmake_text)))
    return [name for name in used if name in BELOW and name != folder and name not in BELOW[folder]]


def includes_header(path, header):
    return re.search(rf"^\s*#\s*include\s+[<\"](suitesparse/)?({header})[>\"]", path.read_text(), re.M)


class Arrows(unittest.TestCase):
    def test_no_include_runs_against_the_design(self):
        wrong = [f"{p.relative_to(SOURCE)} includes {name}" for folder in BELOW for p in sources(folder)
                 for name in wrong_includes(folder, p.read_text())]
        self.assertEqual(wrong, [])

    def test_no_link_runs_against_the_design(self):
        wrong = [f"{folder} links {name}" for folder in BELOW
                 for cmake in (SOURCE / folder).rglob("CMakeLists.txt")
                 for name in wrong_links(folder, cmake.read_text())]
        self.assertEqual(wrong, [])

    def test_a_wrong_arrow_is_noticed(self):
        self.assertEqual(wrong_includes("core", '#include "mesh/mesh.hpp"\n'), ["mesh"])
        self.assertEqual(wrong_includes("dynamics", '#include <Eigen/Core>\n#include "modal/x.hpp"\n'), ["modal"])
        self.assertEqual(wrong_includes("condense", '#include "mesh/mesh.hpp"\n'), [])
        self.assertEqual(wrong_links("dynamics", "LINKS clatter::core clatter::condense"), ["condense"])

    def test_a_foreign_header_stays_behind_files_of_one_name(self):
        for header, owners in HEADER_OWNERS.items():
            users = [str(p.relative_to(SOURCE)) for folder in BELOW for p in sources(folder)
                     if includes_header(p, header)]
            with self.subTest(header=header):
                self.assertEqual([user for user in users if not user.startswith(tuple(owners))], [])

    def test_no_header_of_ours_shows_a_foreign_type_to_others(self):
        for header, owners in HEADER_OWNERS.items():
            private = [str(p.relative_to(SOURCE)) for folder in BELOW for p in sources(folder)
                       if p.suffix != ".cpp" and includes_header(p, header)]
            users = [str(p.relative_to(SOURCE)) for folder in BELOW for p in sources(folder)
                     if any(includes_header(p, re.escape(name)) for name in private)]
            with self.subTest(header=header):
                self.assertEqual([user for user in users if not user.startswith(tuple(owners))], [])


def needed(executable):
    """Direct dependencies of an executable [names of shared libraries]."""
    text = subprocess.run(["readelf", "-d", executable], capture_output=True, text=True, check=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.+)\]", text)


def loaded(executable):
    """Every shared library that the loader brings in, with its file."""
    text = subprocess.run(["ldd", executable], capture_output=True, text=True, check=True).stdout
    return {m[1]: m[2] for m in re.finditer(r"^\s*(\S+) => (\S+)", text, re.M)}


class Linking(unittest.TestCase):
    def executable(self, stage):
        path = BUILD / "bin" / f"clatter-{stage}"
        if not path.exists():
            self.skipTest(f"{path} is not built")
        return path

    def test_dynamics_and_recover_link_neither_gmsh_nor_cholmod(self):
        for stage in ("dynamics", "recover"):
            with self.subTest(stage=stage):
                libraries = [*loaded(self.executable(stage)), *needed(self.executable(stage))]
                self.assertEqual([name for name in libraries if name.startswith(HEAVY)], [])

    def test_hardC10_only_mesh_links_gmsh(self):
        for stage in ("assembly", "modal", "condense"):
            with self.subTest(stage=stage):
                libraries = loaded(self.executable(stage))
                print(stage, "links", " ".join(sorted(name.split(".so")[0] for name in needed(self.executable(stage)))))
                self.assertEqual([name for name in libraries if name.startswith("libgmsh")], [])

    def test_hardH6_one_libhdf5_per_executable(self):
        for stage in BELOW.keys() - {"core"}:
            with self.subTest(stage=stage):
                found = [name for name in loaded(self.executable(stage)) if re.match(r"libhdf5(_serial|_openmpi)?\.so", name)]
                self.assertEqual(len(found), 1, f"clatter-{stage} loads {found}")

    def test_hardE5_our_eigen_is_not_visible_to_gmsh(self):
        symbols = subprocess.run(["nm", "-D", "-C", "--defined-only", self.executable("mesh")],
                                 capture_output=True, text=True, check=True).stdout
        self.assertEqual([line for line in symbols.splitlines() if "Eigen::" in line], [])

    def test_hardE5_one_set_of_flags_for_all_targets(self):
        commands = BUILD / "compile_commands.json"
        if not commands.exists():
            self.skipTest(f"{commands} is missing")
        flags = {}
        for entry in json.loads(commands.read_text()):
            words = entry["command"].split()
            # What alters the layout or alignment of types: machine, language, optimisation, sanitizers.
            layout = frozenset(w for w in words if re.match(r"-(m|O|std=|fsanitize|f(pack|short|abi)|DEIGEN_|DNDEBUG)", w))
            flags.setdefault(layout, []).append(entry["file"])
        self.assertEqual(len(flags), 1, "\n".join(f"{sorted(f)}: {files[:3]}" for f, files in flags.items()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
