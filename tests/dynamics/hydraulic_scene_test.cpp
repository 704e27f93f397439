// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with tensioners, lash adjusters and bodies that slide.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

class HydraulicScenes : public ::testing::Test {
 protected:
  Scene scene(const std::string& text) {
    std::ofstream(folder_ / "drive.run.toml") << text;
    return read_scene(folder_ / "drive.run.toml");
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { build_model(scene(text), {}); });
  }
  H5File recorded(const std::string& text) {
    return testing::complete_file(scene(text), folder_ / "drive.run.h5", result_);
  }
  std::filesystem::path folder_ = testing::test_folder();
  RunResult result_;
};

const std::string kPlunger = R"(
[[rigid_body]]
name = "plunger"
motion = "slide"
axis = [1, 0, 0]
mass_kg = 0.02
)";

/// A plunger of 20 g that a load pushes in by 222.4 N; the spring of the adjuster is left out.
std::string leak_down(double seconds, const std::string& keys) {
  return fmt::format("[time]\nend_s = {}\noutput_step_us = 1000\n{}{}{}", seconds, kPlunger,
                     "[[load]]\nbody = \"plunger\"\ncomponent = \"x\"\nvalue = -222.4\n"
                     "[[lash_adjuster]]\nname = \"hla\"\na = { at_mm = [0, 0, 0] }\n"
                     "b = { body = \"plunger\" }\naxis = [1, 0, 0]\nspring_force_n = 0\n",
                     keys);
}

TEST_F(HydraulicScenes, OracleALashAdjusterLeaksDownByAMillimetre) {
  const double area = 0.25 * std::numbers::pi * 81e-6;
  const std::string start = fmt::format("start_bar = {:.15g}\n", 1.0 + 222.4 / area * 1e-5);
  // Steady from the start but for the plunger's own inertia, 3e-8 s.
  const H5File file = recorded(leak_down(2.70204, start));
  const auto travel = file.read_doubles("history/lash_adjuster_hla_travel");
  EXPECT_NEAR(travel.back(), -1e-3, 5e-9);
  const auto time = file.read_doubles("history/time");
  const size_t half = travel.size() / 2;
  EXPECT_NEAR(travel[half] / time[half], -0.370091e-3, 1e-9);
  const H5File eccentric = recorded(leak_down(1.08081, start + "eccentricity = 1\n"));
  EXPECT_NEAR(eccentric.read_doubles("history/lash_adjuster_hla_travel").back(), -1e-3, 2e-8);
  EXPECT_LT(result_.energy_residue, 1e-4);
}

TEST_F(HydraulicScenes, AStopEndsTheTravel) {
  const double area = 0.25 * std::numbers::pi * 81e-6;
  const std::string start = fmt::format("start_bar = {:.15g}\n", 1.0 + 222.4 / area * 1e-5);
  // It leaks down to the stop, which then bears the load but for the pressure of the supply, to
  // which that of the chamber falls with V / (G E), half a second.
  const H5File file = recorded(leak_down(8.0, start + "stops_mm = [-0.1, 1]\n"));
  const double held = 222.4 - 2.5e5 * area;
  EXPECT_NEAR(file.read_doubles("history/lash_adjuster_hla_travel").back(), -0.1e-3 - held / 1e8,
              2e-9);
  EXPECT_LT(result_.energy_residue, 1e-4);
  test::expect_parts(refusal(leak_down(0.5, "stops_mm = [0.1, 1]\n")),
                     {"stops_mm", "[0.1, 1]", "start at 0 between them"});
  test::expect_parts(refusal(leak_down(0.5, "stops_mm = [-4, 1]\n")), {"stops_mm", "0.15 cm3"});
}

/// A chain of 1e5 N/m that the tensioner holds, shaken at 85 Hz by `shake` N.
std::string chain(const std::string& keys, double seconds = 0.1) {
  return fmt::format(
      "[time]\nend_s = {}\noutput_step_us = 50\nlargest_step_us = 50\n{}{}{}", seconds, kPlunger,
      "[[spring]]\na = { body = \"plunger\", at_mm = [0, 0, 0] }\nb = { at_mm = [100, 0, 0] }\n"
      "stiffness_n_m = 1e5\ndamping_n_s_m = 5\nlength_mm = 101.0\n"
      "[[load]]\nbody = \"plunger\"\ncomponent = \"x\"\ntable = \"shake.csv\"\n"
      "[[tensioner]]\nname = \"slack\"\na = { at_mm = [-20, 0, 0] }\n"
      "b = { body = \"plunger\", at_mm = [0, 0, 0] }\naxis = [1, 0, 0]\n",
      keys);
}

void write_shake(const std::filesystem::path& folder) {
  std::ofstream file(folder / "shake.csv");
  file << "time [s], force [N]\n";
  for (int i = 0; i <= 2000; ++i)
    file << fmt::format("{:.6f}, {:.9g}\n", 1e-4 * i,
                        80.0 * std::sin(2.0 * std::numbers::pi * 85.0 * 1e-4 * i));
}

double swing(const std::vector<double>& values) {
  const auto [low, high] =
      std::minmax_element(values.begin() + static_cast<long>(values.size() / 2), values.end());
  return *high - *low;
}

TEST_F(HydraulicScenes, ATensionerHoldsAShakenChainAndItsEnergyCloses) {
  write_shake(folder_);
  const H5File file = recorded(chain(""));
  const auto pressure = file.read_doubles("history/tensioner_slack_pressure");
  const auto force = file.read_doubles("history/tensioner_slack_force");
  const auto travel = file.read_doubles("history/tensioner_slack_travel");
  EXPECT_LT(result_.energy_residue, 1e-3);
  const double area = 0.25 * std::numbers::pi * 1e-4;
  for (size_t i = 0; i < force.size(); ++i) {
    EXPECT_GT(pressure[i], 0.0);
    EXPECT_NEAR(force[i], area * (pressure[i] - 1e5) + 90.0 - 2000.0 * travel[i], 1e-9);
  }
  // It pumps up: oil comes in while the plunger goes out and does not go back at once.
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (size_t i = values.size() / 2; i < values.size(); ++i) sum += values[i];
    return sum / static_cast<double>(values.size() - values.size() / 2);
  };
  EXPECT_GT(mean(pressure), 4.0e5);
  const H5File plain = recorded(chain("model = \"constant_pressure\"\n"));
  EXPECT_NEAR(mean(plain.read_doubles("history/tensioner_slack_pressure")), 3.5e5, 1e-6);
  EXPECT_FALSE(plain.has("history/tensioner_slack_content"));
  EXPECT_GT(swing(plain.read_doubles("history/plunger_travel")), 1.2 * swing(travel));
  const H5File constant = recorded(chain("model = \"constant_force\"\n"));
  const auto still = constant.read_doubles("history/tensioner_slack_force");
  EXPECT_NEAR(still.back(), 90.0 + 2.5e5 * area, 1e-9);
  EXPECT_LT(swing(still), 1e-12);
}

TEST_F(HydraulicScenes, HardTD6_ADryTensionerLeavesTheChainSlackAndSaysSo) {
  write_shake(folder_);
  const H5File wet = recorded(chain(""));
  const double held = swing(wet.read_doubles("history/plunger_travel"));
  const H5File file = recorded(chain("dry = true\n"));
  const auto names = file.read_strings("effects/name");
  const auto states = file.read_strings("effects/state"), why = file.read_strings("effects/why");
  const auto row = static_cast<size_t>(
      std::find(names.begin(), names.end(), "tensioner slack oil") - names.begin());
  ASSERT_LT(row, names.size());
  EXPECT_EQ(states[row], "off");
  EXPECT_EQ(why[row], "dry: chamber and supply are full of air");
  for (const double p : file.read_doubles("history/tensioner_slack_pressure"))
    EXPECT_NEAR(p, 1e5, 0.05e5);
  EXPECT_GT(swing(file.read_doubles("history/plunger_travel")), 1.2 * held);
}

TEST_F(HydraulicScenes, TheSupplyFollowsItsTable) {
  std::ofstream(folder_ / "supply.csv") << "time [s], pressure [bar]\n-1, 2\n0, 2\n0.05, 5\n1, 5\n";
  write_shake(folder_);
  const std::string keys = "supply_table = \"supply.csv\"\nmodel = \"constant_pressure\"\n";
  const H5File file = recorded(chain(keys));
  const auto pressure = file.read_doubles("history/tensioner_slack_pressure");
  const auto time = file.read_doubles("history/time");
  for (size_t i = 0; i < time.size(); ++i)
    EXPECT_NEAR(pressure[i], 2e5 + std::min(time[i], 0.05) * 6e6, 300.0) << time[i];
  EXPECT_LT(result_.energy_residue, 1e-3);
}

TEST_F(HydraulicScenes, AMovingBallOpensAndShutsAndIsRecorded) {
  write_shake(folder_);
  const H5File file = recorded(chain("[tensioner.check_valve]\nball = \"moving\"\n", 0.05));
  const auto lift = file.read_doubles("history/tensioner_slack_lift");
  const auto [low, high] = std::minmax_element(lift.begin(), lift.end());
  EXPECT_EQ(*low, 0.0);
  EXPECT_GT(*high, 0.02e-3);
  EXPECT_LT(*high, 0.45e-3);
  EXPECT_LT(result_.energy_residue, 1e-3);
}

TEST_F(HydraulicScenes, ASlidingBodyFallsAlongItsObliqueAxis) {
  // Gravity of 10 m/s2 along -z on an axis of slope 0.8: 8 m/s2; and a load along x of 0.6.
  const H5File file = recorded(
      "gravity_m_s2 = 10\n[time]\nend_s = 0.1\n[[rigid_body]]\nname = \"bob\"\nmotion = \"slide\"\n"
      "axis = [3, 0, -4]\nmass_kg = 2\nstart_velocity_m_s = [0.6, 0, -0.8]\n"
      "[[load]]\nbody = \"bob\"\ncomponent = \"x\"\nvalue = 5\n");
  const double expected = 0.1 + 0.5 * (8.0 + 0.6 * 5.0 / 2.0) * 0.01;
  EXPECT_NEAR(file.read_doubles("history/bob_travel").back(), expected, 1e-6);
}

TEST_F(HydraulicScenes, ATensionerOnABodyPushesItBackAndMeasuresAlongTheAxisOfTheStart) {
  // The body is turned in its plane at the start, the axis is given as it is then.
  write_shake(folder_);
  std::string text = chain("");
  text.replace(text.find("a = { at_mm = [-20, 0, 0] }"), 27,
               "a = { body = \"block\", at_mm = [-20, 0, 0] }");
  const std::string mass = "mass_kg = 0.02\n";
  text.insert(text.find(mass), "guide = { body = \"block\" }\n");
  const H5File file = recorded(text +
                               "[[rigid_body]]\nname = \"block\"\nmass_kg = 50\ninertia_kg_m2 = 1\n"
                               "centre_mm = [-100, 0, 0]\nangle_deg = 30\n");
  const auto travel = file.read_doubles("history/tensioner_slack_travel");
  const auto plunger = file.read_doubles("history/plunger_travel");
  const auto block = file.read_doubles("history/block_x");
  for (size_t i = 0; i < travel.size(); ++i)
    EXPECT_NEAR(travel[i], plunger[i] - (block[i] + 0.1), 1e-9) << i;
  EXPECT_LT(block.back(), -0.1);  // the reaction pushes it back
  // All forces are on the line through its centre.
  EXPECT_LT(std::abs(file.read_doubles("history/block_angle").back() - std::numbers::pi / 6.0),
            1e-9);
}

TEST_F(HydraulicScenes, MeaninglessNumbersAreRefusedWithFileLineAndKey) {
  write_shake(folder_);
  const auto expect = [&](const std::string& table, const std::string& key) {
    for (const char* value : {"nan", "inf", "-inf", "1e30", "-1e30", "\"1\"", "true", "{}"}) {
      const std::string ball = table == "check_valve." ? "ball = \"moving\"\n" : "";
      const std::string head =
          table.empty() ? "" : "[tensioner." + table.substr(0, table.size() - 1) + "]\n" + ball;
      const std::string said = refusal(chain(head + key + " = " + value + "\n"));
      EXPECT_NE(said.find("drive.run.toml:"), std::string::npos) << key << value << said;
      EXPECT_NE(said.find("." + table + key + ": found "), std::string::npos)
          << key << " = " << value << ": " << said;
    }
  };
  for (const char* key : {"diameter_mm", "volume_cm3", "start_travel_mm", "start_bar",
                          "outside_bar", "spring_force_n", "spring_rate_n_m", "gap_um",
                          "gap_length_mm", "eccentricity", "viscosity_mpa_s", "density_kg_m3",
                          "modulus_gpa", "free_air", "polytropic_exponent", "supply_bar"})
    expect("", key);
  for (const char* key :
       {"seat_mm", "lift_mm", "discharge", "laminar_below_pa", "opening_bar", "full_opening_bar",
        "ball_mm", "ball_density_kg_m3", "spring_force_n", "spring_rate_n_m",
        "contact_stiffness_n_m", "contact_damping_s_m", "drag_n_s_m"})
    expect("check_valve.", key);
  expect("relief.", "opening_bar");
}

TEST_F(HydraulicScenes, AreRefusedWithPlaceAndReason) {
  write_shake(folder_);
  const auto expect = [&](const std::string& text, const std::string& said) {
    EXPECT_NE(refusal(text).find(said), std::string::npos) << said << "\n" << refusal(text);
  };
  EXPECT_EQ(refusal(chain("")), "accepted");
  expect(chain("diameter_mm = -1\n"), "tensioner[0].diameter_mm: found -1");
  expect(chain("gap_mm = 1\n"), "tensioner[0].gap_mm: unknown key, did you mean gap_um?");
  expect(chain("free_air = 3\n"), "tensioner[0].free_air: found 3");
  expect(chain("supply_bar = 0\n"), "tensioner[0].supply_bar: found 0");
  expect(chain("eccentricity = 1.5\n"), "tensioner[0].eccentricity: found 1.5");
  expect(chain("model = \"rigid\"\n"), "expected one of: hydraulic, constant_pressure");
  expect(chain("start_travel_mm = -40\n"), "start_travel_mm: found -40, expected one that leaves");
  expect(chain("[tensioner.check_valve]\nball = \"stuck\"\n"), "expected one of: quasi_static");
  expect(chain("[tensioner.check_valve]\nopening_bar = 1\n"),
         "full_opening_bar: found 0.02, expected more than opening_bar = 1");
  expect(chain("[tensioner.check_valve]\nball = \"moving\"\nball_mm = 2\n"),
         "ball_mm: found 2, expected more than the seat's 3");
  expect(chain("[tensioner.relief]\nopening_bar = 20\n"), "gradient_ml_s_bar: found nothing");
  std::ofstream(folder_ / "low.csv") << "time [s], pressure [bar]\n-1, 2\n0, 0\n1, 5\n";
  expect(chain("supply_table = \"low.csv\"\n"), "low.csv:3: pressure: found 0 bar");
  std::ofstream(folder_ / "force.csv") << "time [s], force [N]\n-1, 2\n1, 5\n";
  expect(chain("supply_table = \"force.csv\"\n"), "force is in [N], expected a unit of [Pa]");
  std::string twisted = chain("");
  twisted.replace(twisted.rfind("axis = [1, 0, 0]"), 16, "axis = [0, 0, 0]");
  expect(twisted, "tensioner[0].axis: found length 0, expected a direction");
  const std::string slide =
      "[time]\nend_s = 1\n[[rigid_body]]\nname = \"s\"\nmotion = \"slide\"\nmass_kg = 1\n";
  expect(slide, "rigid_body[0].axis");
  expect(slide + "axis = [1, 0, 0]\nstart_velocity_m_s = [0, 1, 0]\n",
         "start_velocity_m_s: found 1 m/s across the axis");
  expect(slide + "axis = [1, 0, 0]\nguide = { body = \"s\" }\n", "guide: found \"s\" itself");
  const std::string held =
      "[[bushing]]\na = { body = \"s\", at_mm = [0, 0, 0] }\nb = {}\nstiffness_n_m = 1\n";
  expect(slide + "axis = [1, 0, 0]\nguide = { body = \"t\" }\n" + held,
         "rigid_body[0].guide.body: no body \"t\"");
  expect(slide +
             "axis = [1, 0, 0]\nguide = { body = \"m\" }\n[[drive]]\nname = \"m\"\n"
             "speed_rpm = 1\n" +
             held,
         "guide: found \"m\", which is driven");
  expect(slide +
             "axis = [1, 0, 0]\nguide = { body = \"t\" }\n[[rigid_body]]\nname = \"t\"\n"
             "motion = \"slide\"\nmass_kg = 1\naxis = [0, 1, 0]\nguide = { body = \"s\" }\n" +
             held,
         "the guides of \"s\" lead back to it");
}

}  // namespace
}  // namespace clatter::dynamics
