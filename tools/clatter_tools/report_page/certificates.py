# SPDX-License-Identifier: GPL-3.0-or-later
"""Certificates in words: what was proved of each artefact, and what was not."""
from clatter import artefact
from clatter.artefact import stem
from ..certificate import GROUPS, limit_text, value_text, verdict

GOOD, NOTE, BAD = "good", "note", "bad"
STATE = {"good": GOOD, "warned": NOTE, "refused": BAD}
ORDER = (GOOD, NOTE, BAD)
OTHERS = ("mesh", "fe", "modes", "static", "sound")   # kinds that have a card where a number is not good
LISTED = 6             # bodies of a run that are named


def collect(folder):
    """Cards (title, state, sentences, table) of reduced models, runs and fields, and of what else has a number that is not good."""
    cards = []
    for kind in OTHERS:
        for path in folder.files.get(kind, ()):
            with artefact.open_artefact(path, kind) as file:
                if said := objections(artefact.certificate(file), artefact.judgements(file), ()):
                    cards.append({"title": path.name, "state": worst(said), "sentences": said, "table": []})
    for path in folder.files["rom"]:
        with artefact.open_artefact(path, "rom") as file:
            cards.append(reduced_model(stem(path), artefact.certificate(file), artefact.judgements(file)))
    for one in folder.runs:
        sentences = []
        if one.run is not None:
            sentences += run_sentences(artefact.certificate(one.run), artefact.judgements(one.run))
        if one.field is not None:
            sentences += field_sentences(one.field)
        if sentences:
            cards.append({"title": f"run {one.stem}", "run": one.number, "state": worst(sentences), "sentences": sentences, "table": []})
    return cards


def percent(share):
    """"0.023 %", "210 %"."""
    return f"{100.0 * share:.2g} %" if share < 1.0 else f"{100.0 * share:.0f} %"


def worst(sentences):
    return max((state for state, _ in sentences), key=ORDER.index)


def state(found, limits, name):
    """Of a number of a certificate by its judgement; a note without one, as in older files, which nobody judged."""
    return STATE[artefact.verdict(found[name], limits[name])] if name in limits else NOTE


def objections(found, limits, said):
    """Sentences about numbers that are not good, but those that have a sentence of their own."""
    return [(state(found, limits, name), f"{name} is {found[name]:.3g}, good {limit_text(limits[name])} (docs/certificates.md).")
            for name in limits if name not in said and state(found, limits, name) != GOOD]


def reduced_model(name, found, limits):
    sentences = model_sentences(found, limits)
    rows = [[title, key, value_text(form, found[key]), meaning] for title, group in GROUPS for key, form, meaning in group if key in found]
    return {"title": f"reduced model {name}", "state": worst(sentences), "sentences": sentences, "table": rows}


def model_sentences(found, limits):
    certified = bool(found) and found.get("certified", 1.0)
    sentences = [(GOOD if certified and found.get("count_proved") else BAD, f"{verdict(found)[0].upper()}{verdict(found)[1:]}.")]
    if "rigid_modes" in found:
        free = f"It moves freely as a rigid body: {found['rigid_modes']:.0f} modes without stiffness" if found["rigid_modes"] else \
            "It is held: no rigid motion is free"
        mass = f"; its mass agrees with the full model's to {found['mass_error']:.0e}" if found.get("mass_error") else ""
        sentences.append((GOOD, f"{free}{mass}."))
    if "frequency_error_estimate" in found and "accurate_to_hz" in found:
        sentences.append((state(found, limits, "frequency_error_estimate"), f"Its own frequencies up to {found['accurate_to_hz']:.0f} Hz are wrong by at most about "
                          f"{percent(found['frequency_error_estimate'])}."))
    if "verified_modes" in found:
        how = max((state(found, limits, name) for name in ("verified_frequency_error", "verified_mac")), key=ORDER.index)
        sentences.append((how, f"Compared with {found['verified_modes']:.0f} modes of the full model: largest error "
                          f"{percent(found['verified_frequency_error'])}, smallest MAC {found['verified_mac']:.4f}."))
    return sentences + objections(found, limits, ("count_proved", "frequency_error_estimate", "verified_frequency_error", "verified_mac"))


def run_sentences(found, limits):
    sentences = []
    if "complete" in found:
        sentences.append((GOOD, "The run is complete.") if found["complete"] else (BAD, "The run was interrupted: it is not complete."))
    if "energy_residue" in found:
        exchanged = f" ({found['energy_exchanged']:.3g} J)" if "energy_exchanged" in found else ""
        sentences.append((state(found, limits, "energy_residue"),
                          f"The balance of energies closes to {found['energy_residue']:.1e} of what was exchanged{exchanged}."))
    sentences += [(GOOD, f"The piston{f' {name}' if name else ''} repeats its lateral position from cycle to cycle to {1e6 * value:.2g} µm.")
                  for name, value in piston_changes(found)]
    changes = sorted(((value, key.removeprefix("periodicity_")) for key, value in found.items()
                      if key.startswith("periodicity_") and not key.startswith(("periodicity_lateral", "periodicity_tilt"))), reverse=True)
    if changes:
        named = ", ".join(f"{name} {percent(value)}" for value, name in changes[:LISTED])
        more = f", of {len(changes) - LISTED} further bodies less" if len(changes) > LISTED else ""
        sentences.append((state(found, limits, f"periodicity_{changes[0][1]}"), f"Velocities change from the last cycle but one to the last: {named}{more}."))
    elif "cycles" in found:
        sentences.append((NOTE, "It has one cycle only: whether it repeats is not known."))
    if "steps_accepted" in found:
        sentences.append((GOOD, f"{found['steps_accepted']:.0f} steps accepted, {found.get('steps_rejected', 0.0):.0f} repeated with a smaller step."))
    return sentences + objections(found, limits, [name for name in limits if name == "energy_residue" or name.startswith("periodicity_")])


def piston_changes(found):
    """(cylinder, change of the lateral position [m])."""
    key = "periodicity_lateral"
    return [(name.removeprefix(key).lstrip("_"), value) for name, value in found.items() if name.startswith(key)]


def field_sentences(field):
    found, limits = artefact.certificate(field), artefact.judgements(field)
    sentences = []
    if "spectra_to_hz" in field.attrs:
        sentences.append((GOOD, f"Spectra reach from {field.attrs.get('spectra_from_hz', 0.0):.0f} to {field.attrs['spectra_to_hz']:.0f} Hz"
                          f"{spectra_limit(field)}."))
    if "mean_square_share_above_spectra" in found:
        share = found["mean_square_share_above_spectra"]
        sentences.append((state(found, limits, "mean_square_share_above_spectra"), f"{percent(share)} of the mean square velocity is above the spectra."))
    if "cycle_end_velocity_jump" in found:
        jump = found["cycle_end_velocity_jump"]
        sentences.append((state(found, limits, "cycle_end_velocity_jump"), f"The surface velocity at the end of the cycle differs from that at its beginning "
                          f"by {percent(jump)} of its RMS."))
    if "skin_closure" in found:
        open_by = found["skin_closure"]
        how = state(found, limits, "skin_closure")
        sentences.append((how, "The skin is closed." if how == GOOD else f"The skin is open: the integral of its normals is {percent(open_by)} of its area."))
    return sentences + objections(found, limits, ("run_complete", "mean_square_share_above_spectra", "cycle_end_velocity_jump", "skin_closure"))


def spectra_limit(field):
    limit = artefact.text(field.attrs["spectra_limit"]) if "spectra_limit" in field.attrs else ""
    return f" ({limit})" if limit else ""
