# SPDX-License-Identifier: GPL-3.0-or-later
"""Run files of a small chain drive with known shape, tensions, speeds: an oval of 60 links around two sprockets."""
import numpy as np
from synthetic import history, new_file

PITCH, LINKS, TEETH, SPAN = 8e-3, 60, 20, 20  # the straight spans are 20 pitches long
RADIUS = TEETH * PITCH / (2.0 * np.pi)
SLACK, TIGHT, SWING = 100.0, 300.0, 50.0  # [N]
CYCLES = 3


def on_oval(s):
    """Points of the loop, clockwise from the left of the crank upwards, and the tension there without its swing."""
    s = np.remainder(s, LINKS * PITCH)
    span, arc = SPAN * PITCH, 0.5 * TEETH * PITCH
    turn = np.array([np.clip((s - span) / RADIUS, 0.0, np.pi), np.clip((s - 2.0 * span - arc) / RADIUS, 0.0, np.pi)])
    x = np.where(s < 2.0 * span + arc, -RADIUS * np.cos(turn[0]), RADIUS * np.cos(turn[1]))
    y = np.select([s < span, s < span + arc, s < 2.0 * span + arc],
                  [s, span + RADIUS * np.sin(turn[0]), 2.0 * span + arc - s], -RADIUS * np.sin(turn[1]))
    from_guide = np.abs(s - 2.0 * span + 0.5 * span - arc) / (0.5 * span)  # 1 at both ends of the tight span
    tension = SLACK + (TIGHT - SLACK) * (turn[0] - turn[1]) / np.pi - 0.2 * np.clip(from_guide, 0.0, 1.0) * (turn[0] - turn[1]) / np.pi
    return np.stack([x, y], axis=-1), tension


def speed(angle, rpm, amplitude):
    """Of the cam [rad/s]: order 1.5 with this amplitude, order 20 with a tenth of it."""
    return rpm * np.pi / 30.0 + amplitude * np.sin(1.5 * angle) + 0.1 * amplitude * np.cos(20.0 * angle)


def write_drive(path, rpm=3000.0, amplitude=4.0, mirrored=False, shapes=90, turns=2.0 * CYCLES, jump=False):
    """One drive; `mirrored`: in a plane in which it runs counter-clockwise. The crank turns at constant speed."""
    side = -1.0 if mirrored else 1.0
    omega = rpm * np.pi / 30.0
    end = 2.0 * np.pi * turns / omega
    with new_file(path, "run") as file:
        file.attrs["title"] = "oval <drive>"
        file["output/time"] = [0.0, end]
        write_shapes(file, np.linspace(0.0, end, shapes), omega, side)
        rng = np.random.default_rng(7)
        # Steps of different lengths, about 0.3 deg of the crank.
        time = np.cumsum(rng.uniform(0.5, 1.5, int(turns * 1200)))
        time *= end / time[-1]
        angle = omega * time
        file["history/time"] = time
        swing = SWING * np.cos(1.5 * angle)
        history(file, "chain_tension_min", SLACK + np.minimum(swing, 0.0), "N")
        history(file, "chain_tension_max", TIGHT + np.maximum(swing, 0.0), "N")
        history(file, "chain_jumps", np.where(jump & (time > 0.5 * end), 2.0, 0.0), "1")
        history(file, "chain_crank_speed", np.full(len(time), omega), "rad/s")
        history(file, "chain_cam_speed", speed(angle, rpm, amplitude), "rad/s")
        for number, name in enumerate(("crank", "cam", "guide")):
            history(file, f"chain_{name}_force_x", 300.0 * (number + 1) * np.sin(angle), "N")
            history(file, f"chain_{name}_force_y", 400.0 * (number + 1) * np.sin(angle), "N")
        history(file, "tensioner_t_pressure", 1e5 * (10.0 + 9.0 * np.sin(1.5 * angle)), "Pa")
        history(file, "tensioner_t_travel", 1e-3 * (2.0 + np.cos(1.5 * angle)), "m")
        history(file, "tensioner_t_lift", np.full(len(time), 4.2e-4), "m")
        history(file, "tensioner_t_force", 150.0 + 100.0 * np.sin(1.5 * angle), "N")
        history(file, "intake_1_lift", 7.5e-3 * np.maximum(np.cos(0.5 * angle), 0.0) ** 3, "m")
        history(file, "intake_1_coil_gap", 2e-4 * (1.0 - np.maximum(np.cos(0.5 * angle), 0.0)), "m")
        history(file, "bracket_acceleration", 2.0 * np.sin(1.5 * angle) + 0.5 * np.sin(20.0 * angle + 1.0) + 3.0, "m/s2")


def write_shapes(file, time, omega, side):
    angle = omega * time
    group = file.require_group("chain/chain")
    group.attrs.update({"plane": "xy", "bush_radius": 2.5e-3, "plate_half_height": 3.6e-3})
    group["time"] = time
    group["inner"] = np.arange(LINKS, dtype=np.int32) % 2
    group["pitch"] = np.full(LINKS, PITCH)
    begin = PITCH * (np.arange(LINKS) + (angle * RADIUS / PITCH)[:, None])
    rear, _ = on_oval(begin)
    front, tension = on_oval(begin + PITCH)
    along = front - rear
    direction = np.arctan2(along[..., 1], side * along[..., 0])
    for name, values in (("x", side * 0.5 * (rear + front)[..., 0]), ("y", 0.5 * (rear + front)[..., 1]), ("angle", direction),
                         ("tension", tension + SWING * np.cos(1.5 * angle)[:, None] * (tension > 0.99 * TIGHT))):
        group[name] = values.astype(np.float32)
    circle = np.linspace(0.0, 2.0 * np.pi, 101)
    wheel = RADIUS * np.column_stack([np.cos(circle), np.sin(circle)])
    turn = "clockwise" if side > 0.0 else "counter-clockwise"
    other = "counter-clockwise" if side > 0.0 else "clockwise"
    y = np.linspace(0.8 * SPAN * PITCH, 0.2 * SPAN * PITCH, 33)
    guide = np.column_stack([np.full(len(y), side * (RADIUS + 3.6e-3)), y])
    for order, (name, teeth, way, outline, at) in enumerate((("crank", TEETH, turn, wheel, 0.0), ("cam", TEETH, turn, wheel, SPAN * PITCH),
                                                             ("guide", 0, other, guide, 0.0))):
        part = group.require_group(f"over/{name}")
        part.attrs.update({"order": order, "teeth": teeth, "turn": way})
        part["outline"] = outline
        rotation = -side * angle if teeth else 0.0 * angle
        part["place"] = np.column_stack([0.0 * angle, at + 0.0 * angle, np.remainder(rotation + np.pi, 2.0 * np.pi) - np.pi]).astype(np.float32)
