# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of a page: arrays in named blocks, each compressed and written as text; a page decodes a block when it first needs it."""
import base64
import json
import zlib

import numpy as np

ALIGN = 8      # bytes, of the beginning of each array in its block
LEVEL = 6      # of the compression


class Pack:
    """Collects arrays; add() returns what refers to one in the page's JSON."""

    def __init__(self):
        self.blocks = {}

    def add(self, block, values, kind="<f4", **more):
        """Appends an array as numbers of that kind; the page gets its flat values, its shape, and `more`. A `scale` multiplies
        integers in the page."""
        values = np.asarray(values)
        if kind[-2] in "iu" and values.dtype.kind == "f":
            values = np.rint(values)
        values = np.ascontiguousarray(values, kind)
        data = self.blocks.setdefault(block, bytearray())
        reference = {"block": block, "at": len(data), "kind": kind[-2:], "shape": list(values.shape), **more}
        # Bytes of equal weight together: numbers that vary slowly then repeat their upper ones, which compresses well.
        planes = values.view("u1").reshape(-1, values.itemsize).T if values.size else np.zeros(0, "u1")
        data += np.ascontiguousarray(planes).tobytes()
        data += bytes(-len(data) % ALIGN)
        return reference

    def scaled(self, block, values, bits=16):
        """The same as integers of 8 or 16 bits between the least and the largest value: the page computes offset + scale n."""
        values = np.asarray(values, float)
        low, high = (float(values.min()), float(values.max())) if values.size else (0.0, 0.0)
        scale = (high - low) / (2**bits - 1) or 1.0
        return self.add(block, (values - low) / scale, f"<u{bits // 8}", scale=scale, offset=low)

    def texts(self):
        """{block: its text}."""
        return {name: base64.b64encode(zlib.compress(bytes(data), LEVEL)).decode() for name, data in self.blocks.items()}


def plain(value):
    """A value for JSON: numbers of NumPy as those of Python, None for what is not finite."""
    if isinstance(value, dict):
        return {key: plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(one) for one in value]
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return plain(value.item())
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value


def json_text(value):
    """JSON that may be written between the tags of a page."""
    return json.dumps(plain(value), separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
