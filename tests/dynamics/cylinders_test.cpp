// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of several cylinders.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/dense/solve.hpp"
#include "dynamics/run/run_file.hpp"
#include "dynamics/run/run_summary.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

/// Full films, which take fewer steps.
constexpr const char* kFull = "[contact]\ncavitation = false\n";
constexpr const char* kTwo = R"(
[[cylinder]]
name = "a"
[[cylinder]]
name = "b"
firing_deg = 360
)";

using Cylinders = testing::SlapScenes;

TEST_F(Cylinders, ANamedOneIsTheOnlyOneToTheBit) {
  const std::string one = std::string("[time]\ncycles = 1\n") + kFull;
  const H5File plain = recorded(scene(one), "plain");
  const H5File named = recorded(scene(one + "[[cylinder]]\nname = \"c1\"\n"), "named");
  for (const char* name : {"q", "v", "a"})
    EXPECT_EQ(plain.read_rows(std::string("bodies/piston/") + name),
              named.read_rows(std::string("bodies/c1_piston/") + name));
  for (const std::string& name : plain.list("history")) {
    const bool clock = name == "time" || name == "crank_angle_deg";
    EXPECT_EQ(plain.read_doubles("history/" + name),
              named.read_doubles("history/" + (clock ? name : "c1_" + name)))
        << name;
  }
  EXPECT_EQ(plain.read_doubles("energy/imbalance"), named.read_doubles("energy/imbalance"));
}

TEST_F(Cylinders, TwoOfOneKindMoveTheSameShiftedByTheirFiringAngle) {
  // A dry skirt that never leaves its liner, strongly damped, forgets its start within a cycle;
  // films remember it for many.
  const H5File file = recorded(scene(std::string(R"(
[contact]
lubrication = "none"
clearance_um = 0.0
asperity_loss_factor = 0.6
)") + kTwo),
                               "two");
  const RowMatrix a = file.read_rows("bodies/a_piston/q"), b = file.read_rows("bodies/b_piston/q");
  const Eigen::Index half = (a.rows() - 1) / 2;  // samples of 360 deg
  for (const auto& [dof, limit] : {std::pair{1, 1e-2}, {2, 1e-3}, {3, 1e-2}}) {  // y, z, rx
    const Eigen::VectorXd first = a.col(dof).head(half);
    const double range = a.col(dof).maxCoeff() - a.col(dof).minCoeff();
    // 2.6e-3, 1.8e-4 and 2.8e-3 are reached: both share their steps and start in another phase.
    EXPECT_LT((first - b.col(dof).segment(half, half)).cwiseAbs().maxCoeff(), limit * range) << dof;
    EXPECT_GT((first - b.col(dof).head(half)).cwiseAbs().maxCoeff(), 0.5 * range) << dof;
  }
}

TEST_F(Cylinders, FilesAndReportsSpeakOfEachByName) {
  const Scene described = scene(std::string("[time]\nfilm_every_deg = 90.0\n") + kFull + kTwo);
  const H5File file = recorded(described, "two");
  std::set<std::string> histories, terms;
  for (const std::string& name : file.list("history")) histories.insert(name);
  for (const std::string& name : file.list("energy/terms")) terms.insert(name);
  for (const std::string name : {"a", "b"}) {
    for (const char* history : {"_piston_lateral", "_piston_tilt", "_gas_pressure", "_pin_force_z",
                                "_crank_pin_force_y", "_film_min", "_side_force"})
      EXPECT_EQ(histories.count(name + history), 1U) << name << history;
    for (const std::string& term : {"gas on " + name + "_piston", name + " inertia frame",
                                    name + "_pin lost", name + "_piston_liner lost"})
      EXPECT_EQ(terms.count(term), 1U) << term;
    EXPECT_EQ(file.shape("film/" + name + "/thrust/gap")[0],
              std::ssize(file.read_doubles("film/time")));
    EXPECT_EQ(result_.periodicity.lateral_of.count(name), 1U);
    EXPECT_EQ(result_.periodicity.velocity.count(name + "_rod"), 1U);
  }
  EXPECT_FALSE(result_.periodicity.lateral.has_value());
  EXPECT_EQ(read_certificate<RunCertificate>(file), run_certificate(result_));
  EXPECT_LT(result_.energy_residue, 1.5e-4);
  const auto has_line = [&](const std::string& part) {
    const auto lines = describe(result_, 1.0);
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.find(part) != std::string::npos;
    });
  };
  EXPECT_TRUE(has_line("periodicity_lateral_b: "));
  EXPECT_TRUE(has_line("  a: oil film "));
  EXPECT_TRUE(has_line("  elastic b_piston "));
  // The film's seconds are those of its own element.
  for (const auto& effect : result_.model->effects.effects()) {
    if (effect.name.ends_with(": oil film")) {
      EXPECT_GT(effect.seconds, 0.0) << effect.name;
    }
  }
}

TEST_F(Cylinders, TwoPistonsPushTheirOwnBoresOfOneBlock) {
  testing::write_rom(folder_ / "block.rom.h5", testing::two_bore_block(0.0535, 8, 6));
  const Scene described = scene(R"(
[time]
cycles = 1
[accuracy]
tolerance = 1e-2
[block]
model = "elastic"
mode_limit_hz = 3000.0
[contact]
cavitation = false
cells_around = 4
cells_along = 4
[[mount]]
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
damping_n_s_m = [1e3, 1e3, 2e3]
[[cylinder]]
name = "c3"
firing_deg = 360.0
[cylinder.block]
liner = "liner_3"
liner_axial = "liner_3_axial"
bearings = ["main_3", "main_4"]
gas_load = "head_3_gas"
[[cylinder]]
name = "c4"
[cylinder.block]
liner = "liner_4"
liner_axial = "liner_4_axial"
bearings = ["main_4", "main_5"]
gas_load = "head_4_gas"
)");
  const LoadedBodies bodies = load_bodies(described);
  const auto model = build_model(described, bodies);
  const auto cylinders = components_of<CylinderComponent>(*model);
  ASSERT_EQ(cylinders.size(), 2U);
  // No patch is in both contacts, and all are of the block.
  std::set<int> patches;
  size_t count = 0;
  for (const auto* cylinder : cylinders) {
    const std::vector<int>& coordinates = cylinder->contact()->coordinates();
    EXPECT_EQ(coordinates.size(), 48U + 4U + 6U + 1U);  // patches, their fit, pin, axial
    patches.insert(coordinates.begin(), coordinates.end());
    count += coordinates.size();
  }
  EXPECT_EQ(patches.size(), count);
  const H5File file = recorded(described, "block");
  EXPECT_LT(result_.energy_residue, 1e-4);  // 2.3e-6 with 6 x 6 cells
  // At its firing TDC each cylinder's gas lifts its own head: what is left without the rigid
  // motion.
  const rom::ReducedModel& block = find_body(bodies, "block")->model;
  const Eigen::MatrixXd q = file.read_rows("bodies/block/q").transpose();
  const Eigen::MatrixXd inertia = block.M_rr * block.rigid;
  const Eigen::MatrixXd deformed =
      q - block.rigid *
              dense::solve_symmetric(block.rigid.transpose() * inertia, inertia.transpose() * q);
  const Eigen::Index end = q.cols() - 1, middle = end / 2;
  const int head_3 = block.set("head_3").dofs[2], head_4 = block.set("head").dofs[2];
  EXPECT_GT(deformed(head_3, end), deformed(head_3, middle) + 1e-6);
  EXPECT_GT(deformed(head_4, middle), deformed(head_4, end) + 1e-6);
}

TEST_F(Cylinders, TakeWhatTheyDoNotGiveFromTheScenesTables) {
  const Scene described = scene(std::string(kTwo) + "[cylinder.contact]\nclearance_um = 31.0\n" +
                                "[cylinder.rod]\nmass_kg = 2.5\n");
  std::vector<CylinderSpec> found;
  for (const auto& component : described.components)
    if (const auto* cylinder = dynamic_cast<const CylinderComponent*>(component.get()))
      found.push_back(cylinder->spec());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_DOUBLE_EQ(found[0].contact->clearance, 20e-6);
  EXPECT_DOUBLE_EQ(found[1].contact->clearance, 31e-6);
  EXPECT_DOUBLE_EQ(found[1].contact->bore_radius, found[0].contact->bore_radius);
  EXPECT_DOUBLE_EQ(found[0].engine.rod.mass, 2.2);
  EXPECT_DOUBLE_EQ(found[1].engine.rod.mass, 2.5);
  EXPECT_DOUBLE_EQ(found[1].engine.rod.length, found[0].engine.rod.length);
}

TEST_F(Cylinders, AreRefusedWithTheTableThatIsWrong) {
  const auto expect = [&](const std::string& changes, const std::string& said) {
    EXPECT_NE(refusal(changes).find(said), std::string::npos) << changes << refusal(changes);
  };
  const std::string two = kTwo;
  expect(two + "[cylinder.contact]\nclearence_um = 3\n",
         "changed.run.toml:9: cylinder[1].contact.clearence_um: unknown key, did you mean "
         "clearance_um?");
  expect(two + "[cylinder.contact]\nclearance_um = -3\n",
         "changed.run.toml:9: cylinder[1].contact.clearance_um: found -3, expected");
  expect(two + "[contact]\nbore_mm = -1\n", "changed.run.toml:9: contact.bore_mm: found -1");
  expect(two + "[cylinder.engine]\nspeed_rpm = 100\n",
         "changed.run.toml:9: cylinder[1].engine.speed_rpm: unknown key");
  expect(two + "[cylinder.block]\nrom = \"x\"\n", "cylinder[1].block.rom: unknown key");
  expect(two + "[cylinder.engine]\nstroke_mm = 500\n",
         "slap.run.toml:6: rod.length_mm: slider-crank: ");
  expect("[[cylinder]]\n", "cylinder[0].name: found nothing");
  expect("[[cylinder]]\nname = \"a/b\"\n", "cylinder[0].name: found \"a/b\", expected a name");
  expect("[[cylinder]]\nname = \"a\"\n[[cylinder]]\nname = \"a\"\n",
         "changed.run.toml:5: cylinder[1].name: found \"a\" after a cylinder \"a\"");
  expect("[[cylinder]]\nname = \"a\"\nfiring_deg = 1000\n",
         "cylinder[0].firing_deg: found 1000, expected");
  expect("[cylinder]\nname = \"a\"\n", "expected tables [[cylinder]]");
}

}  // namespace
}  // namespace clatter::dynamics
