# SPDX-License-Identifier: GPL-3.0-or-later
"""clatter-mesh as a process on parts that are difficult to mesh (odd_parts.cpp), with random settings.

Whatever the part and the settings: it ends within its limits with exit code 0, 2, 3 or 4; with 0 it prints the quality of the mesh, otherwise one error line; it leaves no file, no process and nothing on stdout but the requested output.

    mesh_process_fuzz.py [RUNS [SEED]]     runs and prints a table; CLATTER_BIN, CLATTER_BUILD as for the tests,
                                           CLATTER_FUZZ_TIME_LIMIT seconds for each (60)
"""
import collections
import dataclasses
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

BUILD = pathlib.Path(os.environ.get('CLATTER_BUILD', 'build/release'))
BIN = pathlib.Path(os.environ.get('CLATTER_BIN', BUILD / 'bin'))
ODD_PARTS = BUILD / 'tests/fuzz/odd_parts'
SLACK = 90  # seconds that a loaded machine may need beyond --time-limit


def kinds():
    return subprocess.run([ODD_PARTS], text=True, capture_output=True, check=True).stdout.split()


@dataclasses.dataclass
class Run:
    """One part with one setting, and the outcome."""
    kind: str
    part_seed: int
    settings: str
    code: int = 0
    said: str = ''
    seconds: float = 0.0
    cells: int = 0
    predicted: float = 0.0
    dihedral: float = 0.0
    faults: list = dataclasses.field(default_factory=list)

    def label(self):
        return f'odd_parts {self.kind} {self.part_seed}, {self.settings!r}'


def draw_settings(draw, quick):
    """Text of [mesh] and its tables: sizes from too large to fine, with and without curvature.

    Quick ones are coarse and have no quality targets.
    """
    lines = ['[mesh]', f'element_size_mm = {10 ** draw.uniform(0.9 if quick else 0.0, 1.5):.3g}']
    if quick:
        return '\n'.join([*lines, 'min_dihedral_deg = 0', 'refine_passes = 0']) + '\n'
    if draw.random() < 0.6:
        lines.append(f'elements_per_turn = {draw.randint(4, 30)}')
    if draw.random() < 0.3:
        lines.append(f'min_size_mm = {10 ** draw.uniform(-2.0, 0.0):.3g}')
    if draw.random() < 0.6:  # else the default of four, each remeshing
        lines.append(f'refine_passes = {draw.randint(0, 2)}')
    if draw.random() < 0.4:
        lines += ['[[mesh.local]]', 'surface = "half"', f'factor = {draw.uniform(0.3, 1.0):.3g}']
        if draw.random() < 0.5:
            lines.append(f'elements_per_turn = {draw.randint(4, 30)}')
        if draw.random() < 0.5:
            lines.append(f'growth = {draw.uniform(0.1, 1.0):.3g}')
        lines += ['[surface.half]', 'box = { min = [-200, -200, -200], max = [40, 200, 200] }']
    return '\n'.join(lines) + '\n'


def children_left(folder):
    """Processes whose working folder is `folder`."""
    left = []
    for process in pathlib.Path('/proc').glob('[0-9]*'):
        try:
            if os.readlink(process / 'cwd') == str(folder):
                left.append(process.name)
        except OSError:
            pass
    return left


def check(run, done, folder, before):
    """Appends violations to run.faults."""
    errors = [line for line in done.stderr.splitlines() if line.startswith('clatter-mesh: error: ')]
    others = [line for line in done.stderr.splitlines() if not line.startswith(('clatter-mesh: error: ', 'warning: '))]
    if done.returncode not in (0, 2, 3, 4):
        run.faults.append(f'exit code {done.returncode}')
    if len(errors) != (0 if done.returncode == 0 else 1):
        run.faults.append(f'{len(errors)} error lines')
    if others:
        run.faults.append(f'a strange line: {others[0]}')
    expected = before | ({'part.mesh.h5'} if done.returncode == 0 else set())
    found = {str(path.relative_to(folder)) for path in folder.rglob('*')}
    if found != expected:
        run.faults.append(f'files: {sorted(found ^ expected)}')
    left = children_left(folder)
    if left:
        run.faults.append(f'processes left: {left}')
    if done.returncode == 0:
        summary = json.loads(done.stdout)
        run.cells, run.dihedral = summary['cells'], summary['min_dihedral_deg']
        run.predicted = summary.get('predicted_cells', 0.0)
        if not (run.cells > 0 and 0.0 < run.dihedral <= 70.6):
            run.faults.append(f'quality: {summary}')
    elif json.loads(done.stdout)['error']['exit_code'] != done.returncode:
        run.faults.append(f'stdout: {done.stdout[:80]}')
    run.said = errors[0].removeprefix('clatter-mesh: error: ') if errors else ' '.join(done.stderr.splitlines())


def run_once(kind, part_seed, settings, time_limit, memory_gib=3.0):
    run = Run(kind, part_seed, settings)
    with tempfile.TemporaryDirectory(prefix='clatter-fuzz-') as scratch:
        folder = pathlib.Path(scratch).resolve()
        extension = 'brep' if part_seed % 3 == 0 else 'step'
        made = subprocess.run([ODD_PARTS, kind, str(part_seed), f'part.{extension}'], cwd=folder, text=True,
                              capture_output=True)
        if made.returncode != 0:
            run.faults.append(f'no part: {made.stderr}')
            return run
        (folder / 'tmp').mkdir()
        (folder / 'part.mesh.toml').write_text(
            f'name = "part"\nkind = "cad"\n[cad]\nsource = "part.{extension}"\n{settings}')
        before = {str(path.relative_to(folder)) for path in folder.rglob('*')}
        begin = time.monotonic()
        try:
            done = subprocess.run(
                [BIN.resolve() / 'clatter-mesh', 'part.mesh.toml', '-o', 'part.mesh.h5', '--quiet', '--json',
                 '--time-limit', str(time_limit), '--memory-limit', str(memory_gib)],
                cwd=folder, text=True, capture_output=True, timeout=time_limit + SLACK,
                env={**os.environ, 'TMPDIR': str(folder / 'tmp')})
        except subprocess.TimeoutExpired:
            run.code = -1
            run.faults.append('hangs beyond its limit')
        else:
            run.code = done.returncode
            check(run, done, folder, before)
        run.seconds = time.monotonic() - begin
    return run


def runs(count, seed, time_limit, seconds=float('inf'), quick=False):
    """Yields `count` runs, the kinds in turn, or as many as `seconds` allow."""
    draw = random.Random(seed)
    names = kinds()
    begin = time.monotonic()
    for i in range(count):
        if time.monotonic() - begin > seconds:
            return
        yield run_once(names[i % len(names)], draw.randrange(10000), draw_settings(draw, quick), time_limit)


def outcome(run):
    """Outcome in one word, for the table."""
    if run.code == 0:
        return 'simpler' if 'Gmsh crashes with' in run.said else 'meshed'
    for word, text in (('crashed', 'crashed'), ('time', '--time-limit'), ('memory', '--memory-limit'),
                       ('too many', 'max_cells')):
        if text in run.said:
            return word
    return {2: 'input', 3: 'refused', 4: 'file'}.get(run.code, 'FAULT')


def table(done):
    """Markdown table: a row per kind, a column per outcome."""
    words = ['meshed', 'simpler', 'refused', 'too many', 'crashed', 'time', 'memory', 'input', 'file', 'FAULT']
    count = collections.Counter((run.kind, outcome(run)) for run in done)
    used = [word for word in words if any(count[run.kind, word] for run in done)]
    lines = ['| part | ' + ' | '.join(used) + ' | cells | smallest angle | predicted / cells |',
             '|---|' + '---|' * (len(used) + 3)]
    for kind in sorted({run.kind for run in done}):
        meshed = [run for run in done if run.kind == kind and run.code == 0]
        cells = f'{min(r.cells for r in meshed):.0f} to {max(r.cells for r in meshed):.0f}' if meshed else ''
        angle = f'{min(r.dihedral for r in meshed):.2g}' if meshed else ''
        ratios = sorted(r.predicted / r.cells for r in meshed)
        ratio = f'{ratios[0]:.2f} to {ratios[-1]:.2f}' if ratios else ''
        numbers = ' | '.join(str(count[kind, word] or '') for word in used)
        lines.append(f'| {kind} | {numbers} | {cells} | {angle} | {ratio} |')
    total = ' | '.join(str(sum(count[kind, word] for kind in {r.kind for r in done}) or '') for word in used)
    return '\n'.join([*lines, f'| all {len(done)} | {total} | | | |'])


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    done = []
    for run in runs(count, seed, int(os.environ.get('CLATTER_FUZZ_TIME_LIMIT', '60'))):
        done.append(run)
        print(f'{len(done):4} {run.kind:24} {run.part_seed:5} exit {run.code} {run.seconds:6.1f} s {run.cells:7} cells '
              f'{run.predicted:9.0f} {run.dihedral:5.1f} deg  {outcome(run):8} '
              f'{re.sub(chr(10), " ", run.settings)!r} {run.said[:400]} {run.faults or ""}', flush=True)
    print(table(done))
    sys.exit(any(run.faults for run in done))


if __name__ == '__main__':
    main()
