# SPDX-License-Identifier: GPL-3.0-or-later
"""Checksums of an artefact: which datasets and texts have one, and whether anything was damaged."""
import h5py

from clatter.artefact import BadArtefact

UNREADABLE = (OSError, RuntimeError, KeyError)  # raised by h5py on a failed read
CHECKSUM_SIGNS = ("checksum", "filter returned failure")  # HDF5 1.10 names the checksum of a chunk, 1.14 only the filter
SHOWN = 5


def objects(group, damaged):
    """(path, item) of a group and of all groups and datasets below it; paths that cannot be opened are appended to `damaged`."""
    try:
        names = sorted(group)
        dict(group.attrs)
    except UNREADABLE:
        damaged.append(group.name)
        return
    yield group.name, group
    for name in names:
        try:
            item = group[name]
            dict(item.attrs)
        except UNREADABLE:
            damaged.append(f"{group.name.rstrip('/')}/{name}")
            continue
        if isinstance(item, h5py.Dataset):
            yield item.name, item
        else:
            yield from objects(item, damaged)


def is_damage(error):
    """Whether an exception of h5py is a wrong checksum."""
    return any(sign in str(error) for sign in CHECKSUM_SIGNS)


def has_checksum(dataset):
    """Whether its values are checked on reading; an empty dataset has none to check."""
    return dataset.fletcher32 or not dataset.size


def loose_texts(item):
    """Its attributes that are texts of variable length: HDF5 keeps them in a heap without checksums."""
    return [f"{item.name}@{name}" for name in item.attrs if item.attrs.get_id(name).dtype.kind == "O"]


def without_checksum(found):
    """Datasets and attributes of these objects (path, item) that are not checked on reading."""
    return [name for name, item in found if isinstance(item, h5py.Dataset) and not has_checksum(item)] + [
        text for _, item in found for text in loose_texts(item)]


def describe(file):
    """One line: "checksums of all 34 datasets and all attributes", "no checksums", "checksums, but none of 2 objects: nodes, ..."."""
    found = list(objects(file, []))
    sets = [item for _, item in found if isinstance(item, h5py.Dataset)]
    without = without_checksum(found)
    if not without:
        return f"checksums of all {len(sets)} datasets and all attributes"
    if not any(item.fletcher32 for item in sets):
        return "no checksums: damaged numbers cannot be detected"
    return f"checksums, but none of {counted(without)}: {shown(without)}"


def counted(names):
    return f"{len(names)} object{'s' if len(names) > 1 else ''}"


def shown(names):
    rest = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(name.strip("/") for name in names[:SHOWN]) + rest


def pieces(dataset):
    """Parts that are read one at a time, so that memory stays small."""
    if dataset.chunks:
        return dataset.iter_chunks()
    rows = max(1, 2**20 // max(1, dataset.size // max(1, len(dataset)))) if dataset.shape else 1
    return [slice(at, at + rows) for at in range(0, len(dataset), rows)] if dataset.shape else [()]


def verify(path, file):
    """Reads everything; returns a line on success, else BadArtefact names what is damaged or cannot be verified."""
    damaged, count, size = [], 0, 0
    found = list(objects(file, damaged))
    for name, item in found:
        if not isinstance(item, h5py.Dataset):
            continue
        count += 1
        size += item.size * item.dtype.itemsize
        try:
            for piece in pieces(item):
                item[piece]
        except UNREADABLE:
            damaged.append(name)
    if damaged:
        raise BadArtefact(f"{path}: damaged after it was written: {shown(damaged)}")
    without = without_checksum(found)
    if without:
        raise BadArtefact(f"{path}: cannot be verified, no checksums of {counted(without)}: {shown(without)}")
    return f"{path}: {count} datasets, {size / 1e6:.1f} MB: every number and text is undamaged"
