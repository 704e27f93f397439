// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes whose joints have tables, friction or oil films.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numeric>

#include "dynamics/law/radial_law.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

const std::string kShort =
    "[time]\ncycles = 1\n[accuracy]\ntolerance = 1e-3\n[contact]\ncavitation = false\n";

class JointLaws : public testing::SlapScenes {
 protected:
  /// The default law of the joints as joint.csv, to 30 um.
  void write_default_law() {
    const RadialLaw law;
    std::ofstream out(folder_ / "joint.csv");
    out << "displacement [um], force [N], damping [N s/mm]\n";
    for (int k = 0; k <= 300; ++k)
      out << fmt::format("{}, {}, {}\n", 0.1 * k, law.force(1e-7 * k), 1e-3 * law.damping);
  }
  double largest(const H5File& file, const std::string& name) {
    double most = 0.0;
    for (const double value : file.read_doubles("history/" + name))
      most = std::max(most, std::abs(value));
    return most;
  }
};

TEST_F(JointLaws, ATableOfTheDefaultLawGivesTheSameRun) {
  write_default_law();
  const RowMatrix plain = recorded(scene(kShort), "plain").read_rows("bodies/piston/q");
  for (const char* damping : {"", "damping_column = \"damping\"\n"}) {
    const std::string joint = std::string("model = \"table\"\ntable = \"joint.csv\"\n") + damping;
    const H5File file =
        recorded(scene(kShort + "[small_end]\n" + joint + "[big_end]\n" + joint), "table");
    const RowMatrix table = file.read_rows("bodies/piston/q");
    const double difference = (table - plain).cwiseAbs().maxCoeff() / plain.cwiseAbs().maxCoeff();
    std::printf("table against its law: %.1e, residue %.1e\n", difference, result_.energy_residue);
    EXPECT_LT(difference, 2e-3);
    EXPECT_LT(result_.energy_residue, 1e-4);
  }
}

TEST_F(JointLaws, FrictionIsOffToTheBitWithoutACoefficientAndLosesWithOne) {
  const RowMatrix plain = recorded(scene(kShort), "plain").read_rows("bodies/piston/q");
  const auto with = [&](double coefficient) {
    const std::string friction =
        fmt::format("friction_coefficient = {}\ndiameter_mm = 40\n", coefficient);
    return recorded(scene(kShort + "[small_end]\n" + friction + "[big_end]\n" + friction), "with");
  };
  EXPECT_EQ(with(0.0).read_rows("bodies/piston/q"), plain);
  const RowMatrix slight = with(1e-9).read_rows("bodies/piston/q");
  // The steps are others where rounding decides; the limit is the same motion.
  EXPECT_LT((slight - plain).cwiseAbs().maxCoeff(), 1e-3 * plain.cwiseAbs().maxCoeff());
  const H5File file = with(0.1);
  EXPECT_LT(result_.energy_residue, 1e-4);
  const auto moment = file.read_doubles("history/pin_friction_moment"),
             power = file.read_doubles("history/pin_friction_power"),
             y = file.read_doubles("history/pin_force_y"),
             z = file.read_doubles("history/pin_force_z");
  double most = 0.0;
  for (size_t k = 0; k < moment.size(); ++k) {
    EXPECT_LE(std::abs(moment[k]), 0.1 * 0.02 * std::hypot(y[k], z[k]) * (1.0 + 1e-9));
    EXPECT_GE(power[k], 0.0);
    most = std::max(most, std::abs(moment[k]));
  }
  EXPECT_GT(most, 10.0);
  EXPECT_GT(largest(file, "crank_pin_friction_power"), 1e3);
  EXPECT_GT((file.read_rows("bodies/piston/q") - plain).cwiseAbs().maxCoeff(),
            1e-2 * plain.cwiseAbs().maxCoeff());
}

TEST_F(JointLaws, OilFilmsCarryTheRod) {
  const auto film = [](const char* model, double diameter, double clearance) {
    return fmt::format(
        "model = \"{}\"\ndiameter_mm = {}\nwidth_mm = {}\nclearance_um = {}\n"
        "viscosity_mpa_s = 8\n",
        model, diameter, 0.6 * diameter, clearance);
  };
  for (const char* model : {"moes", "butenschoen"}) {
    const H5File file = recorded(
        scene(kShort + "[small_end]\n" + film(model, 45, 25) + "[big_end]\n" + film(model, 70, 40)),
        "film");
    std::printf("%s: eccentricity %.1f and %.1f um, residue %.1e\n", model,
                1e6 * largest(file, "pin_eccentricity"),
                1e6 * largest(file, "crank_pin_eccentricity"), result_.energy_residue);
    EXPECT_LT(result_.energy_residue, 1e-4) << model;
    EXPECT_GT(largest(file, "pin_force_z"), 2e4);
    EXPECT_LT(largest(file, "pin_eccentricity"), 25e-6);
    EXPECT_GT(largest(file, "crank_pin_eccentricity"), 10e-6);
    EXPECT_GT(largest(file, "crank_pin_friction_moment"), 0.1);
  }
}

TEST_F(JointLaws, ATableOfHookesLawIsTheBushing) {
  std::ofstream(folder_ / "bushing.csv") << "displacement [mm], force [kN]\n0, 0\n1, 100\n3, 300\n";
  const auto swung = [&](const std::string& law, const char* name) {
    std::ofstream(folder_ / "pendulum.run.toml") << R"(
gravity_m_s2 = 9.81
[time]
end_s = 0.05
[[rigid_body]]
name = "rod"
motion = "yz"
mass_kg = 3.0
inertia_kg_m2 = 0.25
centre_mm = [0, 500, 0]
[[bushing]]
a = { body = "rod", at_mm = [0, 0, 0] }
b = {}
damping_n_s_m = 1e3
)" + law;
    return recorded(read_scene(folder_ / "pendulum.run.toml"), name).read_doubles("history/rod_z");
  };
  const auto spring = swung("stiffness_n_m = 1e8\n", "spring"),
             table = swung("table = \"bushing.csv\"\n", "table");
  ASSERT_EQ(spring.size(), table.size());
  for (size_t k = 0; k < spring.size(); ++k) EXPECT_NEAR(table[k], spring[k], 1e-9) << k;
  EXPECT_LT(spring.back(), -1e-3);
}

TEST_F(JointLaws, AreRefusedByWhatIsWrong) {
  std::ofstream(folder_ / "joint.csv") << "displacement [um], force [N], bad [N s/mm], m [N m]\n"
                                          "0, 0, 1, 0\n10, 100, -1, 1\n20, 90, 2, 2\n";
  std::ofstream(folder_ / "load.csv") << "load [kN], moment [N m]\n0, 1\n10, 5\n";
  const std::string end = "[small_end]\n",
                    table = end + "model = \"table\"\ntable = \"joint.csv\"\n";
  const auto expect = [&](const std::string& changes, const std::vector<std::string>& parts) {
    test::expect_parts(refusal(changes), parts);
  };
  expect(end + "model = \"rubber\"\n",
         {"small_end.model: found \"rubber\"", "spring, table, moes"});
  expect(table, {"joint.csv:", "force: found 90 after 100, expected values that do not descend"});
  expect(table + "column = \"m\"\n", {"joint.csv:1: found m in [N m] over [m]"});
  expect(end + "friction_coefficient = 0.1\n", {"small_end.diameter_mm"});
  expect(end + "friction_table = \"load.csv\"\n", {"load.csv:2: moment: found 1 at 0 first"});
  expect(end + "friction_table = \"load.csv\"\nfriction_coefficient = 0.1\n",
         {"friction_table: friction_table and friction_coefficient exclude each other"});
  const std::string film = end + "model = \"moes\"\ndiameter_mm = 40\nviscosity_mpa_s = 8\n";
  expect(film + "width_mm = 60\n", {"width_mm: found 60, which is 1.5 of the diameter"});
  expect(film + "width_mm = 20\nclearance_um = 0\n", {"clearance_um: found 0"});
  for (const std::string key : {"friction_coefficient", "reversal_speed_rad_s"})
    expect(end + "diameter_mm = 40\nfriction_coefficient = 0.1\n[big_end]\ndiameter_mm = 40\n" +
               (key == "friction_coefficient" ? "" : "friction_coefficient = 0.1\n") + key +
               " = -1\n",
           {"big_end." + key + ": found -1"});
  expect(end + "model = \"moes\"\nwidth_mm = 20\ndiameter_mm = -1\nviscosity_mpa_s = 8\n",
         {"diameter_mm: found -1"});
  expect(film +
             "width_mm = 20\n[big_end]\nmodel = \"moes\"\ndiameter_mm = 40\nwidth_mm = 20\n"
             "viscosity_mpa_s = 0\n",
         {"big_end.viscosity_mpa_s: found 0"});
}

}  // namespace
}  // namespace clatter::dynamics
