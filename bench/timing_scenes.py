# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes of bench/timing.py: a timing drive of growing content, after the tests' (tests/dynamics/chain/timing_drive.cpp)."""
import math

CONTENTS = ("force", "hydraulic", "full")
LINKS = (78, 130, 260, 520)
# Torque of a crank with one of three cylinders at full load and of its masses at 3400 rpm: order, amplitude [N m], phase [deg]; phi = 0 at firing TDC.
GAS = ((1.5, 196.60, -79.44), (3.0, 108.82, -107.08), (4.5, 61.96, -131.59), (6.0, 30.01, -153.78))
MASSES = (3.0, 79.30, 90.0)
CRANK_INERTIA, LOAD = 0.15, 0.7
LOBES = {"intake": 235.0, "exhaust": 125.0}  # turn of the cam after firing TDC of cylinder 1 to full lift
CAMS = {"intake": -60.0, "exhaust": 60.0}


def orders(rpm):
    """Speed orders of a crank that turns clockwise: J omega d omega/d phi = T."""
    speed = rpm * math.pi / 30.0
    scale = [(order, LOAD * torque, phase) for order, torque, phase in GAS]
    scale.append((MASSES[0], MASSES[1] * (rpm / 3400.0) ** 2, MASSES[2]))
    for order, torque, phase in scale:
        amplitude = torque / (CRANK_INERTIA * order * speed) * 30.0 / math.pi
        yield f"[[drive.order]]\norder = {order}\namplitude_rpm = {amplitude:.9g}\nphase_deg = {270.0 - phase:.9g}\n"


def bearing(name, x, y, more):
    return f"""
[[rigid_body]]
name = "{name}"
motion = "xy"
centre_mm = [{x}, {y}, 0]
{more}
[[bushing]]
name = "{name}"
a = {{ body = "{name}", at_mm = [{x}, {y}, 0] }}
b = {{ }}
stiffness_n_m = 1e10
damping_n_s_m = 1e4
"""


def valves(cam):
    lobes = [-(LOBES[cam] + 120.0 * cylinder) for cylinder in range(3)]
    return f"""
[[cam_torque]]
name = "{cam}"
body = "{cam}"
lift_mm = 7.5
half_angle_deg = 70
lobes_deg = {lobes}
valves = 2
spring_force_n = 150
spring_stiffness_n_m = 22214.3
mass_kg = 0.08
[[torque]]
name = "{cam}_drag"
body = "{cam}"
drag_n_m = 0.6
"""


def sprocket(name, x, y, teeth):
    return f"""
[[chain.over]]
sprocket = "{name}"
on = {{ body = "{name}", at_mm = [{x}, {y}, 0] }}
teeth = {teeth}
contact = {{ bed_n_m3 = 5e12, width_mm = 4.6, damping_s_m = 0.5, friction = 0.1 }}
"""


def guide(name, on, centre, radius, y_range):
    def angle(y):
        rise = math.degrees(math.asin((y - centre[1]) / radius))
        return rise if centre[0] < 0 else 180.0 - rise
    return f"""
[[chain.over]]
guide = "{name}"
on = {{ {on} }}
turn = "counter-clockwise"
contact = {{ bed_n_m3 = 5.357e11, width_mm = 2.4, damping_s_m = 0.5, friction = 0.08 }}
[[chain.over.segment]]
arc = {{ centre_mm = {list(centre)}, radius_mm = {radius}, from_deg = {angle(y_range[0])!r}, to_deg = {angle(y_range[1])!r} }}
"""


def chain(links, clearance, stiffness):
    """The belt of the reference with links of another pitch: same mass, stiffness and damping per length of chain."""
    finer = links / 130.0
    mass, inertia = 1.0 / finer, 1.0 / finer**3
    return f"""
[[chain]]
name = "chain"
links = {links}
first = "outer"
pitch_mm = {8.0 / finer!r}
bush_mm = {5.0 / finer!r}
plate_half_height_mm = {3.6 / finer!r}
inner = {{ mass_kg = {2.2e-3 * mass!r}, inertia_kg_m2 = {4.0e-8 * inertia!r} }}
outer = {{ mass_kg = {2.6e-3 * mass!r}, inertia_kg_m2 = {4.8e-8 * inertia!r} }}
joint = {{ stiffness_n_m = {stiffness * finer!r}, clearance_um = {clearance!r}, damping_n_s_m = {200.0}, friction = 0.1, pin_mm = {3.3 / finer!r} }}
"""


def scene(content="full", links=130, rpm=3400, time="", accuracy="", clearance=0.0, stiffness=1e7, start_deg=0.0):
    """The text of a scene; `time`, `accuracy`: further lines of those tables; clearance [um] and stiffness [N/m] of a joint of 130
    links; `start_deg`: of the crank, running, where the run begins: -360 with cycle_of."""
    spin = -rpm * math.pi / 60.0
    text = [f"""title = "timing drive, {content}, {links} links"
[time]
{time}
[accuracy]
{accuracy}
[[drive]]
name = "crank"
speed_rpm = {-rpm}
axis = "z"
"""]
    if content == "full" and rpm > 0:
        text += orders(rpm)
    for cam, x in CAMS.items():
        text.append(bearing(cam, x, 326, f"mass_kg = 1.0\ninertia_kg_m2 = 1.30e-3\n"
                            f"angle_deg = {-0.5 * start_deg!r}\nstart_spin_rad_s = {spin!r}"))
        if content == "full":
            text.append(valves(cam))
    # The plunger, 20 g, moves with the arm.
    text.append(bearing("arm", -85, 245, f"mass_kg = 0.2\ninertia_kg_m2 = {4.5e-4 + 0.02 * 0.085**2!r}"))
    if content == "force":
        text.append("""
[[spring]]
name = "tensioner"
a = { at_mm = [-1055, 160, 0] }
b = { body = "arm", at_mm = [-55, 160, 0] }
stiffness_n_m = 2000
length_mm = 1054.817477
""")
    else:
        text.append("""
[[tensioner]]
name = "tensioner"
a = { at_mm = [-55, 160, 0] }
b = { body = "arm", at_mm = [-55, 160, 0] }
axis = [1, 0, 0]
""")
    teeth = 20 * links // 130
    text.append(chain(links, clearance, stiffness))
    text.append(sprocket("crank", 0, 0, teeth) + "gap_deg = -20.94\n")
    text.append(guide("arm", 'body = "arm", at_mm = [0, 0, 0]', (-310.1, 88.9), 280.0, (20.0, 240.0)))
    text.append(sprocket("intake", -60, 326, 2 * teeth))
    text.append(sprocket("exhaust", 60, 326, 2 * teeth))
    text.append(guide("guide", "", (1221.8, -152.5), 1200.0, (250.0, 60.0)))
    return "".join(text)
