// SPDX-License-Identifier: GPL-3.0-or-later
// Complete scenes from TOML to the run file, with synthetic reduced models.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/write_artefact.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/motored_cycle.hpp"
#include "tests/dynamics/synthetic.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

/// An elastic block on its mounts for one cycle.
constexpr const char* kElasticBlock = R"(
[time]
cycles = 1
[block]
model = "elastic"
liner = "liner_4"
liner_axial = "liner_4_axial"
bearings = ["main_4", "main_5"]
gas_load = "head_4_gas"
mode_limit_hz = 8000.0
[[mount]]
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
damping_n_s_m = [1e3, 1e3, 2e3]
)";

/// A folder with the models, the gas table and the scene that the tests change.
class Runs : public ::testing::Test {
 protected:
  void SetUp() override {
    // One folder a test: CTest runs them side by side.
    folder_ = fs::path(::testing::TempDir()) / "clatter_dynamics_runs" /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::create_directories(folder_);
    testing::write_rom(folder_ / "piston.rom.h5", testing::rigid_piston(1.9, 4e-3, 8.992e-3));
    testing::write_rom(folder_ / "block.rom.h5", testing::elastic_block(0.0535, 8, 6));
    testing::write_rom(folder_ / "bar.rom.h5", testing::clamped_bar(1.0, 100, 10));
    testing::write_motored_cycle(folder_ / "motored.csv", {}, 0.0174532925199432957);
    std::ofstream(folder_ / "slap.run.toml") << R"(
[engine]
speed_rpm = 2000.0
stroke_mm = 130.0
[rod]
length_mm = 210.0
mass_kg = 2.2
inertia_kg_m2 = 0.02
centre_mm = 70.0
[time]
cycles = 2
output_step_us = 50.0
[gas]
table = "motored.csv"
[piston]
rom = "piston.rom.h5"
model = "rigid"
[block]
rom = "block.rom.h5"
model = "rigid"
[contact]
bore_mm = 107.0
clearance_um = 20.0
barrel_top_um = 30.0
barrel_bottom_um = 20.0
ovality_um = 40.0
cells_around = 6
cells_along = 6
oil_thickness_um = 5.0
)";
  }
  Scene scene(const std::string& changes = "") {
    std::ofstream(folder_ / "changed.run.toml") << "base = \"slap.run.toml\"\n" << changes;
    return read_scene(folder_ / "changed.run.toml");
  }
  static RunResult run(const Scene& scene, const RunControl& control = {}) {
    return simulate(scene, load_bodies(scene), control);
  }
  fs::path folder_;
};

TEST_F(Runs, LubricatedRigidCyclesCloseTheirEnergyBalance) {
  const RunResult result = run(scene());
  EXPECT_TRUE(result.complete);
  EXPECT_EQ(result.cycles, 2);
  EXPECT_LT(result.energy_residue, 1.5e-4);  // 1.3e-5 is reached
  EXPECT_GT(result.energy_exchanged, 1.0);
  // Film content settles over some cycles; the second must already be close to the first.
  EXPECT_LT(result.periodicity.lateral.value(), 0.5 * 40e-6);
}

TEST_F(Runs, AResumedRunGivesTheSameBits) {
  const Scene described = scene();
  std::optional<Checkpoint> point;
  RunControl control;
  control.checkpoint = [&](const Checkpoint& taken) { point = taken; };
  const RunResult whole = run(described, control);
  ASSERT_TRUE(point.has_value());
  const fs::path file = folder_ / "x.checkpoint";
  write_checkpoint(file, *point, fingerprint(described));
  RunControl resumed;
  resumed.resume_from = read_checkpoint(file, fingerprint(described));
  const RunResult again = run(described, resumed);
  const auto &a = whole.recorder->samples(), &b = again.recorder->samples();
  EXPECT_EQ(a.eta(), b.eta());
  EXPECT_EQ(a.v(), b.v());
  EXPECT_EQ(a.a(), b.a());
  EXPECT_EQ(whole.recorder->history().values, again.recorder->history().values);
  EXPECT_EQ(whole.statistics.accepted, again.statistics.accepted);
  EXPECT_EQ(whole.energy_residue, again.energy_residue);
  ASSERT_FALSE(again.recorder->history().values.empty());
  for (const auto& column : again.recorder->history().values)
    EXPECT_EQ(column.size(), again.recorder->time().size());
  // Neither another scene's checkpoint nor an absent one is used.
  EXPECT_FALSE(read_checkpoint(file, fingerprint(scene("[contact]\nclearance_um = 21.0\n"))));
  EXPECT_FALSE(read_checkpoint(folder_ / "absent.checkpoint", fingerprint(described)));
}

TEST_F(Runs, StoppedRunsLeaveAValidFileMarkedIncomplete) {
  const Scene described = scene();
  const LoadedBodies bodies = load_bodies(described);
  const std::atomic<bool> stop{true};
  RunControl control;
  control.stop = &stop;
  const RunResult result = simulate(described, bodies, control);
  EXPECT_FALSE(result.complete);
  write_artefact(folder_ / "stopped.run.h5", provenance_of(described), {}, {},
                 [&](H5File& file) { write_run(file, described, bodies, result); });
  const H5File back = open_artefact(folder_ / "stopped.run.h5", "clatter/run/1");
  EXPECT_EQ(back.get_int("/", "complete"), 0);
  EXPECT_EQ(back.read_doubles("output/time").size(), 1U);
}

TEST_F(Runs, AWiderBoreIsMoreClearance) {
  const RunResult wide =
      run(scene("[contact]\nclearance_um = 15.0\nbore_height_mm = [0, 400]\n"
                "bore_widening_um = [5, 5]\n"));
  const RunResult clear = run(scene("[contact]\nclearance_um = 20.0\n"));
  const auto &a = wide.recorder->samples().eta(), &b = clear.recorder->samples().eta();
  EXPECT_LT((a - b).norm(), 1e-6 * b.norm());
  // Wider at the top only: the piston must go further there.
  const RunResult cone =
      run(scene("[contact]\nclearance_um = 20.0\nbore_height_mm = [145, 275]\n"
                "bore_widening_um = [0, 20]\n"));
  EXPECT_GT((cone.recorder->samples().eta() - b).norm(), 1e-3 * b.norm());
}

TEST(UniformSamples, AccelerationIsTheMeanOverTheSamplingInterval) {
  // v = t^2 in one mode, between states 0.25 s apart, sampled every second: the mean of 2 t over
  // [t - 1/2, t + 1/2] is 2 t; over the halves at both ends 0.5 and 2 t - 0.5.
  const auto at = [](double t) {
    StageState state;
    state.time = t;
    state.eta = Eigen::VectorXd::Constant(1, t * t * t / 3.0);
    state.v = Eigen::VectorXd::Constant(1, t * t);
    state.a = Eigen::VectorXd::Constant(1, 2.0 * t);
    return state;
  };
  UniformSamples samples(0.0, 4.0, 1.0, 1);
  samples.start(at(0.0));
  for (int k = 1; k <= 16; ++k) samples.add(at(0.25 * (k - 1)), at(0.25 * k));
  ASSERT_EQ(samples.count(), 5);
  const double expected[] = {0.5, 2.0, 4.0, 6.0, 7.5};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(samples.v()(i, 0), i * i, 1e-13);
    EXPECT_NEAR(samples.a()(i, 0), expected[i], 1e-12);
  }
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
  ASSERT_NE(model->contact, nullptr);
  EXPECT_TRUE(model->contact->save().size() == 1);  // no film content
  for (const auto& effect : model->effects.effects()) {
    if (effect.name == "oil film" || effect.name == "cavitation" || effect.name == "friction" ||
        effect.name == "elastic block" || effect.name == "damping of the contact") {
      EXPECT_FALSE(effect.on) << effect.name;
      EXPECT_FALSE(effect.why.empty());
    }
  }
}

TEST_F(Runs, ElasticBlockFileHoldsWhatRecoverReads) {
  const Scene described = scene(kElasticBlock + std::string("[contact]\nlubrication = \"none\"\n"));
  const LoadedBodies bodies = load_bodies(described);
  const RunResult result = simulate(described, bodies, {});
  write_artefact(folder_ / "slap.run.h5", provenance_of(described), {}, {},
                 [&](H5File& file) { write_run(file, described, bodies, result); });
  const H5File back = open_artefact(folder_ / "slap.run.h5", "clatter/run/1");
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
  EXPECT_LT(result.energy_residue, 5e-6);  // 4.3e-7 is reached
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
  const RunResult result = simulate(described, bodies, {});
  EXPECT_TRUE(result.complete) << result.failure;
  EXPECT_GT(result.energy_exchanged, 1.0);
  EXPECT_LT(result.energy_residue, 1.5e-5);  // 1.4e-6
  write_artefact(folder_ / "film.run.h5", provenance_of(described), {}, {},
                 [&](H5File& file) { write_run(file, described, bodies, result); });
  const H5File back = open_artefact(folder_ / "film.run.h5", "clatter/run/1");
  // The film's pressure deforms the liner: what is left without the rigid-body motion.
  const rom::ReducedModel& block = bodies[1].model;
  const RowMatrix q = back.read_rows("bodies/block/q");
  const Eigen::MatrixXd inertia = block.M_rr * block.rigid;
  const Eigen::MatrixXd motion =
      (block.rigid.transpose() * inertia).ldlt().solve(inertia.transpose() * q.transpose());
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
  const LoadedBodies bodies = load_bodies(described);
  const RunResult result = simulate(described, bodies, {});
  const RowMatrix q = result.recorder->samples().eta() * bodies[0].modal.shapes.transpose();
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
  turned.rigid = W.partialPivLu().solve(bar.rigid);
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
    const LoadedBodies bodies = load_bodies(described);
    const RunResult result = simulate(described, bodies, {});
    return result.recorder->samples().eta() * bodies[0].modal.row_of(place).transpose();
  };
  const Eigen::VectorXd whole = tip("bar.rom.h5", 0), combined = tip("turned.rom.h5", n);
  ASSERT_GT(whole.size(), 40);
  // Eigenbases of both differ by rounding; the default tolerance of a step is 1e-3 of 10 um.
  EXPECT_LT((whole - combined).cwiseAbs().maxCoeff(), 1e-6 * whole.cwiseAbs().maxCoeff());
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
                  "contact.bore_widening_um: expected as many values as bore_height_mm"));
  EXPECT_TRUE(has(refusal("[contact]\nbore_height_mm = [1, 2]\nbore_widening_um = [0, -1]\n"),
                  "contact.bore_widening_um: found -1, expected no value below 0"));
  EXPECT_TRUE(has(
      refusal("[contact]\nasperity_loss_factor = 0.75\n"),
      "contact.asperity_loss_factor: found 0.75, expected a number at least 0 and at most 0.6"));
  EXPECT_TRUE(has(refusal("[contact]\nlubricaton = \"none\"\n"), "did you mean lubrication?"));
  EXPECT_TRUE(has(refusal("[piston]\npin = \"pinn\"\n"), "pinn"));
  EXPECT_TRUE(has(refusal("[piston]\ngas_load = \"fire\"\n"), "no unit load \"fire\", found: gas"));
  EXPECT_TRUE(has(refusal("[engine]\nstroke_mm = 500.0\n"), "expected rod > radius"));
  EXPECT_TRUE(has(refusal("[[mount]]\nbody = \"pan\"\nsets = [\"x\"]\nstiffness_n_m = [1,1,1]\n"),
                  "no body \"pan\""));
}

}  // namespace
}  // namespace clatter::dynamics
