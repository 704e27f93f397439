# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the fuzzing target of a reader with clang and runs it for a bounded time."""
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SECONDS = int(os.environ.get('CLATTER_FUZZ_SECONDS', '60'))
FLAGS = ['-std=c++20', '-O1', '-g', '-fsanitize=fuzzer,address,undefined',
         '-fno-sanitize-recover=undefined', f'-I{ROOT}', '-isystem', '/usr/include/eigen3',
         '-isystem', '/usr/include/hdf5/serial']


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
        paths += [ROOT / f'mesh/deck/{name}.cpp' for name in ('cyclic', 'field_text', 'id_index', 'ignore',
                                                              'line_source', 'node_sets', 'refusals', 'system_axes')]
    return [str(path) for path in [*paths, HERE / f'{reader}_fuzz.cpp']]


def run_fuzzer(test, reader):
    """Fails when the target crashes, hangs (5 s) or takes more than 1.5 GB."""
    if shutil.which('clang++') is None:
        sys.exit(77)
    work = pathlib.Path(os.environ['CLATTER_BUILD']) / 'fuzz' / reader
    (work / 'found').mkdir(parents=True, exist_ok=True)
    target = work / 'fuzzer'
    subprocess.run(['clang++', *FLAGS, *sources(reader), '-o', target, '-lfmt'], check=True)
    done = subprocess.run(
        ['nice', '-n', '10', target, f'-max_total_time={SECONDS}', '-max_len=4096', '-timeout=5',
         '-rss_limit_mb=1500', f'-artifact_prefix={work}/', work / 'found',
         HERE / 'corpus' / reader], capture_output=True, text=True)
    test.assertEqual(done.returncode, 0, done.stderr[-4000:])
