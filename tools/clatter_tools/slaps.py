# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter slaps`: what the runs of sweeps say about a slap, ranked, or by parameter, as a table, CSV and picture."""
import csv
import dataclasses
import math

import numpy as np

from clatter.artefact import BadArtefact, dataset, open_artefact, text
from . import parameters
from .whole_file import whole_file

HEAD = ("slap after FTDC [ms]", "rings until [ms]", "liner peak [m/s²]", "block peak [m/s²]", "liner rms above 2 kHz [m/s²]")
BANDS_FROM_HZ, BANDS_TO_HZ = 280.0, 5700.0
# The level by which runs are ranked: (name, dataset of its sweep), the first that the sweep has.
LEVELS = (("sound power", "sound/power/level_dba"), ("ERP", "panels/exposed/level_dba"))


@dataclasses.dataclass
class Row:
    """A run: its level [dB(A)] and what that is, figures of the slap in SI, third octaves by sensor [dB], seconds of run and field."""
    name: str
    title: str
    level: str
    dba: float
    slap: dict
    bands: dict
    mid_hz: np.ndarray
    seconds: float

    def cells(self):
        figures = [1e3 * self.slap["time"], 1e3 * self.slap["rings_until"], self.slap["peak"], self.slap["block_peak"], self.slap["high_rms"]]
        return [f"{self.dba:.1f}"] + [f"{value:.2f}" for value in figures[:2]] + [f"{value:.3g}" for value in figures[2:]]


def add_arguments(command):
    """Declares the arguments of `clatter slaps`."""
    command.add_argument("files", nargs="+", metavar="sweep.h5", help="of `clatter collect`, with sensors of liner and block; without sound power by the ERP")
    command.add_argument("--parameters", metavar="file.toml", help="that of `clatter sweep --parameters`: levels by parameter instead of a ranking")
    command.add_argument("--csv", metavar="file.csv", help="all numbers, third octaves as well")
    command.add_argument("--picture", metavar="file", help="with --parameters: level and liner peak over each of them, SVG or PNG")


def rows_of(path):
    """[Row] of the complete runs of a sweep file."""
    with open_artefact(path, "sweep") as sweep:
        level, at = next(((name, at) for name, at in LEVELS if at in sweep), ("", ""))
        if "slap/peak" not in sweep or not at:
            raise BadArtefact(f"{path}: found no {'level' if 'slap/peak' in sweep else 'slap'}, expected fields with sensors of liner and block, "
                              "and sound power or the panel exposed")
        numbers = {name: dataset(sweep, f"slap/{name}") for name in ("time", "rings_until", "peak", "block_peak", "high_rms")}
        bands = {part: dataset(sweep, f"slap/{part}_db") for part in ("liner", "block")}
        dba, cost = dataset(sweep, at), dataset(sweep, "cost")
        names, titles = dataset(sweep, "name"), dataset(sweep, "title")
        return [Row(text(names[k]), text(titles[k]), level, float(dba[k]), {name: float(values[k]) for name, values in numbers.items()},
                    {part: levels[k] for part, levels in bands.items()}, dataset(sweep, "slap/mid_hz"), float(cost[k, 0] + cost[k, 2]))
                for k in range(len(names)) if np.isfinite(dba[k]) and np.isfinite(numbers["peak"][k])]


def table(head, rows):
    """Lines of a table with aligned columns: the first is text, others are numbers as text."""
    widths = [max(len(str(row[i])) for row in [head, *rows]) for i in range(len(head))]
    return ["  ".join(str(cell).ljust(width) if i == 0 else str(cell).rjust(width) for i, (cell, width) in enumerate(zip(row, widths))).rstrip()
            for row in [head, *rows]]


def head(rows):
    """Of the columns of Row.cells()."""
    return [f"{rows[0].level} [dB(A) re 1 pW]", *HEAD]


def ranking(rows):
    """Lines: the runs by their level, the quietest first, and their third octaves."""
    ranked = sorted(rows, key=lambda row: row.dba)
    lines = [f"runs by {rows[0].level}, the quietest first; accelerations above 300 Hz around firing TDC"]
    lines += table(["run", *head(rows)], [[row.title, *row.cells()] for row in ranked])
    for part in ("liner", "block"):
        shown = (ranked[0].mid_hz > BANDS_FROM_HZ) & (ranked[0].mid_hz < BANDS_TO_HZ)
        lines += ["", f"third octaves of the acceleration of the {part} over the cycle [dB re 1e-6 m/s²], by mid frequency [Hz]"]
        lines += table(["run", *(f"{mid:.0f}" for mid in ranked[0].mid_hz[shown])],
                       [[row.title, *(f"{level:.1f}" for level in row.bands[part][:len(shown)][shown])] for row in ranked])
    return lines


@dataclasses.dataclass
class Influence:
    """A parameter with its runs by ascending value, the base among them where the parameter says its value."""
    parameter: parameters.Parameter
    values: list
    rows: list

    def range_db(self):
        return max(row.dba for row in self.rows) - min(row.dba for row in self.rows)


def influences(rows, found):
    """[Influence], the largest change of the level first; `found`: the parameters."""
    by_name = {row.name: row for row in rows}
    result = []
    for one in found:
        pairs = [(value, by_name.get(one.scene(value))) for value in one.values]
        if one.base is not None and parameters.BASE in by_name:
            pairs.append((one.base, by_name[parameters.BASE]))
        pairs = [(value, row) for value, row in pairs if row]
        if pairs and all(isinstance(value, (int, float)) for value, _ in pairs):
            pairs.sort(key=lambda pair: pair[0])
        if len(pairs) > 1:
            result.append(Influence(one, [value for value, _ in pairs], [row for _, row in pairs]))
    if not result:
        raise BadArtefact("slaps: found no run of the parameters, expected the sweep of this file of parameters")
    return sorted(result, key=lambda one: -one.range_db())


def by_parameter(found):
    """Lines: the parameters by the change of the level that they make; `found`: influences()."""
    level = found[0].rows[0].level
    lines = [f"one parameter at a time, by the change of {level}; accelerations above 300 Hz around firing TDC"]
    cells = []
    for one in found:
        for value, row in zip(one.values, one.rows):
            cells.append([f"{one.parameter.label()} {value}{' (base)' * (row.name == parameters.BASE)}", *row.cells()])
    lines += table(["parameter", *head(found[0].rows)], cells)
    lines += ["", f"range of {level} [dB]"]
    return lines + table(["parameter", "range"], [[one.parameter.label(), f"{one.range_db():.1f}"] for one in found])


def write_csv(path, rows):
    """All numbers of the rows, complete or not at all."""
    mid = rows[0].mid_hz
    columns = ["name", "title", head(rows)[0], "slap [s]", "rings until [s]", "liner peak [m/s2]", "block peak [m/s2]",
            "liner rms above 2 kHz [m/s2]", "seconds"] + [f"{part} {hz:.4g} Hz [dB re 1e-6 m/s2]" for part in ("liner", "block") for hz in mid]
    with whole_file(path) as temporary, open(temporary, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream)
        writer.writerow(columns)
        for row in rows:
            numbers = [row.dba, *(row.slap[name] for name in ("time", "rings_until", "peak", "block_peak", "high_rms")), row.seconds]
            levels = [level for part in ("liner", "block") for level in row.bands[part][:len(mid)]]
            writer.writerow([row.name, row.title, *(f"{value:.6g}" for value in [*numbers, *levels])])


def write_slaps(options):
    """`clatter slaps`: prints the table; writes CSV and picture."""
    rows = [row for path in options.files for row in rows_of(path)]
    if not rows:
        raise BadArtefact(f"{', '.join(options.files)}: found no complete run with a level, expected at least one")
    if len({row.level for row in rows}) > 1:
        raise BadArtefact(f"{', '.join(options.files)}: found some with sound power and some with ERP alone, expected the same of all")
    if options.picture and not options.parameters:
        raise BadArtefact(f"--picture: found {options.picture}, expected it with --parameters only")
    if options.parameters:
        found = influences(rows, parameters.read(options.parameters))
        lines = by_parameter(found)
    else:
        lines = ranking(rows)
    seconds = math.fsum(row.seconds for row in rows if np.isfinite(row.seconds))
    print("\n".join([*lines, "", f"{len(rows)} runs, {seconds:.0f} s of runs and fields"]))
    if options.csv:
        write_csv(options.csv, rows)
    if options.picture:
        from .plots import influence, style  # which load matplotlib
        style.apply()
        style.save(influence.picture(found), options.picture)
