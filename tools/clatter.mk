# SPDX-License-Identifier: GPL-3.0-or-later
# Make rules from TOML files to clatter's artefacts: `include` this file, then name the targets.
#
#   part.mesh.toml -> part.mesh.h5 -> part.fe.h5 (+ part.fe.toml) -> part.rom.h5 (+ part.rom.toml)
#   part.fe.h5 (+ part.modes.toml) -> part.modes.h5;  part.fe.h5, part.rom.h5 -> part.compare.txt
#   part.rom.h5 (+ part.sound.toml) -> part.sound.h5, of use in field.toml
#   part.rom.h5 -> part.mtx, part.inp, part.pch, part.asm, part.op4, part.SID_FEM, part.fem, part.npy, part.flexascii for other programs
#   scene.run.toml -> scene.run.h5 -> scene.field.h5 (+ scene.field.toml, or field.toml for all scenes)
#
# Name the reduced models of a scene: `slap.run.h5: block.rom.h5 piston.rom.h5`. Every other
# file that a stage reads (tables, CAD, base scenes) is in its dependency file after the first run.
# CLATTER_BIN is the folder of the executables; without it PATH is searched. CLATTER_FLAGS is passed to
# every stage (--quiet, --threads 2), CLATTER_MESH_FLAGS to clatter-mesh (--time-limit 0). CLATTER_LAUNCH is
# put before each program: make -j64 CLATTER_LAUNCH="srun -n1 -c1" uses a cluster. An artefact is rebuilt when an input or its stage's program is newer. An
# interrupted run resumes after its last complete cycle. Folders may have blanks and quotes in their names; the stems of files in a
# rule may not have blanks, of which make makes several names.

clatter_tool := $(lastword $(wildcard $(dir $(lastword $(MAKEFILE_LIST)))clatter \
                                      $(dir $(lastword $(MAKEFILE_LIST)))../../bin/clatter))
clatter_program = $(if $(CLATTER_BIN),$(CLATTER_BIN)/clatter-$(1),$(or $(shell command -v clatter-$(1)),\
  $(error clatter-$(1) is not in PATH: install clatter or set CLATTER_BIN to the folder of its programs)))

# Words for the shell, and names as make prerequisites: a folder may have a blank or a quote in its name.
clatter_empty :=
clatter_blank := $(clatter_empty) $(clatter_empty)
clatter_quoted = '$(subst ','\'',$(1))'
clatter_escaped = $(subst $(clatter_blank),\ ,$(1))
# The first prerequisite, and what every stage writes.
clatter_in = $(call clatter_quoted,$<)
clatter_out = -o $(call clatter_quoted,$@) --depfile $(call clatter_quoted,$@.d) $(CLATTER_FLAGS)

# A stage's name as a prerequisite is $(clatter_mesh); what runs it is $(call clatter_run,mesh).
clatter_run = $(CLATTER_LAUNCH) $(call clatter_quoted,$(clatter_$(1)_program))

clatter_mesh_program := $(call clatter_program,mesh)
clatter_assembly_program := $(call clatter_program,assembly)
clatter_modal_program := $(call clatter_program,modal)
clatter_condense_program := $(call clatter_program,condense)
clatter_dynamics_program := $(call clatter_program,dynamics)
clatter_recover_program := $(call clatter_program,recover)
clatter_mesh := $(call clatter_escaped,$(clatter_mesh_program))
clatter_assembly := $(call clatter_escaped,$(clatter_assembly_program))
clatter_modal := $(call clatter_escaped,$(clatter_modal_program))
clatter_condense := $(call clatter_escaped,$(clatter_condense_program))
clatter_dynamics := $(call clatter_escaped,$(clatter_dynamics_program))
clatter_recover := $(call clatter_escaped,$(clatter_recover_program))

.DELETE_ON_ERROR:
.SECONDARY:

%.mesh.h5: %.mesh.toml $(clatter_mesh)
	$(call clatter_run,mesh) $(clatter_in) $(clatter_out) $(CLATTER_MESH_FLAGS)

%.fe.h5: %.mesh.h5 %.fe.toml $(clatter_assembly)
	$(call clatter_run,assembly) $(clatter_in) -c $(call clatter_quoted,$*.fe.toml) $(clatter_out)

# Of reduced parts without a mesh. Before the include: CLATTER_ASSEMBLIES := engine; after it: engine.fe.h5: block.rom.h5 pan.rom.h5
ifneq ($(CLATTER_ASSEMBLIES),)
$(CLATTER_ASSEMBLIES:%=%.fe.h5): %.fe.h5: %.fe.toml $(clatter_assembly)
	$(call clatter_run,assembly) -c $(call clatter_quoted,$*.fe.toml) $(clatter_out)
endif

%.modes.h5: %.fe.h5 %.modes.toml $(clatter_modal)
	$(call clatter_run,modal) $(clatter_in) -c $(call clatter_quoted,$*.modes.toml) $(clatter_out)

%.rom.h5: %.fe.h5 %.rom.toml $(clatter_condense)
	$(call clatter_run,condense) $(clatter_in) -c $(call clatter_quoted,$*.rom.toml) $(clatter_out)

# What a part radiates, for a field.toml with sound = "part.sound.h5": name it as a prerequisite of the fields.
%.sound.h5: %.rom.h5 %.sound.toml $(clatter_recover)
	$(call clatter_run,recover) sound $(clatter_in) -c $(call clatter_quoted,$*.sound.toml) $(clatter_out)

%.sound.h5: %.rom.h5 $(clatter_recover)
	$(call clatter_run,recover) sound $(clatter_in) $(clatter_out)

%.run.h5: %.run.toml $(clatter_dynamics)
	$(call clatter_run,dynamics) $(clatter_in) -o $(call clatter_quoted,$@) --resume --depfile $(call clatter_quoted,$@.d) $(CLATTER_FLAGS)

%.field.h5: %.run.h5 %.field.toml $(clatter_recover)
	$(call clatter_run,recover) $(clatter_in) -c $(call clatter_quoted,$*.field.toml) $(clatter_out)

%.field.h5: %.run.h5 field.toml $(clatter_recover)
	$(call clatter_run,recover) $(clatter_in) -c field.toml $(clatter_out)

# Without a configuration the defaults apply.
%.modes.h5: %.fe.h5 $(clatter_modal)
	$(call clatter_run,modal) $(clatter_in) $(clatter_out)

%.field.h5: %.run.h5 $(clatter_recover)
	$(call clatter_run,recover) $(clatter_in) $(clatter_out)

# Accuracy of a reduced model's lowest modes: frequency errors and MAC, of which part.mac.csv has all pairs.
%.compare.txt: %.fe.h5 %.rom.h5 $(clatter_modal)
	$(call clatter_run,modal) compare $(call clatter_quoted,$*.fe.h5) $(call clatter_quoted,$*.rom.h5) --mac $(call clatter_quoted,$*.mac.csv) $(CLATTER_FLAGS) > $(call clatter_quoted,$@.part)
	mv $(call clatter_quoted,$@.part) $(call clatter_quoted,$@)

# A reduced part for other programs. Matrix Market has three files: the target is a list of them.
clatter_export = $(call clatter_run,condense) export $(clatter_in) $(call clatter_quoted,$@) $(CLATTER_FLAGS)

%.inp: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.pch: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.asm: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.op4: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.SID_FEM: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.fem: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.npy: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.flexascii: %.rom.h5 $(clatter_condense)
	$(clatter_export)

%.mtx: %.rom.h5 $(clatter_condense)
	$(clatter_export)
	ls $(call clatter_quoted,$*.K.mtx) $(call clatter_quoted,$*.M.mtx) $(call clatter_quoted,$*.dofs.tsv) > $(call clatter_quoted,$@)

# A picture of the kind given by the start of its name, from the artefacts that it depends on:
# `pictures/acceleration-dry.png: slap_dry.field.h5`. `clatter plot list` names the kinds.
pictures/%.png: $(clatter_tool)
	$(clatter_tool) plot $(firstword $(subst -, ,$*)) $(filter %.h5,$^) -o $(call clatter_quoted,$@)

-include $(wildcard *.h5.d)
