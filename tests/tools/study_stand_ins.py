# SPDX-License-Identifier: GPL-3.0-or-later
"""Stand-ins for the stages, whose errors and seconds are known exactly: a pipeline for tests of `clatter study`."""
import itertools
import os
import pathlib
import shutil
import tempfile
import unittest
import unittest.mock

import h5py

from clatter_command import clatter
from clatter.artefact import schema_of
from clatter_tools.study import run


SOURCE = pathlib.Path(__file__).resolve().parents[2]
STAGES = ("mesh", "assembly", "modal", "condense", "dynamics", "recover")

# What an artefact was made of, lines as "h=2.0", is kept by its inode; the artefacts of all combinations were written before.
STAND_IN = """#!/bin/bash
set -e
inputs=()
while (( $# )); do case $1 in -o) output=$2; shift 2;; --depfile) shift 2;; -*) shift;; *) inputs+=("$1"); shift;; esac; done
declare -A made
take() { while IFS='= ' read -r key value || [[ $key ]]; do case $key=$value in *=-) ;; h=*|n=*|tau=*|both=*) made[$key]=$value;; esac; done; }
for file in $([[ $0 != *dynamics ]] || sed -nE 's/^(base|rom) = "(.*)"/\\2/p' *.run.toml) "${inputs[@]}"; do
  case $file in *.h5) take < "$GIVEN/of-$(stat -Lc %i "$file")";; *) take < "$file";; esac
done
kind=${output%.h5}; kind=${kind##*.}
echo "details of $output"
[ $kind-${made[tau]} = run-0.1 ] && echo "warning: $output is expensive" >&2
[ $kind = run ] && : ${made[both]:=0.0}
[ $kind = run ] && [ -e $GIVEN/wait ] && { echo $$ > $GIVEN/waiting.part; mv $GIVEN/waiting.part $GIVEN/waiting; exec sleep 60; }
[ $kind = run ] && [ -e $GIVEN/fail ] && { echo told to fail >&2; exit 2; }
[ "${made[h]}" = 20.0 ] && { echo too coarse >&2; exit 2; }
of="h=${made[h]} n=${made[n]:--} tau=${made[tau]:--} both=${made[both]:--}"
cp "$GIVEN/$kind $of" "$output.part"
printf '%s\\n' $of > "$GIVEN/of-$(stat -c %i "$output.part")"
mv "$output.part" "$output"
echo "$output $LAUNCHED" >> $GIVEN/calls
"""
SECONDS = {"mesh": lambda h, n, tau: 0.1, "fe": lambda h, n, tau: 1000.0 / h**3, "rom": lambda h, n, tau: 0.5 * n, "run": lambda h, n, tau: 2.0 / tau,
           "field": lambda h, n, tau: 0.25}


MAKEFILE = """include ../tools/clatter.mk
all: slap.field.h5
slap.run.h5: part.rom.h5
"""
STUDY = """
[[setting]]
name = "cell size"
unit = "mm"
key = "part.mesh.toml:mesh.h"
values = [4.0, 2.0, 1.0, 0.5]

[[setting]]
name = "tolerance"
key = "slap.run.toml:accuracy.tau"
values = [0.4, 0.2, 0.1, 0.05]

[[setting]]
name = "modes"
key = "part.rom.toml:basis.n"
values = [1, 2, 4, 8]
reference = "finest"

[[quantity]]
name = "value"
file = "slap.field.h5"
take = "dataset"
path = "result/value"
unit = "N"

[[quantity]]
name = "of the part"
file = "part.rom.h5"
take = "dataset"
path = "result/value"
"""
SMALL = """
[[setting]]
name = "cell size"
unit = "mm"
key = "part.mesh.toml:mesh.h"
values = [2.0, 1.0]

[[setting]]
name = "tolerance"
key = "slap.run.toml:accuracy.tau"
values = [0.2, 0.1]

[[quantity]]
name = "value"
file = "slap.field.h5"
take = "dataset"
path = "result/value"
"""
H, TAU, N = 2.0, 0.2, 2


def write_given(folder, both=0.0, lengths=(4.0, 2.0, 1.0, 0.5), modes=(None, 1, 2, 4, 8), tolerances=(None, 0.4, 0.3, 0.2, 0.1, 0.05, 0.025)):
    """The artefacts of all combinations of values; `both` is an effect of the scene, which makes the run three seconds longer."""
    for h, n, tau in itertools.product(lengths, modes, tolerances):
        value = exact(h, tau or 1.0, n or 1.0, both if tau else 0.0)
        for kind, seconds in SECONDS.items():
            if (kind in ("mesh", "fe")) != (n is None) or (kind in ("run", "field")) != (tau is not None):
                continue
            own = both if kind in ("run", "field") else "-"
            with h5py.File(folder / f"{kind} h={h} n={n or '-'} tau={tau or '-'} both={own}", "w") as file:
                file.attrs["schema"] = schema_of(kind)
                file["result/value"], file["result/curve"] = value, [value, 2.0 * value]
                timing = file.create_group("timing")
                timing.attrs["total_seconds"], timing.attrs["peak_gib"] = seconds(h, n, tau) + 3.0 * (both != 0.0 and kind == "run"), 0.125 * (n or 0)
                if kind == "run":
                    file["effects/name"], file["effects/state"] = ["both", "rings"], ["on" if both else "off", "off"]


def exact(h=H, tau=TAU, n=N, both=0.0):
    return 100.0 + 0.5 * h**2 - 8.0 * tau + 3.0 / n**3 + both * h * tau


class StandIns(unittest.TestCase):
    """A pipeline of one part, and the study of three settings."""
    both = 0.0

    given = None  # the folder of the artefacts, of all classes
    written = set()  # values of `both` of which they are there

    @classmethod
    def setUpClass(cls):
        if StandIns.given is None:
            StandIns.given = pathlib.Path(tempfile.mkdtemp(prefix="clatter-study-"))
            unittest.addModuleCleanup(shutil.rmtree, cls.given)
        for both in {0.0, cls.both} - cls.written:
            write_given(cls.given, both)
            cls.written.add(both)

    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        (self.root / "tools").symlink_to(SOURCE / "tools")
        self.folder, programs = self.root / "pipeline", self.root / "bin"
        for folder in (self.folder, programs):
            folder.mkdir()
        for stage in STAGES:
            (programs / f"clatter-{stage}").write_text(STAND_IN)
            (programs / f"clatter-{stage}").chmod(0o755)
        for name, text in {"Makefile": MAKEFILE, "part.mesh.toml": f"[mesh]\nh = {H}", "part.fe.toml": "",
                           "part.rom.toml": f"[basis]\nn = {N}", "slap.run.toml": 'base = "engine.run.toml"\nrom = "part.rom.h5"',
                           "engine.run.toml": f"[accuracy]\ntau = {TAU}\n[more]\nboth = {self.both}", "field.toml": "", "study.toml": STUDY}.items():
            self.write(name, text)
        self.environment = {**os.environ, "CLATTER_BIN": str(programs), "GIVEN": str(self.given), "MAKEFLAGS": ""}
        patched = unittest.mock.patch.dict(os.environ, self.environment)
        patched.start()
        self.addCleanup(patched.stop)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def calls(self):
        """Calls of stages since the last time."""
        path = self.given / "calls"
        lines = path.read_text().splitlines() if path.exists() else []
        path.unlink(missing_ok=True)
        return lines

    def study(self, jobs=2):
        """The Study; `made`: artefacts of this run."""
        self.calls()
        found = run.make(self.folder / "study.toml", jobs)
        self.made = [line.split(" ")[0] for line in self.calls()]
        return found

    def command(self, *arguments, code=0):
        """Runs the command in the pipeline's folder; returns what it says."""
        done = clatter("study", "study.toml", *arguments, folder=self.folder, environment={"CLATTER_BIN": "../bin"})
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr
