// SPDX-License-Identifier: GPL-3.0-or-later
// Third octaves, weighting and decibels against published values.
#include "recover/spectrum/levels.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace clatter::recover {
namespace {

TEST(Levels, AWeightingHasTheFiguresOfTheStandard) {
  // IEC 61672-1 table at exact base-ten mid-bands, printed to 0.1 dB.
  const auto at = [](int n) { return a_weighting_db(1000.0 * std::pow(10.0, n / 10.0)); };
  EXPECT_NEAR(at(-15), -39.4, 0.06);
  EXPECT_NEAR(at(-10), -19.1, 0.05);
  EXPECT_NEAR(at(0), 0.0, 0.001);  // the constant 2.000 dB is rounded
  EXPECT_NEAR(at(4), 1.3, 0.05);
  EXPECT_NEAR(at(10), -2.5, 0.05);
  EXPECT_NEAR(at(13), -9.3, 0.05);
  EXPECT_NEAR(10 * std::log10(a_weighting_power(250.0)), a_weighting_db(250.0), 1e-12);
}

TEST(Levels, ThirdOctavesHaveTheirEdgesAndNames) {
  const ThirdOctaves bands = third_octaves(20.0, 25000.0, 0.0);
  // 25 Hz is the first band whose lower edge (22.4) is not below 20; 20 kHz ends at 22.4 kHz.
  ASSERT_EQ(bands.size(), 30);
  EXPECT_EQ(bands.nominal.front(), "25");
  EXPECT_EQ(bands.nominal[1], "31.5");
  EXPECT_EQ(bands.nominal.back(), "20000");
  for (Eigen::Index b = 0; b + 1 < bands.size(); ++b)
    EXPECT_NEAR(bands.upper_hz[b] / bands.lower_hz[b + 1], 1.0, 1e-14);
  for (Eigen::Index b = 0; b < bands.size(); ++b) {
    EXPECT_NEAR(bands.upper_hz[b] / bands.mid_hz[b], std::pow(10.0, 0.05), 1e-14);
    EXPECT_NEAR(bands.mid_hz[b] / bands.lower_hz[b], std::pow(10.0, 0.05), 1e-14);
  }
  const char* expected[] = {"1000", "1250", "1600", "2000", "2500",
                            "3150", "4000", "5000", "6300", "8000"};
  for (int n = 0; n < 10; ++n) EXPECT_EQ(nominal_frequency(n), expected[n]);
  EXPECT_EQ(nominal_frequency(-17), "20");
  EXPECT_EQ(nominal_frequency(-30), "1");
  EXPECT_EQ(nominal_frequency(12), "16000");
}

TEST(Levels, BandsNarrowerThanALineAreLeftOut) {
  const ThirdOctaves bands = third_octaves(20.0, 5000.0, 1000.0 / 60.0);
  // width = 0.2307 mid, so the first band wider than 16.67 Hz is 79.4 Hz (18.3 Hz).
  EXPECT_EQ(bands.nominal.front(), "80");
}

TEST(Levels, BandSumsKeepAllPowerAndGiveEachLineOneHome) {
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(2001, 0.0, 20000.0);
  const Eigen::VectorXd power = Eigen::VectorXd::LinSpaced(2001, 1.0, 3.0);
  const ThirdOctaves bands = third_octaves(100.0, 12000.0, 10.0);
  double inside = 0.0;
  for (Eigen::Index k = 0; k < f.size(); ++k)
    if (f[k] >= bands.lower_hz[0] && f[k] < bands.upper_hz[bands.size() - 1]) inside += power[k];
  EXPECT_NEAR(band_sums(f, power, bands, true).sum() / inside, 1.0, 1e-13);
  // Shared by overlap, a flat density fills each band by its width.
  const Eigen::VectorXd flat = Eigen::VectorXd::Ones(2001);
  const Eigen::VectorXd shared = band_sums(f, flat, bands, false);
  EXPECT_LT((shared - (bands.upper_hz - bands.lower_hz) / 10.0).cwiseAbs().maxCoeff(), 1e-9);
}

// A band whose end no line of a window covers would miss power: of a flat density each band has its
// width.
TEST(Levels, NoBandOfAWindowIsCutByTheLastLine) {
  const double spacing = 200.0, to_hz = 1130.0;  // the band of 1 kHz ends at 1122, lines at 1100
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(6, 0.0, 1000.0);
  const auto bands = [&](bool periodic) {
    return third_octaves(20.0, covered_to_hz(f, to_hz, periodic), spacing);
  };
  EXPECT_EQ(bands(true).nominal, std::vector<std::string>{"1000"});  // no line from 1000 to 1130
  EXPECT_EQ(bands(false).size(), 0);
  const ThirdOctaves cut = third_octaves(20.0, to_hz, spacing);
  const double width = cut.upper_hz[0] - cut.lower_hz[0];
  EXPECT_LT(band_sums(f, Eigen::VectorXd::Ones(6), cut, false)[0], 0.95 * width / spacing);
  const Eigen::VectorXd more = Eigen::VectorXd::LinSpaced(7, 0.0, 1200.0);
  EXPECT_EQ(third_octaves(20.0, covered_to_hz(more, 1250.0, false), spacing).size(), 1);
}

TEST(Levels, VelocityReferencesStandThirtyFourDecibelsApart) {
  const double v2 = 1e-8;
  EXPECT_NEAR(level_db(v2, 1e-18) - level_db(v2, 25e-16), 33.98, 0.005);
  EXPECT_DOUBLE_EQ(level_db(0.0, 1e-12), kSilence);
}

}  // namespace
}  // namespace clatter::recover
