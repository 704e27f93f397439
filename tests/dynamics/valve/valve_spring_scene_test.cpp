// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with [[valve_spring]].
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

class ValveSprings : public ::testing::Test {
 protected:
  Scene scene(const std::string& text) {
    std::ofstream(folder_ / "spring.run.toml") << text;
    return read_scene(folder_ / "spring.run.toml");
  }
  H5File recorded(const std::string& text) {
    return testing::complete_file(scene(text), folder_ / "spring.run.h5", result_);
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { build_model(scene(text), {}); });
  }
  std::filesystem::path folder_ = testing::test_folder();
  RunResult result_;
};

/// A mass of 1 kg that swings on a spring held at its other end.
std::string swinging(const std::string& keys) {
  return R"(
[time]
end_s = 0.1
output_step_us = 20
[accuracy]
tolerance = 1e-4
[[rigid_body]]
name = "mass"
motion = "slide"
mass_kg = 1.0
axis = [0, 0, 1]
start_velocity_m_s = [0, 0, 0.1]
[[load]]
body = "mass"
component = "z"
value = -150.0
[[valve_spring]]
name = "outer"
a = { at_mm = [0, 0, 0] }
b = { body = "mass", at_mm = [0, 0, 40] }
)" + keys;
}

TEST_F(ValveSprings, AMassSwingsWithTheFrequencyOfSpringAndAThirdOfItsMass) {
  const H5File file = recorded(swinging("damping_ratio = 0\n"));
  const auto time = file.read_doubles("history/time"), z = file.read_doubles("history/mass_travel");
  double last = 0.0, first = 0.0;
  int count = 0;
  for (size_t i = 1; i < z.size(); ++i)
    if (z[i - 1] < 0.0 && z[i] >= 0.0) {
      last = time[i - 1] - z[i - 1] * (time[i] - time[i - 1]) / (z[i] - z[i - 1]);
      if (count++ == 0) first = last;
    }
  ASSERT_GE(count, 2);
  const double expected =
      std::sqrt(22214.28 / (1.0 + 28.88398e-3 / 3.0)) / (2.0 * std::numbers::pi);
  // The third of the mass is the first term of a series in the ratio of the masses, 0.03.
  EXPECT_NEAR((count - 1) / (last - first), expected, 1e-3 * expected);
  EXPECT_LT(result_.energy_residue, 1e-4);
  for (const char* name : {"valve_spring_outer_force", "valve_spring_outer_seat_force",
                           "valve_spring_outer_least_gap"})
    EXPECT_TRUE(file.has(std::string("history/") + name)) << name;
}

TEST_F(ValveSprings, RefusalsSayWhatIsWrong) {
  test::expect_parts(refusal(swinging("wire_mm = 30\n")),
                     {"spring.run.toml:", "diameter_mm", "21.5", "30"});
  test::expect_parts(refusal(swinging("masses = 0\n")), {"masses", "0"});
  test::expect_parts(refusal(swinging("stiffness_n_m = 2e4\nmass_kg = 0.03\nturns = 6\n")),
                     {"turns", "stiffness_n_m"});
  test::expect_parts(refusal(swinging("stiffness_n_m = 2e4\n")), {"mass_kg"});
  test::expect_parts(refusal(swinging("to_solid_mm = -1\n")), {"to_solid_mm", "-1"});
  std::string same = swinging("");
  same.replace(same.find("[0, 0, 40]"), 10, "[0, 0, 0]");
  test::expect_parts(refusal(same), {"valve_spring[0].b", "same point"});
}

}  // namespace
}  // namespace clatter::dynamics
