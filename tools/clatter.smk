# SPDX-License-Identifier: GPL-3.0-or-later
# Snakemake rules from TOML files to clatter's artefacts, as clatter.mk has them for make:
#
#   part.mesh.toml -> part.mesh.h5 -> part.fe.h5 (+ part.fe.toml) -> part.rom.h5 (+ part.rom.toml)
#   part.fe.h5 (+ part.modes.toml) -> part.modes.h5;  part.fe.h5, part.rom.h5 -> part.compare.txt
#   part.rom.h5 (+ part.sound.toml) -> part.sound.h5
#   scene.run.toml -> scene.run.h5 -> scene.field.h5 (+ scene.field.toml, or field.toml for all scenes)
#
# A Snakefile includes this file and names what it wants:
#
#   include: shell("clatter rules --snakemake", read=True).strip()
#   speeds = clatter_sweep("speeds")     # a folder that `clatter sweep` wrote
#   rule all:
#       input: speeds.fields
#
# Files that a TOML file names (reduced models, sound files, tables, CAD, base scenes) are its rule's inputs without being listed.
# --config: clatter_bin=FOLDER of the executables, else CLATTER_BIN, else PATH; clatter_flags, passed to every stage (--quiet);
# clatter_mesh_flags (--time-limit 0); clatter_launch, put before each program. A stage has one thread, or as many as
# --set-threads condense=4 says.
import os
import pathlib
import shutil
import sys

from snakemake.exceptions import WorkflowError

sys.path.insert(0, os.path.dirname(str(workflow.included_stack[-1].get_path_or_uri())))
from clatter_tools import named_files, sweep_list  # noqa: E402

clatter_launch = config.get("clatter_launch", "")
clatter_flags = config.get("clatter_flags", "")
clatter_mesh_flags = config.get("clatter_mesh_flags", "")
clatter_field_settings = {}  # folder of a sweep: the file.toml of --field


def clatter_program(stage):
    """Path of an executable."""
    folder = config.get("clatter_bin") or os.environ.get("CLATTER_BIN")
    path = os.path.join(folder, f"clatter-{stage}") if folder else shutil.which(f"clatter-{stage}")
    if not path or not os.path.exists(path):
        raise WorkflowError(f"clatter-{stage}: found no such program in {folder or 'PATH'}; install clatter, or give "
                            "--config clatter_bin=FOLDER of its programs")
    return path


class ClatterSweep:
    """Scenes of a folder of `clatter sweep`: names, and the paths of their runs and fields."""

    def __init__(self, folder, names):
        self.names = names
        self.runs = [f"{folder}/{name}.run.h5" for name in names]
        self.fields = [f"{folder}/{name}.field.h5" for name in names]


def clatter_sweep(folder):
    """The scenes that `clatter sweep` listed in a folder; its --field file is used for their fields."""
    names = sweep_list.names(pathlib.Path(folder))
    if names is None:
        raise WorkflowError(f"{folder}: found no sweep.mk, expected that of `clatter sweep base.run.toml key=values -o {folder}`")
    settings = sweep_list.field_settings(pathlib.Path(folder))
    if settings:
        clatter_field_settings[os.path.normpath(folder)] = settings
    return ClatterSweep(os.path.normpath(folder), names)


def clatter_settings(*candidates):
    """The first of these files that exists, as a list of one; an empty list without."""
    return [path for path in candidates if path and os.path.exists(path)][:1]


def clatter_field_file(scene):
    """Settings of clatter-recover for a scene: its own, else those of its sweep, else field.toml."""
    return clatter_settings(f"{scene}.field.toml", clatter_field_settings.get(os.path.dirname(scene)), "field.toml")


def clatter_named(paths, *own):
    """Files that TOML files name, without the inputs that the rule lists itself."""
    found = {name for path in paths for name in named_files.of(path)}
    return sorted(found - {os.path.normpath(path) for path in own})


def clatter_option(wildcards, input):
    """-c and the settings of a rule, where it has some."""
    return ["-c", *input.settings] if input.get("settings") else []


# A deck may include others, which only its dependency file names.
rule mesh:
    input:
        toml="{part}.mesh.toml",
        named=lambda w: sorted({*clatter_named([f"{w.part}.mesh.toml"]), *named_files.of_dependency_file(f"{w.part}.mesh.h5.d")}
                               - {f"{w.part}.mesh.toml"}),
        program=clatter_program("mesh")
    output: "{part}.mesh.h5"
    threads: 1
    shell: "{clatter_launch} {input.program:q} {input.toml:q} -o {output:q} --depfile {output:q}.d --threads {threads} "
           "{clatter_flags} {clatter_mesh_flags}"

rule assembly:
    input:
        mesh="{part}.mesh.h5",
        settings="{part}.fe.toml",
        named=lambda w: clatter_named([f"{w.part}.fe.toml"], f"{w.part}.mesh.h5"),
        program=clatter_program("assembly")
    output: "{part}.fe.h5"
    threads: 1
    shell: "{clatter_launch} {input.program:q} {input.mesh:q} -c {input.settings:q} -o {output:q} --depfile {output:q}.d "
           "--threads {threads} {clatter_flags}"

rule modal:
    input:
        fe="{part}.fe.h5",
        settings=lambda w: clatter_settings(f"{w.part}.modes.toml"),
        program=clatter_program("modal")
    output: "{part}.modes.h5"
    params: option=clatter_option
    threads: 1
    shell: "{clatter_launch} {input.program:q} {input.fe:q} {params.option:q} -o {output:q} --depfile {output:q}.d "
           "--threads {threads} {clatter_flags}"

rule condense:
    input:
        fe="{part}.fe.h5",
        settings="{part}.rom.toml",
        named=lambda w: clatter_named([f"{w.part}.rom.toml"], f"{w.part}.fe.h5"),
        program=clatter_program("condense")
    output: "{part}.rom.h5"
    threads: 1
    shell: "{clatter_launch} {input.program:q} {input.fe:q} -c {input.settings:q} -o {output:q} --depfile {output:q}.d "
           "--threads {threads} {clatter_flags}"

# Accuracy of a reduced model's lowest modes: frequency errors and MAC, of which part.mac.csv has all pairs.
rule compare:
    input:
        fe="{part}.fe.h5",
        rom="{part}.rom.h5",
        program=clatter_program("modal")
    output:
        table="{part}.compare.txt",
        mac="{part}.mac.csv"
    threads: 1
    shell: "{clatter_launch} {input.program:q} compare {input.fe:q} {input.rom:q} --mac {output.mac:q} --threads {threads} {clatter_flags} "
           "> {output.table:q}"

# What a part radiates, for a field.toml with sound = "part.sound.h5".
rule sound:
    input:
        rom="{part}.rom.h5",
        settings=lambda w: clatter_settings(f"{w.part}.sound.toml"),
        program=clatter_program("recover")
    output: "{part}.sound.h5"
    params: option=clatter_option
    threads: 1
    shell: "{clatter_launch} {input.program:q} sound {input.rom:q} {params.option:q} -o {output:q} --depfile {output:q}.d "
           "--threads {threads} {clatter_flags}"

rule dynamics:
    input:
        toml="{scene}.run.toml",
        named=lambda w: clatter_named([f"{w.scene}.run.toml"]),
        program=clatter_program("dynamics")
    output: "{scene}.run.h5"
    threads: 1
    shell: "{clatter_launch} {input.program:q} {input.toml:q} -o {output:q} --resume --depfile {output:q}.d --threads {threads} "
           "{clatter_flags}"

rule recover:
    input:
        run="{scene}.run.h5",
        settings=lambda w: clatter_field_file(w.scene),
        named=lambda w: clatter_named(clatter_field_file(w.scene), f"{w.scene}.run.h5"),
        program=clatter_program("recover")
    output: "{scene}.field.h5"
    params: option=clatter_option
    threads: 1
    shell: "{clatter_launch} {input.program:q} {input.run:q} {params.option:q} -o {output:q} --depfile {output:q}.d "
           "--threads {threads} {clatter_flags}"
