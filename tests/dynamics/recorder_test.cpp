// SPDX-License-Identifier: GPL-3.0-or-later
// What a run records: samples, histories and energies in blocks, their size, the periodicity.
#include "dynamics/run/recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "dynamics/component/field_stream.hpp"
#include "dynamics/run/run_size.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

/// v = t^2 in one mode.
StageState quadratic(double t) {
  StageState state;
  state.time = t;
  state.eta = Eigen::VectorXd::Constant(1, t * t * t / 3.0);
  state.v = Eigen::VectorXd::Constant(1, t * t);
  state.a = Eigen::VectorXd::Constant(1, 2.0 * t);
  return state;
}

TEST(UniformSamples, AccelerationIsTheMeanOverTheSamplingInterval) {
  // Between states 0.25 s apart, sampled every second: the mean of 2 t over [t - 1/2, t + 1/2] is
  // 2 t; over the halves at both ends 0.5 and 2 t - 0.5.
  SampleBlock all;
  UniformSamples samples(0.0, 4.0, 1.0, 1, [&](const SampleBlock& block) { all = block; });
  samples.start(quadratic(0.0));
  for (int k = 1; k <= 16; ++k) samples.add(quadratic(0.25 * (k - 1)), quadratic(0.25 * k));
  ASSERT_EQ(samples.count(), 5);
  samples.finish();
  ASSERT_EQ(all.count, 5);
  const double expected[] = {0.5, 2.0, 4.0, 6.0, 7.5};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(all.v(i, 0), i * i, 1e-13);
    EXPECT_NEAR(all.a(i, 0), expected[i], 1e-12);
  }
}

TEST(UniformSamples, BlocksFollowOneAnotherWithCompleteAccelerations) {
  // Steps of 0.7 samples, so that samples, halves and blocks end anywhere in them.
  const int64_t n = 3 * UniformSamples::block_rows(1) + 5;
  int64_t next = 0;
  double worst = 0.0;
  const auto check = [&](const SampleBlock& block) {
    EXPECT_EQ(block.first, next);
    for (Eigen::Index i = 0; i < block.count; ++i) {
      const double t = static_cast<double>(next++);
      EXPECT_EQ(block.time(i), t);
      worst = std::max(worst, std::abs(block.v(i, 0) - t * t) / (1.0 + t * t));
      if (t > 0.0 && next <= n) worst = std::max(worst, std::abs(block.a(i, 0) - 2.0 * t) / t);
    }
  };
  UniformSamples samples(0.0, static_cast<double>(n), 1.0, 1, check);
  samples.start(quadratic(0.0));
  const int64_t held = samples.held();
  for (int k = 1; 0.7 * (k - 1) < static_cast<double>(n); ++k)
    samples.add(quadratic(0.7 * (k - 1)), quadratic(0.7 * k));
  EXPECT_EQ(samples.held(), held);
  samples.finish();
  EXPECT_EQ(next, n + 1);
  EXPECT_EQ(samples.count(), n + 1);
  EXPECT_LT(worst, 1e-8);  // differences of t^2 up to 2e9, exact to rounding
}

/// The clamped bar under a step force.
RunResult bar_run(const fs::path& folder, double end, double output_step_us) {
  std::ofstream(folder / "bar.run.toml")
      << "[time]\nend_s = " << end << "\noutput_step_us = " << output_step_us
      << "\nlargest_step_us = 1.0\n[[body]]\nname = \"bar\"\nrom = \"bar.rom.h5\"\n"
         "[[load]]\nbody = \"bar\"\nset = \"tip\"\ncomponent = \"x\"\nvalue = 1000.0\n";
  RunControl control;
  control.output = folder / (std::to_string(end) + ".run.h5");
  const Scene scene = read_scene(folder / "bar.run.toml");
  return simulate(scene, load_bodies(scene), control);
}

TEST(Recorder, HardN11_HoldsNoMoreNumbersInALongRun) {
  const fs::path folder = testing::test_folder();
  testing::write_slap_scene(folder);
  const RunResult some = bar_run(folder, 0.02, 0.5), more = bar_run(folder, 0.08, 0.5);
  // 20 000 and 80 000 steps with twice as many samples of 11 modes: all of them, 1.5 and 6.1
  // million numbers, were in memory before. The slap of these tests with 3 million samples took 2.1
  // GB before and takes 24 MB.
  EXPECT_GT(more.statistics.accepted, 3 * some.statistics.accepted);
  EXPECT_EQ(more.samples, 160001);
  EXPECT_EQ(some.most_held, more.most_held);
  EXPECT_LT(more.most_held, 300000);
  const auto time = more.file->read_doubles("history/time");
  ASSERT_EQ(std::ssize(time), more.statistics.accepted);
  for (size_t i = 1; i < time.size(); ++i) ASSERT_GT(time[i], time[i - 1]);
  EXPECT_EQ(more.file->read_doubles("energy/terms/modal damping").size(), time.size());
  EXPECT_EQ(more.file->shape("bodies/bar/q")[0], more.samples);
}

TEST(FieldStream, HardN11_HoldsOneBlockOfAFieldAndWritesAllInstants) {
  const fs::path path = testing::test_folder() / "fields.h5";
  constexpr int kInstants = 1000;  // of 130 x 3 numbers: twelve blocks
  H5File file = H5File::create(path);
  FieldStream fields(file);
  int64_t most = 0;
  for (int k = 0; k < kInstants; ++k) {
    const RowMatrix links = RowMatrix::Constant(130, 3, k);
    const Eigen::VectorXd tension = Eigen::VectorXd::LinSpaced(130, k, k + 129.0);
    fields.add("group/links", links);
    fields.add("group/tension", tension);
    fields.add("group/nothing", Eigen::VectorXd());
    most = std::max(most, fields.held());
  }
  fields.finish();
  EXPECT_LE(most, 2 * 32768);  // both of its fields
  EXPECT_EQ(fields.held(), 0);
  EXPECT_EQ(file.shape("group/links"), (std::vector<int64_t>{kInstants, 130, 3}));
  EXPECT_EQ(file.shape("group/tension"), (std::vector<int64_t>{kInstants, 130}));
  EXPECT_FALSE(file.has("group/nothing"));
  const RowMatrix tension = file.read_rows("group/tension");
  for (int k = 0; k < kInstants; ++k) {
    ASSERT_EQ(tension(k, 0), k);
    ASSERT_EQ(tension(k, 129), k + 129.0);
  }
}

TEST(Periodicity, IsTheDifferenceOfBothCyclesSampleBySample) {
  const fs::path folder = testing::test_folder();
  testing::write_slap_scene(folder);
  const Scene scene = testing::changed_scene(folder, "[time]\noutput_step_us = 10.0\n");
  const LoadedBodies bodies = load_bodies(scene);
  RunControl control;
  control.output = folder / "slap.run.h5";
  RunResult result = simulate(scene, bodies, control);
  const H5File now = testing::finished_file(scene, bodies, result);
  const H5File before = H5File::open(checkpoint_path(control.output));
  const auto& piston = bodies[0];
  const auto physical = [&](const char* modal) -> RowMatrix {
    return before.read_rows(modal).leftCols(piston.modal.modes()) * piston.modal.shapes.transpose();
  };
  const RowMatrix v = now.read_rows("bodies/piston/v");
  ASSERT_EQ(v.rows(), 6001);  // several blocks
  const RowMatrix change = v - physical(kCycleVelocity);
  const auto energy = [&](const RowMatrix& m) {
    return (m * piston.model.M_rr).cwiseProduct(m).sum();
  };
  EXPECT_NEAR(result.periodicity.velocity.at("piston"), std::sqrt(energy(change) / energy(v)),
              1e-10);
  const RowMatrix moved = now.read_rows("bodies/piston/q") - physical(kCycleEta);
  EXPECT_NEAR(result.periodicity.lateral.value(), moved.col(1).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(result.periodicity.tilt.value(), moved.col(3).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_GT(result.periodicity.lateral.value(), 1e-9);
}

TEST(RunSize, HardN11_IsThatOfTheFileAndTheDiskMustTakeIt) {
  const fs::path folder = testing::test_folder();
  testing::write_slap_scene(folder);
  const Scene scene = testing::changed_scene(
      folder, "[time]\ncycles = 1\noutput_step_us = 1.0\nfilm_every_deg = 1.0\n");
  const LoadedBodies bodies = load_bodies(scene);
  const RunSize size = predict_size(scene, bodies);
  EXPECT_EQ(size.samples, 60001);
  EXPECT_EQ(size.coordinates, 6);
  RunControl control;
  control.output = folder / "slap.run.h5";
  RunResult result = simulate(scene, bodies, control);
  testing::finished_file(scene, bodies, result);
  const double bytes = static_cast<double>(fs::file_size(control.output));
  EXPECT_NEAR(bytes, size.sample_bytes + size.film_bytes, 0.2 * bytes);  // histories come on top

  const fs::path named = "slap.run.h5";
  EXPECT_EQ(check_size(scene, size, named, 1e9), "");
  test::expect_parts(
      test::refusal_of<FileError>([&] { check_size(scene, size, named, 1e6); }),
      {"changed.run.toml:4: time.output_step_us: found 1: 60001 samples of 6 coordinates need",
       "slap.run.h5 has 977 KiB free, expected at least"});
  // At 1 rpm: 4 GiB of memory before (five matrices of samples by modes, twice during writing).
  const Scene slow =
      testing::changed_scene(folder, "[engine]\nspeed_rpm = 1.0\n[time]\noutput_step_us = 20.0\n");
  const RunSize large = predict_size(slow, bodies);
  EXPECT_EQ(large.samples, 6000001);
  test::expect_parts(
      check_size(slow, large, named, 1e12),
      {"slap.run.h5: 6000001 samples of 6 coordinates need", "GiB", "(time.output_step_us = 20)"});
}

TEST(FilmPressure, BeyondOilAndMetalIsReportedOnceWithTimeAndPosition) {
  const fs::path folder = testing::test_folder();
  testing::write_slap_scene(folder);
  const auto warnings = [&](const std::string& changes) {
    const Scene scene = testing::changed_scene(folder, changes);
    RunControl control;
    control.output = folder / "slap.run.h5";
    return simulate(scene, load_bodies(scene), control).warnings;
  };
  const auto high = warnings("[engine]\nspeed_rpm = 12000.0\n[time]\ncycles = 1\n");
  ASSERT_EQ(high.size(), 1U);
  test::expect_parts(high[0], {"film pressure", "GPa at crank angle", "deg on the", "side at",
                               "mm from the pin is above 0.3 GPa", "under a side force of",
                               "the clearance, or use elastic bodies"});
  EXPECT_TRUE(warnings("[time]\ncycles = 1\n").empty());
}

}  // namespace
}  // namespace clatter::dynamics
