// SPDX-License-Identifier: GPL-3.0-or-later
// Runs that record several cycles.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <vector>

#include "dynamics/run/run_size.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

class RecordedCycles : public testing::SlapScenes {
 protected:
  Scene of_cycles(int cycles, int recorded, const std::string& changes = "") {
    return scene(
        fmt::format("{}[time]\ncycles = {}\nrecord_cycles = {}\n", changes, cycles, recorded));
  }
  void expect_same_motion(int cycles, const std::string& changes);
};

constexpr const char* kMounts = R"(
[contact]
lubrication = "none"
[[mount]]
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
damping_n_s_m = [1e3, 1e3, 2e3]
)";

/// The last `count` values of a column.
std::vector<double> tail(const H5File& file, const std::string& name, size_t count) {
  const std::vector<double> all = file.read_doubles(name);
  return {all.end() - static_cast<std::ptrdiff_t>(std::min(count, all.size())), all.end()};
}

/// Compares what both recorded of the last cycle, the only one of `last`.
void expect_same_last_cycle(const H5File& last, const H5File& several) {
  for (const std::string& name : last.list("history")) {
    const std::vector<double> expected = last.read_doubles("history/" + name);
    EXPECT_EQ(expected, tail(several, "history/" + name, expected.size())) << name;
  }
  // Energies that have passed are summed from the beginning of what is recorded.
  for (const char* name : {"energy/kinetic", "energy/strain", "energy/element"}) {
    const std::vector<double> expected = last.read_doubles(name);
    EXPECT_EQ(expected, tail(several, name, expected.size())) << name;
  }
  EXPECT_EQ(last.read_vector("end/eta"), several.read_vector("end/eta"));
  EXPECT_EQ(last.read_vector("end/v"), several.read_vector("end/v"));
  for (const std::string& body : last.list("bodies"))
    for (const char* member : {"q", "v", "a"}) {
      const std::string name = fmt::format("bodies/{}/{}", body, member);
      const RowMatrix expected = last.read_rows(name);
      // Without the first sample, whose acceleration is that of the half interval after it.
      const Eigen::Index n = expected.rows() - 1;
      const RowMatrix found = several.read_rows(name).bottomRows(n);
      // Instants of samples are rounded differently, by 1e-17 s of steps of 5e-5 s.
      EXPECT_LT((found - expected.bottomRows(n)).cwiseAbs().maxCoeff(),
                1e-9 * expected.cwiseAbs().maxCoeff())
          << name;
    }
}

void RecordedCycles::expect_same_motion(int cycles, const std::string& changes) {
  const H5File one = recorded(of_cycles(cycles, 1, changes), "one");
  const RunResult of_one = std::move(result_);
  for (int several = 2; several <= cycles; ++several) {
    SCOPED_TRACE(several);
    const H5File file = recorded(of_cycles(cycles, several, changes), "several");
    EXPECT_EQ(result_.cycles, cycles);
    EXPECT_EQ(result_.samples, several * 1200 + 1);
    EXPECT_EQ(result_.statistics.accepted, of_one.statistics.accepted);
    expect_same_last_cycle(one, file);
    // Of the last two cycles, whether the first of them is recorded or not.
    const CycleDifference &expected = of_one.periodicity, &found = result_.periodicity;
    EXPECT_GT(expected.velocity.at("piston"), 0.0);
    for (const auto& [body, value] : expected.velocity)
      EXPECT_NEAR(found.velocity.at(body), value, 1e-9 * value);
    EXPECT_NEAR(found.lateral.value(), expected.lateral.value(), 1e-9 * expected.lateral.value());
  }
}

TEST_F(RecordedCycles, AFilmMovesTheSameHoweverManyAreRecorded) { expect_same_motion(2, ""); }

TEST_F(RecordedCycles, DryContactMovesTheSameHoweverManyAreRecorded) {
  expect_same_motion(3, "[contact]\nlubrication = \"none\"\n");
}

TEST_F(RecordedCycles, AnElasticBlockMovesTheSameHoweverManyAreRecorded) {
  expect_same_motion(2, testing::kElasticBlock + std::string(kMounts));
}

TEST_F(RecordedCycles, TheyAreOneSpanThatEndsAtTheLastCycle) {
  const H5File file = recorded(of_cycles(2, 2), "run");
  const std::vector<double> angle = file.read_doubles("output/crank_angle_deg");
  EXPECT_NEAR(angle.front(), -1080.0, 1e-9);
  EXPECT_NEAR(angle.back(), 360.0, 1e-9);
  for (size_t i = 1; i < angle.size(); ++i)
    ASSERT_NEAR(angle[i] - angle[i - 1], 720.0 / 1200.0, 1e-9) << i;
  // A step ends where a cycle ends.
  const std::vector<double> steps = file.read_doubles("history/crank_angle_deg");
  EXPECT_TRUE(std::any_of(steps.begin(), steps.end(),
                          [](double at) { return std::abs(at + 360.0) < 1e-9; }));
  // A film field each 10 deg, of both cycles; a position of the pads' cells once.
  EXPECT_EQ(file.read_doubles("film/crank_angle_deg").size(), 144U);
  EXPECT_EQ(file.shape("film/thrust/gap").front(), 144);
  // What was lost is summed over all of it.
  const std::vector<double> lost = file.read_doubles("energy/lost");
  const auto second =
      std::find_if(steps.begin(), steps.end(), [](double at) { return at > -360.0; });
  EXPECT_GT(lost.back(), 1.5 * lost[second - steps.begin()]);
}

TEST_F(RecordedCycles, AStepThatDoesNotDivideTheCycleIsFittedToIt) {
  // 60 ms at 7 ms are 9 steps of a cycle, not 26 of three.
  const H5File file = recorded(scene("[time]\ncycles = 3\nrecord_cycles = 3\noutput_step_us = "
                                     "7000\n[contact]\nlubrication = \"none\"\n"),
                               "run");
  EXPECT_EQ(file.read_doubles("output/time").size(), 28U);
  EXPECT_NEAR(file.read_doubles("output/crank_angle_deg")[9], -1080.0, 1e-9);
}

TEST_F(RecordedCycles, AResumedRunGivesTheSameBits) {
  const Scene described = of_cycles(3, 2);
  const H5File whole = recorded(described, "whole");
  const std::filesystem::path output = folder_ / "whole.run.h5";
  RunControl control;
  control.output = output;
  control.resume_from = read_checkpoint(checkpoint_path(output), fingerprint(described));
  ASSERT_TRUE(control.resume_from.has_value());
  EXPECT_EQ(control.resume_from->cycle, 1);  // none lies in what is recorded
  const RowMatrix q = whole.read_rows("bodies/piston/q");
  const std::vector<double> lost = whole.read_doubles("energy/lost");
  const LoadedBodies bodies = load_bodies(described);
  const std::atomic<bool> stop{true};
  control.stop = &stop;
  RunResult stopped = simulate(described, bodies, control);
  EXPECT_FALSE(stopped.complete);
  EXPECT_EQ(stopped.cycles, 1);
  stopped.file.reset();
  control.stop = nullptr;
  RunResult again = simulate(described, bodies, control);
  EXPECT_EQ(again.cycles, 3);
  const H5File file = testing::finished_file(described, bodies, again);
  EXPECT_EQ(file.read_rows("bodies/piston/q"), q);
  EXPECT_EQ(file.read_doubles("energy/lost"), lost);
}

TEST_F(RecordedCycles, TheDiskMustTakeAllOfThem) {
  const Scene described = of_cycles(2, 2);
  const RunSize size = predict_size(described, load_bodies(described));
  recorded(described, "run");
  EXPECT_EQ(size.samples, result_.samples);
  EXPECT_EQ(size.film_fields, 2 * 72);
}

TEST_F(RecordedCycles, WhatCannotBeRecordedIsRefused) {
  test::expect_parts(
      refusal("[time]\ncycles = 3\nrecord_cycles = 4\n"),
      {"changed.run.toml:4: time.record_cycles: found 4, expected at most cycles, 3"});
  test::expect_parts(refusal("[time]\nrecord_cycles = 0\n"),
                     {"time.record_cycles: found 0, expected a whole number, a number"});
  test::expect_parts(refusal("[time]\nsettle_to = 0.1\nrecord_cycles = 2\n"),
                     {"time.record_cycles", "settle_to exclude each other",
                      "ends with the first cycle that repeats"});
}

}  // namespace
}  // namespace clatter::dynamics
