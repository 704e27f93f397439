# SPDX-License-Identifier: GPL-3.0-or-later
"""The beam of samples/beam through all six programs in variants that must not change its physics."""
import os
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

import stability_models as models
import stability_numbers as numbers
from stability_models import Motion

SAMPLE = Path(__file__).resolve().parent.parent / "samples" / "beam"
SIZE = 0.6  # m
TIP = (0.6, 0.02, 0.015)  # reference node of the force [m]
RESPONSE_HZ = (30.0, 69.0, 300.0, 1000.0)  # the second is next to the first resonance
ARTEFACTS = ("mesh", "fe", "modes", "rom", "run", "field")
REFERENCE_BLAS = ("/usr/lib/x86_64-linux-gnu/blas", "/usr/lib/x86_64-linux-gnu/lapack")


class Failed(Exception):
    """A program that did not end with exit code 0; the message is its last line."""


def plain_environment():
    """The environment without what chooses threads and kernels of BLAS."""
    return {key: value for key, value in os.environ.items() if not key.startswith(("OPENBLAS_", "OMP_"))}


@dataclass
class Variant:
    """How programs are run and what is done to the model before."""
    name: str
    threads: int = 1
    environment: dict = field(default_factory=dict)
    bin: Path = None  # programs of another build
    permuted: bool = False
    motion: Motion = None
    units: tuple = None  # name, metre, newton: through a deck in these units

    def stage(self, folder, binaries, stage, *arguments):
        done = subprocess.run([str(word) for word in ((self.bin or binaries) / f"clatter-{stage}", *arguments, "--threads", self.threads, "--quiet")],
                              cwd=folder, capture_output=True, text=True, env={**plain_environment(), **self.environment})
        if done.returncode:
            raise Failed(f"clatter-{stage}: " + (done.stderr.strip().splitlines() or [f"ended with {done.returncode}"])[-1])


def kernel(name):
    return Variant(f"OpenBLAS kernel {name}", environment={"OPENBLAS_CORETYPE": name})


def reference_blas():
    return Variant("reference BLAS and LAPACK", environment={"LD_LIBRARY_PATH": ":".join(REFERENCE_BLAS)})


def threads():
    return [Variant(f"{count} threads", threads=count) for count in (2, 4)]


def motions():
    turned = models.rotation((1.0, 2.0, 3.0), 37.0)
    mirrored = models.rotation((3.0, -1.0, 0.5), 71.0) @ np.diag([1.0, -1.0, 1.0])
    shift = 10 * SIZE * np.array([0.48, -0.6, 0.64])
    return [Variant("nodes and cells permuted", permuted=True),
            Variant("rotated by 37 degrees about (1, 2, 3)", motion=Motion(turned)),
            Variant("shifted by 10 times its length", motion=Motion(shift=shift)),
            Variant("mirrored and rotated", motion=Motion(mirrored)),
            Variant("permuted, mirrored, rotated, shifted", permuted=True, motion=Motion(mirrored, shift))]


def units():
    return [Variant(f"deck in {name}", units=(name, metre, newton))
            for name, metre, newton in (("m-kg-s", 1.0, 1.0), ("mm-t-s", 1e-3, 1.0), ("in-lbfs2/in-s", 0.0254, 4.4482216152605))]


def scales():
    return [Variant(f"lengths and times x {scale:g}", motion=Motion(scale=scale)) for scale in (1e3, 1e-3)]


def run_beam(folder, binaries, variant, mesh=None):
    """Runs the programs in `folder`; the compared numbers. `mesh`: base mesh that is changed; without it the mesh is made."""
    folder.mkdir(parents=True, exist_ok=True)
    motion, text = variant.motion or Motion(), {path.name: path.read_text() for path in SAMPLE.glob("*.toml")}
    if mesh is None:
        (folder / "beam.mesh.toml").write_text(text["beam.mesh.toml"])
        variant.stage(folder, binaries, "mesh", "beam.mesh.toml", "-o", "beam.mesh.h5")
    else:
        shutil.copy(mesh, folder / "beam.mesh.h5")
    if variant.permuted:
        models.permute(folder / "beam.mesh.h5")
    if variant.motion:
        models.move(folder / "beam.mesh.h5", motion)
    load, scale = "tip_force", motion.scale
    text["beam.fe.toml"] = models.moved_text(text["beam.fe.toml"], ("near",), ("force",), motion, at_hz=1 / scale)
    if variant.units:
        load = from_deck(folder, binaries, variant, text)
    text["beam.rom.toml"] = models.moved_text(text["beam.rom.toml"], fmax_hz=1 / scale)
    text["step.run.toml"] = models.moved_text(text["step.run.toml"], end_s=scale, output_step_us=scale, largest_step_us=scale, value=scale**2)
    text["step.run.toml"] += f"\n[accuracy]\ndisplacement_um = {10 * scale!r}\narm_mm = {50 * scale!r}\n"  # the defaults, at this size
    text["step.field.toml"] = models.moved_text(text["step.field.toml"], from_hz=1 / scale, to_hz=1 / scale, from_s=scale, to_s=scale, step_s=scale)
    for name in ("beam.fe", "beam.modes", "beam.rom", "step.run", "step.field"):
        (folder / f"{name}.toml").write_text(text[f"{name}.toml"])
    variant.stage(folder, binaries, "assembly", "beam.mesh.h5", "-c", "beam.fe.toml", "-o", "beam.fe.h5")
    variant.stage(folder, binaries, "modal", "beam.fe.h5", "-c", "beam.modes.toml", "-o", "beam.modes.h5")
    variant.stage(folder, binaries, "condense", "beam.fe.h5", "-c", "beam.rom.toml", "-o", "beam.rom.h5")
    variant.stage(folder, binaries, "dynamics", "step.run.toml", "-o", "step.run.h5")
    variant.stage(folder, binaries, "recover", "step.run.h5", "-c", "step.field.toml", "-o", "step.field.h5")
    return beam_numbers(folder, load, motion)


def from_deck(folder, binaries, variant, text):
    """Replaces mesh, fe.toml and the names in the other texts by those of a deck; the name of its load."""
    unit, metre, newton = variant.units
    point = models.deck(folder / "beam.mesh.h5", folder / "beam.inp", metre, newton, TIP)
    variant.stage(folder, binaries, "mesh", "beam.inp", "--units", unit, "-o", "beam.mesh.h5", "--recipe", "deck.fe.toml")
    damping = text["beam.fe.toml"].split("[damping]")[1].split("[[")[0]
    sensor = text["beam.fe.toml"].split("[[sensor]]")[1].split("[[")[0].replace("z_max", "skin")
    text["beam.fe.toml"] = (folder / "deck.fe.toml").read_text() + f"\n[damping]{damping}\n[[sensor]]{sensor}"
    load = "step_1_force"
    text["beam.rom.toml"] = text["beam.rom.toml"].replace('"tip"', f'"point_{point}"')
    text["step.run.toml"] = text["step.run.toml"].replace("tip_force", load)
    return load


def beam_numbers(folder, load, motion):
    at = "analysis/swing"
    found = {**numbers.mass_numbers(folder / "beam.fe.h5", motion), **numbers.reduced_numbers(folder / "beam.rom.h5", motion),
             **numbers.response_numbers(folder / "beam.rom.h5", load, "sensor_tip", RESPONSE_HZ, motion),
             **numbers.energy_residue(folder / "step.run.h5"), **numbers.radiated_numbers(folder / "step.field.h5", at, "skin", motion)}
    with h5py.File(folder / "beam.modes.h5") as modes:
        found["full_hz"] = modes["frequency_hz"][()] * motion.scale
        found["full_count"] = np.array([modes["certificate"].attrs["count_below"], modes["certificate"].attrs["count_proved"]])
    with h5py.File(folder / "step.field.h5") as file:
        found["tip"] = motion.direction_back(file[f"{at}/sensors/sensor_tip/displacement"][()]) / motion.scale
    files = dict(zip(ARTEFACTS, ("beam.mesh", "beam.fe", "beam.modes", "beam.rom", "step.run", "step.field")))
    found["bits"] = np.array([numbers.digest(folder / f"{name}.h5") for name in files.values()])
    return found


def beam_differences(found, base):
    """Largest differences of a variant from the base, relative unless the name says otherwise."""
    return {
        "mass": max(numbers.relative(found["mass"], base["mass"]), float(np.abs(found["centre"] - base["centre"]).max()) / SIZE,
                    numbers.largest(found["inertia"], base["inertia"])),
        "full_hz": numbers.relative(found["full_hz"], base["full_hz"]),
        "reduced_hz": numbers.relative(found["reduced_hz"], base["reduced_hz"]),
        "counts": bool(np.array_equal(found["counts"], base["counts"]) and np.array_equal(found["full_count"], base["full_count"])),
        "static": numbers.largest(found["static"], base["static"]),
        "response": max(numbers.largest(a, b) for a, b in zip(found["response"], base["response"])),
        "tip": numbers.largest(found["tip"], base["tip"]),
        "erp": numbers.relative(found["erp"], base["erp"]),
        "bands_db": numbers.band_difference(found["bands"], base["bands"]),
        "residue": numbers.absolute(found["residue"], base["residue"]),
    }
