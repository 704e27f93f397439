# SPDX-License-Identifier: GPL-3.0-or-later
# The studies of this folder, included by its Makefile. Both take up where they were interrupted.

# What the accuracy of the slap costs (study.toml, of its meshes study_mesh.toml): `make study`; pages and tables are in study/ and study_mesh/.
.PHONY: study
study:
	for study in study study_mesh; do $(clatter_tool) study $$study.toml -j2 || exit; done
slap_study.run.h5: block.rom.h5 piston.rom.h5
slap_study.field.h5: slap_study.run.h5 speeds.field.toml block.sound.h5 $(clatter_recover)
	$(call clatter_run,recover) $< -c speeds.field.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)

# Figures 8 to 10 of the paper with four layers of oil and without: `make study-paper -j2`, ten runs.
.PHONY: study-paper
study-paper: study.txt $(addprefix pictures/study-,8.png 9.png 10.png)
	@cat study.txt
paper_oil/sweep.mk: slap.run.toml Makefile study.mk $(clatter_tool)
	$(clatter_tool) sweep $< contact.oil_thickness_um=3,6,12,50 contact.minimum_warm_clearance_um=0,10 time.cycles=3 -o $(@D) --field speeds.field.toml
	touch $@
paper_dry/sweep.mk: slap_dry.run.toml Makefile study.mk $(clatter_tool)
	$(clatter_tool) sweep $< contact.minimum_warm_clearance_um=0,10 time.cycles=3 -o $(@D) --field speeds.field.toml
	touch $@
ifneq (,$(filter study-paper study.txt pictures/study-%,$(MAKECMDGOALS)))
include paper_oil/sweep.mk paper_dry/sweep.mk
endif
$(paper_oil_runs) $(paper_dry_runs): block.rom.h5 piston.rom.h5 $(shapes)
$(paper_oil_fields) $(paper_dry_fields): block.sound.h5
study.txt: $(paper_oil_fields) $(paper_dry_fields) $(clatter_tool)
	$(clatter_tool) collect paper_oil
	$(clatter_tool) collect paper_dry
	$(clatter_tool) slaps paper_oil/sweep.h5 paper_dry/sweep.h5 --csv study.csv >$@.part
	mv $@.part $@
# Liner and block with film; liner with and without oil, 0 and 10 um.
pictures/study-8.png: paper_oil/6_0.field.h5
pictures/study-9.png: paper_oil/6_0.field.h5 paper_dry/0.field.h5
pictures/study-10.png: paper_oil/6_10.field.h5 paper_dry/10.field.h5
pictures/study-%.png: $(clatter_tool)
	$(clatter_tool) plot acceleration $(filter %.h5,$^) -o $@

# What the paper lists as influences, one at a time with 10 um of clearance (parameters.toml): `make study-parameters -j2`, 28 short runs and
# the reduced models that they need.
.PHONY: study-parameters
study-parameters: parameters.txt
	@cat parameters.txt
parameters/sweep.mk: slap_10um.run.toml slap.run.toml parameters.toml Makefile study.mk $(clatter_tool)
	$(clatter_tool) sweep $< time.cycles=2 time.film_every_deg=0 --parameters parameters.toml -o $(@D) --field speeds.field.toml
	touch $@
ifneq (,$(filter study-parameters parameters.txt,$(MAKECMDGOALS)))
include parameters/sweep.mk
endif
$(parameters_runs): block.rom.h5 piston.rom.h5 $(shapes)
$(parameters_fields): block.sound.h5
parameters.txt: $(parameters_fields) $(clatter_tool)
	$(clatter_tool) collect parameters
	$(clatter_tool) slaps parameters/sweep.h5 --parameters parameters.toml --csv parameters.csv --picture pictures/parameters.png >$@.part
	mv $@.part $@

# The reduced models and pressures that they name.
of_parameter = $(filter parameters/$(1)_%,$(parameters_runs))
$(call of_parameter,pin-offset): parameters/pin-offset_%.run.h5: piston_offset%.rom.h5
$(call of_parameter,piston-density): parameters/piston-density_%.run.h5: piston_density%.rom.h5
$(call of_parameter,crown-thickness): parameters/crown-thickness_%.run.h5: piston_crown%.rom.h5
$(call of_parameter,intake-pressure): parameters/intake-pressure_%.run.h5: motored_%bar.csv
$(call of_parameter,fired-load): parameters/fired-load_%.run.h5: fired_%bar.csv
$(call of_parameter,liner-modulus): parameters/liner-modulus_%.run.h5: block_liner%.rom.h5
$(call of_parameter,damping-of-the-block): parameters/damping-of-the-block_%.run.h5: block_damping%.rom.h5
of_parameter_field = $(filter parameters/$(1)_%,$(parameters_fields))
$(call of_parameter_field,liner-modulus): parameters/liner-modulus_%.field.h5: block_liner%.sound.h5 block_liner%.field.toml
$(call of_parameter_field,damping-of-the-block): parameters/damping-of-the-block_%.field.h5: block_damping%.sound.h5 block_damping%.field.toml

# Blocks with another modulus of the liner [GPa] or another damping [% of critical].
study_blocks := block_liner60 block_liner240 block_damping1 block_damping4
block_liner%.fe.toml: block.fe.toml
	sed '/^\[material.liner_iron\]/,/^nu/ s/^E_gpa = .*/E_gpa = $*/' $< >$@
block_damping%.fe.toml: block.fe.toml
	sed 's/^ratio = .*/ratio = 0.0$*/' $< >$@
$(study_blocks:=.fe.h5): %.fe.h5: block.mesh.h5 %.fe.toml $(clatter_assembly)
	$(call clatter_run,assembly) $< -c $*.fe.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(study_blocks:=.rom.h5): %.rom.h5: %.fe.h5 block.rom.toml $(clatter_condense)
	$(call clatter_run,condense) $< -c block.rom.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(study_blocks:=.sound.h5): %.sound.h5: %.rom.h5 block.sound.toml $(clatter_recover)
	$(call clatter_run,recover) sound $< -c block.sound.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(study_blocks:=.field.toml): %.field.toml: speeds.field.toml
	sed 's/block.sound.h5/$*.sound.h5/' $< >$@

# Pistons of another density [kg/m3], crown [mm] or pin offset [mm], without the surfaces of the heat flow.
study_pistons := $(addprefix piston_,density2100 density3300 crown13 crown20 offset-0.5 offset0.5)
plain_piston := sed '/^. Surfaces of the heat flow/,$$d' piston.mesh.toml
$(filter piston_density%,$(study_pistons:=.mesh.toml)): piston_density%.mesh.toml: piston.mesh.toml
	$(plain_piston) >$@
$(filter piston_density%,$(study_pistons:=.fe.toml)): piston_density%.fe.toml: piston.fe.toml
	sed 's/^rho = .*/rho = $*.0/' $< >$@
$(filter piston_crown%,$(study_pistons:=.mesh.toml)): piston_crown%.mesh.toml: piston.mesh.toml
	$(plain_piston) | sed 's/^crown_thickness = .*/crown_thickness = $*.0/' >$@
$(filter piston_crown%,$(study_pistons:=.fe.toml)): piston_crown%.fe.toml: piston.fe.toml
	cp $< $@
$(filter piston_offset%,$(study_pistons:=.mesh.toml)): piston_offset%.mesh.toml: piston.mesh.toml
	$(plain_piston) | sed 's/^pin_offset = .*/pin_offset = $*/' >$@
$(filter piston_offset%,$(study_pistons:=.fe.toml)): piston_offset%.fe.toml: piston.fe.toml
	sed 's/^axis_point = .*/axis_point = [0.0, $(patsubst --%,%,-$*), 0.0]/' $< >$@
$(study_pistons:=.rom.h5): %.rom.h5: %.fe.h5 piston.rom.toml $(clatter_condense)
	$(call clatter_run,condense) $< -c piston.rom.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
motored_%bar.csv: $(clatter_tool)
	$(clatter_tool) motored-cycle --intake-bar $* $@
fired_%bar.csv: $(clatter_tool)
	$(clatter_tool) fired-cycle --imep-bar $* --intake-bar 2.2 $@
