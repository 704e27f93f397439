# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter collect`: levels, orders, slaps and cost of all runs of a sweep in one file."""
import pathlib
import tomllib

import h5py
import numpy as np

from clatter import artefact, chains, fields
from clatter.artefact import BadArtefact, schema_of, text
from . import orders, slap_rows, sweep_list
from .export.patient_file import PatientFile
from .whole_file import whole_file

UNFINISHED = ("failed", "interrupted", "refused")


def add_arguments(command):
    """Declares the arguments of `clatter collect`."""
    command.add_argument("folder", help="of the scenes of `clatter sweep`, with their runs and fields")
    command.add_argument("-o", "--output", metavar="sweep.h5", help="default: sweep.h5 in the folder")


def flat(table, prefix=""):
    """{dotted key: value} of nested tables."""
    found = {}
    for key, value in table.items():
        name = f"{prefix}.{key}" if prefix else key
        found.update(flat(value, name) if isinstance(value, dict) else {name: value})
    return found


def scenes(folder):
    """[(name, title, {changed key: value})] of the scenes of the last sweep into a folder, numbers in order. Scenes that sweep.mk does not
    list are of an earlier sweep, and make does not run them again when their base changes."""
    found, names = [], sweep_list.names(folder)
    for path in folder.glob("*.run.toml"):
        if names is not None and path.name.removesuffix(".run.toml") not in names:
            continue
        with open(path, "rb") as stream:
            try:
                table = tomllib.load(stream)
            except tomllib.TOMLDecodeError as error:
                raise BadArtefact(f"{path}: not TOML: {error}") from error
        name = path.name.removesuffix(".run.toml")
        found.append((name, str(table.get("title", name)), flat({k: v for k, v in table.items() if k not in ("base", "title")})))
    if not found:
        raise BadArtefact(f"{folder}: found no scene, expected those of `clatter sweep`")
    return sorted(found, key=lambda scene: ([value if isinstance(value, (int, float)) else 0.0 for value in scene[2].values()], scene[0]))


def state_of(folder, name):
    """"complete", "failed", "interrupted", "refused" or "missing": what happened last, since a run that fails leaves an older one as it is."""
    files = {"complete": folder / f"{name}.run.h5", **{state: folder / f"{name}.run.{state}.h5" for state in UNFINISHED}}
    times = {state: path.stat().st_mtime_ns for state, path in files.items() if path.exists()}
    return max(times, key=times.get) if times else "missing"


def of_histories(path):
    """({history: spectrum}, cost) of the sprockets' speeds in a run."""
    with artefact.open_artefact(path, "run") as run:
        found = {}
        for chain in chains.names(run):
            for name in run["history"]:
                if name.startswith(f"{chain}_") and name.endswith("_speed") and chains.complete_cycles(chains.crank_angle(run)):
                    found[f"histories/{name}"] = orders.of_run(run, name)
        return found, artefact.totals(run)


def of_field(path):
    """({sensors/label, panels/name or sound/power: spectrum}, {panels/name, sound/power: levels_of()}, cycles, cost) of a field file: over its cycle,
    or the mean over several."""
    with artefact.open_artefact(path, "field") as field:
        cycles = fields.mean_of_cycles(field)[1]
        at = orders.piece(field, None)
        if at not in field:
            return {}, {}, np.nan, artefact.totals(field)
        found, levels = {}, {}
        for sensor in fields.sensor_names(field, at):
            for label in field[f"{at}/sensors/{sensor}/labels"][()]:
                found[f"sensors/{text(label)}"] = orders.of_field(field, text(label))
        for panel in field[f"{at}/panels"]:
            found[f"panels/{panel}"] = orders.of_panel(field, panel)
            levels[f"panels/{panel}"] = levels_of(field[f"{at}/panels/{panel}"], "erp")
        if f"{at}/sound" in field:
            found["sound/power"] = orders.of_sound(field)
            levels["sound/power"] = levels_of(field[f"{at}/sound"], "power")
        return found, levels, cycles, artefact.totals(field)


def levels_of(group, name):
    """(dB, dB(A), standard errors of both, nan of one cycle)."""
    return *(group.attrs[f"{name}_{unit}"] for unit in ("db", "dba")), *(fields.standard_error(group, name, unit) for unit in ("db", "dba"))


class Sweep:
    """What is known of all runs: rows in the order of the scenes, nan where nothing is known."""

    def __init__(self, folder):
        self.scenes = scenes(folder)
        self.states = [state_of(folder, name) for name, *_ in self.scenes]
        self.spectra = [{} for _ in self.scenes]
        self.levels = [{} for _ in self.scenes]
        self.slaps = [{} for _ in self.scenes]
        self.cycles = np.full(len(self.scenes), np.nan)  # of which levels are means
        self.cost = np.full((len(self.scenes), 2, 2), np.nan)  # of run and field: seconds, peak GiB
        for row, (name, *_) in enumerate(self.scenes):
            run, field = (folder / f"{name}.{kind}.h5" for kind in ("run", "field"))
            if self.states[row] == "complete":
                self.spectra[row], self.cost[row, 0] = of_histories(run)
            if field.exists() and self.states[row] == "complete":
                found, self.levels[row], self.cycles[row], self.cost[row, 1] = of_field(field)
                self.spectra[row].update(found)
                with artefact.open_artefact(field, "field") as file:
                    self.slaps[row] = slap_rows.of_field(file)

    def speeds(self):
        """Of the crank [rpm], nan where nothing turns or ran."""
        return np.array([next((spectrum[0] for spectrum in one.values()), np.nan) for one in self.spectra])

    def table(self, name):
        """(RMS by run and half order, unit) of one quantity."""
        rows = [one.get(name) for one in self.spectra]
        width = max(len(row[1]) for row in rows if row)
        values = np.full((len(rows), width), np.nan)
        for k, row in enumerate(rows):
            if row:
                values[k, :len(row[2])] = row[2]
        return values, next(row[3] for row in rows if row)


def write(sweep, path):
    """Writes the file, complete or not at all."""
    with whole_file(path) as part, PatientFile(part) as stream:
        try:
            with h5py.File(stream, "w") as file:
                fill(sweep, file)
        finally:
            stream.check()


def fill(sweep, file):
    """The datasets of docs/formats.md."""
    def put(name, values, unit, meaning):
        values = np.asarray(values)
        if values.dtype.kind in "US":
            values = values.astype("S")
        one = file.create_dataset(name, data=values, fletcher32=True)
        one.attrs["unit"], one.attrs["meaning"] = np.bytes_(unit), np.bytes_(meaning)

    file.attrs["schema"] = np.bytes_(schema_of("sweep"))
    put("name", [name for name, *_ in sweep.scenes], "1", "scenes, a row of all other datasets each")
    put("title", [title.encode() for _, title, _ in sweep.scenes], "1", "titles of the scenes")
    put("state", sweep.states, "1", "complete, failed, interrupted, refused or missing")
    put("speed_rpm", sweep.speeds(), "1/min", "mean speed of the crank")
    put("cycles", sweep.cycles, "1", "cycles of which levels and spectra are means")
    put("cost", sweep.cost.reshape(len(sweep.scenes), 4), "s, GiB, s, GiB", "seconds and peak memory of run and field")
    for key in sorted({key for *_, keys in sweep.scenes for key in keys}):
        values = [keys.get(key, np.nan) for *_, keys in sweep.scenes]
        numbers = all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values)
        put(f"keys/{key}", np.array(values, float) if numbers else [str(value) for value in values], "as in the scene", "value of the key")
    names = sorted({name for one in sweep.spectra for name in one})
    width = 0
    for name in names:
        values, unit = sweep.table(name)
        width = max(width, values.shape[1])
        put(f"{name}/rms", values, unit, "RMS by run and half order of the crank; of panels the root of the ERP, of sound that of its power")
    for name in sorted({name for one in sweep.levels for name in one}):
        rows = np.array([one.get(name, (np.nan,) * 4) for one in sweep.levels])
        what = "sound power" if name == "sound/power" else "equivalent radiated power"
        put(f"{name}/level_db", rows[:, 0], "dB re 1 pW", f"{what} of the cycle, or of the mean over `cycles`")
        put(f"{name}/level_dba", rows[:, 1], "dB(A) re 1 pW", "the same, A-weighted")
        for column, unit in ((2, "db"), (3, "dba")):
            put(f"{name}/standard_error_{unit}", rows[:, column], "dB", f"standard error of level_{unit}, nan of one cycle")
    slap_rows.fill(sweep.slaps, put)
    put("order", 0.5 * np.arange(width), "1", "half orders, columns of rms")


def write_collection(options):
    """`clatter collect`: the file, and what is complete."""
    folder = pathlib.Path(options.folder)
    if not folder.is_dir():
        raise BadArtefact(f"{folder}: no such folder")
    sweep = Sweep(folder)
    path = pathlib.Path(options.output or folder / "sweep.h5")
    write(sweep, path)
    counts = {state: sweep.states.count(state) for state in dict.fromkeys(sweep.states)}
    print(f"{path}: {len(sweep.scenes)} runs, " + ", ".join(f"{count} {state}" for state, count in counts.items()))
    for state in (*UNFINISHED, "missing"):
        names = [name for (name, *_), one in zip(sweep.scenes, sweep.states) if one == state]
        if names:
            print(f"{state}: {', '.join(names)}")
