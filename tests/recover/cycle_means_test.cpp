// SPDX-License-Identifier: GPL-3.0-or-later
// Means over the last cycles of a run, and their standard errors.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "recover/sound/wav.hpp"
#include "sound_run.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

/// Standard error of the mean of independent values as a level [dB], as textbooks write it.
double error_db(const std::vector<double>& P) {
  const double n = static_cast<double>(P.size());
  const double mean = std::accumulate(P.begin(), P.end(), 0.0) / n;
  double squares = 0.0;
  for (const double one : P) squares += (one - mean) * (one - mean);
  return 4.342944819032518 * std::sqrt(squares / (n - 1.0) / n) / mean;
}

double mean(const std::vector<double>& P) {
  return std::accumulate(P.begin(), P.end(), 0.0) / static_cast<double>(P.size());
}

constexpr std::array<double, 5> kSize{7.0, 1.0, 1.3, 0.7, 1.1};

/// Powers of the last cycles of five that have these sizes, for one of `last` in the last one.
std::vector<double> powers(size_t cycles, double last) {
  std::vector<double> P;
  for (size_t c = kSize.size() - cycles; c < kSize.size(); ++c)
    P.push_back(last * std::pow(kSize[c] / kSize.back(), 2));
  return P;
}

/// Writes five cycles of a tone of the sphere.
void write_five(const std::filesystem::path& folder, const Eigen::Vector2d& motion, double hz) {
  const RunPlan plan{.cycles = 5};
  const double w = 2 * kPi * hz;
  write_run(folder, sphere_model(), plan, [&](double t) {
    const auto cycle = static_cast<size_t>(std::floor(t / plan.cycle_s() + 1e-6));
    const Eigen::Vector2d q = kSize.at(std::min<size_t>(cycle, 4)) * motion;
    return Motion{q * std::cos(w * t), -w * q * std::sin(w * t), -w * w * q * std::cos(w * t)};
  });
}

class CycleMeans : public SphereRun {
 protected:
  void SetUp() override {
    SphereRun::SetUp();
    write_five(folder_, kMotion, kLine);
  }
  Summary of(const std::string& window) {
    return recovered("[spectrum]\nto_hz = 1500\n[[window]]\nname = 'w'\n" + window);
  }
  std::string refusal(const std::string& window) {
    return test::refusal_of([&] { of(window); });
  }
};

/// With the sphere's sound.
class CycleSounds : public SoundRun {
 protected:
  void SetUp() override {
    SoundRun::SetUp();
    write_five(folder_, kMotion, kLine);
    write_sound_file();
  }
  Summary of(const std::string& keys) {
    return recovered("sound = 'part.sound.h5'\n" + keys +
                     "[spectrum]\nto_hz = 1500\n[[window]]\nname = 'w'\ncycles = 4\n");
  }
};

TEST_F(CycleSounds, HaveTheLevelOfTheMeanPowerWithItsStandardError) {
  const Summary summary = of("");
  const Analysis &cycle = summary.analyses.at(0), &window = summary.analyses.at(1);
  EXPECT_EQ(window.piece.segments(), 4);
  EXPECT_TRUE(window.piece.is_mean_of_cycles());
  EXPECT_FALSE(cycle.panels[0].erp_error.db.has_value());
  const std::vector<double> erp = powers(4, cycle.panels[0].total_erp);
  EXPECT_NEAR(window.panels[0].total_erp, mean(erp), 1e-9 * mean(erp));
  EXPECT_NEAR(window.panels[0].erp_error.db.value(), error_db(erp), 1e-9);
  const RunSound &last = summary.sounds.at(0), &sound = summary.sounds.at(1);
  const std::vector<double> P = powers(4, last.total);
  EXPECT_NEAR(sound.total, mean(P), 1e-9 * mean(P));
  EXPECT_NEAR(sound.total_a, mean(powers(4, last.total_a)), 1e-9 * last.total_a);
  EXPECT_NEAR(sound.error.db.value(), error_db(P), 1e-9);
  EXPECT_NEAR(sound.error.dba.value(), error_db(P), 1e-9);  // one tone, weighted or not
  EXPECT_GT(error_db(P), 0.5);
  // Panels, directions and microphones have the same mean.
  const double raised = 10.0 * std::log10(mean(P) / last.total);
  EXPECT_NEAR(sound.panels.total[0], mean(powers(4, last.panels.total[0])), 1e-9 * mean(P));
  EXPECT_NEAR(sound.microphones[kAbove].total_db - last.microphones[kAbove].total_db, raised, 1e-6);
  EXPECT_NEAR(sound.microphones[kAbove].error.db.value(), error_db(P), 1e-9);
  EXPECT_NEAR(sound.surface.pressure_db - last.surface.pressure_db, raised, 1e-6);
  EXPECT_NEAR(sound.directivity.mean_square.sum() / last.directivity.mean_square.sum(),
              mean(P) / last.total, 1e-9);
  EXPECT_NEAR(sound.panels.sum_difference, last.panels.sum_difference, 1e-9);

  const H5File file = H5File::open(folder_ / "field.h5");
  const std::string at = "analysis/w/sound";
  EXPECT_NEAR(file.get_double(at, "power_standard_error_dba"), error_db(P), 1e-9);
  EXPECT_NEAR(file.get_double("analysis/w/panels/skin", "erp_standard_error_db"), error_db(erp),
              1e-9);
  EXPECT_FALSE(file.has_attribute("analysis/cycle/sound", "power_standard_error_db"));
  EXPECT_TRUE(file.has(at + "/microphones/above/pressure_power"));
  EXPECT_FALSE(file.has(at + "/microphones/above/pressure_re"));
  const std::string text = summary_text(summary);
  const std::string line =
      fmt::format("'w': sound power {:.1f} dB(A) +- {:.2f} dB re 1 pW (4 cycles)\n",
                  10.0 * std::log10(sound.total_a / 1e-12), error_db(P));
  EXPECT_NE(text.find(line), std::string::npos) << text;
  EXPECT_NE(text.find("'w': ERP of exposed"), std::string::npos);

  // They have no phases to be heard by.
  of("cycle = false\n");
  test::expect_parts(
      test::refusal_of([&] { write_wav(folder_ / "field.h5", "above", {}, folder_ / "a.wav"); }),
      {"expected a field with a cycle or a window in one segment"});
}

TEST_F(CycleMeans, LevelsAreThoseOfTheMeanPowerWithItsStandardError) {
  const Summary summary = of("cycles = 4\n");
  const std::vector<double> P = powers(4, summary.analyses.at(0).panels[0].total_erp);
  const PanelResult& found = summary.analyses.at(1).panels[0];
  EXPECT_NEAR(found.total_erp, mean(P), 1e-9 * mean(P));
  EXPECT_NEAR(found.erp_error.db.value(), error_db(P), 1e-9);
  EXPECT_NEAR(found.erp_error.dba.value(), error_db(P), 1e-9);
}

TEST_F(CycleMeans, OneCycleIsTheLastCycleToTheBit) {
  const Summary summary = of("cycles = 1\n");
  const Analysis &cycle = summary.analyses.at(0), &window = summary.analyses.at(1);
  EXPECT_EQ(window.piece.count, cycle.piece.count);
  EXPECT_EQ(window.velocity.amplitude, cycle.velocity.amplitude);
  EXPECT_EQ(window.panels[0].band_erp_dba, cycle.panels[0].band_erp_dba);
  EXPECT_EQ(window.panels[0].total_erp_a, cycle.panels[0].total_erp_a);
  EXPECT_FALSE(window.panels[0].erp_error.db.has_value());
}

TEST_F(CycleMeans, ARunThatBeginsBeforeFiringIsCoveredByItsCycle) {
  // As every run of an engine, from -360 to 360 deg; before, cycles began at firing.
  write_run(folder_, sphere_model(), {.cycles = 1, .first_angle_deg = -360.0}, [](double) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(2);
    return Motion{ones, ones, ones};
  });
  const RunBody body(folder_ / "run.h5", "");
  const Piece piece = window(body.clock(), {.name = "w", .cycles = 1}, "run");
  EXPECT_EQ(piece.first, 0);
  EXPECT_EQ(piece.count, 720);
  EXPECT_EQ(piece.ftdc_deg, 0.0);
}

TEST_F(CycleMeans, SegmentsThatOverlapCountAsTheEquivalentNumber) {
  // Two cycles each, half overlapping without the key; then the same one by one.
  std::string windows = "cycles = 4\nsegment_deg = 1440\ntaper = 'hann'\n";
  for (const char* begin : {"0.06", "0.12", "0.18"})
    windows +=
        fmt::format("[[window]]\nname = '{0}'\nfrom_s = {0}\nto_s = {1:.2f}\ntaper = 'hann'\n",
                    begin, std::stod(begin) + 0.12);
  const Summary summary = of(windows);
  const Analysis& window = summary.analyses.at(1);
  ASSERT_EQ(window.piece.segments(), 3);
  EXPECT_FALSE(window.piece.is_mean_of_cycles());
  std::vector<double> P;
  for (size_t k = 2; k < 5; ++k) P.push_back(summary.analyses.at(k).panels[0].total_erp);
  EXPECT_NEAR(window.panels[0].total_erp, mean(P), 1e-9 * mean(P));
  const double n_e = equivalent_averages(window.piece);
  EXPECT_LT(n_e, 3.0);
  EXPECT_NEAR(window.panels[0].erp_error.db.value(), error_db(P) * std::sqrt(2.0 / (n_e - 1.0)),
              1e-9);
}

TEST_F(CycleMeans, AnglesHaveTheSameMeans) {
  const Summary summary = of("cycles = 3\ndomain = 'angle'\n");
  // The interpolation needs 20 samples after the window: it ends before the run.
  const Analysis& window = summary.analyses.at(1);
  EXPECT_EQ(window.piece.segments(), 3);
  EXPECT_TRUE(window.piece.is_mean_of_cycles());
  const double last = summary.analyses.at(0).panels[0].total_erp;
  EXPECT_NEAR(window.panels[0].total_erp, mean(powers(3, last)), 0.1 * last);
  EXPECT_GT(window.panels[0].erp_error.db.value(), 0.5);
}

TEST_F(CycleMeans, WithoutTheCycleTheyAreCertifiedByTheirLastOne) {
  const FieldCertificate whole = of("cycles = 2\n").certificate;
  const Summary means =
      recovered("cycle = false\n[spectrum]\nto_hz = 1500\n[[window]]\nname = 'w'\ncycles = 2\n");
  ASSERT_EQ(means.analyses.size(), 1u);
  EXPECT_GT(whole.cycle_to_cycle_velocity_difference.value(), 0.1);
  EXPECT_EQ(means.certificate.cycle_to_cycle_velocity_difference,
            whole.cycle_to_cycle_velocity_difference);
  EXPECT_EQ(means.certificate.cycle_end_velocity_jump, whole.cycle_end_velocity_jump);
}

TEST_F(CycleMeans, MoreThanWereRecordedAreRefusedWithTheKeyOfTheRun) {
  EXPECT_EQ(refusal("cycles = 6\n"),
            (folder_ / "run.h5").string() +
                ": window 'w': cycles: found 6, expected at most 5, which the run has recorded: "
                "set record_cycles = 6 in [time] of its run.toml, or a later end_s");
  test::expect_parts(refusal("cycles = 5\ndomain = 'angle'\n"),
                     {"expected 5 cycles of 3600", "time.record_cycles = 6"});
  test::expect_parts(refusal("cycles = 2.5\n"), {"cycles: found 2.5, expected a whole number"});
}

TEST(LevelErrors, OfValuesByHand) {
  // 1, 2, 3: mean 2, s = 1 / sqrt(3).
  EXPECT_NEAR(level_error_db({1.0, 2.0, 3.0}, 3.0).value(), 4.342944819 / std::sqrt(3.0) / 2.0,
              1e-8);
  EXPECT_FALSE(level_error_db({1.0}, 1.0).has_value());
  EXPECT_FALSE(level_error_db({0.0, 0.0}, 2.0).has_value());
}

}  // namespace
}  // namespace clatter::recover
