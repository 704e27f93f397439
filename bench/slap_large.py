# SPDX-License-Identifier: GPL-3.0-or-later
"""The full sample of piston slap at engine size: a block of 700 000 DoF reduced to 600 liner patches and 300 modes.

One piston: all 600 patches are on liner 4. Four pistons: 150 patches on each of the four liners, 600 in total. Scenes:
idle (800 rpm) in mixed lubrication on 2 x (32 x 24) film cells, warm shapes of liner and skirt, the oil remembered on the
liner with splash and oil ring. Models are kept in the folder: a second call makes only what is missing.
"""
import re
import shutil
import subprocess
import sys
from pathlib import Path

SAMPLE = Path(__file__).resolve().parent.parent / "samples" / "truck_diesel"
SHAPES = ["liner_4.shape.h5", "liner_4_bolted.shape.h5", "skirt.shape.h5"]
STRIPS_ROWS = {1: (10, 30), 4: (5, 15)}  # strips of a sector and rows: 2 sectors, 600 patches in total
PARTS = {1: "block", 4: "engine"}
CLEARANCE_UM = {1: 0.0, 4: 10.0}  # smallest warm gap; two of four pistons start at bottom dead centre, where it is smallest

LINER_OIL = """[contact.liner_oil]
splash_um_s = 100.0
splash_thickness_um = 10.0
most_um = 50.0

[[contact.ring]]
height_mm = 42.0
face_radius_mm = 15.0
load_n_mm = 0.5
least_um = 0.2
"""


def shapes(clearance_um, folder="."):
    """[contact] with the shapes of full load, about as in slap_warm.run.toml."""
    liner, bolted, skirt = (Path(folder) / name for name in SHAPES)
    return f"""[contact]
minimum_warm_clearance_um = {clearance_um}
barrel_apex_mm = -5.0
barrel_top_um = 80.0
barrel_bottom_um = 25.0
[[contact.bore_shape]]
file = "{liner}"
case = "thermal"
[[contact.bore_shape]]
file = "{bolted}"
case = "assembly"
[[contact.skirt_shape]]
file = "{skirt}"
case = "thermal"
"""


def changed(name, *changes):
    """The text of a file of the sample with the lines that match each pattern replaced."""
    text = (SAMPLE / name).read_text()
    for pattern, new in changes:
        text, count = re.subn(f"(?m)^{pattern}$", new, text)
        if count == 0:
            sys.exit(f"bench: {name} has no line {pattern}")
    return text


def write(path, text):
    """Writes a file unless it has this text, so that its time says when it changed."""
    if not path.exists() or path.read_text() != text:
        path.write_text(text)


def make(folder, program, inputs, output, *words):
    """Runs a program unless its output is newer than all inputs."""
    made = folder / output
    if made.exists() and all(made.stat().st_mtime >= (folder / name).stat().st_mtime for name in inputs):
        return
    print(f"bench: {output}", file=sys.stderr, flush=True)
    done = subprocess.run([str(program), *words, "-o", output, "--quiet"], cwd=folder, capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"bench: {done.stderr.strip()}")


def models(folder, binaries, pistons):
    """The reduced block for one or four pistons, and the files of the sample that the scenes need."""
    strips, rows = STRIPS_ROWS[pistons]
    part = PARTS[pistons]
    write(folder / "block.mesh.toml", changed("block.mesh.toml", ("elements_per_turn = .*", "elements_per_turn = 40"),
                                              ("element_size_mm = .*", "element_size_mm = 9.85")))
    write(folder / f"{part}.fe.toml", changed(f"{part}.fe.toml", ("rows = .*", f"rows = {rows}"),
                                              ("strips = .*", f"strips = {strips}")))
    write(folder / f"{part}.rom.toml", changed(f"{part}.rom.toml", ("fmax_hz = .*", "count = 300\nfrequency_error = 0.0"),
                                               ("skin = .*", "skin = []")))
    make(folder, binaries / "clatter-mesh", ["block.mesh.toml"], "block.mesh.h5", "block.mesh.toml")
    make(folder, binaries / "clatter-assembly", ["block.mesh.h5", f"{part}.fe.toml"], f"{part}.fe.h5",
         "block.mesh.h5", "-c", f"{part}.fe.toml")
    make(folder, binaries / "clatter-condense", [f"{part}.fe.h5", f"{part}.rom.toml"], f"{part}.rom.h5",
         f"{part}.fe.h5", "-c", f"{part}.rom.toml")
    for name in ["piston.rom.h5", "motored.csv", "slap.run.toml", "slap_mixed.run.toml",
                 "engine.run.toml", *SHAPES]:
        if not (SAMPLE / name).exists():
            sys.exit(f"bench: {SAMPLE / name} is missing: make demo")
        shutil.copy2(SAMPLE / name, folder / name)


def scene(folder, binaries, pistons):
    """Makes the models; the path of a scene, the base of those that change a setting."""
    models(folder, binaries, pistons)
    text = 'base = "slap_mixed.run.toml"\n'
    if pistons == 4:
        engine = (SAMPLE / "engine.run.toml").read_text()
        text += re.sub(r"(?m)^(base|title) = .*\n", "", engine.split("[[recorded_force]]")[0])
    path = folder / f"pistons_{pistons}.run.toml"
    grid = "[contact]\ncells_around = 32\ncells_along = 24\n"
    path.write_text(text + shapes(CLEARANCE_UM[pistons]).replace("[contact]\n", grid, 1) + LINER_OIL)
    return path


if __name__ == "__main__":  # only the models
    into = Path(sys.argv[1])
    into.mkdir(parents=True, exist_ok=True)
    for number in (1, 4):
        print(scene(into, Path(sys.argv[2]), number))
