# SPDX-License-Identifier: GPL-3.0-or-later
"""The dependencies of the design hold in #include lines, in CMake, and in the linked programs."""
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from observed import observed  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CLATTER_BUILD", SOURCE / "build/release"))

# Libraries: each folder of core/ is one, and may use these of the others.
LIBRARIES = {
    "core/base": set(),
    "core/dense": set(),
    "core/keys": {"core/base"},
    "core/mesh": {"core/base"},
    "core/rom": {"core/base"},
    "core/run": set(),
    "core/sparse": {"core/base", "core/dense", "core/keys"},
    "core/sound": {"core/base", "core/dense"},
    "core/fe": {"core/base", "core/dense", "core/keys", "core/mesh", "core/rom"},
    "core/recipe": {"core/base", "core/dense", "core/keys", "core/mesh", "core/rom", "core/fe"},
    "core/modes": {"core/base", "core/dense", "core/keys", "core/mesh", "core/rom", "core/fe", "core/sparse"},
    "core/ranks": {"core/base", "core/dense", "core/keys", "core/mesh", "core/rom", "core/fe", "core/sparse"},
}
# Stages: each is one program, writes files for the next one, and uses no other stage.
STAGES = {
    "mesh": {"core/base", "core/dense", "core/keys", "core/mesh", "core/rom", "core/fe", "core/recipe"},
    "assembly": {"core/base", "core/dense", "core/keys", "core/mesh", "core/rom", "core/fe", "core/recipe", "core/sparse"},
    "modal": set(LIBRARIES) - {"core/recipe", "core/run", "core/sound"},
    "condense": set(LIBRARIES) - {"core/recipe", "core/run", "core/sound"},
    "dynamics": {"core/base", "core/dense", "core/keys", "core/rom", "core/run"},
    "recover": {"core/base", "core/dense", "core/keys", "core/rom", "core/run", "core/sound"},
}
ALLOWED = LIBRARIES | STAGES
# Library targets that are not named after the folder of their stage.
FOLDER_OF_TARGET = {"meshing": "mesh", "film": "dynamics"}
# A third-party library's headers may be included only in files with its prefix (h5_file, h5_impl, ...).
HEADER_OWNERS = {
    r"gmsh\.h": ["mesh/cad/gmsh_"],
    r"CGAL/.*": ["recover/acoustic/cgal_"],
    r"cholmod\.h": ["core/sparse/factor/cholmod_"],
    r"hdf5\.h|H5\w*\.h": ["core/base/h5_"],
    r"toml\+\+/.*|toml\+\+\.h": ["core/base/config"],
    r"CLI/.*": ["core/base/command_line"],
    r"nlohmann/.*": ["core/base/json_line"],
    r"lapack\.h": ["core/dense/", "core/sound/complex_lu", "core/sparse/factor/front", "dynamics/integrate/dense_lu"],
    r"mpi\.h": ["core/ranks/mpi_", "core/sparse/factor/mumps_"],
    r"dmumps_c\.h": ["core/ranks/mumps_", "core/sparse/factor/mumps_"],
    r"metis\.h": ["core/sparse/factor/metis_", "mesh/part/metis_"],
}
HEAVY = ("libgmsh", "libcholmod", "libarpack", "libmetis")


def folder_of_library(target):
    """The folder that defines a library target of clatter; None for a third-party one."""
    if target in FOLDER_OF_TARGET:
        return FOLDER_OF_TARGET[target]
    stage = target.split("_")[0]
    return next((folder for folder in LIBRARIES if folder == f"core/{target}"), stage if stage in STAGES else None)


def sources(folder):
    return [p for p in (SOURCE / folder).rglob("*") if p.suffix in (".cpp", ".hpp", ".h")]


def complaint(folder, name):
    """The error message when `folder` uses `name`."""
    if name in STAGES:
        return f"{folder} uses {name}, which is a stage: stages exchange files; what two of them need " \
               f"belongs into a library below core/"
    return f"{folder} uses {name}, but may use only: {', '.join(sorted(ALLOWED[folder])) or 'no other folder'}"


def wrong_uses(folder, names):
    return [complaint(folder, name) for name in names
            if name in ALLOWED and name != folder and name not in ALLOWED[folder]]


def wrong_includes(folder, text):
    """Errors in the #include lines of `text`, a source of `folder`."""
    included = re.findall(r'^\s*#\s*include\s+["<]((?:core/)?\w+)/', text, re.M)
    return wrong_uses(folder, included)


def folder_includes(stage):
    """{folder: {folder that it includes: the first include line}} inside a stage.

    What lies directly in a parent folder may be used by its subfolders as well: such lines do not count."""
    edges = {}
    for p in sources(stage):
        folder = str(p.parent.relative_to(SOURCE))
        for path in re.findall(rf'^\s*#\s*include\s+"({stage}/[\w/]+)/\w+\.hpp"', p.read_text(), re.M):
            if path != folder and not folder.startswith(f"{path}/"):
                edges.setdefault(folder, {}).setdefault(path, f"{p.relative_to(SOURCE)} includes {path}")
    return edges


def file_includes(stage):
    """{file: {file that it includes: the include line}} inside a stage; a header and its source are one."""
    edges = {}
    for p in sources(stage):
        file = str(p.relative_to(SOURCE).with_suffix(""))
        for path in re.findall(rf'^\s*#\s*include\s+"({stage}/[\w/]+)\.hpp"', p.read_text(), re.M):
            if path != file:
                edges.setdefault(file, {}).setdefault(path, f"{p.relative_to(SOURCE)} includes {path}")
    return edges


def circle(edges):
    """The include lines of one circle among folders or files, [] where there is none."""
    done = set()

    def search(folder, path):
        for below, line in edges.get(folder, {}).items():
            lines = [*path, (folder, line)]
            if below in (started := [name for name, _ in lines]):
                return [text for _, text in lines[started.index(below):]]
            if below not in done and (found := search(below, lines)):
                return found
        done.add(folder)
        return []

    return next(filter(None, (search(folder, []) for folder in sorted(edges))), [])


def wrong_links(folder, cmake_text):
    """Errors in the libraries that a folder's CMakeLists.txt links."""
    named = re.findall(r"\bclatter(?:::|_)(\w+)", re.sub(r"#.*", "", cmake_text))
    return wrong_uses(folder, [f for f in map(folder_of_library, named) if f])


def includes_header(path, header):
    return re.search(rf"^\s*#\s*include\s+[<\"](suitesparse/)?({header})[>\"]", path.read_text(), re.M)


class Arrows(unittest.TestCase):
    def test_no_include_runs_against_the_design(self):
        wrong = [f"{p.relative_to(SOURCE)}: {what}" for folder in ALLOWED for p in sources(folder)
                 for what in wrong_includes(folder, p.read_text())]
        self.assertEqual(wrong, [])

    def test_no_link_runs_against_the_design(self):
        wrong = [f"{cmake.relative_to(SOURCE)}: {what}" for folder in ALLOWED
                 for cmake in (SOURCE / folder).rglob("CMakeLists.txt")
                 for what in wrong_links(folder, cmake.read_text())]
        self.assertEqual(wrong, [])

    def test_every_source_is_in_a_library_or_a_stage(self):
        known = {str(p.relative_to(SOURCE)) for folder in ALLOWED for p in sources(folder)}
        self.assertEqual([str(p.relative_to(SOURCE)) for p in sources("core")
                          if str(p.relative_to(SOURCE)) not in known], [])

    def test_no_circle(self):
        for folder, below in ALLOWED.items():
            for name in below:
                with self.subTest(folder=folder, below=name):
                    self.assertNotIn(folder, ALLOWED[name])
                    self.assertLessEqual(ALLOWED[name], below)

    def test_folders_of_a_stage_form_no_circle(self):
        for stage in STAGES:
            with self.subTest(stage=stage):
                self.assertEqual(circle(folder_includes(stage)), [])

    def test_a_run_of_condense_or_modal_is_read_forward(self):
        for stage in ("condense", "modal"):
            with self.subTest(stage=stage):
                edges = file_includes(stage)
                self.assertGreater(len(edges), 10)
                self.assertEqual(circle(edges), [])

    def test_a_circle_is_reported_by_its_include_lines(self):
        self.assertEqual(circle({"a": {"b": "a1 includes b"}, "b": {"c": "b1 includes c"}, "c": {"b": "c1 includes b"}}),
                         ["b1 includes c", "c1 includes b"])
        self.assertEqual(circle({"a": {"b": "", "c": ""}, "b": {"c": ""}}), [])

    def test_a_namespace_is_named_after_its_folder(self):
        wrong = []
        for folder in LIBRARIES:
            wanted = "clatter" if folder == "core/base" else folder.replace("core/", "clatter::")
            for p in sources(folder):
                wrong += [f"{p.relative_to(SOURCE)}: found namespace {name}, expected {wanted}"
                          for name in re.findall(r"^namespace (clatter[\w:]*) \{$", p.read_text(), re.M) if name != wanted]
        self.assertEqual(wrong, [])

    def test_a_class_is_defined_once(self):
        """Two classes of one name in one namespace share their inline functions: the linker takes either's."""
        defined = {}
        for p in (p for folder in ALLOWED for p in sources(folder) if p.suffix == ".hpp"):
            for namespace, body in re.findall(r"^namespace ([\w:]+) \{$(.*?)^\}  // namespace", p.read_text(), re.M | re.S):
                for name in re.findall(r"^(?:struct|class|enum class) (\w+)(?: final)?(?: : [^;{]*)? \{", body, re.M):
                    defined.setdefault(f"{namespace}::{name}", []).append(str(p.relative_to(SOURCE)))
        self.assertGreater(len(defined), 200)
        self.assertEqual({name: files for name, files in defined.items() if len(files) > 1}, {})

    def test_paths_in_comments_lead_to_files(self):
        wrong = [f"{p.relative_to(SOURCE)}: names {path}, which does not exist" for folder in ALLOWED for p in sources(folder)
                 for path in re.findall(r"(?<!/)\b((?:core|%s)/[\w/]+\.[ch]pp)" % "|".join(STAGES), p.read_text())
                 if not (SOURCE / path).exists()]
        self.assertEqual(wrong, [])

    def test_a_wrong_arrow_is_noticed(self):
        self.assertEqual(wrong_includes("core/base", '#include "core/mesh/mesh.hpp"\n'),
                         ["core/base uses core/mesh, but may use only: no other folder"])
        self.assertRegex(wrong_includes("dynamics", '#include <Eigen/Core>\n#include "modal/x.hpp"\n')[0],
                         "dynamics uses modal, which is a stage")
        self.assertEqual(wrong_includes("condense", '#include "core/mesh/mesh.hpp"\n'), [])
        self.assertRegex(wrong_links("dynamics", "LINKS clatter::base clatter::condense")[0], "condense, which is a stage")
        self.assertRegex(wrong_links("recover", "LINKS clatter::fe")[0], "recover uses core/fe, but may use only: ")

    def test_artefacts_are_finished_in_one_place(self):
        wrong = [f"{p.relative_to(SOURCE)}: calls {name}, expected write_artefact() or write_exports()"
                 for folder in ALLOWED for p in sources(folder) if p.stem not in ("artefact", "write_artefact")
                 for name in re.findall(r"\b(write_provenance|write_timing|write_depfile)\(", p.read_text())]
        self.assertEqual(wrong, [])

    def test_mains_are_short(self):
        lengths = {stage: len((SOURCE / stage / "main.cpp").read_text().splitlines()) for stage in STAGES}
        self.assertEqual({stage: n for stage, n in lengths.items() if n > 80}, {})

    def test_a_third_party_header_is_included_only_by_files_with_its_prefix(self):
        for header, owners in HEADER_OWNERS.items():
            users = [str(p.relative_to(SOURCE)) for folder in ALLOWED for p in sources(folder)
                     if includes_header(p, header)]
            with self.subTest(header=header):
                self.assertEqual([user for user in users if not user.startswith(tuple(owners))], [])

    def test_no_header_exposes_a_third_party_type(self):
        for header, owners in HEADER_OWNERS.items():
            private = [str(p.relative_to(SOURCE)) for folder in ALLOWED for p in sources(folder)
                       if p.suffix != ".cpp" and includes_header(p, header)]
            users = [str(p.relative_to(SOURCE)) for folder in ALLOWED for p in sources(folder)
                     if any(includes_header(p, re.escape(name)) for name in private)]
            with self.subTest(header=header):
                self.assertEqual([user for user in users if not user.startswith(tuple(owners))], [])


def needed(executable):
    """Direct dependencies of an executable [names of shared libraries]."""
    text = subprocess.run(["readelf", "-d", executable], capture_output=True, text=True, check=True).stdout
    return re.findall(r"\(NEEDED\).*\[(.+)\]", text)


def loaded(executable):
    """Every shared library that the loader loads, with its file."""
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
        observed("dynamics and recover load no heavy library")

    def test_mesh_links_no_blas(self):
        # Not of its own: gmsh of Debian 13 brings one.
        libraries = needed(self.executable("mesh"))
        self.assertEqual([name for name in libraries if name.startswith(("libblas", "liblapack", "libopenblas"))], [])

    def test_hardC10_only_mesh_links_gmsh(self):
        for stage in ("assembly", "modal", "condense"):
            with self.subTest(stage=stage):
                libraries = loaded(self.executable(stage))
                self.assertEqual([name for name in libraries if name.startswith("libgmsh")], [])
                observed(f"clatter-{stage} links {' '.join(sorted(name.split('.so')[0] for name in needed(self.executable(stage))))}")

    def test_hardN13_programs_of_one_process_load_no_mpi(self):
        for stage in ("assembly", "modal", "condense", "dynamics", "recover"):
            with self.subTest(stage=stage):
                libraries = loaded(self.executable(stage))
                self.assertEqual([name for name in libraries if name.startswith(("libmpi.", "libdmumps-"))], [])
        observed("five programs of one process load neither MPI nor MUMPS")

    def test_hardH6_one_libhdf5_per_executable(self):
        for stage in STAGES:
            with self.subTest(stage=stage):
                found = [name for name in loaded(self.executable(stage)) if re.match(r"libhdf5(_serial|_openmpi)?\.so", name)]
                self.assertEqual(len(found), 1, f"clatter-{stage} loads {found}")
        observed(f"each of {len(STAGES)} programs loads one libhdf5: {found[0]}")

    def test_hardE5_our_eigen_is_not_visible_to_gmsh(self):
        symbols = subprocess.run(["nm", "-D", "-C", "--defined-only", self.executable("mesh")],
                                 capture_output=True, text=True, check=True).stdout
        self.assertEqual([line for line in symbols.splitlines() if "Eigen::" in line], [])
        observed(f"none of {len(symbols.splitlines())} visible symbols of clatter-mesh is of Eigen")

    def test_hardE5_one_set_of_flags_for_all_targets(self):
        commands = BUILD / "compile_commands.json"
        if not commands.exists():
            self.skipTest(f"{commands} is missing")
        flags = {}
        for entry in json.loads(commands.read_text()):
            if entry["file"].endswith("/tools/launch.cpp"):  # shares no type with others, runs on any processor
                continue
            words = entry["command"].split()
            # Flags that change the layout or alignment of types: machine, language, sanitizers. How much is optimized does not.
            layout = frozenset(w for w in words if re.match(r"-(m|std=|fsanitize|f(pack|short|abi)|DEIGEN_|DNDEBUG)", w))
            flags.setdefault(layout, []).append(entry["file"])
        observed(f"{sum(map(len, flags.values()))} sources, {len(flags)} set of flags")
        self.assertEqual(len(flags), 1, "\n".join(f"{sorted(f)}: {files[:3]}" for f, files in flags.items()))


if __name__ == "__main__":
    unittest.main(verbosity=2)
