#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds and errors of radiated sound: the boundary elements of the truck diesel's block once, then a run's sound power,
panels, microphones and WAV file.

Uses block.rom.h5 and slap.run.h5 of samples/truck_diesel (after `make demo`), or of --folder. With several --edges each mesh is
compared with the finest: third octaves and total of the run. Ends with exit code 3 when a limit is exceeded both in wall seconds
and in seconds of all processors (which count on a busy machine): 180 s for the part, 2 s for the run's power, panels, directivity,
microphones and WAV; and beyond 2 % of a point source's power.
"""
import argparse
import os
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

import measured
import page

ROOT = Path(__file__).resolve().parent.parent
CYCLE = "analysis/cycle/sound"
PART_SECONDS, RUN_SECONDS, MONOPOLE_DB = 180.0, 2.0, 10 * np.log10(1.02)
HEAD = ["edges a wavelength", "faces", "frequencies", "part, wall [s]", "part, processor [s]", "peak [MB]", "file [MB]", "point source [dB]",
        "stored far field [dB]", "interpolation [dB]", "run, wall [s]", "run, processor [s]", "power [dB(A)]", "bands from the finest [dB]"]


def processor_seconds(function):
    """Result and seconds of all processors that child processes used."""
    before = os.times()
    result = function()
    after = os.times()
    used = after.children_user + after.children_system - before.children_user - before.children_system
    return result, used


def step_seconds(path, name):
    """Seconds of one step of an artefact."""
    with h5py.File(path) as file:
        steps = [step.decode() for step in file["timing/step"][()]]
        return float(file["timing/seconds"][steps.index(name)])


def part(binary, models, folder, edges, to_hz):
    """The sound file of the block."""
    config, output = folder / f"block_{edges:g}.sound.toml", folder / f"block_{edges:g}.sound.h5"
    config.write_text(f"[skin]\nedges_per_wavelength = {edges:g}\n[grid]\nto_hz = {to_hz:g}\n")
    command = [binary, "sound", models / "block.rom.h5", "-c", config, "-o", output, "--quiet", "--threads", "2"]
    (_, wall, peak), used = processor_seconds(lambda: measured.run(command, folder))
    with h5py.File(output) as file:
        return {"edges": edges, "path": output, "wall": wall, "processor": used, "peak": peak,
                "size": output.stat().st_size / 1e6, "frequencies": len(file["frequency_hz"]),
                **dict(file["certificate"].attrs)}


def recover(binary, models, folder, output, sound):
    """Seconds of all processors for the field file of the run, with or without sound."""
    config = folder / "slap.field.toml"
    config.write_text(sound + "[frames]\non = false\n[lines]\nstrongest = 0\n")
    command = [binary, models / "slap.run.h5", "-c", config, "-o", output, "--quiet", "--threads", "2"]
    return processor_seconds(lambda: measured.run(command, folder))[1]


def run(binary, models, folder, made):
    """Sound of the run, and its WAV file, with that sound file."""
    output = folder / f"slap_{made['edges']:g}.field.h5"
    without = recover(binary, models, folder, folder / "silent.field.h5", "")
    used = recover(binary, models, folder, output, f'sound = "{made["path"]}"\n') - without
    (_, listen, _), listen_used = processor_seconds(
        lambda: measured.run([binary, "listen", output, folder / "slap.wav", "--quiet"], folder))
    with h5py.File(output) as file:
        bands = file[f"{CYCLE}/third_octave/power_db"][()]
        below = file["analysis/cycle/third_octave/upper_hz"][()] <= file[CYCLE].attrs["boundary_elements_to_hz"] * (1 + 1e-9)
        return {"wall": step_seconds(output, "radiated sound") + listen, "processor": used + listen_used, "bands": bands[below],
                "dba": file[CYCLE].attrs["power_dba"], "panels": panels(file)}


def panels(file):
    """(name, level [dB], share) of each panel's sound power."""
    group = file["analysis/cycle/panels"]
    return [(name, group[name].attrs["sound_power_db"], group[name].attrs["sound_power_share"]) for name in group]


def row(made, found, finest):
    deviation = np.abs(found["bands"] - finest["bands"]).max()
    return [f"{made['edges']:g}", f"{made['faces']:.0f}", str(made["frequencies"]), f"{made['wall']:.0f}", f"{made['processor']:.0f}",
            f"{made['peak']:.0f}", f"{made['size']:.0f}", f"{made['monopole_error_db']:.4f}", f"{made['far_field_error_db']:.3f}",
            f"{made['interpolation_error_db']:.3f}", f"{found['wall']:.2f}", f"{found['processor']:.2f}", f"{found['dba']:.2f}",
            f"{deviation:.2f}"]


def exceeded(made, found):
    """What is beyond its limit."""
    wrong = []
    if min(made["wall"], made["processor"]) > PART_SECONDS:
        wrong.append(f"the part took {made['wall']:.0f} s, expected {PART_SECONDS:g}")
    if min(found["wall"], found["processor"]) > RUN_SECONDS:
        wrong.append(f"the run's sound took {found['wall']:.2f} s, expected {RUN_SECONDS:g}")
    if made["monopole_error_db"] > MONOPOLE_DB:
        wrong.append(f"a point source has {made['monopole_error_db']:.3f} dB, expected {MONOPOLE_DB:.3f}")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=Path, default=ROOT / "samples/truck_diesel", help="with block.rom.h5 and slap.run.h5")
    parser.add_argument("--edges", type=float, nargs="+", default=[5.0], help="mean edges a wavelength, the finest last; default 5")
    parser.add_argument("--to-hz", type=float, default=2000.0)
    parser.add_argument("--write", action="store_true", help="put the table into docs/accuracy.md")
    arguments = parser.parse_args()
    binary, models = ROOT / "build/release/bin/clatter-recover", arguments.folder.resolve()
    for name in ("block.rom.h5", "slap.run.h5"):
        if not (models / name).exists():
            sys.exit(f"bench: {models / name}: not found, expected after `make -C samples/truck_diesel {name}`")
    with tempfile.TemporaryDirectory(prefix="clatter-bench-sound-") as scratch:
        folder = Path(scratch)
        made = [part(binary, models, folder, edges, arguments.to_hz) for edges in arguments.edges]
        found = [run(binary, models, folder, one) for one in made]
    lines = page.markdown(HEAD, [row(*pair, found[-1]) for pair in zip(made, found)])
    print("\n".join(lines))
    for name, level, share in found[-1]["panels"]:
        print(f"{name:<20} {f'{level:.1f} dB' if share > 0 else 'takes up power':>15} {100 * share:7.1f} %")
    if arguments.write:
        page.write("sound", lines)
    wrong = [text for pair in zip(made, found) for text in exceeded(*pair)]
    if wrong:
        print("\n".join(f"exceeded: {text}" for text in wrong), file=sys.stderr)
        sys.exit(3)


if __name__ == "__main__":
    main()
