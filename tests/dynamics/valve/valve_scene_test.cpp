// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with [[valve]] and [[follower]].
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/given/cam_law.hpp"
#include "dynamics/integrate/equilibrium.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "tests/dynamics/valve/valve_fixture.hpp"
#include "tests/dynamics/valve/valve_scene.hpp"

namespace clatter::dynamics {
namespace {

using testing::of;
using testing::one_valve;
using testing::Valves;
using testing::ValveScene;

TEST_F(Valves, AtLowSpeedAValveFollowsItsLawAndItsTorqueIsQuasiStatic) {
  for (const bool mirrored : {false, true}) {
    ValveScene with;
    with.rpm = 100.0;
    with.output_us = 500.0;
    with.mirrored = mirrored;
    with.tables = "[valve.lash_adjuster]\nmodel = \"rigid\"\n";
    const H5File file = recorded(one_valve(with));
    const auto time = of(file, "time"), lift = of(file, "intake_1_lift"),
               torque = of(file, "intake_1_cam_torque"), seat = of(file, "intake_1_seat_force");
    const CamLaw law = CamLaw::polynomial(7.5e-3, 70.0 * kDegree);
    const double speed = (mirrored ? -1.0 : 1.0) * with.rpm * std::numbers::pi / 30.0;
    const double start = (mirrored ? -1.0 : 1.0) * with.start_deg * kDegree;
    double worst_lift = 0.0, worst_torque = 0.0;
    for (size_t i = 0; i < time.size(); ++i) {
      const SplinePoint y = law.at(start + speed * time[i]);
      worst_lift = std::max(worst_lift, std::abs(lift[i] - y.value));
      const double force = 150.0 + 22214.28 * y.value + 0.0799 * speed * speed * y.second;
      if (y.value > 0.1e-3) {
        worst_torque = std::max(worst_torque, std::abs(torque[i] + force * y.first));
      } else if (y.value == 0.0) {
        EXPECT_GT(seat[i], 100.0) << time[i];
      }
    }
    std::printf("lift off by %.1f um, torque by %.4f of 2.9 N m\n", 1e6 * worst_lift, worst_torque);
    // 500 N on ball, roller and pad, 1e7 N/m together; the torque by the compliance and by what
    // swings at the valve's opening.
    EXPECT_LT(worst_lift, 60e-6);
    EXPECT_LT(worst_torque, 0.06);
    EXPECT_LT(result_.energy_residue, 1e-4);
    EXPECT_TRUE(result_.warnings.empty()) << result_.warnings.front();
  }
}

TEST_F(Valves, AnAdjusterTakesUpTheClearanceAndTheEnergyOfACycleCloses) {
  ValveScene with;
  with.turns = 2.0;
  const H5File file = recorded(one_valve(with));
  const auto lift = of(file, "intake_1_lift"), seat = of(file, "intake_1_seat_force"),
             pressure = of(file, "intake_1_adjuster_pressure"),
             travel = of(file, "intake_1_adjuster_travel"), gap = of(file, "intake_1_coil_gap");
  for (const double p : pressure) EXPECT_GT(p, 0.0);
  for (const double x : gap) EXPECT_GT(x, 0.0);
  EXPECT_LT(result_.energy_residue, 1e-4);
  EXPECT_NEAR(*std::max_element(lift.begin(), lift.end()), 7.5e-3, 0.15e-3);
  // 316.6 N of the spring, 0.8 of it on the ball of 9 mm against 12 N and 1 bar; valves swing a
  // bit.
  EXPECT_NEAR(*std::max_element(pressure.begin(), pressure.end()), 39e5, 2e5);
  EXPECT_GT(seat.back(), 100.0);
  const auto [low, high] = std::minmax_element(travel.begin(), travel.end());
  std::printf(
      "energy %.1e, lift %.3f mm, pressure %.1f to %.1f bar, travel %.1f to %.1f um, steps "
      "%lld\n",
      result_.energy_residue, 1e3 * *std::max_element(lift.begin(), lift.end()),
      1e-5 * *std::min_element(pressure.begin(), pressure.end()),
      1e-5 * *std::max_element(pressure.begin(), pressure.end()), 1e6 * *low, 1e6 * *high,
      static_cast<long long>(result_.statistics.accepted));
  for (const std::string& text : result_.warnings) std::printf("%s\n", text.c_str());
}

/// Work of the torque on the cam from one angle to another.
double work(const std::vector<double>& time, const std::vector<double>& torque, double speed,
            double from, double to) {
  double sum = 0.0;
  for (size_t i = 1; i < time.size(); ++i)
    if (time[i] > from && time[i] <= to)
      sum += 0.5 * (torque[i] + torque[i - 1]) * speed * (time[i] - time[i - 1]);
  return sum;
}

TEST_F(Valves, TheFullTrainTakesTheWorkOfTheQuasiStaticTorque) {
  // The rising flank stores the energy of the spring, the falling one gives it back.
  ValveScene with;
  with.rpm = 200.0;
  with.output_us = 100.0;
  with.tolerance = 1e-4;
  const std::string text = one_valve(with);
  const H5File full = recorded(text);
  const auto time = of(full, "time"), torque = of(full, "intake_1_cam_torque");
  const double speed = with.rpm * std::numbers::pi / 30.0, top = 120.0 * kDegree / speed,
               half = 75.0 * kDegree / speed;
  const double stored = 150.0 * 7.5e-3 + 0.5 * 22214.28 * 7.5e-3 * 7.5e-3;
  const double up = work(time, torque, speed, top - half, top),
               down = work(time, torque, speed, top, top + half);
  std::printf("work up %.5f J, down %.5f J, spring %.5f J\n", up, down, stored);
  // The adjuster sinks by 30 um of 7.5 mm, which is 1 % of the energy at full lift.
  EXPECT_NEAR(up, -stored, 0.015 * stored);
  EXPECT_NEAR(down, stored, 0.03 * stored);

  // The same scene with the torque only, on a shaft.
  const std::string shaft = R"(
[time]
end_s = 0.1
output_step_us = 100
[[shaft]]
name = "cam"
model = "rigid"
speed_rpm = 200
start_deg = -120
[[shaft.disc]]
name = "lobe"
at_mm = 0
polar_kg_m2 = 10
mass_kg = 1
[[shaft.section]]
from_mm = -10
to_mm = 10
diameter_mm = 24
[[valve]]
name = "intake"
lift_mm = 7.5
half_angle_deg = 70
lobe = [{ body = "cam.lobe", at_mm = [0, 0, 0], deg = 0 }]
)";
  const auto row = [](const H5File& file, const std::string& name) {
    const auto names = file.read_strings("effects/name");
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    return file.read_strings("effects/state")[at] + ", " + file.read_strings("effects/why")[at];
  };
  std::vector<double> speeds[2];
  for (const bool full : {false, true}) {
    const H5File file = recorded(shaft + (full ? "" : "model = \"quasi_static\"\n"));
    EXPECT_EQ(row(file, "valve train intake"),
              full ? "on, model = \"full\": 1 valves as bodies"
                   : "off, model = \"quasi_static\": torque on 1 cams by the lift law");
    EXPECT_EQ(file.has("history/valve_intake_1_moment"), !full);
    // Parts that are bodies have rows where there are any.
    const auto names = file.read_strings("effects/name");
    for (const char* part : {"valve intake spring", "valve intake cam", "valve intake contacts"})
      EXPECT_EQ(std::ranges::count(names, part), full ? 1 : 0) << part;
    speeds[full ? 1 : 0] = of(file, "cam.lobe_speed");
  }
  // At full lift the spring's energy is missing in the speed, 8.4e-3 rad/s of 21.
  double dip[2];
  for (int k = 0; k < 2; ++k)
    dip[k] = speeds[k].front() - *std::min_element(speeds[k].begin(), speeds[k].end());
  EXPECT_NEAR(dip[0], stored / (10.0 * speed), 1e-3 * dip[0]);
  EXPECT_NEAR(dip[1], dip[0], 0.015 * dip[0]);
  std::printf("the shaft loses %.6f rad/s, with bodies %.6f\n", dip[0], dip[1]);
}

TEST_F(Valves, AStaticEquilibriumLeavesOpenValvesOpen) {
  ValveScene with;
  with.start_deg = -30.0;
  std::string text = one_valve(with);
  const std::string one = "deg = 0 }";
  text.replace(text.find(one), one.size(),
               "deg = 0 }, { body = \"cam\", at_mm = [0, 0, 40], deg = 150 }");
  const auto model = build_model(scene(text), {}, true);
  const Equilibrium found = find_equilibrium(model->system, 0.0, model->system.eta_start());
  EXPECT_TRUE(found.found) << found.residual;
  const Eigen::VectorXd y = model->system.interface(found.eta);
  for (int k = 0; k < model->system.interface_size(); ++k) {
    const std::string name = model->system.coordinate_name(k);
    // 30 deg before full lift, without what the contacts and the oil give way; the other one
    // closed.
    if (name.starts_with("intake_1:")) {
      EXPECT_NEAR(y(k), 4.08e-3, 0.1e-3);
    }
    if (name.starts_with("intake_2:")) {
      EXPECT_NEAR(y(k), 0.0, 1e-6);
    }
    if (name.starts_with("intake_1_plunger:")) {
      EXPECT_NEAR(y(k), 0.0, 50e-6);
    }
  }
  std::printf("%d iterations\n", found.iterations);
}

TEST_F(Valves, WhatActsOnHeadCamAndValveBalances) {
  // Cam and head fly freely: the valve's seat, its spring and its adjuster are on the head.
  const auto model = build_model(scene(R"(
[time]
end_s = 0.02
output_step_us = 50
[[rigid_body]]
name = "head"
motion = "xy"
mass_kg = 20
inertia_kg_m2 = 0.1
centre_mm = [0, -50, 0]
[[rigid_body]]
name = "cam"
motion = "xy"
mass_kg = 2
inertia_kg_m2 = 1e-3
start_spin_rad_s = 200
angle_deg = -60
[[bushing]]
a = { body = "cam", at_mm = [0, 0, 0] }
b = { body = "head" }
stiffness_n_m = 1e8
damping_n_s_m = 1e3
[[valve]]
name = "intake"
lift_mm = 7.5
half_angle_deg = 70
lobe = [{ body = "cam", at_mm = [0, 0, 0], deg = 0, seat = { body = "head" }, on = { body = "head" } }]
)"),
                                 {});
  System& system = model->system;
  const auto momentum = [&](const Eigen::VectorXd& v) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
      const ModalBody& body = system.bodies()[b];
      sum += body.rigid.leftCols<3>().transpose() * v.segment(system.mode_offset(b), body.modes());
    }
    return sum;
  };
  StepOptions options;
  options.largest = 2e-5;
  const auto method = make_integrator(system, options);
  method->start(0.0, system.eta_start(), system.v_start());
  const Eigen::Vector3d before = momentum(method->state().v);
  double largest = 0.0, head = 0.0;
  while (method->state().time < 0.02) {
    method->step(0.02);
    largest = std::max(largest, (momentum(method->state().v) - before).norm());
    head = std::max(head, std::abs(system.bodies()[0].rigid.col(1).dot(
                              method->state().v.head(system.bodies()[0].modes()))));
  }
  std::printf("momentum of the head %.3g, of all off by %.1e kg m/s\n", head, largest);
  EXPECT_GT(head, 0.05);
  EXPECT_LT(largest, 1e-10);  // rounding of forces of 1000 N over 20 ms
}

TEST_F(Valves, AFollowerWorksAloneBetweenOtherBodies) {
  // The same valve from single components: it moves as that of [[valve]] does.
  const std::string head = R"(
[time]
end_s = 0.06
output_step_us = 50
[[drive]]
name = "cam"
speed_rpm = 1000
start_deg = -120
axis = "z"
)";
  const std::string alone = head + R"(
[[rigid_body]]
name = "valve"
motion = "slide"
mass_kg = 0.053
axis = [0, -1, 0]
[[valve_spring]]
name = "spring"
a = { at_mm = [18.63928, -74.44276, 0] }
b = { body = "valve", at_mm = [18.63928, -34.44276, 0] }
[[stop]]
name = "seat"
a = { body = "valve", at_mm = [18.63928, -134.442757, 0] }
b = { at_mm = [18.63928, -134.44276, 0] }
normal = [0, -1, 0]
stiffness_n_m = 5e7
chi_s_m = 2
[[follower]]
name = "follower"
cam = { body = "cam", at_mm = [0, 0, 0], deg = 0 }
tip = { body = "valve" }
lift_mm = 7.5
half_angle_deg = 70
)";
  const H5File single = recorded(alone);
  const auto lift = of(single, "valve_travel"), force = of(single, "follower_follower_cam_force");
  EXPECT_LT(result_.energy_residue, 1e-4);
  const H5File both = recorded(head + R"(
[[valve]]
name = "intake"
lift_mm = 7.5
half_angle_deg = 70
lobe = [{ body = "cam", at_mm = [0, 0, 0], deg = 0 }]
[valve.lash_adjuster]
model = "rigid"
)");
  const auto highest = [](const std::vector<double>& of) {
    return *std::max_element(of.begin(), of.end());
  };
  // Steps differ: to the tolerance of some 10 nm a step.
  EXPECT_NEAR(highest(lift), highest(of(both, "intake_1_lift")), 1e-6);
  EXPECT_NEAR(highest(force), highest(of(both, "intake_1_cam_force")), 5.0);
}

TEST_F(Valves, ACamByATableOfItsRadiusOpensTheValve) {
  // An eccentric circle of 15 mm, 3 mm off its centre, about a base circle of 15 mm.
  std::ofstream table(folder_ / "cam.csv");
  table << "angle [deg], radius [mm]\n";
  for (int k = 0; k < 360; ++k) {
    const double a = (k - 90.0) * kDegree;
    const double far = 3.0 * std::cos(a) + std::sqrt(225.0 - 9.0 * std::sin(a) * std::sin(a));
    const double x = far - 15.0;
    // Smooth union with the base circle.
    table << fmt::format("{}, {:.9f}\n", k, 15.0 + 0.5 * (x + std::sqrt(x * x + 0.04)) - 0.0);
  }
  table.close();
  std::string text = one_valve({});
  text.replace(text.find("lift_mm = 7.5\nhalf_angle_deg = 70"), 33,
               "law = \"radius\"\ntable = \"cam.csv\"\n");
  const H5File file = recorded(text);
  const auto lift = of(file, "intake_1_lift");
  EXPECT_GT(*std::max_element(lift.begin(), lift.end()), 4e-3);
  EXPECT_LT(result_.energy_residue, 1e-4);
}

TEST_F(Valves, RefusalsSayWhatIsWrong) {
  const auto with = [&](const std::string& valve, const std::string& tables = "") {
    ValveScene scene;
    scene.valve = valve;
    scene.tables = tables;
    return refusal(one_valve(scene));
  };
  test::expect_parts(with("mass_kg = -1\n"), {"valve.run.toml:", "mass_kg", "-1"});
  test::expect_parts(with("opening = [0, -1, 1]\n"), {"opening", "along the cam's axis z"});
  test::expect_parts(with("model = \"fast\"\n"), {"model", "fast", "quasi_static"});
  test::expect_parts(with("", "[valve.follower]\ninertia_kg_m2 = 1e-5\n"),
                     {"inertia_kg_m2", "1e-05", "1.3e-05"});
  test::expect_parts(with("", "[valve.follower]\nroller_radius_mm = 18\n"), {"undercut", "18 mm"});
  test::expect_parts(with("", "[valve.follower]\ncam_mm = [17, 10]\n"), {"cam_mm", "8.5"});
  test::expect_parts(with("", "[valve.lash_adjuster]\nstops_mm = [-3, 2]\n"),
                     {"stops_mm", "-3", "0.15 cm3"});
  test::expect_parts(with("", "[valve.lash_adjuster]\nstart_travel_mm = 1\n"),
                     {"start_travel_mm", "unknown key"});
  std::string text = one_valve({});
  text.replace(text.find("body = \"cam\""), 12, "body = \"cum\"");
  test::expect_parts(refusal(text), {"valve.run.toml:", "cum", "cam"});
  text = one_valve({});
  text.replace(text.find("lobe = ["), 8, "lobe = [] #");
  test::expect_parts(refusal(text), {"lobe"});
}

}  // namespace
}  // namespace clatter::dynamics
