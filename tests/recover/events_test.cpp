// SPDX-License-Identifier: GPL-3.0-or-later
// Windows of what does not repeat: exact lines, energy, warnings of motion that is left out.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/log.hpp"
#include "recover/sound/wav.hpp"
#include "sound_run.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

/// A knock on the sphere at `centre` [s]: displacement 1e-6 m exp(-(t/w)^2) cos(2 pi 500 Hz t).
class Event : public SoundRun {
 protected:
  void knock_at(double centre) {
    constexpr double kWidth = 1e-3, w = 2 * kPi * kLine;
    write_inputs([=](double t) {
      const double x = t - centre, decay = -2.0 * x / (kWidth * kWidth);
      const double u = 1e-6 * std::exp(-x * x / (kWidth * kWidth));
      Motion m{Eigen::Vector2d::Zero(2), Eigen::Vector2d::Zero(2), Eigen::Vector2d::Zero(2)};
      m.q[0] = u * std::cos(w * x);
      m.v[0] = u * (decay * std::cos(w * x) - w * std::sin(w * x));
      return m;
    });
  }

  /// What recovering says as warnings.
  std::vector<std::string> warnings_of(const std::string& toml) {
    std::vector<std::string> warnings;
    set_log_sink([&](bool warning, const std::string& line) {
      if (warning) warnings.push_back(line);
    });
    recovered(toml);
    set_log_sink({});
    return warnings;
  }

  static std::string seconds(double from, double to, const std::string& more = "") {
    return fmt::format(
        "cycle = false\nsound = \"part.sound.h5\"\n[spectrum]\nfrom_hz = 100\n[[window]]\nname = "
        "\"knock\"\nfrom_s = {}\nto_s = {}\n{}[frames]\non = false\n",
        from, to, more);
  }
};

TEST_F(Event, ToneThatFitsTheWindowHasALineOfItsOwn) {
  const Summary summary = recovered(seconds(0.02, 0.04));  // ten periods of 500 Hz
  const Analysis& analysis = summary.analyses.front();
  EXPECT_EQ(analysis.piece.count, 240);
  for (Eigen::Index k = 1; k < analysis.velocity.frequency_hz.size(); ++k) {
    const double expected = k == 10 ? 2 * kPi * kLine * kMotion[1] : 0.0;
    EXPECT_NEAR(std::abs(analysis.velocity.amplitude(k, 1)), expected, 1e-13) << k;
  }
}

TEST_F(Event, EnergyDoesNotDependOnTheWindowAndPowerDoes) {
  knock_at(0.06);
  const auto sound_of = [&](double from, double to) {
    const Summary summary = recovered(seconds(from, to));
    const H5File file = open_artefact(folder_ / "field.h5", kFieldSchema);
    const double duration = file.get_double("analysis/knock", "duration_s");
    EXPECT_NEAR(duration, to - from, 1e-9);
    const std::string at = "analysis/knock/sound";
    EXPECT_NEAR(file.get_double(at, "energy_j"), file.get_double(at, "power_w") * duration,
                1e-12 * file.get_double(at, "energy_j"));
    EXPECT_NE(summary_text(summary).find("sound energy"), std::string::npos);
    return file.get_double(at, "energy_dba");
  };
  const double narrow = sound_of(0.05, 0.07);
  EXPECT_GT(narrow, 0.0);
  // Of wider windows more lines lie at the border between boundary elements and ERP, at 700 Hz.
  EXPECT_NEAR(sound_of(0.03, 0.09), narrow, 0.05);
  EXPECT_NEAR(sound_of(0.0, 0.12), narrow, 0.05);
}

TEST_F(Event, WindowThatEndsBeforeTheMotionDoesSaysSo) {
  knock_at(0.06);
  const auto text_of = [&](double to) { return summary_text(recovered(seconds(0.05, to))); };
  EXPECT_NE(text_of(0.07).find("of any window that holds the event"), std::string::npos);
  const std::string cut = text_of(0.0605);
  EXPECT_NE(cut.find("the motion goes on at their end: the last tenth has "), std::string::npos);
  EXPECT_EQ(cut.find("of any window"), std::string::npos);
  move(kMotion);  // steady: the last tenth has a tenth
  recovered(seconds(0.02, 0.04));
  EXPECT_NEAR(open_artefact(folder_ / "field.h5", kFieldSchema)
                  .get_double("analysis/knock", "last_tenth_share"),
              0.1, 1e-3);
}

TEST_F(Event, OneWindowIsHeardWhereThereIsNoCycle) {
  knock_at(0.06);
  recovered(seconds(0.05, 0.07));
  write_wav(folder_ / "field.h5", "plus_y", {.seconds = 0.1}, folder_ / "knock.wav");
  EXPECT_EQ(std::filesystem::file_size(folder_ / "knock.wav"), 44u + 2u * 4800u);
  recovered(seconds(0.0, 0.12, "segment_s = 0.02\n"));
  test::expect_parts(test::refusal_of([&] {
                       write_wav(folder_ / "field.h5", "plus_y", {}, folder_ / "knock.wav");
                     }),
                     {"field.h5: analysis: found no microphones", "a window in one segment"});
}

TEST_F(Event, WhatIsTaperedOrRepeatsHasNoEnergy) {
  knock_at(0.06);
  recovered(seconds(0.05, 0.07, "taper = \"hann\"\n"));
  EXPECT_FALSE(open_artefact(folder_ / "field.h5", kFieldSchema)
                   .has_attribute("analysis/knock/sound", "energy_j"));
  recovered("sound = \"part.sound.h5\"\nwindow = []\n[frames]\non = false\n");
  EXPECT_FALSE(open_artefact(folder_ / "field.h5", kFieldSchema)
                   .has_attribute("analysis/cycle/sound", "energy_j"));
}

TEST_F(Event, MotionOutsideTheWindowOrUnderATaperIsWarnedOf) {
  knock_at(0.004);
  EXPECT_TRUE(warnings_of(seconds(0.0, 0.06)).empty());
  const std::vector<std::string> outside = warnings_of(seconds(0.02, 0.06));
  ASSERT_EQ(outside.size(), 1u);
  test::expect_parts(outside[0], {"the largest motion of the run, at 0.00", "outside 'knock'",
                                  "0.02 to 0.06 s: spectra and levels lack it"});
  const std::vector<std::string> under = warnings_of(seconds(0.0, 0.06, "taper = \"hann\"\n"));
  ASSERT_EQ(under.size(), 1u);
  test::expect_parts(under[0], {"under the edge of 'knock'", "taper = \"hann\" leaves",
                                "taper = \"none\" keeps it"});
}

}  // namespace
}  // namespace clatter::recover
