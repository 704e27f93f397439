# SPDX-License-Identifier: GPL-3.0-or-later
"""The terminal during `clatter run`: a line for each stage at work, above them those that ended and what make printed."""
import dataclasses
import os
import pathlib
import re
import shutil
import sys
import time

TICK_S = 0.2
NOTED = re.compile(r"\bwarning: |: error: ")


@dataclasses.dataclass
class Stage:
    name: str       # "mesh"
    target: str     # "part.mesh.h5"
    began: float


def stage_of(command, began):
    """From the command line of a stage, as `bin/clatter-mesh part.mesh.toml -o part.mesh.h5`."""
    program = re.search(r"clatter-(\w+)(?= |$)", command)
    target = re.search(r" -o (.+?)(?: -|$)", command)
    return Stage(program[1] if program else "stage", target[1] if target else command.split()[-1], began)


def alive(process):
    """Whether a process runs; one that has ended and that make has not seen yet does not."""
    try:
        return "Z" != (pathlib.Path("/proc") / str(process) / "stat").read_text().rpartition(")")[2].split()[0]
    except OSError:
        return False


def last_line(path):
    """What a stage said last."""
    try:
        lines = path.read_text(errors="replace").replace("\r", "\n").strip().splitlines()
    except OSError:
        lines = []
    return lines[-1].strip() if lines else ""


class Screen:
    def __init__(self, notes):
        self.notes, self.stages, self.below, self.read = notes, {}, 0, 0

    def tick(self, last=False):
        """Draws what has changed; `last`: make has ended."""
        for path in self.notes.glob("*.stage"):
            process = int(path.stem)
            if process not in self.stages:
                self.stages[process] = stage_of(path.read_text(), path.stat().st_mtime)
        ended = [process for process in self.stages if last or not alive(process)]
        lines = self.printed() + [line for process in ended for line in self.end(process)]
        running = [] if last else [self.running(process, stage) for process, stage in self.stages.items()]
        text = f"\x1b[{self.below}F\x1b[J" if self.below else ""
        sys.stdout.write(text + "".join(f"{line}\n" for line in lines + running))
        sys.stdout.flush()
        self.below = len(running)

    def printed(self):
        """Complete lines that make and other commands have printed since the last tick."""
        with open(self.notes / "make", "rb") as stream:
            stream.seek(self.read)
            text = stream.read()
        whole = text.rpartition(b"\n")[0]
        self.read += len(whole) + (1 if whole or text.startswith(b"\n") else 0)
        return whole.decode(errors="replace").split("\n") if whole else []

    def running(self, process, stage):
        line = f"  {stage.name:<9} {stage.target:<24} {time.time() - stage.began:7.0f} s   {last_line(self.log(process))}"
        return line[:shutil.get_terminal_size().columns - 1]

    def log(self, process):
        return self.notes / f"{process}.log"

    def end(self, process):
        """The lines of a stage that ended: its warnings and errors, then its own."""
        stage, log = self.stages.pop(process), self.log(process)
        said = log.read_text(errors="replace").splitlines() if log.exists() else []
        log.unlink(missing_ok=True)
        os.unlink(self.notes / f"{process}.stage")
        failed = any(": error: " in line for line in said)
        return [*(line for line in said if NOTED.search(line)),
                f"{'x' if failed else '-'} {stage.name:<9} {stage.target:<24} {time.time() - stage.began:7.1f} s"]
