# SPDX-License-Identifier: GPL-3.0-or-later
"""One artefact (HDF5 file) as its stage wrote it: attributes, inputs, certificate, timing, effects."""
import functools
import hashlib
import pathlib

import h5py
import numpy as np

from .errors import BadArtefact, CannotWrite


def stem(path) -> str:
    """"v1.5" of "v1.5.run.h5" or "v1.5.run.toml": the name without its kind and format."""
    return pathlib.Path(path).name.rsplit(".", 2)[0]


def text(value):
    """An attribute or element that may be bytes as str."""
    return value.decode() if isinstance(value, bytes) else str(value)


def schema_of(kind):
    """The current schema of files of that kind: "clatter/mesh/2"."""
    return f"clatter/{kind}/{2 if kind in ('mesh', 'fe', 'modes', 'sound') else 1}"


def open_artefact(path, kind=None):
    """Opens an artefact for reading; `kind` is the middle of its schema, as "run" in clatter/run/1."""
    path = pathlib.Path(path)
    if not path.exists():
        raise BadArtefact(f"{path}: no such file")
    try:
        file = h5py.File(path, "r")
    except OSError as error:
        raise BadArtefact(f"{path}: not a readable HDF5 file") from error
    schema = text(file.attrs.get("schema", "none"))
    if kind and schema != schema_of(kind):
        raise BadArtefact(f"{path}: schema: found {schema}, expected {schema_of(kind)}")
    return file


def configuration(file):
    """The resolved configuration: an attribute, or a dataset of one text where it is over 60 000 bytes long."""
    return text(file["config"][0] if "config" in file else file.attrs.get("config", ""))


def dataset(file, name):
    """A dataset's values; if it is absent, BadArtefact names the file and the datasets of its group."""
    if name in file:
        return file[name][()]
    group = name.rpartition("/")[0]
    present = ", ".join(sorted(file[group])) if group in file else "no such group"
    raise BadArtefact(f"{file.filename}: {name}: missing; {group} contains: {present}")


def sha256(path):
    """Of a file's contents; of a file that has not changed it is computed once."""
    state = path.stat()
    return digest_of(path, state.st_size, state.st_mtime_ns)


@functools.lru_cache(maxsize=None)
def digest_of(path, _size, _changed):
    digest = hashlib.sha256()
    with open(path, "rb") as stream:
        for block in iter(lambda: stream.read(1 << 20), b""):
            digest.update(block)
    return digest.hexdigest()


def inputs(file):
    """Pairs (path, state) of an artefact's input files: "unchanged", "changed since", "missing"."""
    return [(path, state) for path, state, _ in hashed_inputs(file)]


def hashed_inputs(file):
    """The same with their SHA-256 at that time: (path, state, digest)."""
    if "inputs/path" not in file:
        return []
    folder = pathlib.Path(file.filename).parent
    found = []
    for path, digest in zip(file["inputs/path"][()], file["inputs/sha256"][()]):
        path = text(path)
        existing = next((p for p in (pathlib.Path(path), folder / path, folder / pathlib.Path(path).name)
                      if p.exists()), None)
        state = "missing" if existing is None else "unchanged" if sha256(existing) == text(digest) else "changed since"
        found.append((path, state, text(digest)))
    return found


def certificate(file):
    """The certificate as {name: number}."""
    return {name: value for name, value in file["certificate"].attrs.items()} if "certificate" in file else {}


def judgements(file):
    """{name: (good, refused)}: the limits of the judged numbers of the certificate (docs/certificates.md); none of older files."""
    if "judged" not in file:
        return {}
    return {name: (float(good), float(file["judged/refused"].attrs[name])) for name, good in file["judged/good"].attrs.items()}


def verdict(value, limits):
    """"good", "warned" or "refused". A number is good up to limits[0] and refused above limits[1], or, where limits[1] is the smaller
    one, good from limits[0] on and refused below limits[1]; NaN is refused."""
    good, refused = limits
    sign = -1.0 if refused < good else 1.0
    if sign * value <= sign * good:
        return "good"
    return "warned" if sign * value <= sign * refused else "refused"


def timing(file):
    """Rows (step, seconds, peak GiB so far) of the stage that wrote the file."""
    if "timing/step" not in file:
        return []
    steps = [text(name) for name in file["timing/step"][()]]
    return list(zip(steps, file["timing/seconds"][()], file["timing/peak_gib"][()]))


def totals(file):
    """(seconds, peak GiB) of the stage."""
    attributes = file["timing"].attrs if "timing" in file else {}
    return float(attributes.get("total_seconds", float("nan"))), float(attributes.get("peak_gib", float("nan")))


class Artefact:
    """A file of clatter, open for reading until it is closed; `with` closes it. Each class below reads one kind."""

    kind = None  # the middle of its schema; None: any

    def __init__(self, path):
        """path: of the file, or an open h5py.File. Refused for a file that is missing, not HDF5 or of another kind."""
        self.file = path if isinstance(path, h5py.File) else open_artefact(path, self.kind)  # for all that has no name here
        self.path = pathlib.Path(self.file.filename)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return f"{type(self).__name__}({str(self.path)!r})"

    def close(self) -> None:
        """Closes the file; arrays that were read stay."""
        self.file.close()

    def attribute(self, name):
        """An attribute of the file, SI units: text, or a number."""
        self._check(name in self.file.attrs, f"attribute {name}: missing")
        value = self.file.attrs[name]
        return value if isinstance(value, np.number) else text(value)

    def _check(self, condition, otherwise) -> None:
        """Refused with the file and a sentence where a condition does not hold."""
        if not condition:
            raise BadArtefact(f"{self.path}: {otherwise}")

    @property
    def certificate(self) -> dict:
        """{name: number}: what was proved; units and meanings are in docs/formats.md."""
        return {name: float(value) for name, value in certificate(self.file).items()}

    @property
    def verdicts(self) -> dict:
        """{name: "good", "warned" or "refused"} of the judged numbers of the certificate; docs/certificates.md has the limits."""
        return {name: verdict(self.certificate[name], limits) for name, limits in judgements(self.file).items()}

    @property
    def configuration(self) -> str:
        """Every value of configuration that was used, `table.key = value` a line."""
        return configuration(self.file)

    @property
    def inputs(self) -> list:
        """Pairs (path, state) of the files that were read: "unchanged", "changed since" or "missing"."""
        return inputs(self.file)

    @property
    def seconds(self) -> float:
        """Time that the program took [s]."""
        return totals(self.file)[0]
