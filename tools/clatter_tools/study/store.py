# SPDX-License-Identifier: GPL-3.0-or-later
"""Artefacts known by what they depend on: each is made once by the pipeline's own rules, in a folder of its own."""
import contextlib
import dataclasses
import fcntl
import functools
import hashlib
import math
import os
import pathlib
import re
import signal
import subprocess
import tomllib

from clatter import artefact
from clatter.artefact import BadArtefact, CannotWrite
from . import toml_text
from ..keys.schema_line import schema_line
from ..sweep import write_changed
from .pipeline import environment

LEFT_OUT = (".h5", ".d", ".part", ".toml", ".checkpoint", ".xdmf")  # of the pipeline's folder, in the folders of artefacts
HEAD = """# Written by `clatter study`: each artefact of its variants once.
.PHONY: all
all: {all}
"""
# The inputs are links to artefacts that are complete: make need not look what they are made of. `times` is the shell's: of a stage that goes on from
# its checkpoint the seconds before the interruption count as well. .span: when the stage began and ended; with a launcher, which gives each stage processors
# of its own, also that. What the stage says is in a file beside the artefact, and shown where it fails.
RULE = """{target}:{inputs}
	+@cd {folder} && {{ ls *.checkpoint >/dev/null 2>&1 || rm -f .times.part .span.part; }} && trap 'times >>.times.part; exit 143' INT TERM && \\
	date +%s.%N >>.span.part && {{ $(MAKE) --no-print-directory -I {pipeline} {old}{name} >.log 2>&1 || {{ cat .log >&2; exit 2; }}; }} && \\
	times >>.times.part && mv .times.part .times && date "+%s.%N $${{CLATTER_LAUNCH:+launched}}" >>.span.part && mv .span.part .span && \\
	echo {line} && sed -n 's/^warning: /  &/p' .log >&2
"""
BESIDE, TAKEN = "beside others", "taken over"
OVERLAP = 0.05  # of a stage's time, during which others may run: less than its seconds vary by


@dataclasses.dataclass
class Made:
    """An artefact: its name in the pipeline, its folder's name, all that it depends on (texts of TOML files by name, artefacts by name), and the first
    variant that needs it."""
    name: str
    folder: str
    texts: dict
    inputs: dict
    variant: str = dataclasses.field(default="", compare=False)


class Store:
    """The artefacts of all variants, in `folder`/made."""

    def __init__(self, pipeline, folder):
        self.pipeline, self.folder = pipeline, pathlib.Path(folder)
        self.made = {}

    def digest(self, name):
        """Of the contents of a given file."""
        path = self.pipeline.folder / name
        return artefact.sha256(path) if path.is_file() else "missing"

    def path(self, made):
        return self.folder / "made" / made.folder / made.name

    def missing(self):
        return [made for made in self.made.values() if not self.path(made).exists()]

    def read_newer(self, made):
        """Whether the stage of an artefact read a file, as its dependency file says, that neither make nor a TOML file names (one that a deck
        includes) and that has changed since."""
        path = self.path(made)
        listed = path.with_name(path.name + ".d")
        if not path.exists() or not listed.exists():
            return False
        inputs = listed.read_text(encoding="utf-8").replace("\\\n", " ").split("\n", 1)[0].partition(":")[2].split()
        others = [path.parent / name for name in inputs if name not in made.texts and name not in made.inputs]
        return any(one.exists() and one.stat().st_mtime_ns > path.stat().st_mtime_ns for one in others)

    def drop_stale(self):
        """Removes artefacts that read_newer finds, and those that depend on them."""
        stale = {one.folder for one in self.made.values() if self.read_newer(one)}
        for one in self.made.values():
            if one.folder in stale or any(other.folder in stale for other in one.inputs.values()):
                self.path(one).unlink(missing_ok=True)

    def drop_unmeasured(self):
        """Removes artefacts whose processor seconds are not known, those that an earlier run took over: they are made here."""
        for one in self.made.values():
            if self.path(one).exists() and not math.isfinite(self.processor_seconds(one)):
                self.path(one).unlink()

    def reuse(self, made):
        """Takes artefacts, [Made] of the folder as it is, over from the pipeline's folder where make finds them up to date."""
        wanted = {other.name: other for target in made for other in [*target.inputs.values(), target] if other in self.missing()}
        for name, one in wanted.items():
            own, path = self.pipeline.folder / name, self.path(one)
            if not own.is_file() or subprocess.run(["make", "-q", name], cwd=self.pipeline.folder, env=environment(), capture_output=True,
                                                   check=False).returncode:
                continue
            try:
                path.parent.mkdir(parents=True, exist_ok=True)
                os.link(own.resolve(), path)  # stages replace files by renaming: what a later run writes is another file
            except OSError:
                link(path, str(own.resolve()))

    def prepare(self):
        """Folders with everything that make needs for the missing artefacts, and study.mk."""
        try:
            self.drop_stale()
            for made in self.missing():
                self.fill(self.folder / "made" / made.folder, made)
            self.folder.mkdir(parents=True, exist_ok=True)
            write_changed(self.folder / "study.mk", self.makefile())
        except OSError as error:
            raise CannotWrite(f"{error.filename or self.folder}: cannot be written: {error.strerror}") from error

    def fill(self, folder, made):
        """Only the TOML files and artefacts that the artefact depends on, so that it cannot read another variant's; links to all other files."""
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in made.texts.items():
            write_changed(folder / name, text)
        for name, other in made.inputs.items():
            link(folder / name, f"../{other.folder}/{other.name}")
        for path in self.pipeline.folder.iterdir():
            if path.suffix not in LEFT_OUT and not path.name.startswith(".") and path.resolve() != self.folder.resolve() \
                    and not self.pipeline.is_made(path.name):
                link(folder / path.name, os.path.relpath(path.resolve(), folder.resolve()))

    @contextlib.contextmanager
    def alone(self):
        """The study's folder for this process; BadArtefact where another one has it."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            lock = open(self.folder / ".lock", "w", encoding="utf-8")
        except OSError as error:
            raise CannotWrite(f"{self.folder}: cannot be written: {error.strerror}") from error
        with lock:  # closing it gives the folder back, as the end of the process does
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                raise BadArtefact(f"{self.folder}: another clatter study works in this folder, expected one at a time") from error
            self.lock = lock
            yield

    def makefile(self):
        targets = {one.folder: f"made/{one.folder}/{one.name}" for one in self.made.values()}
        rules = [HEAD.format(all=" ".join(targets.values()))]
        for one in self.made.values():
            inputs = "".join(f" {targets[other.folder]}" for other in one.inputs.values())
            rules.append(RULE.format(target=targets[one.folder], inputs=f" |{inputs}" if inputs else "", folder=f"made/{one.folder}", name=one.name,
                                     line=quoted(f"  {one.name} of {one.variant}"),
                                     pipeline=quoted(self.pipeline.folder.resolve()), old="".join(f"-o {name} " for name in one.inputs)))
        return "\n".join(rules)

    def make(self, jobs, only=None):
        """Makes what is missing, of artefacts [Made] or all; False where some of it could not be made, KeyboardInterrupt where it was interrupted."""
        targets = ["all"] if only is None else [f"made/{one.folder}/{one.name}" for one in only]
        if not targets:
            return True
        self.__dict__.pop("spans", None)
        # Make does not pass a signal on through the shells of its rules: it goes to the whole group. It has the lock as long as it runs, also after this
        # process was killed.
        process = subprocess.Popen(["make", "--no-print-directory", "-k", f"-j{jobs}", "-f", "study.mk", *targets], cwd=self.folder, env=environment(),
                                   start_new_session=True, pass_fds=(self.lock.fileno(),))
        before = signal.signal(signal.SIGTERM, lambda *_: os.killpg(process.pid, signal.SIGTERM))
        interrupted = False
        try:
            while True:
                try:
                    code = process.wait()
                    break
                except KeyboardInterrupt:
                    interrupted = True
                    os.killpg(process.pid, signal.SIGINT)
        finally:
            signal.signal(signal.SIGTERM, before)
        if interrupted or code < 0:
            raise KeyboardInterrupt
        return code == 0

    def show(self, name, targets):
        """variants/name: a folder of links to the artefacts of a variant."""
        folder = self.folder / "variants" / name
        wanted = {other.name: other for target in targets for other in [*target.inputs.values(), target]}
        try:
            folder.mkdir(parents=True, exist_ok=True)
            for path in folder.iterdir():
                if path.is_symlink() and (path.name not in wanted or not path.exists()):
                    path.unlink()
            for own, other in wanted.items():
                if self.path(other).exists():
                    link(folder / own, f"../../made/{other.folder}/{other.name}")
        except OSError as error:
            raise CannotWrite(f"{folder}: cannot be written: {error.strerror}") from error

    def condition(self, made):
        """What keeps the seconds of an artefact's stage from being compared with those of others: BESIDE other stages, TAKEN over from the pipeline's
        folder, of which nobody knows beside what they ran; "" for none."""
        spans = self.spans
        if made.folder not in spans:
            return TAKEN
        begin, end, launched = spans[made.folder]
        shared = sum(max(0.0, min(end, other[1]) - max(begin, other[0])) for folder, other in spans.items() if folder != made.folder)
        return BESIDE if shared > OVERLAP * (end - begin) and not launched else ""

    @functools.cached_property
    def spans(self):
        """{folder: (begin, end [s], whether by a launcher)} of all artefacts that were made here, also by earlier studies."""
        found = {}
        for path in (self.folder / "made").glob("*/.span"):
            words = path.read_text(encoding="utf-8").split()
            launched = words[-1] == "launched"
            found[path.parent.name] = (float(words[0]), float(words[-2 if launched else -1]), launched)
        return found

    def processor_seconds(self, made):
        """User and system seconds of the commands that made an artefact, on this machine; nan where they are not known."""
        path = self.folder / "made" / made.folder / ".times"
        lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
        found = [one for line in lines[1::2] for one in re.findall(r"(\d+)m([\d.]+)s", line)]  # each `times` has a line of the shell and one of its children
        return sum(60.0 * int(minutes) + float(seconds) for minutes, seconds in found) if found else float("nan")


class VariantFiles:
    """What the artefacts of one variant depend on: `changed` TOML files ({name: tables}), everything else as in the folder."""

    def __init__(self, store, changed, variant):
        self.store, self.pipeline, self.changed, self.variant = store, store.pipeline, changed, variant
        self.known = {}

    def artefact(self, name):
        """The Made of a target."""
        if name in self.known:
            return self.known[name]
        texts, inputs, given = {}, {}, {}
        seen, queue = {name}, list(self.pipeline.rules[name].inputs)
        while queue:
            one = queue.pop(0)
            if one in seen:
                continue
            seen.add(one)
            if self.pipeline.is_made(one):
                made = self.artefact(one)
                inputs.update({**made.inputs, one: made})
                texts.update(made.texts)
            elif one.endswith(".toml") and "/" not in one:
                texts[one] = self.text(one)
                queue += self.pipeline.named_by(self.tables(one))
            else:
                given[one] = self.store.digest(one)
        contents = {key: toml_text.text_of(tomllib.loads(value)) for key, value in texts.items()}  # comments do not count
        lists = [[self.pipeline.commands(name)], *([f"{key}={value}" for key, value in sorted(found.items())]
                                         for found in (given, contents, {key: made.folder for key, made in inputs.items()}))]
        digest = hashlib.sha256("".join(f"{len(part)} {part}\n" for part in [name, *(one for parts in lists for one in parts)]).encode()).hexdigest()
        made = Made(name, f"{name.removesuffix('.h5')}-{digest[:16]}", texts, inputs, self.variant)
        self.known[name] = self.store.made.setdefault(made.folder, made)
        return self.known[name]

    def tables(self, name):
        return self.changed[name] if name in self.changed else self.pipeline.table(name)

    def text(self, name):
        """The contents of a TOML file for the folder of an artefact: paths that lead out of the pipeline's folder become absolute."""
        folder, tables = self.pipeline.folder, self.tables(name)
        moved = toml_text.replace_texts(tables, lambda text: str((folder / text).resolve()) if text.startswith("../") and (folder / text).exists() else text)
        if name not in self.changed and moved == tables:
            return (folder / name).read_text(encoding="utf-8")
        return schema_line(name) + toml_text.text_of(moved)


def quoted(path):
    """A path for a command of a make rule."""
    if re.search(r"['\n#]", str(path)):
        raise BadArtefact(f"{path}: found ', # or a line break in the path of the pipeline, expected a path without them")
    return "'" + str(path).replace("$", "$$") + "'"


def link(path, target):
    """A symbolic link that replaces an older one."""
    if not path.is_symlink() or os.readlink(path) != target:
        path.unlink(missing_ok=True)
        path.symlink_to(target)
