# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter drive` and `clatter orders`: pictures of a chain drive, orders over the speed of several runs."""
import pathlib

import numpy as np

from clatter import chains
from clatter.artefact import BadArtefact, open_artefact, schema_of, stem, text
from . import orders

FAINT = 1e-3  # of all orders together: of less no speed is named
ORDERS = (1.5, 3.0, 4.5, 20.0, 40.0)  # of a three-cylinder engine, and the teeth of a crank sprocket with 20


def add_arguments(commands):
    """Declares both commands."""
    one = commands.add_parser("drive", help="draw all pictures of a chain drive: its run as still, animation, curves")
    one.add_argument("file", metavar="run.h5")
    one.add_argument("-o", "--output", metavar="folder", help="folder of the pictures; default: the run's name")
    one.add_argument("--format", choices=("svg", "png"), default="svg", help="of the pictures; default svg")
    one.add_argument("--frames", type=int, default=0, metavar="N", help="also write N frames of one cycle as PNG, for a video")
    one = commands.add_parser("orders", help="draw the orders of a run, or Campbell diagram and order cuts of runs at several speeds")
    one.add_argument("files", nargs="+", metavar="file.h5", help="runs, fields, or what `clatter collect` has made of them")
    what = one.add_mutually_exclusive_group(required=True)
    what.add_argument("--history", metavar="NAME", help="of run files")
    what.add_argument("--sensor", metavar="LABEL", help="of field files: a channel's acceleration, as sensor_arm.x")
    what.add_argument("--panel", metavar="NAME", help="of field files: a panel's equivalent radiated power, as exposed")
    what.add_argument("--sound", action="store_true", help="of field files: the sound power")
    one.add_argument("--window", metavar="NAME", help="of field files: a window; default: the mean over cycles where there is one, else the cycle")
    one.add_argument("--where", action="append", default=[], metavar="KEY=VALUE", help="of the runs of a sweep those with this value of a key")
    one.add_argument("--orders", default=",".join(f"{order:g}" for order in ORDERS), metavar="LIST",
                     help="orders of the cuts, multiples of 0.5; default %(default)s")
    one.add_argument("--a-weighting", action="store_true", help="of a power: levels in dB(A)")
    one.add_argument("--to-hz", type=float, metavar="HZ", help="top of the diagram; default: 15 %% above the highest of these orders")
    one.add_argument("--cycles", type=int, metavar="N", help="cycles at the end that are analysed; default: the last third")
    one.add_argument("-o", "--output", default="campbell.svg", metavar="picture", help="SVG or PNG; default %(default)s")


def write_pictures(options):
    """`clatter drive`: one file per picture that the run has the data of; prints their paths."""
    from . import plots
    from .plots import drive, drive_film, tensioner, valves
    if options.frames < 0:
        raise BadArtefact(f"--frames: found {options.frames}, expected a number of frames")
    with open_artefact(options.file, "run") as run:
        chain, titled = chains.read_chain(run), drive.titled(run)
        others = [name for name in chains.names(run) if name != chain.name]
        kinds = ["drive", "loop", "speed"]
        kinds += ["tensioner"] if tensioner.tensioners(run) else []
        kinds += ["valves"] if valves.rows(run) else []
    if others:
        print(f"these are of chain {chain.name}; the run also has {', '.join(others)}")
    folder = pathlib.Path(options.output or stem(options.file))
    for kind in kinds:
        path = folder / f"{kind}.{options.format}"
        plots.draw(kind, [options.file], path)
        print(path)
    drive_film.write_page(chain, *titled, folder / "drive.html")
    print(folder / "drive.html")
    if options.frames:
        count = drive_film.write_frames(chain, *titled, folder / "frames", options.frames)
        print(f"{folder / 'frames'}: {count} frames")


def cut_orders(text):
    """The orders of --orders."""
    try:
        found = [float(part) for part in text.split(",")]
    except ValueError:
        found = []
    if not found or any(order <= 0.0 or (2.0 * order) % 1.0 for order in found):
        raise BadArtefact(f"--orders: found {text}, expected multiples of 0.5 separated by commas")
    return found


def quantity(options):
    """(what the options name as in a sweep file, in words)."""
    if options.sound:
        return "sound/power", "the sound power"
    if options.panel:
        return f"panels/{options.panel}", f"the ERP of {options.panel}"
    return (f"sensors/{options.sensor}", options.sensor) if options.sensor else (f"histories/{options.history}", options.history)


def spectra_of(path, options):
    """Orders of what the options name, of one run or of all of a sweep."""
    with open_artefact(path) as file:
        if text(file.attrs.get("schema", "")) == schema_of("sweep"):
            orders.refuse_window(file, options.window)
            return orders.of_sweep(file, quantity(options)[0], options.where)
    with open_artefact(path, "run" if options.history else "field") as file:
        if options.history:
            return [orders.of_run(file, options.history, options.cycles)]
        if options.sound:
            return [orders.of_sound(file, options.window)]
        return [orders.of_field(file, options.sensor, options.window) if options.sensor
                else orders.of_panel(file, options.panel, options.window)]


def write_orders(options):
    """`clatter orders`: the picture, and a table of levels."""
    from .plots import campbell, style
    cuts = cut_orders(options.orders)
    if options.cycles is not None and options.cycles < 1:
        raise BadArtefact(f"--cycles: found {options.cycles}, expected at least 1")
    if options.to_hz is not None and not options.to_hz > 0.0:
        raise BadArtefact(f"--to-hz: found {options.to_hz:g}, expected a frequency above 0")
    spectra = [one for path in options.files for one in spectra_of(path, options)]
    if options.a_weighting:
        spectra = [orders.a_weighted(one) for one in spectra]
    title = ", ".join([f"Orders of {quantity(options)[1]}", *(condition.replace("=", " = ") for condition in options.where)])
    style.apply()
    style.save(campbell.picture(spectra, cuts, title, options.to_hz), options.output)
    print_levels(sorted(spectra, key=lambda one: one[0]), cuts)
    print(options.output)


def print_levels(spectra, cuts):
    """Levels of each order by speed, and the speeds where they are largest."""
    unit = spectra[0][3]
    print(orders.level_name(unit).replace("m/s²", "m/s2"))
    print(f"{'rpm':>8} {'all':>10} " + " ".join(f"{f'order {cut:g}':>10}" for cut in cuts))
    for speed, order, rms, _ in spectra:
        values = [orders.fluctuation(rms), *(orders.of_order(order, rms, cut) for cut in cuts)]
        print(f"{speed:8.0f} " + " ".join(f"{orders.level(value, unit):10.4g}" for value in values))
    largest = max(orders.fluctuation(rms) for _, _, rms, _ in spectra)
    for cut in cuts:
        values = [orders.of_order(order, rms, cut) for _, order, rms, _ in spectra]
        if len(spectra) > 1 and np.max(values) > FAINT * largest:  # false where the samples do not resolve the order
            print(f"order {cut:g} is largest at {orders.peak_of([one[0] for one in spectra], values)[0]:.0f} rpm")
