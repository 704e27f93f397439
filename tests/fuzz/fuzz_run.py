# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the fuzzing target of a reader with clang and runs it for a bounded time."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SECONDS = int(os.environ.get('CLATTER_FUZZ_SECONDS', '60'))
FLAGS = ['-std=c++20', '-O1', '-g', '-fsanitize=fuzzer,address,undefined',
         '-fno-sanitize-recover=undefined', f'-I{ROOT}', '-isystem', '/usr/include/eigen3',
         '-isystem', '/usr/include/hdf5/serial']


# Files of mesh/deck that use finished decks of both readers.
AFTER_READING = ('cards_page', 'check', 'import', 'units')

# Errors as text, which every reader throws.
ERRORS = ('base/error', 'base/json_line', 'base/log', 'base/part_names', 'base/planned_files', 'base/refusal')


def sources(reader):
    """The reader and its dependencies."""
    core = {'msh': [], 'matrix': ['base/matrix_text', 'base/text_lines', 'base/whole_file']}.get(
        reader, ['base/whole_file', 'mesh/cell', 'mesh/mesh'])
    paths = [ROOT / f'core/{name}.cpp' for name in (*ERRORS, *core)]
    if reader == 'msh':
        paths.append(ROOT / 'mesh/deck/msh/scan.cpp')
    elif reader != 'matrix':
        paths += sorted((ROOT / f'mesh/deck/{reader}').glob('*.cpp'))
        paths += sorted(path for path in (ROOT / 'mesh/deck').glob('*.cpp') if path.stem not in AFTER_READING)
    return [str(path) for path in [*paths, HERE / f'{reader}_fuzz.cpp']]


# A deck of one cell, to which each seed adds one card.
SMALL_DECK = {
    'nastran': 'PSOLID,1,1\nMAT1,1,210.,,.3,7.8\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n'
               'GRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n',
    'abaqus': '*NODE,NSET=N\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n',
}
DATA = {'nastran': '{},1,1,123,1,2,3,4,1.\n', 'abaqus': '*{},NSET=N,ELSET=E,TYPE=P,NAME=A\n1,1,3,.5\n'}


def card_names(reader):
    """Cards or keywords (without star) that a reader reads or passes over: its tables, by docs/cards.md."""
    sections = (ROOT / 'docs/cards.md').read_text().split('\n## ')[1:]
    rows = [line.split('|') for section in sections if section.lower().startswith(reader)
            for line in section.splitlines() if line.startswith('| `')]
    return [name.lstrip('*') for row in rows if row[2].strip() != 'refused' for name in re.findall('`([^`]+)`', row[1])]


def write_seeds(reader, work):
    """A deck with each card once, and a dictionary of their names: new cards are fuzzed from their first day."""
    (work / 'seeds').mkdir(parents=True, exist_ok=True)
    names = card_names(reader)
    for name in names:
        text = SMALL_DECK[reader] + DATA[reader].format(name)
        (work / 'seeds' / re.sub(r'\W', '_', name)).write_text(text)
    (work / 'dictionary').write_text(''.join(f'"{name}"\n' for name in names))
    return [f'-dict={work}/dictionary', work / 'seeds']


def run_fuzzer(test, reader):
    """Fails when the target crashes, hangs (5 s) or takes more than 1.5 GB."""
    if shutil.which('clang++') is None:
        sys.exit(77)
    work = pathlib.Path(os.environ['CLATTER_BUILD']) / 'fuzz' / reader
    (work / 'found').mkdir(parents=True, exist_ok=True)
    seeds = write_seeds(reader, work) if reader in SMALL_DECK else []
    target = work / 'fuzzer'
    subprocess.run(['clang++', *FLAGS, *sources(reader), '-o', target, '-lfmt'], check=True)
    done = subprocess.run(
        ['nice', '-n', '10', target, f'-max_total_time={SECONDS}', '-max_len=4096', '-timeout=5',
         '-rss_limit_mb=1500', f'-artifact_prefix={work}/', work / 'found',
         HERE / 'corpus' / reader, *seeds], capture_output=True, text=True)
    test.assertEqual(done.returncode, 0, done.stderr[-4000:])
