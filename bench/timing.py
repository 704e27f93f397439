#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy costs on the timing drive: error against CPU seconds of the kernel's integrators, of CVODE with and without root finding,
and of fixed steps, on the same scene; cost by content, by number of links and by the scales of the error test.

Errors are relative differences from a converged run: of the largest tension of each joint over time, and of the speed of the intake
sprocket (largest difference over half of its range). Another solver's run says how far the reference is converged. Tensions are compared at
equal instants, 5 us apart. Seconds are CPU seconds of one core in the step loop, without the equilibrium at the start; medians of `--runs`.
The machine may be shared: only ratios within one run are reliable.

CVODE with root finding starts again wherever a bush or plate begins or ends a contact, as methods for motion with events do: its root
functions are the gaps of all outlines of links from all profiles, negative by the depth where they touch. Needs SUNDIALS (tools/setup
bench), then ninja -C build/release bench_programs; takes about five minutes on an idle machine.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import timing_figure
import timing_scenes
from integrators import seconds_at
from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bench/integrate_scene"
TABLES = ("methods", "fixed", "content", "links", "scales")
METHODS = ("tr-bdf2", "sdirk2", "predictor-corrector", "cvode", "cvode-2", "cvode-roots", "cvode-2-roots")
TOLERANCES = (1.0, 0.3, 0.1, 1e-2, 1e-3, 1e-4)
REFERENCE, OTHER = ("cvode", 1e-7), ("tr-bdf2", 1e-6)
WANTED = (1e-2, 3e-3, 1e-3)  # errors of force peaks at which methods are compared
LENGTHS = (1e-5, 5e-6, 2e-6, 1e-6, 5e-7)  # of fixed steps [s]
PAPER = 1e-8  # its fixed step [s]
LIMIT = 15  # CPU seconds of an integration


class Bench:
    def __init__(self, folder, runs):
        self.folder, self.runs = folder, runs

    def run(self, span, method, tolerance, runs=None, accuracy="", **scene):
        """The program's numbers, or None when the method fails or takes too long; `span` [s]."""
        path = self.folder / "drive.run.toml"
        time = f"end_s = {span}\noutput_step_us = 5\nlargest_step_us = 20\n"
        path.write_text(timing_scenes.scene(time=time, accuracy=f"tolerance = 1e-3\n{accuracy}", **scene))
        runs = runs or self.runs
        limit = LIMIT * runs + 5
        done = subprocess.run([PROGRAM, path, method, f"{tolerance:g}", str(runs)], capture_output=True, text=True,
                              env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))
        if done.returncode:
            why = (done.stderr.strip().splitlines() or [""])[-1] if done.returncode > 0 else f"more than {limit} s"
            print(f"{scene} {method} {tolerance:g}: {why}", file=sys.stderr, flush=True)
            return None
        found = json.loads(done.stdout.splitlines()[-1])
        found["values"] = np.array(found["values"])
        found["seconds"] = statistics.median(found["seconds"])
        found["attempts"] = found["steps"] + found["rejected"]
        return found


def errors(found, reference):
    """Of the peaks, the largest and the root mean square over the joints; of the intake's speed."""
    peaks, right = (np.abs(run["values"][:, :-1]).max(axis=0) for run in (found, reference))
    relative = np.abs(peaks - right) / right
    speed, exact = found["values"][:, -1], reference["values"][:, -1]
    return float(relative.max()), float(np.sqrt((relative**2).mean())), float(np.abs(speed - exact).max() / (0.5 * np.ptp(exact)))


def compared(found, reference, span, tolerance):
    """One row of a table: errors and cost per second of engine time."""
    worst, rms, speed = errors(found, reference)
    return {"tolerance": tolerance, "worst": worst, "rms": rms, "speed": speed, "steps": found["steps"] / span,
            "seconds": found["seconds"] / span, "evaluations": found["evaluations"] / found["attempts"],
            "matrices": found["matrices"] / found["attempts"], "events": found["events"] / span}


def show(name, row):
    print(f"{name} {row['tolerance']:g}: peaks {row['worst']:.1e} (rms {row['rms']:.1e}), speed {row['speed']:.1e}, "
          f"{row['steps']:.0f} steps/s, {row['evaluations']:.2f} evaluations and {row['matrices']:.2f} matrices a step, "
          f"{row['seconds']:.1f} s/s", file=sys.stderr, flush=True)
    return row


def methods_table(bench, span, methods):
    reference = bench.run(span, *REFERENCE, runs=1)
    doubt = errors(bench.run(span, *OTHER, runs=1), reference)[0]
    points = {}
    for method in methods:
        points[method] = []
        for tolerance in TOLERANCES:
            found = bench.run(span, method, tolerance, runs=None if tolerance > 1e-2 else 1)
            if found is not None:
                points[method].append(show(method, compared(found, reference, span, tolerance)))
    return {"doubt": doubt, "points": points}


def fixed_table(bench, span):
    reference = bench.run(span, *REFERENCE, runs=1)
    rows = {}
    for method in ("tr-bdf2-fixed", "predictor-corrector-fixed"):
        rows[method] = []
        for length in LENGTHS:
            found = bench.run(span, method, length, runs=1)
            if found is not None:
                rows[method].append(show(method, compared(found, reference, span, length)))
    return rows


def content_table(bench, span, tolerance):
    return {content: show(content, per_second(bench.run(span, "tr-bdf2", tolerance, content=content), span))
            for content in timing_scenes.CONTENTS}


def links_table(bench, span, tolerance):
    return {links: show(f"{links} links", per_second(bench.run(span, "tr-bdf2", tolerance, links=links), span))
            for links in timing_scenes.LINKS}


def scales_table(bench, span):
    """Limits of displacement [um] and velocity [m/s] of a step, one relaxed at a time."""
    reference = bench.run(span, *REFERENCE, runs=1)
    rows = []
    for displacement, velocity in ((0.01, 1e-4), (1, 1e-4), (0.01, 1e-2), (0.1, 1e-2), (1, 1e-3), (1, 1e-2), (10, 1e-2), (1, 0.1), (10, 0.1)):
        scales = f"displacement_um = {displacement / 1e-2!r}\nvelocity_m_s = {velocity / 1e-2!r}\n"
        found = bench.run(span, "tr-bdf2", 1e-2, accuracy=scales)
        if found is not None:
            rows.append({"displacement": displacement, "velocity": velocity, **compared(found, reference, span, 1e-2)})
            show(f"{displacement} um, {velocity} m/s:", rows[-1])
    return rows


def per_second(found, span):
    return {"tolerance": 0.0, "worst": np.nan, "rms": np.nan, "speed": np.nan, "steps": found["steps"] / span, "seconds": found["seconds"] / span,
            "evaluations": found["evaluations"] / found["attempts"], "matrices": found["matrices"] / found["attempts"],
            "microseconds": 1e6 * found["seconds"] / found["attempts"], "coordinates": found["coordinates"]}


def percent(value):
    return f"{100 * value:.2g} %"


def count(value):
    return f"{value:,.0f}".replace(",", " ")


def lines_of(results):
    """Markdown of all tables."""
    lines = []
    if "methods" in results:
        points = results["methods"]["points"]
        lines += markdown(["method", "tolerance", "largest error of a joint's peak", "rms of all", "speed", "steps per s", "evaluations a step",
                           "matrices a step", "restarts per s", "CPU s per s"],
                          [[m, f"{r['tolerance']:g}", percent(r["worst"]), percent(r["rms"]), percent(r["speed"]), count(r["steps"]),
                            f"{r['evaluations']:.1f}", f"{r['matrices']:.2f}", count(r["events"]), f"{r['seconds']:.0f}"]
                           for m, rows in points.items() for r in rows])
        lines += ["", *equal_error(points), "", f"The reference differs from another solver's by {percent(results['methods']['doubt'])} (largest error)."]
    if "fixed" in results:
        lines += ["", *markdown(["fixed steps of", "length", "largest error of a joint's peak", "steps per s", "CPU s per s"],
                                [[m.removesuffix("-fixed"), f"{1e6 * r['tolerance']:g} us", percent(r["worst"]), count(r["steps"]), f"{r['seconds']:.0f}"]
                                 for m, rows in results["fixed"].items() for r in rows])]
        lines += ["", fixed_text(results)]
    if "content" in results:
        lines += ["", *markdown(["content", "coordinates", "steps per s", "us a step", "CPU s per s"],
                                [[c, str(r["coordinates"]), count(r["steps"]), f"{r['microseconds']:.0f}", f"{r['seconds']:.0f}"]
                                 for c, r in results["content"].items()])]
    if "links" in results:
        lines += ["", *markdown(["links", "coordinates", "us a step", "ns a step and link", "evaluations a step", "matrices a step"],
                                [[str(n), str(r["coordinates"]), f"{r['microseconds']:.0f}", f"{1e3 * r['microseconds'] / int(n):.0f}",
                                  f"{r['evaluations']:.1f}", f"{r['matrices']:.2f}"] for n, r in results["links"].items()])]
    if "scales" in results:
        lines += ["", *markdown(["limits of a step: displacement", "velocity", "largest error of a joint's peak", "rms of all", "speed", "steps per s", "CPU s per s"],
                                [[f"{r['displacement']:g} um", f"{r['velocity']:g} m/s", percent(r["worst"]), percent(r["rms"]), percent(r["speed"]),
                                  count(r["steps"]), f"{r['seconds']:.0f}"] for r in results["scales"]])]
    return lines


def at_error(points, error, key):
    return {m: seconds_at([(r["worst"], r[key]) for r in rows], error) for m, rows in points.items()}


def equal_error(points):
    """Seconds at equal errors of the peaks."""
    rows = []
    for error in WANTED:
        seconds, steps = (at_error(points, error, key) for key in ("seconds", "steps"))
        own, roots = seconds.get("tr-bdf2"), [s for m, s in seconds.items() if m.endswith("-roots") and s]
        ratio = f"{min(roots) / own:.1f}" if own and roots else ""
        fewer = f"{1 / PAPER / steps['tr-bdf2']:.0f}" if steps.get("tr-bdf2") else ""
        rows.append([percent(error), *(f"{s:.0f}" if s else "" for s in seconds.values()), ratio, fewer])
    return markdown(["error", *points, "best CVODE with roots / tr-bdf2", f"steps of {PAPER:g} s / tr-bdf2"], rows)


def fixed_text(results):
    rows = results["fixed"]["predictor-corrector-fixed"]
    each = statistics.median(r["seconds"] / r["steps"] for r in rows)
    return f"{1 / PAPER:.0e} steps of {PAPER:g} s would take {each / PAPER / 3600:.1f} CPU hours per second at the {1e6 * each:.0f} us of the predictor/corrector's fixed steps."


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tables", nargs="*", default=TABLES, choices=TABLES)
    parser.add_argument("--methods", nargs="*", default=METHODS, choices=METHODS)
    parser.add_argument("--span", type=float, default=0.01, help="engine time of the methods [s]")
    parser.add_argument("--tolerance", type=float, default=0.1, help="of the tables by content and links")
    parser.add_argument("--runs", type=int, default=3, help="measurements, of which the median counts")
    parser.add_argument("--results", type=Path, help="all numbers as JSON; those that are there already are kept")
    parser.add_argument("--write", action="store_true", help="tables into docs/accuracy.md, picture docs/timing.png")
    options = parser.parse_args()
    if not PROGRAM.exists():
        sys.exit(f"bench: {PROGRAM} is missing: tools/setup bench, make build-tests, ninja -C build/release bench_programs")
    results = json.loads(options.results.read_text()) if options.results and options.results.exists() else {}
    with tempfile.TemporaryDirectory() as scratch:
        bench = Bench(Path(scratch), options.runs)
        made = {"methods": lambda: methods_table(bench, options.span, options.methods), "fixed": lambda: fixed_table(bench, 0.2 * options.span),
                "content": lambda: content_table(bench, options.span, options.tolerance),
                "links": lambda: links_table(bench, 0.3 * options.span, options.tolerance), "scales": lambda: scales_table(bench, options.span)}
        for table in options.tables:
            if table not in results:
                results[table] = made[table]()
                if options.results:
                    options.results.write_text(json.dumps(results))
    lines = lines_of(results)
    print("\n".join(lines))
    if options.write:
        write("timing", lines)
        timing_figure.draw(results, ROOT / "docs/timing.png")


if __name__ == "__main__":
    main()
