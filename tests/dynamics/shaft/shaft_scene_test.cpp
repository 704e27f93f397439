// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with shafts and torques.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/given/cam_law.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/scene_text.hpp"

namespace clatter::dynamics {
namespace {

class ShaftScenes : public testing::SceneText {
 protected:
  ShaftScenes() : SceneText("cam") {}
};

/// The intake cam of the timing drive's reference: wheel, shaft, four bearings, three cylinders.
std::string camshaft(const std::string& model, const std::string& time) {
  std::string text = time + R"([accuracy]
velocity_m_s = 0.1
[[shaft]]
name = "intake"
axis = "z"
centre_mm = [-60, 326, 0]
speed_rpm = 1700
loss_time_us = 1
model = ")" + model + R"("
[[shaft.section]]
from_mm = -35
to_mm = 295
diameter_mm = 24
[[shaft.disc]]
name = "wheel"
at_mm = -25
mass_kg = 0.7
polar_kg_m2 = 1.15e-3
)";
  for (int k = 0; k < 6; ++k)
    text += fmt::format(
        "[[shaft.disc]]\nname = \"lobe_{}\"\nat_mm = {}\nmass_kg = 0.05\n"
        "polar_kg_m2 = 1.1e-5\n",
        k + 1, 25 + 85 * (k / 2) + 35 * (k % 2));
  for (int k = 0; k < 4; ++k)
    text += fmt::format(
        "[[shaft.bearing]]\nname = \"b{}\"\nat_mm = {}\ndiameter_mm = 24\n"
        "width_mm = 16\nclearance = 2e-3\nviscosity_mpa_s = 10\n{}",
        k + 1, 85 * k, k == 0 ? "thrust_stiffness_n_m = 1e6\n" : "");
  for (int cylinder = 0; cylinder < 3; ++cylinder)
    text += fmt::format(
        "[[cam_torque]]\nname = \"valve_{0}\"\nbody = \"intake.lobe_{0}\"\n"
        "lift_mm = 7.5\nhalf_angle_deg = 70\nlobes_deg = [{1}]\nvalves = 2\n"
        "spring_force_n = 150\nspring_stiffness_n_m = 22214.3\nmass_kg = 0.08\n",
        2 * cylinder + 1, 120 * cylinder + 60);
  return text + "[[torque]]\nname = \"drag\"\nbody = \"intake.wheel\"\ndrag_n_m = 0.6\n" +
         // A drive that balances the drag.
         "[[torque]]\nname = \"drive\"\nbody = \"intake.wheel\"\nvalue_n_m = 0.6\n";
}

const char* const kTime = "[time]\nend_s = 0.02\noutput_step_us = 50\n";

TEST_F(ShaftScenes, ACamshaftInItsBearingsTurnsUnderItsValves) {
  const H5File file = recorded(camshaft("full", kTime));
  const auto speed = file.read_doubles("history/intake.wheel_speed");
  const auto weighed = file.read_doubles("history/bearing_intake_b1_eccentricity");
  const auto torque = file.read_doubles("history/cam_torque_valve_1_moment");
  double largest = 0.0;
  for (size_t i = 0; i < torque.size(); ++i) largest = std::max(largest, std::abs(torque[i]));
  EXPECT_NEAR(largest, 5.9, 1.0);  // 2 x 269 N x 11 mm
  for (const double e : weighed) EXPECT_LT(e, 0.9);
  // Of a step at tolerance 1e-3.
  EXPECT_LT(result_.energy_residue, 2e-2);
  EXPECT_EQ(file.read_doubles("history/intake.wheel_x").size(), speed.size());
}

TEST_F(ShaftScenes, TheModelsOfAShaftAgreeInItsMeanMotion) {
  double angle[3];
  int k = 0;
  for (const char* model : {"full", "torsion", "rigid"}) {
    const H5File file = recorded(camshaft(model, kTime));
    angle[k++] = file.read_doubles("history/intake.wheel_angle").back();
    EXPECT_EQ(file.read_doubles("history/intake.lobe_5_speed").size(),
              file.read_doubles("history/time").size());
  }
  // The rigid one by classical Runge-Kutta steps.
  const double inertia =
      1.15e-3 + 6.0 * 1.1e-5 + 7850.0 * std::numbers::pi / 32.0 * std::pow(0.024, 4) * 0.330;
  const CamLaw law = CamLaw::polynomial(7.5e-3, 70.0 * kDegree);
  const auto rate = [&](const Eigen::Vector2d& at) {
    double moment = 0.0;
    for (const double lobe : {60.0, 180.0, 300.0}) {
      const SplinePoint y = law.at(at(0) - lobe * kDegree);
      const double force = 150.0 + 22214.3 * y.value + 0.08 * at(1) * at(1) * y.second;
      moment -= 2.0 * std::max(0.0, force) * y.first;
    }
    return Eigen::Vector2d(at(1), moment / inertia);
  };
  Eigen::Vector2d exact(0.0, 1700.0 * std::numbers::pi / 30.0);
  const double h = 1e-5;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector2d k1 = rate(exact), k2 = rate(exact + 0.5 * h * k1),
                          k3 = rate(exact + 0.5 * h * k2), k4 = rate(exact + h * k3);
    exact += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  EXPECT_NEAR(angle[2], exact(0), 1e-4);  // at tolerance 1e-3
  std::printf("wheel after 20 ms: full %.5f, torsion %.5f, rigid %.5f rad\n", angle[0], angle[1],
              angle[2]);
  // Bearings take 0.1 N m of 1.3e-3 kg m2 for 20 ms; the elastic twist is some 1e-4 rad.
  EXPECT_NEAR(angle[1], angle[2], 2e-3);
  EXPECT_NEAR(angle[0], angle[1], 5e-2);
  EXPECT_LT(angle[0], angle[1]);
}

TEST_F(ShaftScenes, APointOfADiscIsWhereItIsInTheScene) {
  // A spring on the wheel's rim, 25 mm beside the axis, turns it: M = F r.
  for (const char* model : {"full", "torsion", "rigid"}) {
    const H5File file = recorded(fmt::format(R"([time]
end_s = 1e-3
output_step_us = 20
[[shaft]]
name = "shaft"
axis = "x"
centre_mm = [0, 100, 50]
start_deg = 40
model = "{}"
[[shaft.section]]
from_mm = 0
to_mm = 100
diameter_mm = 20
[[shaft.disc]]
name = "wheel"
at_mm = 60
mass_kg = 1
polar_kg_m2 = 1e-3
[[shaft.bearing]]
name = "l"
at_mm = 10
model = "linear"
stiffness_n_m = 1e8
damping_n_s_m = 1e3
thrust_stiffness_n_m = 1e7
[[shaft.bearing]]
name = "r"
at_mm = 90
model = "linear"
stiffness_n_m = 1e8
damping_n_s_m = 1e3
[[spring]]
a = {{ body = "shaft.wheel", at_mm = [60, 125, 50] }}
b = {{ at_mm = [60, 125, 1050] }}
stiffness_n_m = 1
length_mm = 900
)",
                                             model));
    // Force along +z at 25 mm along y turns about +x.
    const auto angle = file.read_doubles("history/shaft.wheel_angle");
    const double inertia = 1e-3 + 7850.0 * std::numbers::pi / 32.0 * std::pow(0.02, 4) * 0.1;
    const double start = 40.0 * std::numbers::pi / 180.0;
    EXPECT_NEAR(angle.front(), start, 1e-9) << model;
    EXPECT_NEAR((angle.back() - start) / (0.5 * 0.1 * 0.025 / inertia * 1e-6), 1.0, 2e-3) << model;
  }
}

TEST_F(ShaftScenes, ABearingDragsItsHousingAndAngularMomentumIsKept) {
  for (const char* film : {"butenschoen", "moes"}) {
    const H5File file = recorded(fmt::format(R"([time]
end_s = 0.05
output_step_us = 200
[accuracy]
tolerance = 1e-4
[[shaft]]
name = "shaft"
speed_rpm = 3000
[[shaft.section]]
from_mm = -10
to_mm = 10
diameter_mm = 20
[[shaft.disc]]
name = "wheel"
at_mm = 0
mass_kg = 0.5
polar_kg_m2 = 2e-5
diametral_kg_m2 = 2e-5
[[shaft.bearing]]
name = "b"
at_mm = 0
on = {{ body = "housing" }}
model = "{}"
diameter_mm = 20
width_mm = 16
clearance = 2e-3
viscosity_mpa_s = 20
[[rigid_body]]
name = "housing"
mass_kg = 2
inertia_kg_m2 = 4e-5
)",
                                             film));
    const auto turned = file.read_doubles("history/shaft.wheel_angle");
    const auto housing = file.read_doubles("history/housing_angle");
    const auto speed = file.read_doubles("history/shaft.wheel_speed");
    const double start = 3000.0 * std::numbers::pi / 30.0;
    const double inertia = 2e-5 + 7850.0 * std::numbers::pi / 32.0 * std::pow(0.02, 4) * 0.02;
    EXPECT_GT(housing.back(), 0.5) << film;
    EXPECT_LT(speed.back(), 0.9 * start) << film;
    // Integrated once: I_p a + J b = I_p w t, to rounding of the sum over steps.
    const double kept = inertia * (turned.back() - start * 0.05) + 4e-5 * housing.back();
    EXPECT_LT(std::abs(kept), 1e-6 * inertia * start * 0.05) << film;
    // Centred, the moment is Petroff's: both speeds approach exponentially.
    const double petroff = 0.5 * std::numbers::pi * 20e-3 * 16e-3 * 4e-4 / 2e-3;
    const double rate = petroff * (1.0 / inertia + 1.0 / 4e-5);
    const double together = inertia * start / (inertia + 4e-5);
    EXPECT_NEAR(speed.back(), together + (start - together) * std::exp(-rate * 0.05), 1e-3 * start)
        << film;
  }
}

TEST_F(ShaftScenes, TorquesActOnRigidBodiesAndTheirReactions) {
  // A crank of 1 kg m2 with 3 N m against a block of 2 kg m2; the block turns the other way.
  const H5File file = recorded(R"([time]
end_s = 0.1
output_step_us = 1000
[[rigid_body]]
name = "crank"
mass_kg = 1
inertia_kg_m2 = 1
[[rigid_body]]
name = "block"
mass_kg = 1
inertia_kg_m2 = 2
[[torque]]
body = "crank"
reaction = "block"
value_n_m = 3
)");
  EXPECT_NEAR(file.read_doubles("history/crank_angle").back(), 0.5 * 3.0 * 0.01, 1e-8);
  EXPECT_NEAR(file.read_doubles("history/block_angle").back(), -0.25 * 3.0 * 0.01, 1e-8);
  EXPECT_NEAR(file.read_doubles("history/torque_1_moment").back(), 3.0, 1e-12);
}

TEST_F(ShaftScenes, ALoadActsOnADiscOfEveryModel) {
  // 2 N m on a free shaft, by a load and by a torque; "end" is a part of the rigid shaft's body.
  const auto shaft = [](const std::string& model, const std::string& moment) {
    return "[time]\nend_s = 0.01\noutput_step_us = 100\n[[shaft]]\nname = \"cam\"\n"
           "axis = \"z\"\nmodel = \"" +
           model +
           "\"\n[[shaft.section]]\nfrom_mm = 0\nto_mm = 100\ndiameter_mm = 20\n"
           "[[shaft.disc]]\nname = \"wheel\"\nat_mm = 10\nmass_kg = 1\npolar_kg_m2 = 1e-3\n"
           "[[shaft.disc]]\nname = \"end\"\nat_mm = 90\nmass_kg = 1\npolar_kg_m2 = 1e-3\n" +
           moment;
  };
  const std::string load = "[[load]]\nbody = \"cam.end\"\ncomponent = \"rz\"\nvalue = 2\n";
  const std::string torque = "[[torque]]\nbody = \"cam.end\"\nvalue_n_m = 2\n";
  for (const char* model : {"full", "torsion", "rigid"}) {
    const double turned = recorded(shaft(model, load)).read_doubles("history/cam.end_angle").back();
    const double expected =
        recorded(shaft(model, torque)).read_doubles("history/cam.end_angle").back();
    EXPECT_NEAR(turned, expected, 1e-6 * expected) << model;
    EXPECT_GT(turned, 0.9 * 0.5 * 2.0 / 2.1e-3 * 1e-4) << model;
  }
  EXPECT_NE(refusal(shaft("rigid", "[[load]]\nbody = \"cam.end\"\nvalue = 2\n"))
                .find("load.component: found \"x\", expected one that \"cam.end\" follows as a "
                      "single coordinate"),
            std::string::npos);
  EXPECT_NE(refusal(shaft("rigid", "[[load]]\nbody = \"cam.ende\"\nvalue = 2\n"))
                .find("load.body: no body \"cam.ende\" in the scene"),
            std::string::npos);
}

TEST_F(ShaftScenes, AreRefusedByTableKeyAndName) {
  const std::string head = "[time]\nend_s = 0.1\n[[shaft]]\nname = \"cam\"\n";
  const std::string section = "[[shaft.section]]\nfrom_mm = 0\nto_mm = 100\ndiameter_mm = 20\n";
  const std::string disc = "[[shaft.disc]]\nname = \"wheel\"\nat_mm = 10\nmass_kg = 1\n";
  const std::string bearing =
      "[[shaft.bearing]]\nname = \"b\"\nat_mm = 50\ndiameter_mm = 20\nwidth_mm = 10\n"
      "clearance = 1e-3\nviscosity_mpa_s = 10\n";
  const auto expect = [&](const std::string& text, const std::string& said) {
    const std::string found = refusal(text);
    EXPECT_NE(found.find(said), std::string::npos) << text << "\nsaid: " << found;
    EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  };
  EXPECT_EQ(refusal(head + section + disc + bearing), "accepted");
  expect(head + disc, "cam.run.toml:3: shaft[0].section: found none, expected at least one table");
  expect(head + section, "shaft[0].slices: found 0 and no disc or bearing");
  expect(head + "slices = 2\n" + section + "[[shaft.section]]\nfrom_mm = 110\nto_mm = 120\n" +
             "diameter_mm = 20\n",
         "section 2 from 110 mm: the one before it ends at 100 mm");
  expect(head + "[[shaft.section]]\nfrom_mm = 5\nto_mm = 5\ndiameter_mm = 20\n",
         "cam.run.toml:7: shaft[0].section[0].to_mm: found 5, expected above from_mm, 5");
  expect(head +
             "[[shaft.section]]\nfrom_mm = 0\nto_mm = 5\ndiameter_mm = 20\n"
             "inner_diameter_mm = 20\n",
         "inner_diameter_mm: found 20, expected below diameter_mm, 20");
  expect(head + "shear_modulus_gpa = 10\n" + section + disc,
         "shaft[0].shear_modulus_gpa: found 10 with Young's modulus 206, which is Poisson's ratio");
  expect(head + section + "[[shaft.disc]]\nname = \"wheel\"\nat_mm = 101\n",
         "shaft[0].disc[0].at_mm: found 101, expected on the shaft, 0 to 100");
  expect(head + section + disc + disc,
         "shaft[0].disc[1].name: found \"wheel\" after a part of the shaft");
  expect(head + section + disc + "[shaft.disc.phaser]\nstiffness_n_m_rad = 1\n",
         "polar_kg_m2: found 0, expected a moment of inertia of what the phaser turns");
  expect(head + section +
             "[[shaft.bearing]]\nname = \"b\"\nat_mm = 50\ndiameter_mm = 20\n"
             "width_mm = 30\nclearance = 1e-3\nviscosity_mpa_s = 10\n",
         "width_mm: found 30, which is 1.5 of the diameter, expected 0.12 to 1");
  expect(head + section +
             "[[shaft.bearing]]\nname = \"b\"\nat_mm = 50\ndiameter_mm = 20\n"
             "width_mm = 10\nclearance = 0\nviscosity_mpa_s = 10\n",
         "shaft[0].bearing[0].clearance: found 0, expected");
  expect(head + section + bearing + "on = { body = \"block\" }\n",
         "shaft[0].bearing[0].on.body: no body \"block\" in the scene");
  expect(head + section + bearing + "on = { body = \"cam.b\", at_mm = [0, 2, 50] }\n",
         "the point of \"cam.b\" is 2 mm beside the axis of \"cam\"");
  const std::string drive = "[[drive]]\nname = \"crank\"\nspeed_rpm = 1000\n";
  EXPECT_EQ(refusal(head + "speed_of = \"crank\"\nspeed_ratio = 0.5\n" + section + disc + drive),
            "accepted");
  expect(head + "speed_of = \"pump\"\n" + section + disc + drive,
         "shaft[0].speed_of: found \"pump\", expected the name of a [[drive]]");
  expect(head + "speed_of = \"crank\"\nspeed_rpm = 1\n" + section + disc + drive,
         "shaft[0].speed_of: speed_of and speed_rpm exclude each other");
  expect(head + "speed_ratio = 0.5\n" + section + disc, "shaft[0].speed_ratio: needs speed_of");
  expect(head + section + bearing + "model = \"moss\"\n",
         "model: found \"moss\", expected one of: butenschoen, moes, linear");
  expect(head + "model = \"torsion\"\n" + section + disc + "polar_kg_m2 = 1\nunbalance_g_mm = 5\n",
         "shaft[0].disc[0].unbalance_g_mm: found with an axis that is fixed, expected model");
  expect(head + section + disc + "polar_kg_m2 = 1e-4\nunbalance_g_mm = 2e4\n",
         "disc \"wheel\": unbalance_g_mm: found 20000, expected below");
  const std::string plain =
      "[[shaft.bearing]]\nname = \"b\"\nat_mm = 50\nmodel = \"coefficients\"\n";
  expect(head + section + plain,
         "shaft[0].bearing[0].model: found \"coefficients\" alone, expected stiffness_matrix_n_m "
         "or table");
  expect(head + section + plain + "stiffness_matrix_n_m = [1, 2]\n",
         "stiffness_matrix_n_m: found 2 numbers, expected 4");
  std::ofstream(folder_ / "b.csv") << "speed [rpm], k11 [N/mm], c11 [N s/m]\n0, 1, 2\n";
  expect(head + section + plain + "table = \"b.csv\"\n",
         "b.csv:1: no column \"k12\", found: k11, c11");
  std::ofstream(folder_ / "c.csv") << "speed [rpm], k11 [N], c11 [N s/m]\n0, 1, 2\n";
  expect(head + section + plain + "table = \"c.csv\"\n",
         "c.csv:1: found k11 in [N] over [rad/s], expected units of [N/m] over a speed, [rpm]");
  const std::string shaft = head + section + disc;
  expect(shaft + "[[torque]]\nbody = \"cam\"\nvalue_n_m = 1\n",
         "torque[0].body: no body \"cam\" that turns about an axis, found: cam.wheel");
  expect(shaft + "[[torque]]\nbody = \"cam.wheel\"\n", "torque: found none, expected value_n_m");
  expect(shaft + "[[torque]]\nbody = \"cam.wheel\"\nreaction = \"cam.wheel\"\nvalue_n_m = 1\n",
         "torque[0].reaction: \"cam.wheel\" turns about z, expected another body");
  expect(shaft +
             "[[cam_torque]]\nbody = \"cam.wheel\"\nlift_mm = 7\nhalf_angle_deg = 70\n"
             "lobes_deg = []\nspring_force_n = 100\n",
         "cam_torque[0].lobes_deg: found none, expected a number");
  expect(shaft +
             "[[cam_torque]]\nbody = \"cam.wheel\"\nlift_mm = 7\nhalf_angle_deg = 200\n"
             "lobes_deg = [0]\nspring_force_n = 100\n",
         "cam_torque[0].half_angle_deg: found 200, expected");
}

}  // namespace
}  // namespace clatter::dynamics
