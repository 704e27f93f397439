# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter info`: contents, inputs, certificate and cost of an artefact."""
import re

import h5py

from clatter import artefact
from . import certificate, integrity


# Of datasets that a file keeps without the attribute, by their path: those of docs/formats.md.
UNITS = [(re.compile(pattern), unit) for pattern, unit in (
    (r"/bodies/[^/]+/q$", "m"), (r"/bodies/[^/]+/v$", "m/s"), (r"/bodies/[^/]+/a$", "m/s2"),
    (r"/film/.*/(gap|axial|liner_oil|liner_height)$", "m"), (r"/film/.*/(contact_)?pressure$", "Pa"), (r"/film/.*/fill$", "1"),
    (r"/film/.*/angle_deg$", "deg"), (r"/chain/[^/]+/(x|y|pitch)$|/over/[^/]+/outline$", "m"), (r"/chain/[^/]+/angle$", "rad"),
    (r"/chain/[^/]+/tension$", "N"), (r"/effects/seconds$", "s"))]


def unit_of(item):
    """Of a dataset or of the group that keeps one for all of its datasets; empty where it has none."""
    for one in (item, item.parent):
        if "unit" in one.attrs:
            return artefact.text(one.attrs["unit"])
    return next((unit for pattern, unit in UNITS if pattern.search(item.name)), "")


def print_tree(group, depth=1):
    """Groups and datasets with shape and unit; long lists are cut after eight entries."""
    names = list(group)
    for name in names[:8] if len(names) > 12 else names:
        item = group[name]
        if isinstance(item, h5py.Group):
            print(f"{'  ' * depth}{name}/  {sparse_note(item)}".rstrip())
            if not sparse_note(item):
                print_tree(item, depth + 1)
        else:
            shape = " x ".join(map(str, item.shape)) or "scalar"
            print(f"{'  ' * depth}{name:<28} {shape:>14}  {item.dtype}  {unit_of(item)}".rstrip())
    if len(names) > 12:
        print(f"{'  ' * depth}... and {len(names) - 8} more")


def sparse_note(group):
    """"csc 300 x 300, 4213 entries" for a sparse matrix, else nothing."""
    if "format" not in group.attrs or "data" not in group:
        return ""
    rows, columns = group.attrs["shape"] if "shape" in group.attrs else ("?", "?")
    return f"{artefact.text(group.attrs['format'])} {rows} x {columns}, {len(group['data'])} entries"


def print_info(path):
    """Prints everything about one artefact."""
    with artefact.open_artefact(path) as file:
        print(f"{path}: {artefact.text(file.attrs.get('schema', 'no schema'))}, "
              f"written by clatter {artefact.text(file.attrs.get('version', 'of unknown version'))}")
        print_section("inputs", [f"{name}  sha256 {digest[:12]}  ({state})"
                                    for name, state, digest in artefact.hashed_inputs(file)])
        if artefact.text(file.attrs.get("schema", "")).startswith("clatter/rom/"):
            certificate.print_certificate(artefact.certificate(file), artefact.judgements(file))
            certificate.print_boundary(file)
        else:
            print_section("proved", [f"{name:<40} {value:<14.6g}  {certificate.remark(name, value, artefact.judgements(file))}".rstrip()
                                     for name, value in artefact.certificate(file).items()])
        steps = [f"{name:<40} {seconds:9.2f} s   peak {peak:.2f} GiB" for name, seconds, peak in artefact.timing(file)]
        if steps:
            seconds, peak = artefact.totals(file)
            steps.append(f"{'total':<40} {seconds:9.2f} s   peak {peak:.2f} GiB")
        print_section("cost", steps)
        print_section("integrity", [f"{integrity.describe(file)} (clatter info --verify checks them all)"])
        print("contents")
        print_tree({name: file[name] for name in file if name not in ("inputs", "certificate", "judged", "timing")})


def print_section(title, lines):
    if lines:
        print(title)
        for line in lines:
            print(f"  {line}")


def print_verified(path):
    """Checks every dataset against its checksum; BadArtefact if one is damaged or has none."""
    with artefact.open_artefact(path) as file:
        print(integrity.verify(path, file))


def print_config(path):
    """Prints the resolved configuration of the stage."""
    with artefact.open_artefact(path) as file:
        print(artefact.configuration(file))
