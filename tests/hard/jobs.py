# SPDX-License-Identifier: GPL-3.0-or-later
"""Command lines that run the tests of an entry, from what CTest has registered: one process for each test program or Python file."""
import dataclasses
import json
import os
import pathlib
import re
import signal
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "docs"))
import repository


SKIPPED = 77  # exit code of a Python test that cannot run here


@dataclasses.dataclass(frozen=True)
class Registered:
    """A test as CTest knows it. `program`: its command without the choice of tests; `names`: [(suite, case)] that it runs, and
    for GoogleTest `choice`, the name by which a filter chooses it."""
    program: tuple
    names: tuple
    choice: str | None
    environment: tuple
    folder: str
    seconds: float
    long: bool


@dataclasses.dataclass(frozen=True)
class Job:
    """A process, and the names of the entry that it is for."""
    command: tuple
    environment: tuple
    folder: str
    seconds: float
    names: tuple


@dataclasses.dataclass(frozen=True)
class Outcome:
    """What a process did: tests that ran to their end, without those that were skipped."""
    ran: int
    skipped: int
    failed: bool
    output: str


def registered_tests(build):
    """All tests of the build folder."""
    done = subprocess.run(["ctest", "--show-only=json-v1"], cwd=build, capture_output=True, text=True, check=True)
    return [one for test in json.loads(done.stdout)["tests"] if "command" in test for one in [registered(test)] if one]


def registered(test):
    """A test of CTest's list; None for those that are neither GoogleTest cases nor Python files."""
    properties = {one["name"]: one["value"] for one in test["properties"]}
    command = test["command"]
    common = (tuple(properties.get("ENVIRONMENT", ())), properties.get("WORKING_DIRECTORY", "."),
              properties.get("TIMEOUT", 600.0), "long" in properties.get("LABELS", ()))
    filtered = [word for word in command if word.startswith("--gtest_filter=")]
    if filtered:
        choice = filtered[0].partition("=")[2]
        return Registered((command[0],), (google_name(choice),), choice, *common)
    script = next((at for at, word in enumerate(command) if word.endswith("_test.py")), None)
    if script is None:
        return None
    classes = [word for word in command[script + 1:] if not word.startswith("-")]
    names = [name for name in repository.python_tests(pathlib.Path(command[script]).read_text())
             if not classes or name[0] in classes]
    return Registered(tuple(command[:script + 1]), tuple(names), None, *common)


def google_name(choice):
    """(suite, case) as in the source: without the prefix of an instance and the numbers of parameters and types."""
    suite, _, case = choice.partition(".")
    parts = [part for part in suite.split("/") if not part.isdigit()]
    return parts[-1], case.split("/")[0]


def jobs_of(tests, registered, with_long=True):
    """(jobs, names that no registered test has) of the names `Suite` or `Suite.Case` of an entry."""
    jobs, missing, chosen = [], [], {}
    for name in tests:
        suite, _, case = name.partition(".")
        fitting = [(one, pair) for one in registered for pair in one.names if pair[0] == suite and case in ("", pair[1])]
        if not fitting:
            missing.append(name)
        for one, pair in fitting:
            if one.long and not with_long:
                continue
            choice = one.choice or (f"{pair[0]}.{pair[1]}" if case else suite)
            group = chosen.setdefault((one.program, one.choice is None), {})
            group.setdefault(choice, (one, name))
    for (program, python), choices in chosen.items():
        first = next(iter(choices.values()))[0]
        arguments = tuple(choices) if python else (f"--gtest_filter={':'.join(choices)}",)
        jobs.append(Job((*program, *arguments), first.environment, first.folder,
                        max(one.seconds for one, _ in choices.values()), tuple(dict.fromkeys(name for _, name in choices.values()))))
    return jobs, missing


def run(job):
    """Runs the process in a group of its own, which ends with it."""
    environment = {**os.environ, **dict(one.partition("=")[::2] for one in job.environment)}
    process = subprocess.Popen(job.command, cwd=job.folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    try:
        output = process.communicate(timeout=job.seconds)[0]
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output = process.communicate()[0] + f"\nstopped after {job.seconds:.0f} s\n"
    except BaseException:
        os.killpg(process.pid, signal.SIGKILL)
        raise
    return outcome(output, process.returncode)


def outcome(output, code):
    """Counts of what unittest and GoogleTest print at the end."""
    ran, skipped = 0, 0
    for pattern, count in ((r"^Ran (\d+) tests? in", 1), (r"^\[=+\] (\d+) tests? from .* ran\.", 1)):
        ran += count * sum(map(int, re.findall(pattern, output, re.M)))
    for pattern in (r"^(?:OK|FAILED) \(.*?skipped=(\d+)", r"^\[  SKIPPED \] (\d+) tests?,"):
        skipped += sum(map(int, re.findall(pattern, output, re.M)))
    return Outcome(max(0, ran - skipped), skipped, code not in (0, SKIPPED), output)
