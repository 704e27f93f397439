#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Error against seconds of the kernel's integrators, of some that were tried, of CVODE and of IDA (SUNDIALS) on the same forces.

Each scene of bench/integrate/scenes.cpp is integrated by each method with tolerances from 1e-2 to 1e-9. The error is the largest
difference of what is compared, over 200 instants, from a converged run; another solver's run says how far that is converged.
Seconds are CPU seconds of the integration on one core, medians of several measurements. Needs SUNDIALS (tools/setup bench), then
ninja -C build/release bench_programs; takes about ten minutes.
"""
import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

import numpy as np

import integrators_figure
from page import markdown, write

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = ROOT / "build/release/bench/integrate_scene"
KERNEL = ["tr-bdf2", "sdirk2", "predictor-corrector"]
TRIED = ["generalised-alpha-0.8", "generalised-alpha-0.4", "exponential"]  # not in the kernel
IDA = ["ida", "ida-2", "ida-displacements"]
METHODS = [*KERNEL, *TRIED, "cvode", "cvode-2", *IDA]
# Reference, another solver's run, errors at which seconds are compared.
SCENES = {
    "andrews": (("cvode", 1e-10), ("ida-displacements", 1e-10), (1e-2, 1e-3, 1e-4)),
    "chain": (("cvode", 1e-10), ("ida", 1e-9), (10.0, 1.0, 0.1)),
    "damped-chain": (("cvode", 1e-10), ("ida", 1e-9), (10.0, 1.0, 0.1)),
    "slap": (("ida", 1e-8), ("cvode-2", 1e-8), (1.0, 0.1, 0.02)),
    "bounces": (("ida", 1e-12), ("cvode", 1e-11), (10.0, 0.1, 1e-3)),
}
WANTED = 5.0  # times faster than IDA at equal error


def integrate(scene, method, tolerance, runs=1, limit=20):
    """The program's numbers, or None when the method fails or a run takes more than `limit` CPU seconds."""
    command = [PROGRAM, scene, method, f"{tolerance:g}", str(runs)]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit * runs, limit * runs)))
    if done.returncode:
        why = done.stderr.strip() or f"more than {limit} s"
        print(f"{scene}, {method}, {tolerance:g}: {why}", file=sys.stderr, flush=True)
        return None
    found = json.loads(done.stdout)
    found["values"] = np.array(found["values"])
    found["seconds"] = statistics.median(found["seconds"])
    return found


def difference(one, other):
    """The largest difference; inf where a motion was lost."""
    largest = np.abs(one["values"] - other["values"]).max()
    return float(largest) if np.isfinite(largest) else np.inf


def measure(scene, methods, tolerances, runs):
    """{"unit", "doubt", "points": {method: [(error, seconds, tolerance, counts)]}} of a scene."""
    (method, tolerance), other, _ = SCENES[scene]
    reference = integrate(scene, method, tolerance, limit=300)
    doubt = difference(integrate(scene, *other, limit=300), reference)
    points = {}
    for name in methods:
        points[name] = []
        for step in tolerances:
            found = integrate(scene, name, step)
            if found is None:
                continue
            if found["seconds"] < 1.0:
                found["seconds"] = integrate(scene, name, step, runs)["seconds"]
            counts = {key: found[key] for key in ("steps", "rejected", "evaluations", "matrices", "events")}
            points[name].append((difference(found, reference), found["seconds"], step, counts))
            print(f"{scene} {name} {step:g}: error {points[name][-1][0]:.2e}, {found['seconds']:.4f} s, {counts}",
                  file=sys.stderr, flush=True)
            if points[name][-1][0] < 3.0 * doubt:
                break  # finer ones only compare references
    return {"unit": reference["unit"], "coordinates": reference["coordinates"], "doubt": doubt, "points": points}


def seconds_at(points, error):
    """Seconds for this error: between the cheapest runs, on logarithmic axes; None where no run is as accurate."""
    front, least = [], np.inf
    for found, seconds in sorted(((p[0], p[1]) for p in points), key=lambda p: (p[1], p[0])):
        if found < least:
            front.append((found, seconds))
            least = found
    if not front or least > error:
        return None
    if front[0][0] <= error:
        return front[0][1]
    errors, seconds = np.log(np.maximum([p[0] for p in front], 1e-300)), np.log([p[1] for p in front])
    return float(np.exp(np.interp(np.log(error), errors[::-1], seconds[::-1])))


def best(row):
    return min((seconds for seconds in row if seconds is not None), default=None)


def table(results):
    methods = [method for method in METHODS if any(method in r["points"] for r in results.values())]
    lines = markdown(["scene", "error", *methods, "IDA / kernel", f"{WANTED:g} times"], list(rows(results, methods)))
    return [*lines, "", "References differ from those of another solver by "
            + ", ".join(f"{r['doubt']:.0e} {r['unit']}".removesuffix(" -") + f" ({scene})" for scene, r in results.items()) + "."]


def rows(results, methods):
    for scene, result in results.items():
        for error in SCENES[scene][2]:
            seconds = {m: seconds_at(result["points"].get(m, []), error) for m in methods}
            kernel, ida = (best(seconds[m] for m in group if m in seconds) for group in (KERNEL, IDA))
            ratio = ida / kernel if kernel and ida else None
            verdict = "-" if ratio is None else "met" if ratio >= WANTED else "missed"
            yield [scene, f"{error:g} {result['unit']}".removesuffix(" -"), *(f"{s:.2g}" if s else "" for s in seconds.values()),
                   f"{ratio:.2g}" if ratio else "", verdict]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenes", nargs="*", default=list(SCENES), choices=list(SCENES))
    parser.add_argument("--methods", nargs="*", default=METHODS, choices=METHODS)
    parser.add_argument("--tolerances", type=float, nargs="*", default=[10.0**-k for k in range(2, 10)])
    parser.add_argument("--runs", type=int, default=5, help="measurements below a second, of which the median counts")
    parser.add_argument("--results", type=Path, help="all numbers as JSON")
    parser.add_argument("--figure", type=Path, help="picture, error against seconds")
    parser.add_argument("--write", action="store_true", help="table into docs/accuracy.md, picture docs/integrators.png")
    options = parser.parse_args()
    if not PROGRAM.exists():
        sys.exit(f"bench: {PROGRAM} is missing: tools/setup bench, make build-tests, ninja -C build/release bench_programs")
    results = {scene: measure(scene, options.methods, options.tolerances, options.runs) for scene in options.scenes}
    lines = table(results)
    print("\n".join(lines))
    if options.results:
        options.results.write_text(json.dumps(results))
    for path in [options.figure, ROOT / "docs/integrators.png" if options.write else None]:
        if path:
            integrators_figure.draw(results, path)
    if options.write:
        write("integrators", lines)


if __name__ == "__main__":
    main()
