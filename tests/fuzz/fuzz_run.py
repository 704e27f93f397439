# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the fuzzing target of a reader with clang and runs it for a bounded time."""
import fcntl
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SECONDS = int(os.environ.get('CLATTER_FUZZ_SECONDS', '60'))
FLAGS = '-O1 -g1 -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined'


def build(reader):
    """The target of a reader, by clang, in a build folder of its own."""
    folder = pathlib.Path(os.environ['CLATTER_BUILD']) / 'fuzz/build'
    for command in (['cmake', '-S', ROOT, '-B', folder, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=None', '-DCLATTER_ARCH=',
                     '-DCMAKE_C_COMPILER=clang', '-DCMAKE_CXX_COMPILER=clang++', f'-DCMAKE_CXX_FLAGS={FLAGS}'],
                    ['cmake', '--build', folder, '--target', f'{reader}_fuzzer']):
        with open(folder.parent / 'lock', 'w') as lock:  # tests of several readers share the folder
            fcntl.flock(lock, fcntl.LOCK_EX)
            subprocess.run(command, check=True)
    return folder / f'tests/fuzz/{reader}_fuzzer'


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


def texts_of_tests(reader):
    """Decks, and parts of decks, of the reader's tests: string literals of several lines."""
    for path in sorted((ROOT / f'tests/mesh/deck/{reader}').glob('*_test.cpp')):
        for literals in re.findall(r'(?:"(?:[^"\\\n]|\\.)*"\s*)+', path.read_text()):
            text = ''.join(re.findall(r'"((?:[^"\\\n]|\\.)*)"', literals))
            if '\\n' in text:
                yield text.replace('\\n', '\n').replace('\\t', '\t').replace('\\"', '"')


def write_seeds(reader, work):
    """A deck with each card once, those of the tests, and a dictionary of names: new cards are fuzzed from their first day."""
    (work / 'seeds').mkdir(parents=True, exist_ok=True)
    names = card_names(reader)
    for name in names:
        text = SMALL_DECK[reader] + DATA[reader].format(name)
        (work / 'seeds' / re.sub(r'\W', '_', name)).write_text(text)
    for number, text in enumerate(texts_of_tests(reader)):
        (work / 'seeds' / f'test_{number}').write_text(SMALL_DECK[reader] + text)
    (work / 'dictionary').write_text(''.join(f'"{name}"\n' for name in names))
    return [f'-dict={work}/dictionary', work / 'seeds']


def run_fuzzer(test, reader):
    """Fails when the target crashes, hangs (5 s) or takes more than 1.5 GB."""
    if shutil.which('clang++') is None:
        sys.exit(77)
    work = pathlib.Path(os.environ['CLATTER_BUILD']) / 'fuzz' / reader
    (work / 'found').mkdir(parents=True, exist_ok=True)
    seeds = write_seeds(reader, work) if reader in SMALL_DECK else []
    done = subprocess.run(
        ['nice', '-n', '10', build(reader), f'-max_total_time={SECONDS}', '-max_len=4096', '-timeout=5',
         '-rss_limit_mb=1500', f'-artifact_prefix={work}/', work / 'found',
         HERE / 'corpus' / reader, *seeds], capture_output=True, text=True)
    test.assertEqual(done.returncode, 0, done.stderr[-4000:])
