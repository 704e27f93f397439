# SPDX-License-Identifier: GPL-3.0-or-later
"""A part that is not ours in `clatter study`: deck beam8f of package calculix-ccx-test, a clamped strip of 8 x 1.5 x 1 mm of 256 C3D8, under a force of
1 N that moves along its thinnest direction's face from the clamp to the free end in 1 ms."""
import pathlib

import calculix_decks

DECK = "beam8f"
STATIONS = 8         # nodes along the strip at which the force acts, 1 mm apart; between two of them it changes over linearly
SECONDS = 1e-3       # that the force takes
CLATTER_MK = pathlib.Path(__file__).resolve().parents[2] / "tools/clatter.mk"
NAMES = [f"at_{k}" for k in range(1, STATIONS + 1)]
X_OF_THE_END = 3 * (STATIONS - 1)  # column of the displacements: three for each node

MESH = f"""name = "strip"
kind = "deck"
[deck]
source = "{DECK}.inp"
units = "mm-t-s"
"""
FE = """length_unit = "mm"
[material.EL]
regions = ["Eall"]
E_gpa = 210.0
nu = 0.3
rho = 7800.0
hex8 = "full"                # as the deck says: C3D8
[damping]
ratio = 0.01
at_hz = 13000.0
[[support]]
node_set = "FIX"
"""
RUN = """title = "1 N moves along the strip in 1 ms"
[time]
end_s = 1e-3
output_step_us = 1.0
largest_step_us = 2.0
[accuracy]
tolerance = 1e-3
displacement_um = 1.0
velocity_m_s = 0.01
[[body]]
name = "strip"
rom = "strip.rom.h5"
"""
STUDY = f"""cost = "processor"

[[setting]]
name = "modes up to"
unit = "Hz"
key = "strip.rom.toml:fmax_hz"
values = [25e3, 50e3, 100e3, 200e3, 500e3, 1000e3]

[[setting]]
name = "element"
key = "strip.fe.toml:material.EL.hex8"
values = ["full", "incompatible"]

[[setting]]
name = "tolerance"
key = "moving.run.toml:accuracy.tolerance"
values = [1e-2, 1e-3, 1e-4, 1e-5]

[[setting]]
name = "largest step"
unit = "us"
key = "moving.run.toml:time.largest_step_us"
values = [8.0, 4.0, 2.0, 1.0, 0.5]

[[quantity]]
name = "first frequency"
file = "strip.rom.h5"
take = "frequency"
number = 1

[[quantity]]
name = "largest deflection of the free end"
file = "moving.run.h5"
take = "dataset"
path = "bodies/strip/q"
column = {X_OF_THE_END}
reduce = "largest"
unit = "m"

[[quantity]]
name = "largest velocity of the free end"
file = "moving.run.h5"
take = "dataset"
path = "bodies/strip/v"
column = {X_OF_THE_END}
reduce = "largest"
unit = "m/s"
"""


def write(folder):
    """Writes the pipeline and study.toml into a folder; returns the path of the study."""
    folder = pathlib.Path(folder)
    sensors = "".join(f'[[sensor]]\nname = "{name}"\nsurface = "skin"\nnear = [1.0, 0.75, {float(k)}]\n' for k, name in enumerate(NAMES, 1))
    loads = "".join(f'[[load]]\nbody = "strip"\nset = "{name}"\ncomponent = "x"\ntable = "moving.csv"\ncolumn = "{name}"\nunit = "N"\n' for name in NAMES)
    quoted = ", ".join(f'"{name}"' for name in NAMES)
    files = {f"{DECK}.inp": calculix_decks.deck_text(DECK), "strip.mesh.toml": MESH, "strip.fe.toml": FE + sensors, "moving.run.toml": RUN + loads,
             "strip.rom.toml": f"boundary = [{quoted}]\nfmax_hz = 200e3\n", "moving.csv": force_table(),
             "Makefile": f"include {CLATTER_MK}\nmoving.run.h5: strip.rom.h5\n", "study.toml": STUDY}
    for name, text in files.items():
        (folder / name).write_text(text)
    return folder / "study.toml"


def force_table():
    """1 N at the station that it reaches, nothing at the others, from the clamp on."""
    rows = [["time [s]", *(f"{name} [N]" for name in NAMES)]]
    for k in range(STATIONS + 1):
        rows.append([f"{k * SECONDS / STATIONS:.10g}", *("1" if k == other else "0" for other in range(1, STATIONS + 1))])
    return "".join(",".join(row) + "\n" for row in rows)
