// SPDX-License-Identifier: GPL-3.0-or-later
// Every key of a scene with meaningless values: each is refused with file, line and key.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/dynamics/slap_scene.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;
using Values = std::vector<std::string>;

// Which of the meaningless values mean something for a key.
enum Allowed : unsigned { kNone = 0, kZero = 1, kNegative = 2, kTiny = 4 };

/// A number of a scene.
struct NumberKey {
  std::string key;   // in messages
  std::string text;  // TOML with the value at {}
  unsigned allowed = kNone;
};

std::string in(const std::string& key) {
  const size_t dot = key.find('.');
  return fmt::format("[{}]\n{} = {{}}\n", key.substr(0, dot), key.substr(dot + 1));
}

const char* const kMount = "[[mount]]\nsets = [\"mounts\"]\n";
const char* const kLoad = "[[load]]\nbody = \"piston\"\nset = \"pin\"\ncomponent = \"z\"\n";

std::vector<NumberKey> engine_numbers() {
  std::vector<NumberKey> keys{{"gravity_m_s2", "gravity_m_s2 = {}\n", kZero | kTiny}};
  for (const char* key : {"engine.speed_rpm",
                          "engine.stroke_mm",
                          "rod.length_mm",
                          "rod.mass_kg",
                          "rod.inertia_kg_m2",
                          "time.cycles",
                          "time.record_cycles",
                          "time.output_step_us",
                          "time.largest_step_us",
                          "time.smallest_step_us",
                          "accuracy.tolerance",
                          "accuracy.displacement_um",
                          "accuracy.velocity_m_s",
                          "accuracy.arm_mm",
                          "piston.displacement_um",
                          "piston.velocity_m_s",
                          "block.displacement_um",
                          "block.velocity_m_s",
                          "small_end.exponent",
                          "small_end.stiffness",
                          "big_end.exponent",
                          "big_end.stiffness",
                          "small_end.reversal_speed_rad_s",
                          "big_end.reversal_speed_rad_s",
                          "contact.bore_mm",
                          "contact.pad_span_deg",
                          "contact.cells_around",
                          "contact.cells_along",
                          "contact.viscosity_pa_s",
                          "contact.oil_thickness_um",
                          "contact.peklenik",
                          "contact.asperity_factor",
                          "contact.asperity_modulus_gpa",
                          "contact.summit_roughness_um",
                          "contact.reversal_speed_m_s"})
    keys.push_back({key, in(key), kNone});
  for (const char* key : {"time.film_every_deg", "contact.bulk_modulus_mpa"})
    keys.push_back({key, in(key), kZero});
  for (const char* key : {"rod.centre_mm",
                          "time.ramp_deg",
                          "gas.ambient_bar",
                          "rod.mode_limit_hz",
                          "piston.mode_limit_hz",
                          "small_end.clearance_um",
                          "small_end.soft_stiffness_n_m",
                          "small_end.damping_n_s_m",
                          "big_end.clearance_um",
                          "big_end.soft_stiffness_n_m",
                          "big_end.damping_n_s_m",
                          "pin_guide.axial_stiffness_n_m",
                          "pin_guide.axial_damping_n_s_m",
                          "pin_guide.tilt_stiffness_n_m",
                          "pin_guide.tilt_damping_n_m_s",
                          "contact.clearance_um",
                          "contact.barrel_top_um",
                          "contact.barrel_bottom_um",
                          "contact.ovality_um",
                          "contact.initial_fill",
                          "contact.supply_fill",
                          "contact.supply_pressure_bar",
                          "contact.piston_roughness_um",
                          "contact.liner_roughness_um",
                          "contact.asperity_loss_factor",
                          "small_end.friction_coefficient",
                          "big_end.friction_coefficient",
                          "contact.friction_coefficient"})
    keys.push_back({key, in(key), kZero | kTiny});
  for (const char* key : {"engine.pin_offset_mm", "contact.skirt_bottom_mm", "contact.skirt_top_mm",
                          "contact.barrel_apex_mm"})
    keys.push_back({key, in(key), kZero | kTiny | kNegative});
  keys.push_back({"block.mode_limit_hz", "[block]\nmode_limit_hz = {}\n", kZero | kTiny});
  keys.push_back({"mount[0].stiffness_n_m", kMount + std::string("stiffness_n_m = [1, {}, 1]\n"),
                  kZero | kTiny});
  keys.push_back({"mount[0].damping_n_s_m",
                  kMount + std::string("stiffness_n_m = [1, 1, 1]\ndamping_n_s_m = [0, 0, {}]\n"),
                  kZero | kTiny});
  keys.push_back({"load[0].value", kLoad + std::string("value = {}\n"), kZero | kTiny | kNegative});
  keys.push_back({"load[0].scale", kLoad + std::string("table = \"load.csv\"\nscale = {}\n"),
                  kZero | kTiny | kNegative});
  keys.push_back({"contact.profile_height_mm",
                  "[contact]\nprofile_height_mm = [{}, 9000]\nprofile_relief_um = [1, 0]\n",
                  kZero | kTiny | kNegative});
  keys.push_back({"contact.profile_relief_um",
                  "[contact]\nprofile_height_mm = [0, 1]\nprofile_relief_um = [{}, 0]\n",
                  kZero | kTiny});
  keys.push_back({"contact.bore_height_mm",
                  "[contact]\nbore_height_mm = [{}, 9000]\nbore_widening_um = [1, 0]\n",
                  kZero | kTiny | kNegative});
  keys.push_back({"contact.bore_widening_um",
                  "[contact]\nbore_height_mm = [0, 1]\nbore_widening_um = [{}, 0]\n",
                  kZero | kTiny});
  return keys;
}

Values meaningless(const NumberKey& key) {
  Values values{"nan", "inf", "-inf", "1e30", "-1e30", "\"1\"", "true", "{}"};
  if ((key.allowed & kZero) == 0) values.emplace_back("0");
  if ((key.allowed & kNegative) == 0) values.emplace_back("-1");
  if ((key.allowed & kTiny) == 0) values.emplace_back("1e-30");
  return values;
}

class SceneValues : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_slap_scene(folder_);
    std::ofstream(folder_ / "load.csv") << "crank_angle [deg], force [N]\n-360, 0\n-120, 1\n120, "
                                           "1\n359, 0\n";
  }
  void expect_refused(const std::string& key, const std::string& text, const Values& values) const {
    for (const std::string& value : values) {
      const std::string said =
          testing::scene_refusal(folder_, fmt::format(fmt::runtime(text), value));
      EXPECT_NE(said.find("changed.run.toml:"), std::string::npos)
          << key << " = " << value << ": " << said;
      EXPECT_NE(said.find(fmt::format(": {}: found ", key)), std::string::npos)
          << key << " = " << value << ": " << said;
      EXPECT_NE(said.find("expected "), std::string::npos) << key << " = " << value << ": " << said;
    }
  }
  fs::path folder_ = testing::test_folder();
};

// Before, 1e30 passed for nearly every key, and 1e-30 for lengths, masses, times and stiffnesses.
TEST_F(SceneValues, HardN10_MeaninglessNumbersAreRefusedWithFileLineAndKey) {
  for (const NumberKey& key : engine_numbers()) expect_refused(key.key, key.text, meaningless(key));
}

TEST_F(SceneValues, EveryNumberOfASceneIsInTheTable) {
  std::set<std::string> known;
  for (const NumberKey& key : engine_numbers()) known.insert(key.key);
  const Scene scene = testing::changed_scene(
      folder_, fmt::format("[block]\nmodel = \"elastic\"\n[small_end]\n[big_end]\n[pin_guide]\n"
                           "[accuracy]\n{}stiffness_n_m = [1, 1, 1]\n",
                           kMount));
  std::istringstream lines(scene.resolved);
  for (std::string line; std::getline(lines, line);) {
    const size_t equal = line.find(" = ");
    const std::string key = line.substr(0, equal);
    if (line.find_first_of("-0123456789", equal) == equal + 3) {
      EXPECT_EQ(known.count(key), 1U) << line;
    }
  }
}

TEST_F(SceneValues, OfAnotherTypeAreRefused) {
  for (const char* key : {"engine.balanced", "contact.cavitation", "contact.asperities",
                          "contact.friction", "contact.flow_factors"})
    expect_refused(key, in(key), {"1", "\"on\"", "nan"});
  for (const char* key : {"contact.lubrication", "contact.asperity_law", "time.method",
                          "gas.interpolation", "piston.model", "block.model"})
    expect_refused(key, in(key), {"1", "\"off\"", "true", "\"\""});
  for (const char* key : {"piston.pin", "piston.skirt", "piston.gas_load", "gas.column",
                          "gas.table", "piston.rom", "block.liner", "block.liner_axial"})
    expect_refused(key, in(key), {"1", "true", "[\"a\"]"});
}

}  // namespace
}  // namespace clatter::dynamics
