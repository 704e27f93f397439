# SPDX-License-Identifier: GPL-3.0-or-later
"""The scenes that sweep.mk lists, which `clatter sweep` wrote into a folder."""
import re


def names(folder):
    """Names of the scenes in their order; None where there is no sweep.mk."""
    fragment = folder / "sweep.mk"
    if not fragment.exists():
        return None
    found = re.search(r"^\S+_names := (.*)$", fragment.read_text(encoding="utf-8"), re.M)
    return found[1].split() if found else None


def field_settings(folder):
    """The file.toml of `clatter sweep --field`; None without."""
    found = re.search(r"^\$\(\S+_fields\): \S+: \S+ (\S+) \$\(clatter_recover\)$", (folder / "sweep.mk").read_text(encoding="utf-8"), re.M)
    return found[1] if found else None
