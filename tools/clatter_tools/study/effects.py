# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter study --effects`: each effect of a scene switched off, or on where a default is enough, what that changes and what it saves.

Which effects a scene has, and whether they are on, is what its run says (group effects). effect_keys.py has the keys that switch them, in all
cylinders at once; others are named in the study file:

    [[effect]]
    name = "friction of the guides"
    keys = ["drive.run.toml:chain.chain.over.1.contact.friction", "drive.run.toml:chain.chain.over.4.contact.friction"]   # or key = "..."
    off = 0.0                          # and on = value for an effect that is off; [..] with a value for each key

Quantities that need what an effect switches off (the sound of a block that becomes rigid) are not known without it: it is kept. Seconds depend on what else
runs: the base is made once more beside the others, as far as they differ from it, and its seconds are those of that time.
"""
import copy
import csv
import dataclasses
import math
import re

from clatter import artefact
from clatter.artefact import text
from . import effect_keys, plan, results, run, toml_text
from .findings import digits

CLEAR = 2.0  # standard errors: a smaller change of a mean may be none
SAVES = 0.1  # of the seconds: less is no reason to leave an effect out, and within what seconds vary by


@dataclasses.dataclass
class Switch:
    """An effect switched from what the scene has: to "off" or "on" by {file: tables}; `changes`: by quantity [Value or None]; `saved`: share of the
    seconds that is saved, negative where it costs more, of the stages that the effect changes."""
    name: str
    to: str
    tables: dict
    changes: list = dataclasses.field(default_factory=list)
    saved: float = float("nan")


def switches_of(wanted, pipeline, scenes):
    """The Switches of a scene's effects; `scenes`: {scene file: {effect: "on" or "off"}}."""
    found = []
    for file, effects in scenes.items():
        value_of = lambda path, file=file: pipeline.base_value(file, path)  # noqa: E731
        states = plain_states(effects, value_of)
        for name, state in states.items():
            if state == "off" and states.get(effect_keys.NEEDS.get(name), "on") == "off":
                continue
            values = [(path, off if state == "on" else on) for path, off, on in effect_keys.keys_of(name, value_of)]
            if values and all(value is not None for _, value in values):
                found.append(switch(wanted, pipeline, name, "off" if state == "on" else "on", [((file, path), value) for path, value in values]))
    for one in wanted.effects:
        values = [pipeline.base_value(*key) for key in one.keys]
        to = "on" if one.off is None or (one.on is not None and values == one.off) else "off"
        found.append(switch(wanted, pipeline, one.name, to, list(zip(one.keys, one.on if to == "on" else one.off))))
    return found


def plain_states(effects, value_of):
    """{effect: "on" or "off"} with one entry for all cylinders: "on" where it is in one of them."""
    cylinders, found = effect_keys.cylinders_of(value_of), {}
    for name, state in effects.items():
        plain = effect_keys.plain_name(name, cylinders)
        found[plain] = "on" if "on" in (state, found.get(plain)) else state
    return found


def switch(wanted, pipeline, name, to, values):
    """A Switch by [((file, path of keys), value)]."""
    tables = {}
    for (file, path), value in values:
        own = tables.setdefault(file, copy.deepcopy(pipeline.table(file)))
        toml_text.set_value(f"{wanted.path}: {name}: {file}", own, path, value)
    return Switch(name, to, tables)


def states_of(made, own):
    """{scene file: {effect: state}} of the runs of a variant whose scenes are in the pipeline's folder."""
    found = {}
    for one in {one.name: one for target in own for one in [*target.inputs.values(), target]}.values():
        scene = one.name.removesuffix(".h5") + ".toml"
        if one.name.endswith(".run.h5") and (made.pipeline.folder / scene).is_file():
            with artefact.open_artefact(made.store.path(one), "run") as file:
                if "effects/name" in file:
                    found[scene] = {text(name): text(state) for name, state in zip(file["effects/name"][()], file["effects/state"][()])}
    return found


@dataclasses.dataclass
class Effects:
    """base: values of the quantities; switches in the order of their effects."""
    plan: plan.Plan
    base: list
    switches: list

    def scaled(self, quantity, difference):
        """A change of a quantity in the units of its errors."""
        size = self.base[quantity].size()
        return difference / size if self.plan.quantities[quantity].relative and size > 0.0 else difference

    def small(self, quantity):
        """A change that does not matter, in the units of errors."""
        own = self.plan.quantities[quantity].small
        return 0.01 * self.base[quantity].size() if own is None else own


def make(path, jobs):
    """The Effects of a study file: makes the base, then the scenes with one effect switched."""
    wanted = plan.read(path, required="quantity")
    pipeline = run.pipeline_of(wanted)
    made = run.Making(wanted, pipeline)
    base = made.add({})
    made.make(["base"], [base], jobs)
    switches = switches_of(wanted, pipeline, states_of(made, base))
    folders = [re.sub(r"[^\w.+=-]+", "-", f"{one.to}-{one.name}") for one in switches]
    artefacts = [made.add(one.tables, folder) for one, folder in zip(switches, folders)]
    timed = once_more(made, base, artefacts)
    made.make(["base", "base-once-more", *folders], [base, timed, *artefacts], jobs)
    found = Effects(wanted, made.values(base), switches)
    before = made.stages(timed)
    for one, own in zip(switches, artefacts):
        one.changes = [None if value is None else value.minus(old) for value, old in zip(made.values(own), found.base)]
        one.saved = saved(wanted, before, made.stages(own), changed_names(base, [own]))
    return found


def changed_names(base, others):
    """Names of the artefacts in which variants, [Made] each, differ from the base."""
    known = {one.name: one.folder for target in base for one in [*target.inputs.values(), target]}
    return {one.name for own in others for target in own for one in [*target.inputs.values(), target] if known.get(one.name) != one.folder}


def once_more(made, base, others):
    """The artefacts of the base, [Made], to be made once more in other folders, as far as one of the others differs from them."""
    names = changed_names(base, others)

    def again(one):
        if one.name not in names:
            return one
        found = dataclasses.replace(one, folder=f"{one.folder}-once-more", inputs={name: again(other) for name, other in one.inputs.items()})
        return made.store.made.setdefault(found.folder, found)

    return [again(one) for one in base]


def saved(wanted, before, after, names):
    """Share of the seconds of stages, by name, that is saved; nan where one of them is missing."""
    spent = [run.cost_of(wanted, [stage for stage in stages if stage.name in names]) for stages in (before, after)]
    return 1.0 - spent[1] / spent[0]


def change_text(effects, quantity, change):
    """"+0.02 dB(A)", "-3.1 %", of means "+0.4 ± 0.3 dB(A)"; of a curve the largest change."""
    own = effects.plan.quantities[quantity]
    value, error = (effects.scaled(quantity, one) for one in (change.number(), change.error))
    factor, unit = (100.0, "%") if own.relative else (1.0, own.unit)
    spread = f" ± {digits(factor * error)}" if error > 0.0 else ""
    return f"{digits(factor * value, '+')}{spread} {unit}".rstrip()


def advice(effects, one):
    """"leave out", "keep", "switch on" or "leave off"; what could not be run is said."""
    missing = [own.name for own, change in zip(effects.plan.quantities, one.changes) if change is None]
    if len(missing) == len(one.changes):
        return f"cannot be switched {one.to} here: see what its stage said"
    known = [(effects.scaled(k, change.size()), effects.scaled(k, change.error), effects.small(k)) for k, change in enumerate(one.changes)
             if change is not None]
    matters = any(size > max(small, CLEAR * error) for size, error, small in known)
    if missing:
        return f"{'keep' if one.to == 'off' else 'leave off'} (some results cannot be computed {'without' if one.to == 'off' else 'with'} it)"
    if not matters and any(size + CLEAR * error > small for size, error, small in known if error > 0.0):
        return f"{'keep' if one.to == 'off' else 'leave off'} (within twice the standard error: more cycles decide)"
    if one.to == "on":
        return "switch on" if matters else "leave off"
    if matters:
        return "keep"
    return "leave out" if one.saved > SAVES else "costs little, keep"


def sentence(effects, one):
    """"friction: height of the slap -3.1 %, sound power +0.02 dB(A), 8 % of the time: leave out"."""
    name = one.name if one.to == "off" else f"{one.name} (off)"
    known = [f"{effects.plan.quantities[k].name} {change_text(effects, k, change)}" for k, change in enumerate(one.changes) if change is not None]
    share = one.saved if one.to == "off" else -one.saved
    time = [f"{100.0 * share:.0f} % of the time" if share >= 0.0 else f"without it {-100.0 * share:.0f} % more time"] if math.isfinite(share) else []
    return f"{name}: {', '.join([*known, *time]) or 'not known'}: {advice(effects, one)}"


def report(effects):
    """All lines that are printed; a change of a quantity is that by switching the effect off (on where it says so)."""
    if not effects.switches:
        return ["no effect of the scenes can be switched by a key that is known; [[effect]] names others"]
    return [sentence(effects, one) for one in effects.switches]


def rows(effects):
    """What the sentences say as a table: rows of cells, the first is the head."""
    found = [["effect", "switched", *(own.name for own in effects.plan.quantities), "its share of the time", "advice"]]
    for one in effects.switches:
        changes = ["-" if change is None else change_text(effects, k, change) for k, change in enumerate(one.changes)]
        share = one.saved if one.to == "off" else -one.saved
        found.append([one.name, one.to, *changes, f"{100.0 * share:.0f} %" if math.isfinite(share) else "-", advice(effects, one)])
    return found


def write(effects):
    """effects.csv in the study's folder; returns its path."""
    def fill(part):
        with open(part, "w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            names = [f"{one.name} [{'1' if one.relative else one.unit}]" for one in effects.plan.quantities]
            writer.writerow(["effect", "switched", *names, "share of the seconds saved", "advice"])
            for one in effects.switches:
                changes = ["" if change is None else f"{effects.scaled(k, change.number()):.6g}" for k, change in enumerate(one.changes)]
                writer.writerow([one.name, one.to, *changes, f"{one.saved:.4g}", advice(effects, one)])

    return results.whole(effects.plan.output / "effects.csv", fill)
