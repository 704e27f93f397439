"""Checksums of an artefact: which datasets have one (HDF5's Fletcher32), and whether every number is as it was written."""
import h5py

from .artefact import BadArtefact

UNREADABLE = (OSError, RuntimeError, KeyError)  # what h5py makes of a failed read
SHOWN = 5


def objects(group, damaged):
    """Datasets (path, dataset) below a group; the paths of objects that cannot be opened join `damaged`."""
    try:
        names = sorted(group)
    except UNREADABLE:
        damaged.append(group.name)
        return
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


def has_checksum(dataset):
    """Whether its values are checked on reading; an empty dataset has none to check."""
    return dataset.fletcher32 or not dataset.size


def describe(file):
    """One line: "checksums of all 34 datasets", "no checksums", "checksums of 30 of 34 datasets: without: nodes"."""
    found = list(objects(file, []))
    without = [name for name, item in found if not has_checksum(item)]
    if not without:
        return f"checksums of all {len(found)} datasets"
    if len(without) == sum(bool(item.size) for _, item in found):
        return "no checksums: numbers that were damaged cannot be told from right ones"
    return f"checksums of {len(found) - len(without)} of {len(found)} datasets, none of {shown(without)}"


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
    """Reads everything; returns a line of praise, or BadArtefact names what is damaged or cannot be verified."""
    damaged, without, count, size = [], [], 0, 0
    for name, item in objects(file, damaged):
        count += 1
        size += item.size * item.dtype.itemsize
        if not has_checksum(item):
            without.append(name)
        try:
            for piece in pieces(item):
                item[piece]
        except UNREADABLE:
            damaged.append(name)
    if damaged:
        raise BadArtefact(f"{path}: damaged after it was written: {shown(damaged)}")
    if without:
        raise BadArtefact(f"{path}: cannot be verified, no checksums of {len(without)} datasets: {shown(without)}")
    return f"{path}: {count} datasets, {size / 1e6:.1f} MB: every number is as it was written"
