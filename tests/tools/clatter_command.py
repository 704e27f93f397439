# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter` for tests, without the second that Python takes to load its modules: in a child of the test's process, which has them."""
import os
import pathlib
import subprocess
import sys
import tempfile
import traceback

from clatter_tools import command_line

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"


def clatter(*arguments, folder, environment=None):
    """Runs `clatter arguments` in `folder`, with {name: value} added to the environment; returns a CompletedProcess with its texts."""
    arguments = [str(one) for one in arguments]
    with tempfile.TemporaryFile("w+") as output, tempfile.TemporaryFile("w+") as errors:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        child = os.fork()
        if child == 0:
            code = 1
            try:
                os.dup2(output.fileno(), 1)
                os.dup2(errors.fileno(), 2)
                sys.stdout, sys.stderr = (open(number, "w", encoding="utf-8", closefd=False) for number in (1, 2))
                os.chdir(folder)
                os.environ.update(environment or {})
                code = command_line.main(arguments, rules=TOOLS / "clatter.mk")
            except SystemExit as end:  # of argparse
                code = end.code
            except BaseException:  # as Python does at its end: the test sees code 1 and the trace
                traceback.print_exc()
            finally:
                try:
                    sys.stdout.flush()
                    sys.stderr.flush()
                finally:  # whatever happens, the child does not go on as a second test
                    os._exit(code or 0)
        code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        texts = []
        for file in (output, errors):
            file.seek(0)
            texts.append(file.read())
    return subprocess.CompletedProcess(["clatter", *arguments], code, *texts)
