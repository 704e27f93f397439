# SPDX-License-Identifier: GPL-3.0-or-later
# Make rules from TOML files to clatter's artefacts: `include` this file, then name the targets.
#
#   part.mesh.toml -> part.mesh.h5 -> part.fe.h5 (+ part.fe.toml) -> part.rom.h5 (+ part.rom.toml)
#   part.fe.h5 (+ part.modes.toml) -> part.modes.h5;  part.fe.h5, part.rom.h5 -> part.compare.txt
#   part.rom.h5 (+ part.sound.toml) -> part.sound.h5, of use in field.toml
#   part.rom.h5 -> part.mtx, part.inp, part.pch, part.fem for other programs
#   scene.run.toml -> scene.run.h5 -> scene.field.h5 (+ scene.field.toml, or field.toml for all scenes)
#
# Name the reduced models of a scene: `slap.run.h5: block.rom.h5 piston.rom.h5`. Every other
# file that a stage reads (tables, CAD, base scenes) is in its dependency file after the first run.
# CLATTER_BIN is the folder of the executables; without it PATH is searched. CLATTER_FLAGS is passed to
# every stage (--quiet, --threads 2), CLATTER_MESH_FLAGS to clatter-mesh (--time-limit 0). CLATTER_LAUNCH is
# put before each program: make -j64 CLATTER_LAUNCH="srun -n1 -c1" uses a cluster. An artefact is rebuilt when an input or its stage's program is newer. An
# interrupted run resumes after its last complete cycle.

clatter_tool := $(lastword $(wildcard $(dir $(lastword $(MAKEFILE_LIST)))clatter \
                                      $(dir $(lastword $(MAKEFILE_LIST)))../../bin/clatter))
clatter_program = $(if $(CLATTER_BIN),$(CLATTER_BIN)/clatter-$(1),$(or $(shell command -v clatter-$(1)),\
  $(error clatter-$(1) is not in PATH: install clatter or set CLATTER_BIN to the folder of its programs)))

clatter_mesh := $(call clatter_program,mesh)
clatter_assembly := $(call clatter_program,assembly)
clatter_modal := $(call clatter_program,modal)
clatter_condense := $(call clatter_program,condense)
clatter_dynamics := $(call clatter_program,dynamics)
clatter_recover := $(call clatter_program,recover)

.DELETE_ON_ERROR:
.SECONDARY:

%.mesh.h5: %.mesh.toml $(clatter_mesh)
	$(CLATTER_LAUNCH) $(clatter_mesh) $< -o $@ --depfile $@.d $(CLATTER_FLAGS) $(CLATTER_MESH_FLAGS)

%.fe.h5: %.mesh.h5 %.fe.toml $(clatter_assembly)
	$(CLATTER_LAUNCH) $(clatter_assembly) $< -c $*.fe.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

%.modes.h5: %.fe.h5 %.modes.toml $(clatter_modal)
	$(CLATTER_LAUNCH) $(clatter_modal) $< -c $*.modes.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

%.rom.h5: %.fe.h5 %.rom.toml $(clatter_condense)
	$(CLATTER_LAUNCH) $(clatter_condense) $< -c $*.rom.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

# What a part radiates, for a field.toml with sound = "part.sound.h5": name it as a prerequisite of the fields.
%.sound.h5: %.rom.h5 %.sound.toml $(clatter_recover)
	$(CLATTER_LAUNCH) $(clatter_recover) sound $< -c $*.sound.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

%.sound.h5: %.rom.h5 $(clatter_recover)
	$(CLATTER_LAUNCH) $(clatter_recover) sound $< -o $@ --depfile $@.d $(CLATTER_FLAGS)

%.run.h5: %.run.toml $(clatter_dynamics)
	$(CLATTER_LAUNCH) $(clatter_dynamics) $< -o $@ --resume --depfile $@.d $(CLATTER_FLAGS)

%.field.h5: %.run.h5 %.field.toml $(clatter_recover)
	$(CLATTER_LAUNCH) $(clatter_recover) $< -c $*.field.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

%.field.h5: %.run.h5 field.toml $(clatter_recover)
	$(CLATTER_LAUNCH) $(clatter_recover) $< -c field.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

# Without a configuration the defaults apply.
%.modes.h5: %.fe.h5 $(clatter_modal)
	$(CLATTER_LAUNCH) $(clatter_modal) $< -o $@ --depfile $@.d $(CLATTER_FLAGS)

%.field.h5: %.run.h5 $(clatter_recover)
	$(CLATTER_LAUNCH) $(clatter_recover) $< -o $@ --depfile $@.d $(CLATTER_FLAGS)

# Accuracy of a reduced model's lowest modes: frequency errors and MAC, of which part.mac.csv has all pairs.
%.compare.txt: %.fe.h5 %.rom.h5 $(clatter_modal)
	$(CLATTER_LAUNCH) $(clatter_modal) compare $*.fe.h5 $*.rom.h5 --mac $*.mac.csv $(CLATTER_FLAGS) > $@.part
	mv $@.part $@

# A reduced part for other programs. Matrix Market has three files: the target is a list of them.
clatter_export = $(CLATTER_LAUNCH) $(clatter_condense) export $< $@ $(CLATTER_FLAGS)

%.inp: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.pch: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.fem: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.mtx: %.rom.h5 $(clatter_condense)
	$(clatter_export)
	ls $*.K.mtx $*.M.mtx $*.dofs.tsv > $@

# A picture of the kind given by the start of its name, from the artefacts that it depends on:
# `pictures/acceleration-dry.png: slap_dry.field.h5`. `clatter plot list` names the kinds.
pictures/%.png: $(clatter_tool)
	$(clatter_tool) plot $(firstword $(subst -, ,$*)) $(filter %.h5,$^) -o $@

-include $(wildcard *.h5.d)
