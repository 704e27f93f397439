# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts of the folder of one part; samples/beam has what is general."""

CAD_MESH = """# {stem}: {written}, lengths here are in {unit}; {size} {unit} in all.
name = "{stem}"
kind = "cad"
length_unit = "{unit}"

[cad]
source = {source}
# defeature_below = 0.5      # removes narrower faces: fillets, chamfers, tiny holes

[mesh]
element_size_mm = {element}      # the one number that refines everything

# Names of faces, for couplings, supports, loads and sensors of the .fe.toml: change them to what the faces are.
# `clatter-mesh faces` lists all faces with the lines that select each; `clatter plot faces` draws them.
{surfaces}"""

DECK_MESH = """# The deck's own cells. Make repeats what depends on the deck when it changes; the .fe.toml was written once from it.
name = "{stem}"
kind = "deck"

[deck]
source = {source}
units = "{units}"
"""

DAMPING = """
[damping]
ratio = 0.01               # of critical: a casting with its joints; of one bare part of metal 0.001
at_hz = 1000.0
"""

CAD_FE = """# Material, couplings and sensors. CHANGE: the material; the names of surfaces are those of the .mesh.toml.
length_unit = "{unit}"

[material.steel]
regions = ["solid"]
E_gpa = 210.0
nu = 0.3
rho = 7850.0               # kg/m3
""" + DAMPING + """
# The part is free. CHANGE: where it is bolted down, hold a surface:
# [[support]]
# surface = "plane_1"

# A reference node in the middle of each bore, where a scene joins it with other parts.{couplings}"""

SENSORS = """
# Three points far from each other. CHANGE: to where you measure, the nearest node is taken; the hit is at the first.
"""

SLAP_MAKEFILE = """# Piston slap with and without oil: `clatter run` or make repeats what a newer input affects.
# `make check` compares the reduced models with the full ones.
include $(shell clatter rules)
runs := slap slap_dry
all: $(runs:=.field.h5)
check: block.compare.txt piston.compare.txt
\t@cat $^
.DEFAULT_GOAL := all
.PHONY: all check
$(runs:=.run.h5): block.rom.h5 piston.rom.h5 liner_4.shape.h5 liner_4_bolted.shape.h5 skirt.shape.h5
$(runs:=.field.h5): block.sound.h5

# Shapes that temperatures give to liner and skirt (block_warm.fe.toml, piston_warm.fe.toml), and the bolts of the head to
# the liner (engine_bolts.fe.toml).
%_warm.fe.h5: %.mesh.h5 %_warm.fe.toml $(clatter_assembly)
\t$(call clatter_run,assembly) $< -c $*_warm.fe.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
%_warm.static.h5: %_warm.fe.h5 $(clatter_modal)
\t$(call clatter_run,modal) statics $< --case motored -o $@ --depfile $@.d $(CLATTER_FLAGS)
liner_4.shape.h5: block_warm.static.h5
\t$(call clatter_run,modal) shape $< --surface liner_4_bore -o $@ --depfile $@.d $(CLATTER_FLAGS)
engine_bolts.fe.h5: block.mesh.h5 engine_bolts.fe.toml head.rom.h5 $(clatter_assembly)
\t$(call clatter_run,assembly) $< -c engine_bolts.fe.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
engine_bolts.static.h5: engine_bolts.fe.h5 $(clatter_modal)
\t$(call clatter_run,modal) statics $< --case assembly -o $@ --depfile $@.d $(CLATTER_FLAGS)
liner_4_bolted.shape.h5: engine_bolts.static.h5
\t$(call clatter_run,modal) shape $< --surface liner_4_bore -o $@ --depfile $@.d $(CLATTER_FLAGS)
skirt.shape.h5: piston_warm.static.h5
\t$(call clatter_run,modal) shape $< --surface skirt -o $@ --depfile $@.d $(CLATTER_FLAGS)
"""

REST = {
    "{stem}.rom.toml": """# Craig-Bampton: these sets are retained, modes represent the rest.
# CHANGE: sets that no scene needs can go, but what stays has to hold all rigid motions of the part.
method = "craig-bampton"
boundary = [{names}]
fmax_hz = {fmax}             # of the modes, for {longest} mm of steel or aluminium: results hold to about half of it
""",
    "hit.run.toml": """# A hit at sensor_1. CHANGE: set and component, or hit.csv. Couple other parts by [[body]], [[bushing]], [[mount]].
title = "hit at sensor_1"

[time]
end_s = {end}
output_step_us = {step}
largest_step_us = {step}

[[body]]
name = "{stem}"
rom = "{stem}.rom.h5"

[[load]]
body = "{stem}"
set = "sensor_1"
component = "{component}"
table = "hit.csv"
""",
    "hit.field.toml": """# Velocity of the surface and its spectrum: nothing rotates, so there is no cycle.
body = "{stem}"
cycle = false
# CHANGE: for sound power instead of its estimate; then also `hit.field.h5: {stem}.sound.h5` in the Makefile:
# sound = "{stem}.sound.h5"

[spectrum]
from_hz = 20.0

[[window]]
name = "hit"
from_s = 0.0
to_s = {end}

[frames]
from_s = 0.0
to_s = {frames_end}
step_s = {frames_step}
""",
    "study.toml": """# What accuracy costs: `make study`; tables, diagrams and page are in study/.
cost = "processor"

{mesh_setting}[[setting]]
name = "modes up to"
unit = "Hz"
key = "{stem}.rom.toml:fmax_hz"
values = [{modes}]

[[setting]]
name = "largest step"
unit = "us"
key = "hit.run.toml:time.largest_step_us"
values = [{steps}]

[[quantity]]
name = "frequency 7"        # the first elastic one of a free part
file = "{stem}.rom.h5"
take = "frequency"
number = 7

[[quantity]]
name = "radiated power, estimated"
file = "hit.field.h5"
take = "erp_dba"
""",
    "Makefile": """# `clatter run` or make repeats what a newer input affects.
# `make check` compares the modes of the reduced model with those of the full one.
include $(shell clatter rules)
all: {stem}.rom.h5 hit.field.h5
check: {stem}.compare.txt
\t@cat $<
study:
\t$(clatter_tool) study study.toml -j2
.DEFAULT_GOAL := all
.PHONY: all check study
hit.run.h5: {stem}.rom.h5
""",
}
