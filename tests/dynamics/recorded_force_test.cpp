// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that a run records, and the motion under one of them alone.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "dynamics/run/periodic_response.hpp"
#include "dynamics/run/response_file.hpp"
#include "dynamics/run/run_size.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kPi = std::numbers::pi;

/// The means of cos(w t) over the intervals around n + 1 instants of one second.
RowMatrix cosine_means(Eigen::Index n, double w) {
  const double step = 1.0 / static_cast<double>(n);
  RowMatrix force(n + 1, 1);
  for (Eigen::Index i = 0; i <= n; ++i) {
    const double from = step * (i == 0 ? 0.0 : static_cast<double>(i) - 0.5);
    const double to = step * (i == n ? static_cast<double>(n) : static_cast<double>(i) + 0.5);
    force(i, 0) = (std::sin(w * to) - std::sin(w * from)) / (w * (to - from));
  }
  return force;
}

/// Largest error of a mode's velocity under cos(w t), relative to its amplitude.
double harmonic_error(double omega, double damping, double w, Eigen::Index n) {
  const PeriodicMotion motion = periodic_response(cosine_means(n, w), 1.0 / static_cast<double>(n),
                                                  Eigen::VectorXd::Constant(1, omega * omega),
                                                  Eigen::VectorXd::Constant(1, damping));
  const std::complex<double> i(0.0, 1.0), v = i * w / (omega * omega - w * w + i * w * damping);
  double worst = 0.0;
  for (Eigen::Index k = 0; k <= n; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(n);
    worst = std::max(worst, std::abs(motion.v(k, 0) - std::real(v * std::exp(i * w * t))));
  }
  return worst / std::abs(v);
}

struct ForcedOscillator {
  const char* name;
  double omega, damping;
};
void PrintTo(const ForcedOscillator& oscillator, std::ostream* out) { *out << oscillator.name; }

class PeriodicResponse : public ::testing::TestWithParam<ForcedOscillator> {};

TEST_P(PeriodicResponse, IsTheHarmonicSolution) {
  const auto [name, omega, damping] = GetParam();
  for (const double line : {1.0, 3.0, 99.0})
    EXPECT_LT(harmonic_error(omega, damping, 2.0 * kPi * line, 200), 1e-9) << line;
}

INSTANTIATE_TEST_SUITE_P(Oscillators, PeriodicResponse,
                         ::testing::Values(ForcedOscillator{"soft", 2.0, 0.1},
                                           ForcedOscillator{"stiff", 1e6, 1e3},
                                           ForcedOscillator{"overdamped", 20.0, 500.0},
                                           ForcedOscillator{"critical", 20.0, 40.0},
                                           ForcedOscillator{"rigid", 0.0, 0.0},
                                           ForcedOscillator{"dragged", 0.0, 3.0},
                                           ForcedOscillator{"resonant", 2.0 * kPi * 3.0, 1.0}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(PeriodicResponseOf, ConstantForceIsTheStaticOne) {
  const RowMatrix force = RowMatrix::Constant(51, 2, 3.0);
  const PeriodicMotion motion =
      periodic_response(force, 0.01, Eigen::Vector2d(25.0, 0.0), Eigen::Vector2d(0.3, 0.0));
  EXPECT_LT((motion.eta.col(0).array() - 3.0 / 25.0).abs().maxCoeff(), 1e-13);
  EXPECT_LT(motion.eta.col(1).cwiseAbs().maxCoeff(), 1e-13);  // a rigid mode has no mean force
  EXPECT_LT(motion.v.cwiseAbs().maxCoeff(), 1e-12);
}

class RecordedForce : public testing::SlapScenes {
 protected:
  /// An elastic block under the mounts, with `forces` recorded.
  std::string engine(const std::string& forces) {
    return std::string(
               "[time]\ncycles = 6\noutput_step_us = 20.0\n[contact]\ncavitation = false\n"
               "[accuracy]\ntolerance = 1e-3\n[engine]\nbalanced = true\n") +
           testing::kElasticBlock + R"(
[[mount]]
body = "block"
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
damping_n_s_m = [4e4, 4e4, 4e4]
)" + forces;
  }
};

constexpr const char* kAll = R"(
[[recorded_force]]
name = "slap"
body = "block"
of = ["piston_liner"]
[[recorded_force]]
name = "others"
body = "block"
of = ["gas on block", "crank_pin", "pin_guide", "mount 1", "balance of the other cylinders"]
)";

TEST_F(RecordedForce, ImpulsesAreThoseOfTheIntegrator) {
  const H5File run = recorded(scene(engine(kAll)), "run");
  const RowMatrix force = run.read_rows("forces/block/slap") + run.read_rows("forces/block/others");
  const RowMatrix v = run.read_rows("bodies/block/v");
  const LoadedBodies bodies = load_bodies(scene(engine(kAll)));
  const LoadedBody& block = *find_body(bodies, "block");
  const Eigen::VectorXd time = run.read_vector("output/time");
  const double step = (time(time.size() - 1) - time(0)) / static_cast<double>(time.size() - 1);
  // The rigid modes have no forces of their own: their momentum is the sum of all impulses.
  const Eigen::MatrixXd R = block.model.rigid;
  const Eigen::Index n = force.rows() - 1;
  Eigen::RowVectorXd impulse = step * force.colwise().sum();
  impulse -= 0.5 * step * (force.row(0) + force.row(n));
  const Eigen::RowVectorXd momentum = (v.row(n) - v.row(0)) * block.model.M_rr * R;
  const Eigen::RowVectorXd of_forces = impulse * R;
  const double scale = step * (force * R).cwiseAbs().colwise().sum().maxCoeff();
  EXPECT_LT((momentum - of_forces).cwiseAbs().maxCoeff(), 1e-6 * scale) << momentum << "\n"
                                                                        << of_forces;
}

TEST_F(RecordedForce, PartsSumUpToTheMotionOfTheRun) {
  const H5File run = recorded(scene(engine(kAll)), "run");
  const auto alone = [&](const std::string& name) {
    const auto path = folder_ / (name + ".run.h5");
    H5File file = H5File::create(path);
    write_response(run.path(), name, "", file);
    return file.read_rows("bodies/block/v");
  };
  const RowMatrix slap = alone("slap"), sum = slap + alone("others");
  RowMatrix v = run.read_rows("bodies/block/v");
  v.rowwise() -= Eigen::RowVectorXd(v.topRows(v.rows() - 1).colwise().mean());
  RowMatrix parts = sum;
  parts.rowwise() -= Eigen::RowVectorXd(sum.topRows(sum.rows() - 1).colwise().mean());
  // 0.089: modes of this block ring on for many cycles, and steps of 0.06 ms damp them.
  EXPECT_LT((v - parts).norm(), 0.12 * v.norm());
  EXPECT_GT(slap.norm(), 0.3 * v.norm());
  EXPECT_GT((v - slap).norm(), 0.3 * v.norm());
}

TEST_F(RecordedForce, CountInTheSizeOfTheRun) {
  const Scene with = scene(engine(kAll));
  const LoadedBodies bodies = load_bodies(with);
  const RunSize size = predict_size(with, bodies);
  const double without = predict_size(scene(engine("")), bodies).sample_bytes;
  const double block = find_body(bodies, "block")->model.size();
  EXPECT_DOUBLE_EQ(size.sample_bytes - without,
                   2.0 * 8.0 * static_cast<double>(size.samples) * block);
}

TEST_F(RecordedForce, AreRefusedByName) {
  const auto refused = [&](const std::string& forces) {
    return test::refusal_of([&] { recorded(scene(engine(forces)), "refused"); });
  };
  test::expect_parts(
      refused("[[recorded_force]]\nname = \"slap\"\nbody = \"block\"\nof = [\"slap\"]\n"),
      {"changed.run.toml", "of: found \"slap\", expected forces on block: ", "piston_liner",
       "gas on block"});
  test::expect_parts(refused("[[recorded_force]]\nname = \"slap\"\nbody = \"rod\"\nof = "
                             "[\"piston_liner\"]\n"),
                     {"body: found \"rod\", expected a reduced part whose frame is given: "});
  const H5File run = recorded(scene(engine(kAll)), "run");
  H5File file = H5File::create(folder_ / "none.run.h5");
  test::expect_parts(
      test::refusal_of([&] { write_response(run.path(), "gas", "", file); }),
      {"run.run.h5: forces: found \"others\" on block, \"slap\" on block, expected \"gas\""});
  test::expect_parts(test::refusal_of([&] { write_response(run.path(), "", "", file); }),
                     {"expected --force and --body that name one of them"});
}

}  // namespace
}  // namespace clatter::dynamics
