# SPDX-License-Identifier: GPL-3.0-or-later
# What the oil pan of the whole engine and its joint do to the level, included by the Makefile: `make study-whole -j2`.
.PHONY: study-whole
study-whole: whole.txt
	@cat whole.txt
whole/sweep.mk: engine_whole.run.toml parameters_whole.toml study_whole.mk $(clatter_tool)
	$(clatter_tool) sweep $< time.film_every_deg=0 --parameters parameters_whole.toml -o $(@D) --field engine_whole.field.toml
	touch $@
ifneq (,$(filter study-whole whole.txt,$(MAKECMDGOALS)))
include whole/sweep.mk
endif
$(whole_runs): piston.rom.h5 $(shapes)
whole/base.run.h5: engine_whole.rom.h5
whole/base.field.h5: engine_whole.sound.h5
whole.txt: $(whole_fields) $(clatter_tool)
	$(clatter_tool) collect whole
	$(clatter_tool) slaps whole/sweep.h5 --parameters parameters_whole.toml >$@.part
	$(clatter_tool) report whole | sed -n '/^sound power that leaves/,/^$$/p' >>$@.part
	mv $@.part $@

# Engines with another pan, or another gasket under it [N/mm3].
pans := thickness1 thickness2 loss0.02 loss0.1 oil0 oil28
gaskets := gasket0.5 gasket50 gasket50000
of_whole = $(filter whole/$(1)_%,$(whole_runs) $(whole_fields))
define part_of_whole
$(filter %.run.h5,$(call of_whole,$(1))): whole/$(1)_%.run.h5: engine_whole_$(2)%.rom.h5
$(filter %.field.h5,$(call of_whole,$(1))): whole/$(1)_%.field.h5: engine_whole_$(2)%.sound.h5 engine_whole_$(2)%.field.toml
endef
$(eval $(call part_of_whole,thickness-of-the-pan,thickness))
$(eval $(call part_of_whole,loss-factor-of-its-sheet,loss))
$(eval $(call part_of_whole,oil-in-it,oil))
$(eval $(call part_of_whole,stiffness-of-its-gasket,gasket))
oil_pan_thickness%.mesh.toml: oil_pan.mesh.toml
	sed 's/^thickness = .*/thickness = $*/' $< >$@
oil_pan_thickness%.fe.toml: oil_pan.fe.toml
	cp $< $@
oil_pan_loss%.fe.toml: oil_pan.fe.toml
	sed '/^rho/a loss_factor = $*' $< >$@
oil_pan_oil0.fe.toml: oil_pan.fe.toml
	sed '/^\[\[surface_mass\]\]/,/^area_mass/d' $< >$@
oil_pan_oil%.fe.toml: oil_pan.fe.toml
	sed 's/^area_mass = .*/area_mass = $*/' $< >$@
$(patsubst %,oil_pan_%.fe.h5,$(filter loss% oil%,$(pans))): oil_pan_%.fe.h5: oil_pan.mesh.h5 oil_pan_%.fe.toml $(clatter_assembly)
	$(call clatter_run,assembly) $< -c oil_pan_$*.fe.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(patsubst %,oil_pan_%.rom.h5,$(pans)): %.rom.h5: %.fe.h5 oil_pan.rom.toml $(clatter_condense)
	$(call clatter_run,condense) $< -c oil_pan.rom.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
# The middle of its flange lies half a thickness below the block.
engine_whole_thickness%.fe.toml: engine_whole.fe.toml
	awk -v t=$* '{ sub(/-80\.75\]/, sprintf("%g]", -80 - t / 2)); sub(/oil_pan\.rom/, "oil_pan_thickness" t ".rom") } 1' $< >$@
engine_whole_loss%.fe.toml engine_whole_oil%.fe.toml: engine_whole.fe.toml
	sed 's/"oil_pan.rom.h5"/"$(patsubst engine_whole_%.fe.toml,oil_pan_%.rom.h5,$@)"/' $< >$@
# The tangential stiffness in the same proportion.
engine_whole_gasket%.fe.toml: engine_whole.fe.toml
	awk -v k=$* '/^name = "pan_gasket"/ { own = 1 } /^$$/ { own = 0 } own && /^normal_/ { $$3 = k "e9" } own && /^tang/ { $$3 = k * 0.34 "e9" } 1' $< >$@
whole_engines := $(addprefix engine_whole_,$(pans) $(gaskets))
$(foreach one,$(pans),$(eval engine_whole_$(one).fe.h5: oil_pan_$(one).rom.h5))
$(whole_engines:=.fe.h5): %.fe.h5: block.mesh.h5 %.fe.toml engine_bolts.static.h5 $(parts:=.rom.h5) $(clatter_assembly)
	$(call clatter_run,assembly) $< -c $*.fe.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(whole_engines:=.rom.h5): %.rom.h5: %.fe.h5 engine_whole.rom.toml $(clatter_condense)
	$(call clatter_run,condense) $< -c engine_whole.rom.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(whole_engines:=.sound.h5): %.sound.h5: %.rom.h5 engine_whole.sound.toml $(clatter_recover)
	$(call clatter_run,recover) sound $< -c engine_whole.sound.toml -o $@ --depfile $@.d $(CLATTER_FLAGS)
$(whole_engines:=.field.toml): %.field.toml: engine_whole.field.toml
	sed 's/engine_whole.sound.h5/$*.sound.h5/' $< >$@
