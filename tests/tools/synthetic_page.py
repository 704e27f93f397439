# SPDX-License-Identifier: GPL-3.0-or-later
"""A folder with everything that a page of results shows: a reduced box that moves, its field, film maps, runs at three speeds."""
import h5py
import numpy as np
import synthetic
import synthetic_drive
from clatter.artefact import sha256
from clatter_tools.plots import style
from clatter_tools.report_page import skin

SAMPLES = 720            # of a cycle
RPM = 2000.0
LINES = 60
STRONG = (9, 30)         # lines that the field has in full: 150 and 500 Hz
MAC = "# MAC\nfull_hz,200.01,400.1\n200.0,0.999999,0.02\n400.0,0.03,0.9999\n"
QUANTITIES = ("sound power", "height <slap>")
OPTIONS = dict(dtype=h5py.string_dtype())


def shapes(nodes):
    """Six motions of a box, (3 n, 6): three translations, bending, torsion, breathing."""
    x, y, z = nodes.T
    zero, one = np.zeros_like(x), np.ones_like(x)
    motions = [(one, zero, zero), (zero, one, zero), (zero, zero, one), (zero, np.sin(8 * x), zero), (zero, -8 * x * z, 8 * x * y),
               (x * np.cos(7 * z), y, z * z)]
    return np.stack([np.column_stack(motion).ravel() for motion in motions], axis=1)


def velocity(loudness):
    """Reduced velocities over a cycle, (SAMPLES, 6), periodic: lines of random size and phase, loud ones at STRONG."""
    rng = np.random.default_rng(3)
    lines = np.zeros((SAMPLES // 2 + 1, 6), complex)
    lines[1:LINES] = rng.normal(size=(LINES - 1, 6)) + 1j * rng.normal(size=(LINES - 1, 6))
    lines[list(STRONG)] *= 8.0
    return np.fft.irfft(lines * loudness * 1e-3 * SAMPLES, SAMPLES, axis=0)


def write_rom(path):
    """A reduced box of six coordinates: three rigid ones, three modes at 200, 400 and 800 Hz."""
    nodes, faces = synthetic.box_skin()
    with synthetic.new_file(path, "rom") as file:
        file["skin/T"], file["skin/nodes"], file["skin/triangles"] = shapes(nodes), nodes, faces
        file["M_rr"] = np.eye(6)
        file["K_rr"] = np.diag([0.0, 0.0, 0.0, *(2.0 * np.pi * np.array([200.0, 400.0, 800.0])) ** 2])
        file["certificate"].attrs.update({"certified": 1.0, "count_proved": 1.0, "rigid_modes": 3.0, "accurate_to_hz": 1000.0})


def write_run(path, title, loudness=1.0, film=True):
    """A slap run with the motion of its block and maps of its film."""
    synthetic.write_run(path, clearance=20e-6 * loudness, film=film)
    angle = np.linspace(-360.0, 360.0, 25)
    with h5py.File(path, "a") as file:
        file.attrs["title"] = title
        file["bodies/block/v"] = np.vstack([velocity(loudness), velocity(loudness)[:1]])
        for key, values in (("name", ["oil film", "gravity"]), ("state", ["on", "off"]), ("why", ["[contact]", "gravity_m_s2"])):
            file.create_dataset(f"effects/{key}", data=values, **OPTIONS)
        file["effects/seconds"] = [1.25, 0.0]
        file["film/crank_angle_deg"] = angle
        for pad, centre in (("thrust", 0.0), ("antithrust", 180.0)):
            write_pad(file.create_group(f"film/{pad}"), centre, angle, film)


def write_pad(pad, centre, angle, film):
    pad["angle_deg"], pad["axial"] = centre + np.linspace(-36.0, 36.0, 10), np.linspace(-0.04, 0.03, 16)
    bump = np.exp(-(np.linspace(-2, 2, 10)[:, None] ** 2) - np.linspace(-2, 2, 16) ** 2)
    turning = np.cos(np.radians(angle - centre))[:, None, None]
    pad["gap"] = (20e-6 + 5e-6 * turning * bump).astype(np.float32)
    pad["contact_pressure"] = np.zeros((len(angle), 10, 16), np.float32)
    if film:
        pad["pressure"] = (4e6 * np.maximum(turning, 0.0) * bump).astype(np.float32)
        pad["fill"] = (0.5 + 0.5 * turning * bump).astype(np.float32)


def write_field(path, rom, loudness=1.0, rpm=RPM):
    """The field of such a run: lines, instants and panels that follow from its velocity."""
    nodes, faces = synthetic.box_skin()
    time = (np.arange(SAMPLES) - SAMPLES // 2) * (120.0 / rpm / SAMPLES)
    values, expansion = velocity(loudness), shapes(nodes)
    with synthetic.new_file(path, "field") as file:
        file.attrs["body"] = "block"
        file.attrs["spectra_from_hz"], file.attrs["spectra_to_hz"] = 20.0, LINES * rpm / 120.0
        file.create_dataset("inputs/path", data=[path.name.replace(".field.", ".run."), rom], **OPTIONS)
        file.create_dataset("inputs/sha256", data=["", sha256(path.parent / rom)], **OPTIONS)
        write_cycle(file, time, rpm, loudness)
        synthetic.write_skin(file, nodes, faces)
        for group in ("lines", "frames"):
            del file[group]
        hz = file["analysis/cycle/frequency_hz"][()]
        file["lines/frequency_hz"] = hz[list(STRONG)]
        for number, line in enumerate(STRONG):
            turned = 2.0 * np.mean(values * np.exp(-2j * np.pi * hz[line] * time)[:, None], axis=0)
            for part, one in (("re", turned.real), ("im", turned.imag)):
                file[f"lines/velocity_{part}/{number:05d}"] = (expansion @ one).reshape(-1, 3)
        file["frames/time"] = time[SAMPLES // 2:SAMPLES // 2 + 3]
        for number in range(3):
            file[f"frames/velocity/{number:05d}"] = (expansion @ values[SAMPLES // 2 + number]).reshape(-1, 3)
        write_panels(file, nodes, faces)


def write_cycle(file, time, rpm, loudness):
    synthetic.write_piece(file, "analysis/cycle", time, 40.0 * loudness, 900.0)
    cycle = file["analysis/cycle"]
    cycle.attrs.update({"samples": SAMPLES, "first_sample": 0, "speed_rpm": rpm})
    cycle["crank_angle_deg"] = np.linspace(-360.0, 360.0, SAMPLES, endpoint=False)
    hz = np.arange(LINES) * rpm / 120.0
    del cycle["frequency_hz"]
    cycle["frequency_hz"], cycle["order"] = hz, hz * 60.0 / rpm
    for panel in ("top", "bottom"):
        cycle.copy("panels/skin", f"panels/{panel}")
    for panel, share in (("skin", 1.0), ("exposed", 0.5), ("top", 0.3), ("bottom", 0.2)):
        power = share * loudness**2 * 1e-9 / (1.0 + ((hz - 500.0) / 20.0) ** 2)
        del cycle[f"panels/{panel}/erp"]
        cycle[f"panels/{panel}/erp"] = power
        total = 10.0 * np.log10(power.sum() / 1e-12)
        cycle[f"panels/{panel}"].attrs.update({"erp_db": total, "erp_dba": total - 3.0, "area_m2": share, "share_of_skin": share})
        cycle[f"panels/{panel}/instant_mean_square_velocity"] = 1e-6 * (1.0 + np.cos(np.linspace(0.0, 6.0, SAMPLES)))
    sound = cycle.create_group("sound")
    sound["power"] = cycle["panels/exposed/erp"][()] / 4.0
    for key in ("db", "dba"):
        sound[f"third_octave/power_{key}"] = cycle[f"panels/exposed/third_octave/erp_{key}"][()] - 6.0
        sound.attrs[f"power_{key}"] = cycle["panels/exposed"].attrs[f"erp_{key}"] - 6.0
    sound.attrs["boundary_elements_to_hz"] = 400.0
    sound["microphones/front/pressure_re"] = np.where(hz <= 400.0, 0.01 * loudness, 0.0)
    sound["microphones/front/pressure_im"] = np.zeros(LINES)
    sound["microphones/front/third_octave/pressure_db"] = np.linspace(50.0, 60.0, 8)
    sound["microphones/front"].attrs.update({"pressure_db": 66.0, "pressure_dba": 63.0})
    for sensor in cycle["sensors"].values():
        lines = np.fft.rfft(sensor["acceleration"], axis=0)[:LINES] * 2.0 / SAMPLES
        sensor["spectrum/acceleration_re"], sensor["spectrum/acceleration_im"] = lines.real, lines.imag


def write_panels(file, nodes, faces):
    height = nodes[faces[:, :3]].mean(axis=1)[:, 2]
    for panel, chosen in (("skin", height > -1.0), ("exposed", height > 0.01), ("top", height > 0.249), ("bottom", height < 1e-3)):
        file[f"panels/{panel}/faces"] = np.flatnonzero(chosen).astype(np.int32)


def write_folder(folder):
    """Runs "wet" and "dry" at one speed, "fast" at another; a reduced block; a chain drive; a comparison of modes; a study."""
    write_rom(folder / "block.rom.h5")
    for name, title, loudness, rpm, film in (("wet", "engine, oil film", 1.0, RPM, True), ("dry", "engine, dry <contact>", 2.0, RPM, False),
                                             ("fast", "engine, oil film, fast", 1.5, 3000.0, True)):
        write_run(folder / f"{name}.run.h5", title, loudness, film)
        write_field(folder / f"{name}.field.h5", "block.rom.h5", loudness, rpm)
    synthetic_drive.write_drive(folder / "oval.run.h5")
    (folder / "block.compare.txt").write_text(" mode full reduced error MAC\n 7  200.0  200.01  0.005  0.999999\n 8  400.0  400.1  0.025  0.9999\nall good\n")
    (folder / "block.mac.csv").write_text(MAC)
    write_study(folder / "study")


def write_study(folder):
    """A study of two quantities, of which the first has a picture, and its effects."""
    folder.mkdir()
    with synthetic.new_file(folder / "study.h5", "study") as file:
        for name, texts in (("quantity", QUANTITIES), ("headline", [f"{one}: 7" for one in QUANTITIES]), ("verdict", [f"{one}: the budget is closed, sum over run 1.00" for one in QUANTITIES]),
                            ("sentences", [f"cells, {one}: 2 % costs 3 s\nsteps, {one}: no value changes it" for one in QUANTITIES])):
            file.create_dataset(f"said/{name}", data=texts, **OPTIONS)
    style.save(style.figure()[0], folder / "sound-power.png")
    (folder / "effects.csv").write_text("effect,switched,sound power [dB(A)],advice\n<friction>,off,-0.3,keep\n")


def corners():
    """Corner nodes of the box, in the page's order."""
    nodes, faces = synthetic.box_skin()
    return np.unique(faces[:, :3]), skin.smooth_normals(nodes, faces)
