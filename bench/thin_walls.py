#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin walls, nearly incompressible materials and jumps of stiffness: solves and seconds of the three eigen-solvers,
and strips under a tip load against the closed form.

Sheets of C3D20 of 200 x 200 mm from 5 to 0.1 mm and a cube, the cube with Poisson's ratio up to .499999, a sandwich
with a soft middle layer; 20 lowest modes of the free parts. --before names the bin folder of an older build for
comparison. Strips 20 mm wide, clamped at one end, nu = 0: P l^3 / 3 E I.
"""
import argparse
import json
import re
import subprocess
import tempfile
import time
from pathlib import Path

import page

ROOT = Path(__file__).resolve().parent.parent
SOLVERS = ["block-lanczos", "arpack", "amls"]
CORNERS = [(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0), (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2)]
MID_SIDE_NODES = [(1, 0, 0), (2, 1, 0), (1, 2, 0), (0, 1, 0), (1, 0, 2), (2, 1, 2), (1, 2, 2), (0, 1, 2),
                  (0, 0, 1), (2, 0, 1), (2, 2, 1), (0, 2, 1)]


def deck(size, cells, nu=0.3, layers=None, soft=1.0, tip=None):
    """A box of C3D20 in mm, t, s; cells of `layers` (by index along z) are softer by `soft`; a clamp at x = 0 and a
    force along z at the other end with `tip` [N]."""
    number, lines, groups = {}, [], ([], [])

    def node(position):
        if position not in number:
            number[position] = len(number) + 1
            where = [size[d] * position[d] / (2 * cells[d]) for d in range(3)]
            lines.append(f"{number[position]}, " + ", ".join(f"{x:.12g}" for x in where))
        return number[position]

    cell = 0
    for k in range(cells[2]):
        for j in range(cells[1]):
            for i in range(cells[0]):
                cell += 1
                ids = [node((2 * i + a, 2 * j + b, 2 * k + c)) for a, b, c in CORNERS + MID_SIDE_NODES]
                text = [str(n) for n in [cell] + ids]
                groups[1 if layers and k in layers else 0].append(
                    ", ".join(text[:16]) + ",\n" + ", ".join(text[16:]))
    text = ["*NODE", *lines]
    for name, group, modulus in zip("AB", groups, (2.1e5, 2.1e5 * soft)):
        if group:
            text += [f"*ELEMENT, TYPE=C3D20, ELSET={name}", *group, f"*MATERIAL, NAME={name}", "*ELASTIC",
                     f"{modulus!r}, {nu!r}", "*DENSITY", "7.85e-9", f"*SOLID SECTION, ELSET={name}, MATERIAL={name}"]
    if tip is None:
        return "\n".join(text + ["*STEP", "*FREQUENCY", "20", "*END STEP", ""])
    text += ["*BOUNDARY"] + [f"{n}, 1, 3" for position, n in number.items() if position[0] == 0]
    ends = [n for position, n in number.items() if position[0] == 2 * cells[0]]
    return "\n".join(text + ["*STEP", "*STATIC", "*CLOAD"] + [f"{n}, 3, {tip / len(ends)!r}" for n in ends] +
                     ["*END STEP", ""])


def assembled(folder, build, name, text):
    (folder / f"{name}.inp").write_text(text)
    for command in (["clatter-mesh", f"{name}.inp", "--units", "mm-t-s", "-o", f"{name}.mesh.h5", "--recipe",
                     f"{name}.fe.toml"],
                    ["clatter-assembly", f"{name}.mesh.h5", "-c", f"{name}.fe.toml", "-o", f"{name}.fe.h5"]):
        subprocess.run([build / command[0], *command[1:], "--quiet"], cwd=folder, check=True,
                       stdout=subprocess.DEVNULL)
    return f"{name}.fe.h5"


def modes(folder, build, model, solver, limit):
    """"solves, seconds" or the kind of failure, and the first elastic frequency [Hz]."""
    (folder / "ask.modes.toml").write_text(f'count = 20\neigen_solver = "{solver}"\n')
    begin = time.monotonic()
    try:
        done = subprocess.run([build / "clatter-modal", model, "-c", "ask.modes.toml", "-o", "out.modes.h5"],
                              cwd=folder, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return f"over {limit:.0f} s", ""
    seconds = time.monotonic() - begin
    output = done.stdout + done.stderr
    if done.returncode != 0:
        return f"exit {done.returncode}", ""
    solves = re.search(r"(\d+) solves\)", output).group(1)
    hz = [float(value) for value in re.findall(r"^ +\d+ +([\d.e+-]+) Hz", output, re.M)]
    return f"{solves}, {seconds:.1f} s", f"{hz[6]:.5g}"


def models(folder, build):
    cube = (200, 200, 200), (8, 8, 8)
    yield "cube 200 mm", assembled(folder, build, "cube", deck(*cube))
    for t in (5, 3, 2, 1, 0.5, 0.1):
        yield f"sheet {t:g} mm", assembled(folder, build, f"sheet{t:g}", deck((200, 200, t), (24, 24, 1)))
    for nu in (0.49, 0.4999, 0.499999):
        yield f"cube, nu = {nu:g}", assembled(folder, build, f"nu{nu:g}", deck(*cube, nu=nu))
    for jump in (1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10):
        yield f"sandwich, E ratio {jump:g}", assembled(
            folder, build, f"jump{jump:g}", deck((200, 200, 60), (10, 10, 6), layers=(2, 3), soft=jump))


def strips(folder, build):
    rows = []
    for length, t, n in ((100, 2, 10), (300, 1, 30), (1000, 2, 100), (1000, 1, 100), (3000, 1, 300)):
        model = assembled(folder, build, f"strip{length}_{t}", deck((length, 20, t), (n, 1, 1), nu=0.0, tip=1.0))
        done = subprocess.run([build / "clatter-modal", "statics", model, "--case", "step_1", "--json", "-o",
                               "out.static.h5"], cwd=folder, capture_output=True, text=True)
        exact = length**3 / (3 * 2.1e5 * 20 * t**3 / 12) / 1e3
        if done.returncode != 0:
            rows.append([f"{length} x 20 x {t}", f"{length / t:.0f}", f"exit {done.returncode}", "", ""])
            continue
        case = json.loads(done.stdout)["results"][0]
        rows.append([f"{length} x 20 x {t}", f"{length / t:.0f}", f"{case['largest_displacement_m'] / exact - 1:+.1e}",
                     f"{case['forward_error']:.1e}", f"{case['backward_error']:.0e}"])
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", default=ROOT / "build/release/bin", type=Path)
    parser.add_argument("--before", type=Path, help="bin folder of an older build, for comparison")
    parser.add_argument("--limit", type=float, default=60.0, help="time limit of one run [s]")
    parser.add_argument("--write", action="store_true", help="put the tables into docs/accuracy.md")
    options = parser.parse_args()
    builds = [options.build] + ([options.before] if options.before else [])
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for part, model in models(folder, options.build):
            row = [part]
            for build in builds:
                found = [modes(folder, build, model, solver, options.limit) for solver in SOLVERS]
                if build == options.build:
                    row.append(found[0][1])
                row += [text for text, _ in found]
            rows.append(row)
            print("  ".join(row), flush=True)
        statics = strips(folder, options.build)
    head = ["part", "first elastic [Hz]"] + [f"{solver}{after}" for after in ["", " before"][:len(builds)]
                                             for solver in SOLVERS]
    tables = (page.markdown(head, rows),
              page.markdown(["strip [mm]", "length / thickness", "against P l^3 / 3 E I", "forward error, estimated",
                             "backward error"], statics))
    for mark, table in zip(("thin_walls", "thin_strips"), tables):
        print("\n".join(table))
        if options.write:
            page.write(mark, table)


if __name__ == "__main__":
    main()
