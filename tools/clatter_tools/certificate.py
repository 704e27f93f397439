# SPDX-License-Identifier: GPL-3.0-or-later
"""The certificate of a reduced model, grouped, with unit and meaning of each figure."""
import numpy as np

from clatter import artefact

# (group, rows of (key, format with unit, meaning)); units and meanings are those of the table in docs/formats.md.
GROUPS = [
    ("rigid motions and mass", [
        ("rigid_modes", "{:.0f}", "zero modes, as many as the body has free motions"),
        ("rigid_stiffness_residue", "{:.1e}", "|K_rr r| / (|K_rr| |r|) of a rigid motion r"),
        ("rigid_shape_error", "{:.1e}", "rigid motions by the constraint modes, before they were restored"),
        ("mass_error", "{:.1e}", "ten mass properties against the full matrices"),
        ("mass_error_elements", "{:.1e}", "the same against the sum over the elements"),
        ("inertia_invariants_error", "{:.1e}", "inertia invariants against M_rr and the rigid motions"),
    ]),
    ("modes of the basis", [
        ("fixed_interface_modes", "{:.0f}", "modes with the boundary held"),
        ("own_modes", "{:.0f}", "modes of the body itself"),
        ("load_shapes", "{:.0f}", "static shapes of load cases"),
        ("residual_modes", "{:.0f}", "vectors that represent the truncated modes"),
        ("eigen_residual_max", "{:.1e}", "largest residual of a mode"),
        ("eigen_frequency_error", "{:.1e}", "largest estimated relative error of its frequency, by AMLS"),
        ("modal_mass_error", "{:.1e}", "modal masses against 1"),
        ("dropped_vectors", "{:.0f}", "dependent vectors removed"),
        ("count_proved", "{:yes}", "no mode is missing, by the inertia count below"),
        ("count_below", "{:.0f}", "modes below the limit by inertia"),
        ("count_limit_hz", "{:.2f} Hz", "the limit of the count"),
    ]),
    ("accuracy", [
        ("cutoff_hz", "{:.1f} Hz", "all modes up to here are in the basis"),
        ("accurate_to_hz", "{:.1f} Hz", "the errors below hold up to here"),
        ("frequency_error_estimate", "{:.2e}", "largest estimated relative error of the body's own frequencies"),
        ("frequency_error_joined", "{:.2e}", "the same without residual modes: for a body joined to others"),
        ("frequency_error_modes", "{:.0f}", "own elastic modes used for both estimates"),
        ("frequency_error_parts", "{:.2e}",
         "largest estimated relative error of these frequencies for the modes that reduced parts lack"),
        ("frequency_error_target", "{:.2e}", "requested accuracy"),
        ("frequency_error_bound", "{:.2e}", "bound for the chosen cut-off"),
        ("cutoffs_tried", "{:.0f}", "cut-offs tried to find it"),
        ("rows_added_error", "{:.1e}", "rows added later: difference of the recomputed basis"),
        ("verified_to_hz", "{:.1f} Hz", "compared with modes of the full model up to here"),
        ("verified_modes", "{:.0f}", "elastic modes compared"),
        ("verified_frequency_error", "{:.2e}", "largest relative error of a frequency found"),
        ("verified_mac", "{:.6f}", "smallest MAC found"),
    ]),
    ("interface modes", [
        ("interface_coordinates", "{:.0f}", "boundary coordinates before they were reduced"),
        ("interface_modes", "{:.0f}", "characteristic constraint modes kept"),
        ("interface_cutoff_hz", "{:.1f} Hz", "the lowest omitted one; 0: none omitted, or weighted by area"),
        ("interface_frequency_error", "{:.2e}", "largest frequency error due to this reduction"),
        ("interface_film_work_error", "{:.2e}", "error of the work of a film's pressure"),
    ]),
    ("conditioning", [
        ("condition_M_rr", "{:.1e}", "condition of M_rr with unit diagonal"),
        ("first_elastic_hz", "{:.2f} Hz", "first elastic mode of (K_rr, M_rr)"),
        ("max_frequency_hz", "{:.4g} Hz", "highest mode: an explicit step must resolve it"),
        ("K_ii_rcond", "{:.1e}", "ratio of the pivots of K_ii"),
        ("K_ii_probe_residual", "{:.1e}", "residual of a random solve with K_ii"),
    ]),
]


def bad(name, value, judgements):
    """What follows the meaning of a number that is not good."""
    said = remark(name, value, judgements)
    return f": {said}" if said.startswith("NOT") else ""


def value_text(form, value):
    if form == "{:yes}":
        return "yes" if value else "no"
    return form.format(value)


def verdict(found):
    """A summary in one line."""
    if not found:
        return "NO CERTIFICATE: its modes and its mass were not checked"
    if not found.get("certified", 1.0):
        return "NOT CERTIFIED: condensed with --no-certificate, or from such a part; modes not counted, spectrum not computed"
    proof = "no mode is missing" if found.get("count_proved") else "THE NUMBER OF MODES IS NOT PROVED"
    known = "verified by the full model" if "verified_modes" in found else "errors estimated, not verified (--verify)"
    return f"certified; {proof}; {known}"


def limit_text(limits):
    """"up to 0.001", "from 0.9": the numbers that are good."""
    return f"{'from' if limits[1] < limits[0] else 'up to'} {limits[0]:g}"


def remark(name, value, judgements):
    """"" for what is not judged, "good (up to 0.001)" or "NOT GOOD (up to 0.001)"."""
    if name not in judgements:
        return ""
    good = artefact.verdict(value, judgements[name]) == "good"
    return f"{'good' if good else 'NOT GOOD'} ({limit_text(judgements[name])})"


def print_certificate(found, judgements):
    """`found`, `judgements`: artefact.certificate(file), artefact.judgements(file) of a reduced model."""
    print(f"certificate: {verdict(found)}")
    left = {name: value for name, value in found.items() if name != "certified"}
    for title, rows in GROUPS:
        rows = [(name, value_text(form, left[name]), meaning + bad(name, left.pop(name), judgements)) for name, form, meaning in rows if name in left]
        if rows:
            print(f"  {title}")
        for name, value, meaning in rows:
            print(f"    {name:<26} {value:>14}  {meaning}")
    if left:
        print("  more")
    for name, value in left.items():
        print(f"    {name:<26} {value:>14.6g}")


def print_boundary(file):
    """The boundary map: coordinates and mean position of each set."""
    if "sets" not in file:
        return
    units = artefact.text(file.attrs["units"]) if "units" in file.attrs else "SI"
    print(f"boundary: {file.attrs['n_boundary']} of {len(file['K_rr'])} coordinates ({units})")
    for name, dofs in file["sets"].items():
        at, position = dofs["dofs"][()], dofs["position"][()]
        rotations = np.count_nonzero(dofs["is_rotation"][()])
        centre = ", ".join(f"{x:.4g}" for x in position.mean(axis=0))
        span = f"{at.min() + 1}-{at.max() + 1}" if len(at) else "none"
        print(f"    {name:<26} {span:>14}  {artefact.text(dofs.attrs['kind'])}: {len(at) - rotations} displacements, "
              f"{rotations} rotations about ({centre}) m")
