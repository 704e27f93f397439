# SPDX-License-Identifier: GPL-3.0-or-later
"""A field file for the tests of hand-offs: a sphere of curved 6-node triangles over which a plane wave travels.

v(x, t) = Re( AMPLITUDE exp(i (w t - k . x)) ) along DIRECTION: with e^{+i w t} the phase falls along WAVE. Areas, normals
and normal velocities are integrals by a fine rule, made here from the shape functions alone.
"""
import contextlib
import io

import h5py
import numpy as np
import synthetic
from clatter_tools import command_line

RADIUS = 0.1
AMPLITUDE = 2e-3 * np.exp(0.4j)
DIRECTION = np.array([0.6, 0.0, 0.8])
WAVE = np.array([7.0, 2.0, -3.0])  # [rad/m]
FREQUENCIES = (100.0, 250.0, 1033.25)
TIMES = (-2e-4, 0.0, 3e-4, 5e-4)
PHASE = "x(t) = Re( X exp(+i 2 pi f t) ), t = 0 at crank angle 0 (at the first sample when nothing turns)"


def sphere():
    """Nodes n x 3 and 6-node triangles, outward, all nodes on the sphere."""
    nodes, triangles = synthetic.box_skin((2.0, 2.0, 2.0), (2, 2, 2))
    nodes = nodes - nodes.mean(axis=0)
    return RADIUS * nodes / np.linalg.norm(nodes, axis=1)[:, None], triangles


def shape_functions(r, s):
    """(N, dN/dr, dN/ds) of the 6-node triangle: corners, mid-side nodes of edges 01, 12, 20."""
    t = 1 - r - s
    return (np.array([t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t]),
            np.array([1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s]),
            np.array([1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s)]))


def integrals(nodes, triangles, velocity):
    """(area f, vector area f x 3, volume flow f) of quadratic triangles; velocity n x 3."""
    points, weights = np.polynomial.legendre.leggauss(8)
    points, weights = (points + 1) / 2, weights / 2
    area, vector, flow = np.zeros(len(triangles)), np.zeros((len(triangles), 3)), np.zeros(len(triangles), velocity.dtype)
    x, v = nodes[triangles], velocity[triangles]
    for a, wa in zip(points, weights):
        for b, wb in zip(points, weights):
            shape, by_r, by_s = shape_functions(a, b * (1 - a))
            normal = np.cross(np.einsum("i,fic->fc", by_r, x), np.einsum("i,fic->fc", by_s, x)) * wa * wb * (1 - a)
            area += np.linalg.norm(normal, axis=1)
            vector += normal
            flow += np.einsum("fc,i,fic->f", normal, shape, v)
    return area, vector, flow


def line_velocity(nodes, step):
    """n x 3, complex peak amplitudes [m/s]."""
    return (step + 1) * AMPLITUDE * np.exp(-1j * nodes @ WAVE)[:, None] * DIRECTION


def frame_velocity(nodes, step):
    return np.real(line_velocity(nodes, 0) * np.exp(2j * np.pi * FREQUENCIES[0] * TIMES[step])).astype(np.float32)


def write(path, lines=True, frames=True):
    nodes, triangles = sphere()
    area, vector, _ = integrals(nodes, triangles, np.zeros((len(nodes), 3)))
    with synthetic.new_file(path, "field") as file:
        file.attrs.update({"body": "ball", "phase": PHASE, "air_density_kg_m3": 1.2, "air_sound_speed_m_s": 340.0})
        file["skin/nodes"], file["skin/triangles"] = nodes, triangles
        file["skin/face_area"], file["skin/face_normal"] = area, vector / np.linalg.norm(vector, axis=1)[:, None]
        file["skin/face_centre"] = nodes[triangles[:, 3:]].mean(axis=1)
        file["panels/skin/faces"] = np.arange(len(triangles), dtype=np.int32)
        file["panels/upper/faces"] = np.flatnonzero(nodes[triangles[:, :3]].mean(axis=1)[:, 2] > 0).astype(np.int32)
        if lines:
            write_lines(file, nodes, triangles, area)
        if frames:
            write_frames(file, nodes, triangles, area)
        write_sensors(file)


def write_lines(file, nodes, triangles, area):
    file["lines/frequency_hz"] = FREQUENCIES
    for step in range(len(FREQUENCIES)):
        velocity = line_velocity(nodes, step)
        normal = integrals(nodes, triangles, velocity)[2] / area
        for name, values in (("velocity", velocity), ("normal_velocity", normal)):
            file[f"lines/{name}_re/{step:05d}"], file[f"lines/{name}_im/{step:05d}"] = values.real, values.imag


def acoustic_skin():
    """Nodes and outward flat triangles of a closed sphere, somewhat larger than the body."""
    nodes, triangles = sphere()
    return 1.1 * nodes, triangles[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]]].reshape(-1, 3)


def flat_normals(nodes, triangles):
    """(areas f, unit normals f x 3) of flat triangles."""
    a, b, c = np.moveaxis(nodes[triangles], 1, 0)
    twice = np.cross(b - a, c - a)
    return np.linalg.norm(twice, axis=1) / 2, twice / np.linalg.norm(twice, axis=1)[:, None]


def acoustic_velocity(step):
    """Mean normal velocity of each triangle of the acoustic skin: the wave at its centre, and a pulsation."""
    nodes, triangles = acoustic_skin()
    return (line_velocity(nodes[triangles].mean(axis=1), step) * flat_normals(nodes, triangles)[1]).sum(axis=1) + (step + 1) * 1e-3j


def write_acoustic(file):
    file["acoustic/nodes"], file["acoustic/triangles"] = acoustic_skin()
    for step in range(len(FREQUENCIES)):
        values = acoustic_velocity(step)
        for part in ("re", "im"):
            file[f"lines/acoustic_normal_velocity_{part}/{step:05d}"] = values.real if part == "re" else values.imag


def write_frames(file, nodes, triangles, area):
    file["frames/time"] = TIMES
    for step in range(len(TIMES)):
        velocity = frame_velocity(nodes, step)
        file[f"frames/velocity/{step:05d}"] = velocity
        file[f"frames/normal_velocity/{step:05d}"] = (integrals(nodes, triangles, velocity)[2] / area).astype(np.float32)


SENSOR_HZ = 20.0 * np.arange(1, 8)


def sensor_spectrum(kind, channel):
    """Complex, over SENSOR_HZ."""
    return {"velocity": 1, "displacement": 2, "acceleration": 3}[kind] * (channel + 1) * 1e-3 * np.exp(-0.02j * SENSOR_HZ)


SENSOR_TIME = -0.02 + 1e-4 * np.arange(31)  # not a multiple of the four values of a line


def sensor_history(kind, channel):
    """Real, over SENSOR_TIME."""
    return {"velocity": 1, "displacement": 2, "acceleration": 3}[kind] * (channel + 1) * 1e-3 * np.cos(700.0 * SENSOR_TIME + channel)


def write_sensors(file):
    """sensor_a with x y z, sensor_b with one direction between axes and a rotation about -z."""
    at = "analysis/cycle"
    file[f"{at}/frequency_hz"], file[f"{at}/time"] = SENSOR_HZ, SENSOR_TIME
    slant = np.array([0.6, 0.0, 0.8])
    channel = 0
    for name, labels, position, directions, rotation in (("sensor_a", "xyz", (0.1, 0.0, 0.0), np.eye(3), [0, 0, 0]),
                                                         ("sensor_b", "st", (0.0, 0.0, -0.1), [slant, [0, 0, -1]], [0, 1])):
        own = f"{at}/sensors/{name}"
        file.create_dataset(f"{own}/labels", data=[f"{name}.{label}" for label in labels], dtype=h5py.string_dtype())
        file[f"{own}/position"], file[f"{own}/direction"] = np.tile(position, (len(labels), 1)), np.array(directions, float)
        file[f"{own}/is_rotation"] = np.array(rotation, np.int32)
        for kind in ("velocity", "displacement", "acceleration"):
            values = np.stack([sensor_spectrum(kind, channel + k) for k in range(len(labels))], axis=1)
            file[f"{own}/spectrum/{kind}_re"], file[f"{own}/spectrum/{kind}_im"] = values.real, values.imag
            file[f"{own}/{kind}"] = np.stack([sensor_history(kind, channel + k) for k in range(len(labels))], axis=1)
        channel += len(labels)


def export(folder, *arguments, code=0):
    """Runs `clatter export` on ball.field.h5 in a folder; returns (stdout, stderr)."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.chdir(folder), contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        found = command_line.main(["export", "ball.field.h5", *map(str, arguments)], rules="")
    if found != code:
        raise AssertionError(f"exit code {found}: {out.getvalue()}{err.getvalue()}")
    return out.getvalue(), err.getvalue()


def volume(nodes, triangles):
    """Of a closed surface of 3-node triangles, or of the corners of others; positive when the normals point outward."""
    a, b, c = np.moveaxis(nodes[triangles[:, :3]], 1, 0)
    return np.einsum("fc,fc->", np.cross(a, b), c) / 6
