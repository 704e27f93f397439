# SPDX-License-Identifier: GPL-3.0-or-later
"""Keys of a scene that switch the effects of its run, by the names that the run has for them (group effects)."""
import re

# Effect of a cylinder or of the scene: [(key of the scene, value that switches off, on; None: it cannot be switched so)].
PLAIN = {
    "elastic piston": [("piston.model", "rigid", "elastic")],
    "balance by other cylinders": [("engine.balanced", False, None)],
    "elastic block": [("block.model", "rigid", "elastic")],
    "oil film": [("contact.lubrication", "none", "film")],
    "cavitation": [("contact.cavitation", False, True)],
    "viscosity over pressure": [("contact.oil.pressure_coefficient_1_gpa", 0.0, None)],
    "friction factors": [("contact.friction_factors", False, None)],
    "gap around the entire skirt": [("contact.span", "pads", None)],
    "grooves and windows": [("contact.recess", [], None)],
    "asperity contact": [("contact.asperities", False, True)],
    "damping of the contact": [("contact.asperity_loss_factor", 0.0, 0.05)],
    "friction": [("contact.friction", False, True)],
    "shapes of bore and skirt": [("contact.bore_shape", [], None), ("contact.skirt_shape", [], None)],
    "gravity": [("gravity_m_s2", 0.0, 9.81)],
}
# Effects that are nothing without another one: they are not switched on where it is off.
NEEDS = {"cavitation": "oil film", "damping of the contact": "asperity contact"}
# Effect of a table with a name: its pattern, the list of tables, the same.
NAMED = [
    (r"elastic (.+)", "body", [("model", "rigid", "elastic")]),
    (r"(.+) bending", "shaft", [("model", "torsion", None)]),
    (r"(.+) torsion", "shaft", [("model", "rigid", None)]),
    (r"valve train (.+)", "valve", [("model", "quasi_static", "full")]),
    (r"tensioner (.+) oil", "tensioner", [("model", "constant_force", None)]),
    (r"tensioner (.+) check valve", "tensioner", [("model", "constant_pressure", None)]),
    (r"lash_adjuster (.+) oil", "lash_adjuster", [("model", "constant_force", None)]),
]
OF_CYLINDER = re.compile(r"(?:(\w+): |elastic (\w+)_(?=piston$))")
OF_A_CYLINDER = ("engine", "piston", "contact")  # tables of PLAIN that a cylinder may have of its own


def plain_name(name, cylinders):
    """The effect's name without that of its cylinder: "oil film" of "c3: oil film", "elastic piston" of "elastic c3_piston"."""
    found = OF_CYLINDER.match(name)
    if not found or (found[1] or found[2]) not in cylinders:
        return name
    return name[found.end():] if found[1] else "elastic piston"


def cylinders_of(value_of):
    """Names of a scene's cylinders, or their numbers."""
    return [one.get("name", str(k)) for k, one in enumerate(value_of(("cylinder",)) or []) if isinstance(one, dict)]


def keys_of(name, value_of):
    """[(path of keys, value that switches off, on)] of an effect by its plain name; [] where none is known or the scene lacks the table. `value_of(path)`:
    what the scene or its base has at a path, None for nothing. A table of a cylinder's own that has the key is switched with that of the scene."""
    found = []
    for key, off, on in PLAIN.get(name, []):
        path = tuple(key.split("."))
        if len(path) == 1 or value_of(path[:1]) is not None:
            found.append((path, off, on))
        own = [("cylinder", one, *path) for one in (cylinders_of(value_of) if path[0] in OF_A_CYLINDER else [])]
        found += [(one, off, on) for one in own if value_of(one) is not None]
    for pattern, tables, keys in [] if found else NAMED:
        match = re.fullmatch(pattern, name)
        if match and value_of((tables, match[1])) is not None:
            return [((tables, match[1], key), off, on) for key, off, on in keys]
    return found
