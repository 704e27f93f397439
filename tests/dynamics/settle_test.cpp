// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that settle to their periodic cycle, and runs that start from the end of another.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <numbers>

#include "core/dense/solve.hpp"
#include "dynamics/element/mount.hpp"
#include "dynamics/run/mounted_motion.hpp"
#include "dynamics/run/run_end.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Vector12 = Eigen::Matrix<double, 12, 1>;

/// The whole engine as a rigid body under its mounts, through their element.
class MountedEngine {
 public:
  explicit MountedEngine(const testing::SyntheticEngine& engine)
      : model_(engine.model()),
        modal_(testing::modal_rigid_motions(*model_, engine, kEnd)),
        y_(testing::rigid_motions(*model_, engine, kEnd)) {}
  const Model& model() const { return *model_; }

  /// A state in which all bodies move together by z = (w, w').
  StageState state(const Vector12& z) const {
    const System& system = model_->system;
    StageState state;
    state.eta = modal_ * z.head<6>();
    state.v = modal_ * z.tail<6>();
    state.a = Eigen::VectorXd::Zero(system.modes());
    state.y = system.interface(state.eta);
    state.v_y = system.interface(state.v);
    return state;
  }
  /// One cycle of the motion by classical Runge-Kutta steps, under a constant load `force`.
  Vector12 cycle(Vector12 z, const Vector6& force) const {
    constexpr int kSteps = 4000;
    const double h = kCycle / kSteps;
    for (int i = 0; i < kSteps; ++i) {
      const Vector12 k1 = rate(z, force), k2 = rate(z + h / 2 * k1, force),
                     k3 = rate(z + h / 2 * k2, force), k4 = rate(z + h * k3, force);
      z += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return z;
  }
  /// Where a constant load holds it, by the stiffness that the rate of the motion has.
  Vector6 rest(const Vector6& force) const {
    Eigen::Matrix<double, 6, 6> stiffness;
    for (int k = 0; k < 6; ++k)
      stiffness.col(k) = -rate(Vector12::Unit(k), Vector6::Zero()).tail<6>();
    return dense::solve(stiffness, rate(Vector12::Zero(), force).tail<6>());
  }
  static constexpr double kCycle = 0.06, kEnd = 0.03;

 private:
  Vector12 rate(const Vector12& z, const Vector6& force) const {
    const System& system = model_->system;
    const Eigen::VectorXd y = y_ * z.head<6>(), v = y_ * z.tail<6>();
    Vector6 sum = force;
    for (int e = 0; e < system.elements(); ++e) {
      const auto* mount = dynamic_cast<const Mount*>(&system.element(e));
      if (mount == nullptr) continue;
      const auto& at = mount->coordinates();
      Mount own = *mount;
      Response response;
      own.evaluate({0.0, 1.0, 1, {}}, gather(y, at), gather(v, at), false, response);
      sum += y_(at, Eigen::all).transpose() * response.force;
    }
    Vector12 rate;
    rate << z.tail<6>(), dense::solve_symmetric(modal_.transpose() * modal_, sum);
    return rate;
  }
  std::unique_ptr<Model> model_;
  Eigen::MatrixXd modal_, y_;  // of the unit motions, N x 6 and n_y x 6
};

testing::SyntheticEngine dry_engine() {
  testing::EngineVariant variant;
  variant.film = false;
  return testing::SyntheticEngine(variant);
}

TEST(MountedMotions, FromAnyStartOneCycleTellsWhereTheMotionRepeats) {
  const testing::SyntheticEngine engine = dry_engine();
  const MountedEngine mounted(engine);
  const auto motion = MountedMotion::of(mounted.model(), MountedEngine::kEnd);
  ASSERT_TRUE(motion.has_value());
  EXPECT_EQ(motion->modes().cols(), 6);
  const Vector6 force{30.0, -20.0, 100.0, 5.0, 3.0, -4.0};
  Vector12 start;
  start << 1e-4, 2e-4, -3e-4, 1e-4, -2e-4, 3e-4, 1e-3, 0.0, 2e-3, 1e-3, 2e-3, -1e-3;
  const Vector12 end = mounted.cycle(start, force);
  StageState state = mounted.state(end);
  const StageState plain = state;
  EXPECT_GT(motion->predict(mounted.state(start), MountedEngine::kCycle, state), 1e-5);
  // A constant load repeats where it is at rest.
  const Vector6 rest = mounted.rest(force);
  const StageState expected = mounted.state((Vector12() << rest, Vector6::Zero()).finished());
  EXPECT_LT((state.eta - expected.eta).norm(), 1e-7 * (plain.eta - expected.eta).norm());
  EXPECT_LT(state.v.norm(), 1e-7 * plain.v.norm());
}

TEST(MountedMotions, AnEngineThatIsNotHeldHasNone) {
  testing::SyntheticEngine engine = dry_engine();
  engine.scene.components.pop_back();  // the mounts
  EXPECT_FALSE(MountedMotion::of(*engine.model(), 0.03).has_value());
}

/// Soft mounts, of which the slowest mode loses 2 % of its amplitude in a cycle. What rattles in
/// the block never repeats.
constexpr const char* kSoftMounts = R"(
[[mount]]
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
damping_n_s_m = [1e2, 1e2, 2e2]
[engine]
balanced = true
[time]
)";

class Settling : public testing::SlapScenes {
 protected:
  Scene on_mounts(const std::string& time) {
    return scene(testing::kElasticBlock + std::string(kSoftMounts) + time);
  }
};

/// How far the block is from where it was a cycle before, the largest of its displacements [m].
double jump(const H5File& file) {
  const RowMatrix q = file.read_rows("bodies/block/q");
  return (q.bottomRows(1) - q.topRows(1)).cwiseAbs().maxCoeff();
}

TEST_F(Settling, TheMountsAreForetoldInsteadOfWaitedFor) {
  const H5File plain = recorded(on_mounts("cycles = 4\n"), "plain");
  const H5File settled = recorded(on_mounts("settle_to = 1e-6\ncycles = 4\n"), "settled");
  EXPECT_EQ(result_.cycles, 4);
  EXPECT_GT(jump(plain), 2e-5);                 // 80 um
  EXPECT_LT(jump(settled), 0.1 * jump(plain));  // 0.3 to 2.3 um, by rounding, which rattling leaves
}

TEST_F(Settling, ItEndsWhenACycleRepeatsTheOneBefore) {
  const H5File file = recorded(scene("[time]\nsettle_to = 1.0\ncycles = 30\n"), "run");
  EXPECT_LT(result_.cycles, 30);
  EXPECT_LE(result_.periodicity.velocity.at("piston"), 1.0);
  EXPECT_TRUE(std::none_of(result_.warnings.begin(), result_.warnings.end(), [](const auto& text) {
    return text.find("not settled") != std::string::npos;
  }));
  // 0 deg is the firing of the reported cycle, however many there were.
  EXPECT_NEAR(file.read_doubles("output/crank_angle_deg").front(), -360.0, 1e-9);
  EXPECT_NEAR(file.read_doubles("output/crank_angle_deg").back(), 360.0, 1e-9);
}

TEST_F(Settling, AResumedRunGivesTheSameBits) {
  const Scene described = on_mounts("settle_to = 1e-6\ncycles = 3\n");
  const H5File whole = recorded(described, "whole");
  const int cycles = result_.cycles;
  const fs::path output = folder_ / "whole.run.h5";
  RunControl control;
  control.output = output;
  control.resume_from = read_checkpoint(checkpoint_path(output), fingerprint(described));
  ASSERT_TRUE(control.resume_from.has_value());
  EXPECT_EQ(control.resume_from->cycle, cycles - 1);
  const RowMatrix q = whole.read_rows("bodies/block/q");
  const LoadedBodies bodies = load_bodies(described);
  RunResult again = simulate(described, bodies, control);
  EXPECT_EQ(again.cycles, cycles);
  EXPECT_EQ(testing::finished_file(described, bodies, again).read_rows("bodies/block/q"), q);
}

TEST_F(Settling, ARunThatDoesNotSettleSaysSo) {
  recorded(scene("[time]\nsettle_to = 1e-9\ncycles = 2\n"), "run");
  ASSERT_FALSE(result_.warnings.empty());
  EXPECT_TRUE(result_.complete);
  test::expect_parts(result_.warnings.back(),
                     {"not settled after 2 cycles", "time.settle_to = 1e-09"});
}

TEST_F(Settling, WhatDoesNotRepeatIsRefused) {
  const std::string drive = "[time]\nsettle_to = 0.01\n[[drive]]\nname = \"shaft\"\naxis = \"x\"\n";
  test::expect_parts(refusal(drive + "speed_rpm = 1500.0\n"),
                     {"changed.run.toml:3: time.settle_to: found 0.01", "\"shaft\"", "repeat"});
  test::expect_parts(
      refusal(drive + "speed_rpm = 2000.0\n[[drive.order]]\norder = 0.25\namplitude_rpm = 5\n"),
      {"\"shaft\""});
  EXPECT_EQ(refusal(drive + "speed_rpm = 1000.0\n[[drive.order]]\norder = 2\namplitude_rpm = 5\n"),
            "accepted");
  test::expect_parts(refusal("[time]\nsettle_to = 0.01\ncycles = 1\n"),
                     {"time.cycles: found 1, expected a whole number, a number at least 2"});
}

TEST_F(Settling, ARunGoesOnFromTheEndOfAnother) {
  const H5File two = recorded(scene("[time]\nsettle_to = 1e-9\ncycles = 2\n"), "two");
  const H5File one = recorded(scene("[time]\ncycles = 1\n"), "one");
  const Scene later = scene("[time]\ncycles = 1\nstart_from = \"one.run.h5\"\n");
  EXPECT_EQ(later.inputs.back(), folder_ / "one.run.h5");
  const H5File on = recorded(later, "on");
  for (const char* name : {"q", "v", "a"})
    EXPECT_EQ(on.read_rows(std::string("bodies/piston/") + name),
              two.read_rows(std::string("bodies/piston/") + name));
  EXPECT_EQ(on.read_doubles("history/film_fill"), two.read_doubles("history/film_fill"));
  EXPECT_NE(on.read_doubles("history/film_fill"), one.read_doubles("history/film_fill"));
}

TEST_F(Settling, AStartThatDoesNotFitIsRefused) {
  test::expect_parts(
      refusal("[time]\nstart_from = \"nowhere.run.h5\"\n"),
      {"changed.run.toml:3: time.start_from: found", "nowhere.run.h5", "which does not exist"});
  recorded(scene("[time]\ncycles = 1\n"), "run");
  const auto from = [&](const std::string& changes) {
    const Scene later = scene(changes + "[time]\ncycles = 1\nstart_from = \"run.run.h5\"\n");
    return test::refusal_of([&] { recorded(later, "later"); });
  };
  test::expect_parts(from("[contact]\ncells_along = 8\n"),
                     {"run.run.h5: piston_liner: the saved film state has"});
  EXPECT_EQ(from("[engine]\nspeed_rpm = 2200.0\n"), "accepted");
  test::expect_parts(
      from("[[rigid_body]]\nname = \"disc\"\nmotion = \"yz\"\nmass_kg = 1.0\ninertia_kg_m2 = 1.0\n"
           "centre_mm = [0, 0, 0]\n"),
      {"run.run.h5: found the end of piston (6 modes), rod (3 modes), expected that of",
       "disc (3 modes)"});
}

}  // namespace
}  // namespace clatter::dynamics
