// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of joints, springs, shafts, torques, tensioners and valve springs that are off are the
// limit of the effect going to zero.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "dynamics/scene/effect_catalogue.hpp"
#include "tests/dynamics/effects/limit_case.hpp"
#include "tests/dynamics/effects/limit_list.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

using testing::LimitCase;

constexpr const char* kTime = "[time]\nend_s = 0.1\noutput_step_us = 100\n";

/// A ball that moves along x and turns about z.
constexpr const char* kBall = R"(
[[rigid_body]]
name = "ball"
motion = "xy"
mass_kg = 2
inertia_kg_m2 = 0.1
centre_mm = [0, 100, 0]
start_velocity_m_s = [0.3, -0.5, 0]
start_spin_rad_s = 2
)";

/// A plunger on a slide.
constexpr const char* kPlunger = R"(
[[rigid_body]]
name = "plunger"
motion = "slide"
axis = [1, 0, 0]
mass_kg = 0.02
start_velocity_m_s = [0.2, 0, 0]
)";

/// A shaft with two discs in stiff bearings, of which the first is driven and the second brakes.
std::string shaft(const std::string& model, const std::string& keys, const std::string& phaser = "",
                  double bearing = 1e9) {
  std::string text = std::string(kTime) +
                     "[[shaft]]\nname = \"cam\"\nspeed_rpm = 1000\nmodel = \"" + model + "\"\n" +
                     keys + "[[shaft.section]]\nfrom_mm = 0\nto_mm = 300\ndiameter_mm = 24\n";
  for (const int k : {1, 2})
    text += fmt::format(
        "[[shaft.disc]]\nname = \"d{}\"\nat_mm = {}\nmass_kg = 0.5\npolar_kg_m2 = 1e-3\n{}", k,
        k == 1 ? 50 : 250, k == 1 ? phaser : "");
  for (const int k : {1, 2})
    text += fmt::format(
        "[[shaft.bearing]]\nname = \"b{}\"\nat_mm = {}\nmodel = \"linear\"\nstiffness_n_m = {}\n"
        "damping_n_s_m = {}\nthrust_stiffness_n_m = {}\n",
        k, k == 1 ? 0 : 300, bearing, 1e-5 * bearing, bearing);
  for (const int k : {1, 2})
    text += fmt::format("[[torque]]\nname = \"t{0}\"\nbody = \"cam.d{0}\"\nvalue_n_m = {1}\n", k,
                        k == 1 ? 20 : -20);
  return text;
}

/// The same without torques, or with a further table.
std::string plain_shaft(const std::string& more) {
  std::string text = shaft("rigid", "");
  return text.substr(0, text.find("[[torque]]")) + more;
}

class MechanismLimits : public ::testing::TestWithParam<std::string> {
 protected:
  LimitCase named(const std::string& effect) { return case_of(cases(), effect); }
  std::filesystem::path folder_ = testing::test_folder();

 private:
  std::function<Scene()> off(const std::string& text) {
    return [this, text] { return testing::scene_of(folder_, text); };
  }
  std::function<Scene(double)> on(std::function<std::string(double)> text) {
    return [this, text = std::move(text)](double strength) {
      return testing::scene_of(folder_, text(strength));
    };
  }
  std::vector<LimitCase> cases();
  std::vector<LimitCase> joints();
  std::vector<LimitCase> shafts();
  std::vector<LimitCase> hydraulics();
};

std::vector<LimitCase> MechanismLimits::joints() {
  const std::string ball = std::string(kTime) + kBall;
  std::string falling = ball;
  falling.replace(falling.find("\"xy\""), 4, "\"zx\"");
  falling.replace(falling.find("-0.5, 0"), 7, "0, -0.5");
  const std::string at = "{ body = \"ball\", at_mm = [20, 110, 0] }";
  const std::string disc = std::string(kTime) +
                           "[[rigid_body]]\nname = \"disc\"\nmotion = \"space\"\nmass_kg = 2\n"
                           "inertia_kg_m2 = [0.01, 0.02, 0.01]\ncentre_mm = [0, 0, 100]\n"
                           "start_velocity_m_s = [0.3, 0, 0]\n";
  testing::write_rom(folder_ / "bar.rom.h5", testing::clamped_bar(1.0, 100, 10));
  testing::write_rom(folder_ / "block.rom.h5", testing::elastic_block(0.0535, 4, 3));
  const std::string block =
      std::string(kTime) +
      "[[body]]\nname = \"block\"\nrom = \"block.rom.h5\"\n[[load]]\nbody = \"block\"\n"
      "load = \"head_4_gas\"\nvalue = 1000\n";
  return {{"elastic joints", off(ball), on([=](double s) {
             return ball + fmt::format(
                               "[[bushing]]\nname = \"j\"\na = {}\nb = {{ at_mm = [0, 90, "
                               "0] }}\nstiffness_n_m = {}\ndamping_n_s_m = {}\n",
                               at, 1e4 * s, 10 * s);
           })},
          {"springs", off(ball), on([=](double s) {
             return ball + fmt::format(
                               "[[spring]]\nname = \"s\"\na = {}\nb = {{ at_mm = [0, 0, 0] "
                               "}}\nstiffness_n_m = {}\ndamping_n_s_m = {}\nlength_mm = "
                               "50\n",
                               at, 1e4 * s, 10 * s);
           })},
          {"mounts", off(block), on([=](double s) {
             return block + fmt::format(
                                "[[mount]]\nbody = \"block\"\nsets = [\"mounts\"]\n"
                                "stiffness_n_m = [{0}, {0}, {0}]\n"
                                "damping_n_s_m = [{1}, {1}, {1}]\n",
                                1e8 * s, 1e4 * s);
           })},
          {"stops", off(ball), on([=](double s) {
             return ball + fmt::format(
                               "[[stop]]\nname = \"p\"\na = {}\nb = {{ at_mm = [0, 112, 0] "
                               "}}\nnormal = [0, 1, 0]\nstiffness_n_m = {}\n",
                               at, 1e6 * s);
           })},
          {"rolling discs", off(disc), on([=](double s) {
             return disc + fmt::format(
                               "[[rolling_disc]]\nname = \"r\"\nbody = \"disc\"\n"
                               "axis = [0, 1, 0]\nradius_mm = 101\nfriction = 0.3\n"
                               "stiffness_n_m = {}\n",
                               1e6 * s);
           })},
          {"gravity", off("gravity_m_s2 = 0\n" + falling),
           on([=](double s) { return fmt::format("gravity_m_s2 = {}\n", 10 * s) + falling; })}};
}

std::vector<LimitCase> MechanismLimits::shafts() {
  const auto stiff = [](double s) {
    return fmt::format("youngs_modulus_gpa = {0}\nshear_modulus_gpa = {1}\n", 10.0 / s, 4.0 / s);
  };
  // A spring beside the axis: its moment depends on where the axis is.
  const std::string pulled =
      "[[bushing]]\nname = \"p\"\na = { body = \"cam.d1\", at_mm = [20, 0, 50] }\n"
      "b = { at_mm = [25, 5, 50] }\nstiffness_n_m = 1e6\n";
  const std::string phaser = "[shaft.disc.phaser]\nstiffness_n_m_rad = {}\n";
  return {{"torsion of a shaft", off(shaft("rigid", "")),
           on([=](double s) { return shaft("torsion", stiff(s)); }), 1e-2, 1e-3, 0.5},
          {"bending of a shaft", off(shaft("torsion", stiff(1e-3)) + pulled),
           on([=](double s) { return shaft("full", stiff(s), "", 1e9 / s) + pulled; }), 3e-3, 1e-3},
          {"bearings of a shaft", off(shaft("torsion", stiff(1e-3)) + pulled),
           on([=](double s) { return shaft("full", stiff(s), "", 1e9 / s) + pulled; }), 3e-3, 1e-3},
          {"unbalance of a disc", off(shaft("full", "")), on([](double s) {
             return shaft("full", "", fmt::format("unbalance_g_mm = {}\n", 1e4 * s));
           })},
          {"phaser", off(shaft("torsion", "")), on([=](double s) {
             return shaft("torsion", "", fmt::format(fmt::runtime(phaser), 1e5 / s));
           })},
          {"torques over angle", off(plain_shaft("")), on([](double s) {
             return plain_shaft(fmt::format(
                 "[[torque]]\nname = \"t\"\nbody = \"cam.d1\"\nvalue_n_m = {}\n", 20 * s));
           })},
          {"cam torque", off(plain_shaft("")), on([](double s) {
             return plain_shaft(fmt::format(
                 "[[cam_torque]]\nname = \"v\"\nbody = \"cam.d2\"\nlift_mm = 7.5\nhalf_angle_deg = "
                 "70\nlobes_deg = [-30]\nspring_force_n = {}\n",
                 300 * s));
           })},
          {"torque of valves", off(plain_shaft("")), on([](double s) {
             return plain_shaft(fmt::format(
                 "[[valve]]\nname = \"in\"\nmodel = \"quasi_static\"\nlift_mm = 7.5\n"
                 "half_angle_deg = 70\nmass_kg = {}\nlobe = [{{ body = \"cam.d2\", at_mm = [0, 0, "
                 "250], deg = -30 }}]\n[valve.spring]\nforce_n = {}\nstiffness_n_m = {}\nmass_kg = "
                 "{}\n[valve.follower]\nmass_kg = {}\ninertia_kg_m2 = {}\n",
                 0.05 * s, 150 * s, 2e4 * s, 0.03 * s, 0.04 * s, 2e-5 * s));
           })}};
}

std::vector<LimitCase> MechanismLimits::hydraulics() {
  const std::string plunger = std::string(kTime) + kPlunger;
  const auto tensioner = [=](const std::string& keys, const std::string& tables) {
    return plunger +
           "[[tensioner]]\nname = \"t\"\na = { at_mm = [0, 0, 0] }\n"
           "b = { body = \"plunger\" }\naxis = [1, 0, 0]\n" +
           keys + tables;
  };
  const std::string shut = "[tensioner.check_valve]\nball = \"stuck_shut\"\n";
  return {{"hydraulic element", off(plunger), on([=](double s) {
             return tensioner(
                 fmt::format("model = \"constant_force\"\ndiameter_mm = 0.1\nsupply_bar = 1\n"
                             "spring_force_n = {}\nspring_rate_n_m = {}\n",
                             90 * s, 2000 * s),
                 "");
           })},
          {"check valve", off(tensioner("start_bar = 3.49\n", shut)), on([=](double s) {
             return tensioner("start_bar = 3.49\n",
                              fmt::format("[tensioner.check_valve]\nlift_mm = {}\n", 0.42 * s));
           }),
           0.1, 0.01},
          {"relief valve", off(tensioner("start_bar = 30\n", shut)), on([=](double s) {
             return tensioner(
                 "start_bar = 30\n",
                 shut + fmt::format("[tensioner.relief]\nopening_bar = 5\ngradient_ml_s_bar = {}\n",
                                    s));
           })},
          {"valve spring", off(plunger), on([=](double s) {
             return plunger +
                    fmt::format(
                        "[[valve_spring]]\nname = \"s\"\na = {{ at_mm = [50, 0, 0] }}\n"
                        "b = {{ body = \"plunger\", at_mm = [0, 0, 0] }}\nstiffness_n_m = "
                        "{}\nmass_kg = {}\nforce_n = {}\n",
                        2e4 * s, 0.03 * s, 150 * s);
           })}};
}

std::vector<LimitCase> MechanismLimits::cases() {
  std::vector<LimitCase> all = joints();
  for (const auto& more : {shafts(), hydraulics()}) all.insert(all.end(), more.begin(), more.end());
  for (LimitCase& one : all) {
    one.steps = {0.0, 2e-5, 100};
    for (const char* part : {"torsion", "bending", "bearings", "phaser"})
      one.histories_only = one.histories_only || one.effect.starts_with(part);
    for (const char* absent : {"elastic joints", "springs", "stops", "rolling discs",
                               "unbalance of a disc", "phaser", "torques over angle", "cam torque",
                               "torque of valves", "hydraulic element", "valve spring"})
      if (one.effect == absent) one.row_off = "none";
  }
  return all;
}

TEST_P(MechanismLimits, OffIsTheLimitOfNoStrength) { expect_limit(named(GetParam())); }

INSTANTIATE_TEST_SUITE_P(Effects, MechanismLimits,
                         ::testing::ValuesIn(testing::effects_of_the_mechanism_limits()),
                         testing::name_of_effect);

TEST(EffectLimits, EveryEffectOfTheCatalogueHasOneOrAReason) {
  std::map<std::string, int> found;
  for (const auto& names :
       {testing::effects_of_the_cylinder_limits(), testing::effects_of_the_mechanism_limits()})
    for (const std::string& name : names) ++found[name];
  for (const auto& [name, reason] : testing::effects_without_a_strength()) {
    ++found[name];
    EXPECT_FALSE(reason.empty()) << name;
  }
  size_t entries = 0;
  for (const EffectFamily& family : effect_catalogue())
    for (const EffectEntry& entry : family.entries) {
      ++entries;
      EXPECT_EQ(found[std::string(entry.name)], 1) << entry.name;
    }
  EXPECT_EQ(found.size(), entries);  // no name that the catalogue lacks
}

}  // namespace
}  // namespace clatter::dynamics
