// SPDX-License-Identifier: GPL-3.0-or-later
// Complete scenes from TOML to the run file, with synthetic reduced models.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/dense/solve.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

/// An elastic block on its mounts for one cycle.
const std::string kElasticBlock = std::string(testing::kElasticBlock) + R"(
[time]
cycles = 1
[[mount]]
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
damping_n_s_m = [1e3, 1e3, 2e3]
)";

/// A folder with the models, the gas table and the scene that the tests change.
class Runs : public ::testing::Test {
 protected:
  void SetUp() override { testing::write_slap_scene(folder_); }
  Scene scene(const std::string& changes = "") { return testing::changed_scene(folder_, changes); }
  /// Runs it into a file of its own.
  RunResult run(const Scene& scene, RunControl control = {}) {
    control.output = folder_ / fmt::format("{}.run.h5", ++runs_);
    return simulate(scene, load_bodies(scene), control);
  }
  /// The same; returns the finished file.
  H5File recorded(const Scene& scene) {
    RunResult result = run(scene);
    return testing::finished_file(scene, load_bodies(scene), result);
  }
  fs::path folder_ = testing::test_folder();
  int runs_ = 0;
};

TEST_F(Runs, LubricatedRigidCyclesCloseTheirEnergyBalance) {
  const RunResult result = run(scene());
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.cycles, 2);
  EXPECT_LT(result.energy_residue, 1.5e-4);  // 1.3e-5 is reached
  EXPECT_GT(result.energy_exchanged, 1.0);
  // Film content settles over some cycles; the second must already be close to the first.
  EXPECT_LT(result.periodicity.lateral.value(), 0.6 * 40e-6);
}

TEST_F(Runs, AResumedRunGivesTheSameBits) {
  const Scene described = scene("[time]\ncycles = 3\n");
  const LoadedBodies bodies = load_bodies(described);
  const std::string mark = fingerprint(described);
  RunResult whole = run(described);
  const fs::path point = checkpoint_path(folder_ / "1.run.h5");
  fs::copy_file(point, checkpoint_path(folder_ / "2.run.h5"));
  RunControl resumed;
  resumed.resume_from = read_checkpoint(point, mark);
  ASSERT_TRUE(resumed.resume_from.has_value());
  EXPECT_EQ(resumed.resume_from->cycle, 2);
  RunResult again = run(described, resumed);
  EXPECT_EQ(whole.statistics.accepted, again.statistics.accepted);
  EXPECT_EQ(run_certificate(whole), run_certificate(again));
  ASSERT_TRUE(again.periodicity.lateral.has_value());
  const H5File a = testing::finished_file(described, bodies, whole);
  const H5File b = testing::finished_file(described, bodies, again);
  for (const char* name : {"bodies/piston/q", "bodies/piston/v", "bodies/piston/a"})
    EXPECT_EQ(a.read_rows(name), b.read_rows(name)) << name;
  for (const std::string group : {"history", "energy", "energy/terms", "output"}) {
    EXPECT_EQ(a.list(group), b.list(group));
    for (const std::string& name : a.list(group)) {
      if (name == "terms") continue;
      const auto values = a.read_doubles(group + "/" + name);
      EXPECT_EQ(values, b.read_doubles(group + "/" + name)) << name;
      EXPECT_EQ(values.size(),
                a.read_doubles(group == "output" ? "output/time" : "history/time").size());
    }
  }
  // Neither another scene's checkpoint nor an absent one is used.
  EXPECT_FALSE(read_checkpoint(point, fingerprint(scene("[contact]\nclearance_um = 21.0\n"))));
  EXPECT_FALSE(read_checkpoint(folder_ / "absent.checkpoint", mark));
}

TEST_F(Runs, StoppedRunsLeaveAValidFileMarkedIncomplete) {
  const Scene described = scene();
  const std::atomic<bool> stop{true};
  RunControl control;
  control.stop = &stop;
  RunResult result = run(described, control);
  EXPECT_FALSE(result.complete);
  const H5File back = testing::finished_file(described, load_bodies(described), result);
  EXPECT_EQ(back.get_int("/", "complete"), 0);
  EXPECT_EQ(back.get_string("/", "angle_zero"), "firing TDC");
  EXPECT_EQ(back.read_doubles("output/time").size(), 1U);
  EXPECT_EQ(back.read_doubles("history/time").size(), 0U);
}

TEST_F(Runs, AnEngineWithoutGasDoesNotFire) {
  EXPECT_EQ(scene().angle_zero, "firing TDC");
  std::ifstream in(folder_ / "slap.run.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const size_t gas = text.find("[gas]");
  ASSERT_NE(gas, std::string::npos);
  text.erase(gas, text.find("\n[", gas) - gas);
  std::ofstream(folder_ / "slap.run.toml") << text;
  EXPECT_EQ(scene().angle_zero, "TDC");
  EXPECT_EQ(scene("[gas]\ntable = \"motored.csv\"\n").angle_zero, "firing TDC");
}

TEST_F(Runs, RefusalsAreReportedByKindWithTheLastDetail) {
  RunResult result;
  result.model = build_model(scene(), load_bodies(scene()));
  StepStatistics first, second;
  first.refusals["contact: gap below the film's minimum"] = {2, "-1e-07 m on the thrust pad"};
  second.refusals["contact: gap below the film's minimum"] = {1, "-3e-07 m on the thrust pad"};
  result.statistics += first;
  result.statistics += second;
  const std::vector<std::string> lines = describe(result, 1.0);
  EXPECT_EQ(std::count(lines.begin(), lines.end(),
                       "  refused 3x: contact: gap below the film's minimum (last: -3e-07 m on the "
                       "thrust pad)"),
            1);
}

TEST_F(Runs, AWiderBoreIsMoreClearance) {
  const auto motion = [&](const std::string& contact) {
    return recorded(scene("[contact]\n" + contact)).read_rows("bodies/piston/q");
  };
  const RowMatrix wide = motion(
      "clearance_um = 15.0\nbore_height_mm = [0, 400]\n"
      "bore_widening_um = [5, 5]\n");
  const RowMatrix clear = motion("clearance_um = 20.0\n");
  EXPECT_LT((wide - clear).norm(), 1e-6 * clear.norm());
  // Wider at the top only: the piston must go further there.
  const RowMatrix cone = motion(
      "clearance_um = 20.0\nbore_height_mm = [145, 275]\n"
      "bore_widening_um = [0, 20]\n");
  EXPECT_GT((cone - clear).norm(), 1e-3 * clear.norm());
}

TEST_F(Runs, HardN9_ASkirtThatLeavesItsLinerIsSaid) {
  const auto ends = [this](const std::string& changes) {
    const Scene described = scene(changes);
    const auto model = build_model(described, load_bodies(described));
    for (const auto& effect : model->effects.effects())
      if (effect.name == "ends of the liner") return std::pair{effect.on, effect.why};
    return std::pair{false, std::string("absent")};
  };
  EXPECT_FALSE(ends("").first);
  // The pin is at 145 mm at BDC, the skirt reaches 45 mm below it; at 115 mm + 45 mm the crank is
  // 133.3 deg after TDC: r cos a + sqrt(l^2 - r^2 sin^2 a) = 160 mm.
  EXPECT_EQ(ends("[contact]\nliner_bottom_mm = 115.0\n"),
            (std::pair{true, std::string("skirt leaves its bottom by 15 mm, 133 to 227 deg after "
                                         "TDC")}));
  EXPECT_EQ(ends("[contact]\nliner_bottom_mm = 90.0\nliner_top_mm = 290\n").second,
            "skirt stays 10 mm above its bottom, leaves its top by 10 mm, -28 to 28 deg after TDC");
  // An elastic liner ends with its patches.
  EXPECT_TRUE(ends(kElasticBlock).first);
}

TEST_F(Runs, WhatIsOffIsNotThere) {
  const Scene without = scene(
      "[contact]\nlubrication = \"none\"\nfriction = false\n"
      "asperity_loss_factor = 0.0\n");
  const auto bodies = load_bodies(without);
  EXPECT_EQ(bodies.size(), 1U);  // a rigid block is no body
  const auto model = build_model(without, bodies);
  EXPECT_EQ(model->system.modes(), 9);           // six of the piston, three of the rod
  EXPECT_EQ(model->system.interface_size(), 9);  // pin and rod
  const film::PistonLiner* contact = testing::cylinder_of(*model).contact();
  ASSERT_NE(contact, nullptr);
  EXPECT_TRUE(contact->save().size() == 1);  // no film content
  for (const auto& effect : model->effects.effects()) {
    if (effect.name == "oil film" || effect.name == "cavitation" || effect.name == "friction" ||
        effect.name == "elastic block" || effect.name == "damping of the contact") {
      EXPECT_FALSE(effect.on) << effect.name;
      EXPECT_FALSE(effect.why.empty());
    }
  }
}

TEST_F(Runs, TheTableSaysThatFullFilmsUseNoOilLayer) {
  const Scene full = scene("[contact]\ncavitation = false\noil_thickness_um = 6\n");
  const auto model = build_model(full, load_bodies(full));
  for (const auto& effect : model->effects.effects()) {
    if (effect.name != "cavitation") continue;
    EXPECT_FALSE(effect.on);
    EXPECT_NE(effect.why.find("every cell is full; oil_thickness_um"), std::string::npos);
  }
}

TEST_F(Runs, ElasticBlockFileHoldsWhatRecoverReads) {
  const Scene described = scene(kElasticBlock + std::string("[contact]\nlubrication = \"none\"\n"));
  const LoadedBodies bodies = load_bodies(described);
  RunResult result = run(described);
  const H5File back = testing::finished_file(described, bodies, result);
  const auto time = back.read_vector("output/time");
  const auto n_t = time.size();
  EXPECT_EQ(n_t, 1201);  // 60 ms at 50 us
  EXPECT_NEAR(time(n_t - 1), 0.03, 1e-12);
  EXPECT_NEAR(back.read_vector("output/crank_angle_deg")(0), -360.0, 1e-9);
  for (const char* name : {"q", "v", "a"}) {
    const auto shape = back.shape(std::string("bodies/block/") + name);
    EXPECT_EQ(shape[0], n_t);
    EXPECT_EQ(shape[1], bodies[1].model.size());
  }
  EXPECT_EQ(back.get_string("bodies/block", "rom"), "block.rom.h5");
  EXPECT_EQ(back.get_string("bodies/block", "rom_sha256"),
            sha256_of_file(folder_ / "block.rom.h5"));
  EXPECT_EQ(back.get_string("history/piston_lateral", "unit"), "m");
  for (const char* name : {"piston_tilt", "side_force", "pin_force_z", "gas_pressure"}) {
    EXPECT_TRUE(back.has(std::string("history/") + name)) << name;
  }
  EXPECT_EQ(read_certificate<RunCertificate>(back), run_certificate(result));
  EXPECT_LT(result.energy_residue, 2.5e-6);  // 2.4e-7 is reached
  // v is the derivative of q: trapezoidal sums of v give back q to the sampling's accuracy.
  const RowMatrix q = back.read_rows("bodies/piston/q"), v = back.read_rows("bodies/piston/v");
  double worst = 0.0;
  for (Eigen::Index i = 1; i < n_t; ++i) {
    const double moved = 0.5 * (time(i) - time(i - 1)) * (v(i, 2) + v(i - 1, 2));
    worst = std::max(worst, std::abs(q(i, 2) - q(i - 1, 2) - moved));
  }
  EXPECT_LT(worst, 1.5e-4 * q.col(2).cwiseAbs().maxCoeff());
}

TEST_F(Runs, AFilmBetweenElasticBodiesClosesTheEnergyBalanceAndDeformsTheLiner) {
  testing::write_rom(folder_ / "soft.rom.h5", testing::elastic_piston(0.0535, 4, 6));
  const Scene described = scene(kElasticBlock + std::string(R"(
[piston]
rom = "soft.rom.h5"
model = "elastic"
pin = "pin"
skirt = "skirt"
gas_load = "gas"
mode_limit_hz = 8000.0
)"));
  const LoadedBodies bodies = load_bodies(described);
  RunResult result = run(described);
  EXPECT_TRUE(result.complete) << result.failure;
  EXPECT_GT(result.energy_exchanged, 1.0);
  EXPECT_LT(result.energy_residue, 1.5e-5);  // 1.4e-6
  const H5File back = testing::finished_file(described, bodies, result);
  // The film's pressure deforms the liner: what is left without the rigid-body motion.
  const rom::ReducedModel& block = bodies[1].model;
  const RowMatrix q = back.read_rows("bodies/block/q");
  const Eigen::MatrixXd inertia = block.M_rr * block.rigid;
  const Eigen::MatrixXd motion = dense::solve_symmetric(block.rigid.transpose() * inertia,
                                                        inertia.transpose() * q.transpose());
  const Eigen::MatrixXd deformation = q.transpose() - block.rigid * motion;
  const double largest = deformation(block.set("liner_4").dofs, Eigen::all).cwiseAbs().maxCoeff();
  EXPECT_GT(largest, 1e-7);
  EXPECT_LT(largest, 1e-4);
}

TEST_F(Runs, ASceneWithoutEngineRunsABodyUnderALoad) {
  std::ofstream(folder_ / "bar.run.toml") << R"(
[time]
end_s = 1e-3
output_step_us = 10.0
largest_step_us = 2.0
[[body]]
name = "bar"
rom = "bar.rom.h5"
[[load]]
body = "bar"
set = "tip"
component = "x"
value = 1000.0
)";
  const Scene described = read_scene(folder_ / "bar.run.toml");
  const RowMatrix q = recorded(described).read_rows("bodies/bar/q");
  // The tip of a bar under a step force swings between 0 and twice the static displacement.
  const double still = 1000.0 / (210e9 * 1e-4);
  EXPECT_NEAR(q.col(0).maxCoeff(), 2.0 * still, 0.03 * still);  // ten modes of the triangle wave
  EXPECT_GT(q.col(0).minCoeff(), -0.03 * still);
}

TEST_F(Runs, ATipThatBecameACombinationOfCoordinatesMovesTheSame) {
  // The bar in coordinates z, q = W z: the tip is no coordinate any more.
  const rom::ReducedModel bar = testing::clamped_bar(1.0, 100, 10);
  rom::ReducedModel turned = bar;
  const int n = bar.size();
  Eigen::MatrixXd W = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) W(i, j) += 0.1 * std::cos(1.0 + 3.0 * i + 7.0 * j);
  turned.M_rr = W.transpose() * bar.M_rr * W;
  turned.K_rr = W.transpose() * bar.K_rr * W;
  turned.M_rr = (0.5 * (turned.M_rr + turned.M_rr.transpose())).eval();
  turned.K_rr = (0.5 * (turned.K_rr + turned.K_rr.transpose())).eval();
  turned.rigid = dense::solve(W, bar.rigid);
  turned.combined = W.row(0);
  turned.sets.at("tip").dofs = {n};
  turned.n_boundary = 0;
  testing::write_rom(folder_ / "turned.rom.h5", turned);
  const auto tip = [&](const std::string& rom, int place) -> Eigen::VectorXd {
    std::ofstream(folder_ / "bar.run.toml") << "[time]\nend_s = 5e-4\noutput_step_us = 10.0\n"
                                               "largest_step_us = 2.0\n[[body]]\nname = \"bar\"\n"
                                               "rom = \"" +
                                                   rom +
                                                   "\"\n[[load]]\nbody = \"bar\"\n"
                                                   "set = \"tip\"\ncomponent = \"x\"\nvalue = 1e3\n"
                                                   "[[mount]]\nbody = \"bar\"\nsets = [\"tip\"]\n"
                                                   "stiffness_n_m = [1e7, 0, 0]\n"
                                                   "damping_n_s_m = [100, 0, 0]\n";
    const Scene described = read_scene(folder_ / "bar.run.toml");
    const rom::ReducedModel model = load_bodies(described)[0].model;
    return recorded(described).read_rows("bodies/bar/q") * model.row_of(place).transpose();
  };
  const Eigen::VectorXd whole = tip("bar.rom.h5", 0), combined = tip("turned.rom.h5", n);
  ASSERT_GT(whole.size(), 40);
  // Eigenbases of both differ by rounding; the default tolerance of a step is 1e-3 of 10 um.
  EXPECT_LT((whole - combined).cwiseAbs().maxCoeff(), 1e-6 * whole.cwiseAbs().maxCoeff());
}

TEST_F(Runs, ABodysOwnScalesSetItsErrorLimitsAndNoOthers) {
  const auto model_of = [this](const std::string& changes) {
    const Scene described = scene(kElasticBlock + changes);
    return build_model(described, load_bodies(described));
  };
  const auto model = model_of("");
  const auto scaled = model_of("[piston]\ndisplacement_um = 0.5\nvelocity_m_s = 1e-3\n");
  const ErrorWeights general = error_weights(model->system, {}),
                     own = error_weights(scaled->system, {});
  // Piston, block and rod. The general scales are 10 um and 0.1 m/s.
  EXPECT_DOUBLE_EQ(own.velocity_limit[0], 1e-2 * general.velocity_limit[0]);
  EXPECT_EQ(own.velocity_limit[1], general.velocity_limit[1]);
  EXPECT_EQ(own.velocity_limit[2], general.velocity_limit[2]);
  for (int y = 0; y < model->system.interface_size(); ++y) {
    const double factor = model->system.owner(y) == 0 ? 20.0 : 1.0;
    EXPECT_DOUBLE_EQ(own.displacement(y), factor * general.displacement(y))
        << model->system.coordinate_name(y);
  }
}

TEST_F(Runs, BadScenesAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& changes) -> std::string {
    try {
      const Scene described = scene(changes);
      build_model(described, load_bodies(described));
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(refusal("[contact]\nclearance_um = -1.0\n"), "contact.clearance_um: found -1"));
  EXPECT_TRUE(has(refusal("[contact]\nbore_height_mm = [1, 2]\nbore_widening_um = [1]\n"),
                  "expected as many as bore_height_mm"));
  EXPECT_TRUE(has(refusal("[contact]\nbore_height_mm = [1, 2]\nbore_widening_um = [0, -1]\n"),
                  "contact.bore_widening_um: found -1, expected a number at least 0"));
  EXPECT_TRUE(has(refusal("[contact]\nliner_bottom_mm = 300.0\nliner_top_mm = 200.0\n"),
                  "contact.liner_top_mm: found 200, expected more than liner_bottom_mm, 300"));
  EXPECT_TRUE(has(refusal("[contact]\nlubricaton = \"none\"\n"), "did you mean lubrication?"));
  EXPECT_TRUE(has(refusal("[piston]\npin = \"pinn\"\n"), "pinn"));
  EXPECT_TRUE(has(refusal("[piston]\ngas_load = \"fire\"\n"), "no unit load \"fire\", found: gas"));
  EXPECT_TRUE(has(refusal("[engine]\nstroke_mm = 500.0\n"), "expected rod > radius"));
  EXPECT_TRUE(has(refusal("[[mount]]\nbody = \"pan\"\nsets = [\"x\"]\nstiffness_n_m = [1,1,1]\n"),
                  "no body \"pan\""));
}

}  // namespace
}  // namespace clatter::dynamics
