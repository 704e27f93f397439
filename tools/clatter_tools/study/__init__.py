# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study study.toml`: what the accuracy of any result of a pipeline costs, setting by setting.

The study file names a pipeline, the settings to vary and the quantities of interest:

    pipeline = "."                     # folder with the Makefile, from here; default: the folder of this file
    check = true                       # a run with every setting at its finest value; default true
    cost = "seconds"                   # of the stages, as their files say; or "processor": seconds of processor time on this machine
    reuse = false                      # take artefacts that are up to date over from the pipeline's folder, with their seconds; default false

    [[setting]]
    name = "cell size"
    unit = "mm"                        # optional
    key = "beam.mesh.toml:mesh.element_size_mm"   # or keys = [...], of which a value has one entry each
    values = [40, 30, 20, 15, 10]      # from coarse to fine: the last is the finest; numbers get the base's among them
    base = 15                          # only where the file does not have the key
    reference = "auto"                 # "finest", "richardson", or "auto": Richardson's where the order is clean
    sizes = [4, 3, 2, 1.5, 1]          # step sizes for the order; default: numbers that fall, or the inverse of numbers that rise

    [[quantity]]
    name = "first bending"
    file = "beam.modes.h5"             # as make names it
    take = "frequency"                 # one of quantities.py, with its own keys
    number = 1
    exact = 67.9                       # optional: analytic number, or { file = "other.h5", take = ... } of another program
    unit = "Hz"; error = "relative"    # optional: of what is taken; "absolute"

A key is a file of the pipeline's folder and a path of keys; an entry of a list of tables goes by its name or number
(body.beam.rom, load.0.value). A scene with `base` gets the key itself.

**Variants.** The base is the folder as it is; it is made first, and all quantities are taken from it before anything else is made. One setting at a time takes its values; one more variant has all of them at their
finest. What each variant needs is asked from make (its database of rules); an artefact is known by the digest of everything that
it depends on: the commands that make it, contents of the TOML files after the change, of the files that they name and of the programs, and the digests
of the artefacts that it is made of. Equal digests: made once, for all variants and later studies, in a folder of its own,
`study/made/<artefact>-<digest>/`, by the pipeline's own rules. `study/study.mk` has a rule for each: make -j, CLATTER_LAUNCH,
interrupting and resuming work as with any Makefile. `study/variants/` shows each variant as a folder of links. A line for each artefact that has been
made names the first variant that needs it; warnings are shown, and all that a stage that failed has said, which is otherwise in `.log` beside its artefact.

**Errors.** Along a setting, the error of a value is the difference from the setting's reference: the limit of Richardson's extrapolation
Q(h) = Q* + C h^p, with p from the three finest values, where four values agree about p, otherwise the finest value. The budget adds the
differences of the base over the settings, with their signs, and compares the sum with the run with everything refined.
The total error of a variant, in the diagrams, is against the exact value where there is one, otherwise against that run, less
what Richardson's extrapolation says about the rest. Quantities that are curves (third octaves) have vectors of differences; their size is the largest entry, and
sum and refined run are compared where the run differs most. A variant that could not be made, or has not what a quantity takes, is missing: the finest value that
is there is then the reference, which is said, --within refuses, and the exit code is 3. A number between the tested values that the base has counts as one of them.

pipeline.py asks make, variants.py changes TOML files, store.py makes artefacts, quantities.py reads them, convergence.py has the
numbers, findings.py the sentences, results.py the file, page.py the page, effects.py (with effect_keys.py and effects_page.py) and
proposal.py, place.py and proof.py the options --effects and --within, markdown.py the tables of --markdown.

**Seconds.** Those of stages that ran beside others of the study (-j2, not with CLATTER_LAUNCH) are longer than on an idle machine, and of artefacts that
were taken over (`reuse`) nobody knows: they are shown as "(beside others)", "(taken over)", and no costs are ranked by them. cost = "processor" compares
all that was made here, -j1 measures alike.

Limits: with CLATTER_LAUNCH on other machines processor seconds are not known, cost = "seconds" is. CLATTER_FLAGS (threads) is no part of the digests. A finest value that is its own
reference has no error in the budget: what is beyond it is not seen.
"""
