// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of general components: mechanisms of rigid bodies; the registry and its documentation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <numbers>
#include <set>
#include <sstream>

#include "dynamics/run/run_file.hpp"
#include "dynamics/scene/registry.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/paths.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

class Components : public ::testing::Test {
 protected:
  Scene scene(const std::string& text) {
    std::ofstream(folder_ / "mechanism.run.toml") << text;
    return read_scene(folder_ / "mechanism.run.toml");
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { build_model(scene(text), {}); });
  }
  H5File recorded(const Scene& scene) {
    return testing::complete_file(scene, folder_ / "mechanism.run.h5", result_);
  }
  fs::path folder_ = testing::test_folder();
  RunResult result_;
};

TEST_F(Components, AndrewsMechanismAsASceneMovesLikeThatOfTheLibrary) {
  const H5File file = recorded(read_scene(CLATTER_SOURCE_DIR "/tests/dynamics/andrews.run.toml"));
  testing::Andrews mechanism(1e10, 1e4);
  StepOptions options;
  options.first = 1e-9;
  options.smallest = 1e-13;
  options.accuracy = {1e-6, 1e-3, 1.0, 1e-3};
  const auto run = testing::started(mechanism.system, options);
  while (run->state().time < 0.03) run->step(0.03);
  for (size_t k = 0; k < 7; ++k) {
    const auto angle = file.read_doubles(fmt::format("history/K{}_angle", k + 1));
    // Both start by an implicit Euler stage, of 1e-7 and 1e-9 s; the mechanism amplifies that, and
    // joints of 1e8 N/m would change the angles by 1e-2 rad.
    EXPECT_NEAR(angle.back(), run->state().y(mechanism.bodies[k][2]), 2e-4) << k + 1;
  }
  EXPECT_LT(result_.energy_residue, 1e-4);
}

/// A rod of 1 m and 3 kg that hangs on a bushing, under gravity.
std::string pendulum(const std::string& plane, const std::string& centre) {
  return fmt::format(R"(
gravity_m_s2 = 9.81
[time]
end_s = 0.5
[accuracy]
tolerance = 1e-5
displacement_um = 1000
velocity_m_s = 1
arm_mm = 1000
[[rigid_body]]
name = "rod"
motion = "{}"
mass_kg = 3.0
inertia_kg_m2 = {}
centre_mm = {}
[[bushing]]
a = {{ body = "rod", at_mm = [0, 0, 0] }}
b = {{}}
stiffness_n_m = 1e8
damping_n_s_m = 1e3
)",
                     plane, plane == "space" ? "[0.25, 0.25, 0.25]" : "0.25", centre);
}

TEST_F(Components, APendulumSwingsTheSameInEveryPlaneAndInSpace) {
  // Released from the horizontal, 0.5 m beside its joint: a body of the same moment everywhere.
  const auto heights = [&](const std::string& plane, const std::string& centre) {
    const H5File file = recorded(scene(pendulum(plane, centre)));
    return file.read_doubles("history/rod_z").back();
  };
  const double down = heights("yz", "[0, 500, 0]");
  const double reaction =
      H5File::open(folder_ / "mechanism.run.h5").read_doubles("history/bushing_1_force_z").back();
  // theta'' = -m g l cos(theta) / (J + m l^2) from theta = 0; by classical Runge-Kutta steps.
  double angle = 0.0, rate = 0.0;
  const double h = 1e-4, factor = 3.0 * 9.81 * 0.5 / (0.25 + 3.0 * 0.25);
  const auto pull = [&](double at) { return -factor * std::cos(at); };
  for (int i = 0; i < 5000; ++i) {
    const double k1 = pull(angle), k2 = pull(angle + h / 2 * rate),
                 k3 = pull(angle + h / 2 * rate + h * h / 4 * k1),
                 k4 = pull(angle + h * rate + h * h / 2 * k2);
    angle += h * rate + h * h / 6 * (k1 + k2 + k3);
    rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  EXPECT_NEAR(down, 0.5 * std::sin(angle), 1e-4);
  // On the rod: its weight, the centripetal and the tangential acceleration of its centre.
  const double upward = 0.5 * (pull(angle) * std::cos(angle) - rate * rate * std::sin(angle));
  EXPECT_NEAR(reaction, 3.0 * (9.81 + upward), 1e-3 * 3.0 * 9.81);
  EXPECT_NEAR(heights("zx", "[500, 0, 0]"), down, 1e-5);
  EXPECT_NEAR(heights("space", "[300, 400, 0]"), down, 1e-4);
}

TEST_F(Components, ABodyThatSpinsInSpaceRecordsItsAttitude) {
  // 10 rad/s about its z axis, which the start turns onto the engine's x axis.
  const H5File file = recorded(
      scene("[time]\nend_s = 0.2\n[[rigid_body]]\nname = \"top\"\nmotion = \"space\"\n"
            "mass_kg = 2\ninertia_kg_m2 = [0.01, 0.01, 0.015]\nstart_spin_rad_s = [0, 0, 10]\n"
            "quaternion = [0.70710678118654757, 0, 0.70710678118654757, 0]\n"));
  const auto time = file.read_doubles("history/time");
  const Eigen::Quaterniond start(std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0);
  const auto q = [&](const char* part) {
    return file.read_doubles(std::string("history/top_q") + part);
  };
  const auto w = q("w"), x = q("x"), y = q("y"), z = q("z");
  ASSERT_GT(time.size(), 3U);
  for (size_t i = 0; i < time.size(); ++i) {
    const Eigen::Quaterniond turned =
        start * Eigen::AngleAxisd(10.0 * time[i], Eigen::Vector3d::UnitZ());
    // Equal rotations may have quaternions of opposite sign.
    EXPECT_NEAR(std::abs(turned.dot(Eigen::Quaterniond(w[i], x[i], y[i], z[i]))), 1.0, 1e-9) << i;
  }
  EXPECT_GT(std::abs(x.back() - x.front()), 0.1);
}

TEST_F(Components, AFourBarLinkageFollowsItsDrive) {
  // Crank of 0.1 m that a drive turns, coupler of 0.4 m, rocker of 0.3 m on a ground bar of 0.4 m.
  const double ground = 0.4, crank = 0.1, coupler = 0.4, rocker = 0.3;
  const auto rocker_angle = [&](double theta) {
    const double x = crank * std::cos(theta) - ground, y = crank * std::sin(theta);
    const double d = std::hypot(x, y);
    const double inner =
        std::acos((d * d + rocker * rocker - coupler * coupler) / (2.0 * d * rocker));
    return std::atan2(y, x) - inner;
  };
  const double start = rocker_angle(0.0);
  const double tip_x = ground + rocker * std::cos(start), tip_y = rocker * std::sin(start);
  const std::string text = fmt::format(
      R"(
[time]
end_s = 0.25
[accuracy]
displacement_um = 100
velocity_m_s = 1
[[drive]]
name = "motor"
axis = "z"
speed_rpm = 60.0
[[rigid_body]]
name = "coupler"
mass_kg = 1.0
inertia_kg_m2 = 0.0133
centre_mm = [{0:.17g}, {1:.17g}, 0]
angle_deg = {2:.17g}
start_velocity_m_s = [0, {3:.17g}, 0]
[[rigid_body]]
name = "rocker"
mass_kg = 1.0
inertia_kg_m2 = 0.0075
centre_mm = [{4:.17g}, {5:.17g}, 0]
angle_deg = {6:.17g}
[[bushing]]
a = {{ body = "coupler", at_mm = [100, 0, 0] }}
b = {{ body = "motor" }}
stiffness_n_m = 1e8
damping_n_s_m = 1e4
[[bushing]]
a = {{ body = "coupler", at_mm = [{7:.17g}, {8:.17g}, 0] }}
b = {{ body = "rocker" }}
stiffness_n_m = 1e8
damping_n_s_m = 1e4
[[bushing]]
a = {{ body = "rocker", at_mm = [400, 0, 0] }}
b = {{}}
stiffness_n_m = 1e8
damping_n_s_m = 1e4
)",
      500.0 * (crank + tip_x), 500.0 * tip_y,
      std::atan2(tip_y, tip_x - crank) * 180.0 / std::numbers::pi, std::numbers::pi * crank,
      500.0 * (ground + tip_x), 500.0 * tip_y, start * 180.0 / std::numbers::pi, 1e3 * tip_x,
      1e3 * tip_y);
  const H5File file = recorded(scene(text));
  // A quarter turn of the crank at 60 rpm. Joints of 1e8 N/m give by less than 1 um.
  EXPECT_NEAR(file.read_doubles("history/rocker_angle").back(),
              rocker_angle(0.5 * std::numbers::pi), 1e-4);
  EXPECT_GT(std::abs(rocker_angle(0.5 * std::numbers::pi) - start), 0.03);
}

TEST_F(Components, OfTheRegistryAreThoseOfTheReadme) {
  std::ostringstream readme;
  readme << std::ifstream(CLATTER_SOURCE_DIR "/dynamics/README.md").rdbuf();
  std::string table;
  for (const ComponentKind& kind : component_kinds()) {
    std::string names;
    for (const ComponentKind::Entry& entry : kind.tables)
      names += (names.empty() ? "`" : " `") + entry.form + "`";
    table += fmt::format("| {} | {} |\n", names, kind.summary);
  }
  EXPECT_NE(readme.str().find("| table | component |\n|---|---|\n" + table + "\n"),
            std::string::npos)
      << "expected in dynamics/README.md:\n"
      << table;
}

/// InputError where `config` has a key that `table`, or one below it, has not.
void check_all(const keys::Table& table, const Config& config) {
  table.check_known(config);
  for (const keys::Key& key : table.keys()) {
    if (key.table == nullptr || !config.has(key.name)) continue;
    if (key.type == keys::Type::kTables)
      for (const Config& one : config.tables(key.name)) check_all(*key.table, one);
    else
      check_all(*key.table, config.table(key.name));
  }
}

TEST(SceneTable, HasEveryKeyOfTheSamples) {
  int found = 0;
  for (const auto& entry : fs::recursive_directory_iterator(CLATTER_SOURCE_DIR "/samples")) {
    if (entry.path().string().ends_with(".run.toml")) {
      EXPECT_NO_THROW(check_all(scene_table(), Config::load_with_base(entry.path())))
          << entry.path();
      ++found;
    }
  }
  EXPECT_GE(found, 18);
  const Config wrong = Config::parse("[contact.oil]\nlow = 1\n", "a.toml");
  EXPECT_EQ(test::refusal_of([&] { check_all(scene_table(), wrong); }),
            "a.toml:2: contact.oil.low: unknown key, did you mean law?");
}

/// Every key and table has a meaning and a name of its own, and every rule names a key of its
/// table.
void check_described(const keys::Table& table) {
  std::set<std::string> names;
  for (const keys::Key& key : table.keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << table.name() << "." << key.name;
    EXPECT_FALSE(key.meaning.empty()) << table.name() << "." << key.name;
    for (const keys::Rule& rule : key.rules)
      EXPECT_NE(table.find(rule.other), nullptr)
          << table.name() << "." << key.name << " by " << rule.other;
    if (key.table != nullptr) check_described(*key.table);
  }
  for (const auto& group : table.alternatives())
    for (const std::string& name : group)
      EXPECT_NE(table.find(name), nullptr) << table.name() << "." << name;
}

TEST(SceneTable, DescribesAllKeysAndNamesOnlyThem) {
  check_described(scene_table());
  for (const ComponentKind& kind : component_kinds())
    for (const ComponentKind::Entry& entry : kind.tables)
      EXPECT_NE(scene_table().find(entry.name()), nullptr) << entry.form;
  for (const char* key : {"title", "time", "accuracy", "recorded_force"})
    EXPECT_NE(scene_table().find(key), nullptr) << key;
}

TEST_F(Components, AreRefusedByTableKeyAndName) {
  const std::string time = "[time]\nend_s = 0.1\n";
  const std::string body = "[[rigid_body]]\nname = \"bar\"\nmass_kg = 1.0\ninertia_kg_m2 = 0.1\n";
  const auto expect = [&](const std::string& changes, const std::string& said) {
    EXPECT_NE(refusal(time + changes).find(said), std::string::npos)
        << changes << refusal(time + changes);
  };
  EXPECT_EQ(refusal(time + body), "accepted");
  expect("[[rigid_bodies]]\nname = \"bar\"\n",
         "mechanism.run.toml:3: rigid_bodies: unknown key, did you mean rigid_body?");
  expect(body + "[[bushings]]\n",
         "mechanism.run.toml:7: bushings: unknown key, did you mean bushing?");
  expect(body + "[small_end]\nexponent = 1\n", "small_end: needs [engine]");
  expect(
      "",
      "body: give [engine] with [piston], or a [[body]], [[rigid_body]], [[valve]] or [[shaft]]");
  expect(body + "motion = \"plane\"\n",
         "mechanism.run.toml:7: rigid_body[0].motion: found \"plane\", expected one of: xy, yz");
  expect(body + body, "mechanism.run.toml:7: a second body named \"bar\"");
  expect("[[rigid_body]]\nname = \"bar\"\nmass_kg = -1.0\n", "rigid_body[0].mass_kg: found -1");
  expect(
      "[[rigid_body]]\nname = \"bar\"\nmotion = \"space\"\nmass_kg = 1.0\n"
      "inertia_kg_m2 = [1, 1, 3]\n",
      "mechanism.run.toml:3: bar: principal moments of inertia: found 3 above the sum");
  const std::string stiff = "stiffness_n_m = 1e6\n";
  const std::string a = "a = { body = \"bar\", at_mm = [0, 0, 0] }\n";
  expect(body + "[[bushing]]\n" + a + stiff, "bushing[0].b: found nothing, expected a table");
  expect(body + "[[bushing]]\n" + a + "b = { body = \"bra\" }\n" + stiff,
         "mechanism.run.toml:9: bushing[0].b.body: no body \"bra\" in the scene, found: bar");
  expect(body + "[[bushing]]\na = { body = \"bar\" }\nb = {}\n" + stiff,
         "mechanism.run.toml:8: bushing[0].a: found no point, expected at_mm");
  expect(body + "[[bushing]]\na = { body = \"bar\", at_mm = [0, 0, 1] }\nb = {}\n" + stiff,
         "a joint of \"bar\" is 1 mm beside the plane in which it moves");
  expect(body + "[[spring]]\n" + a + "b = {}\nlength_mm = 1\n" + stiff,
         "mechanism.run.toml:9: spring[0].b: is the same point as a");
  expect(body + "[[bushing]]\n" + a + "b = {}\nstiffness_n_m = 0\n",
         "bushing[0].stiffness_n_m: give stiffness_n_m or damping_n_s_m above 0");
  expect(body + "[[load]]\nbody = \"bar\"\ncomponent = \"z\"\nvalue = 1\n",
         "load.component: found \"z\", expected one that \"bar\" follows");
  expect(body + "[[load]]\nbody = \"bar\"\nset = \"tip\"\ncomponent = \"x\"\nvalue = 1\n",
         "load.set: \"bar\" has no reduced model, expected component only");
  expect(body + "[[drive]]\nname = \"bar\"\nspeed_rpm = 1\n",
         "mechanism.run.toml:7: a second body named \"bar\"");
  expect(body +
             "[[drive]]\nname = \"motor\"\nspeed_rpm = 0\n[[drive.order]]\norder = 1\n"
             "amplitude_rpm = 1\n",
         "mechanism.run.toml:9: drive[0].speed_rpm: ");
}

}  // namespace
}  // namespace clatter::dynamics
