// SPDX-License-Identifier: GPL-3.0-or-later
// Line spectra: amplitudes, phases, Parseval, tapers; pieces of a run.
#include "recover/spectrum/spectra.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/error.hpp"
#include "recover/spectrum/fft.hpp"
#include "recover/spectrum/lines.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

Piece cycle_piece(int n) {
  return {.name = "cycle", .count = n, .step_s = 0.06 / n, .periodic = true};
}

RowMatrix tone(const Piece& piece, double amplitude, double hz, double phase, double mean) {
  RowMatrix x(piece.count, 1);
  for (int64_t i = 0; i < piece.count; ++i) {
    const double t = piece.start_s() + static_cast<double>(i) * piece.step_s;
    x(i, 0) = mean + amplitude * std::cos(2 * std::numbers::pi * hz * t + phase);
  }
  return x;
}

TEST(Spectra, TransformEqualsTheDefinition) {
  for (int n : {1, 2, 3, 8, 15, 49, 97}) {  // also odd and prime lengths
    const Eigen::VectorXd x = test::random_vector(n);
    const Eigen::VectorXcd X = real_fft(x);
    ASSERT_EQ(X.size(), n / 2 + 1);
    for (int k = 0; k <= n / 2; ++k) {
      std::complex<double> sum = 0.0;
      for (int i = 0; i < n; ++i) sum += x[i] * std::polar(1.0, -2 * std::numbers::pi * k * i / n);
      EXPECT_LT(std::abs(X[k] - sum), 1e-13 * n) << n << " " << k;
    }
  }
}

TEST(Spectra, ToneOnALineHasItsAmplitudeAndPhaseWhereverTheSamplesBegin) {
  for (double first_s : {0.0, 0.0123, -0.3}) {
    Piece piece = cycle_piece(720);
    piece.first_s = first_s;
    piece.ftdc_s = 0.017;
    const double hz = 37 / 0.06;
    const LineSpectrum s = line_spectrum(piece, tone(piece, 2.5, hz, 0.6, 1.25), 1e9);
    EXPECT_NEAR(s.frequency_hz[37], hz, 1e-10);
    // x = Re X e^{+i w t}: a phase of +0.6 is the argument of X. 1e-11: 37 turns of rounding.
    EXPECT_LT(std::abs(s.amplitude(37, 0) - std::polar(2.5, 0.6)), 1e-11);
    EXPECT_NEAR(s.amplitude(0, 0).real(), 1.25, 1e-13);
    EXPECT_LT(s.amplitude.col(0).cwiseAbs().sum() - 2.5 - 1.25, 1e-9);  // nothing leaks
  }
}

TEST(Spectra, ParsevalHoldsForEvenAndOddLengths) {
  for (int n : {720, 721}) {
    const RowMatrix x = test::random_matrix<RowMatrix>(n, 3);
    const LineSpectrum s = line_spectrum(cycle_piece(n), x, 1e9);
    for (int c = 0; c < 3; ++c) {
      const double lines = s.power_factor.dot(s.amplitude.col(c).cwiseAbs2());
      EXPECT_NEAR(lines / (x.col(c).squaredNorm() / n), 1.0, 1e-13);
    }
  }
}

TEST(Spectra, TapersKeepAmplitudesOfTonesAndPowerOfNoise) {
  for (Taper taper : {Taper::kNone, Taper::kHann, Taper::kTukey, Taper::kFlatTop}) {
    Piece piece = cycle_piece(4096);
    piece.periodic = false;
    piece.taper = taper;
    const LineSpectrum s = line_spectrum(piece, tone(piece, 2.0, 200 / 0.06, 0.3, 5.0), 1e9);
    // Side lobes of the tone's negative frequency: 2e-10 at most.
    EXPECT_LT(std::abs(s.amplitude(200, 0) - std::polar(2.0, 0.3)), 2e-9) << name_of(taper);
    EXPECT_LT(std::abs(s.amplitude(0, 0)), 1e-12);
    EXPECT_NEAR(s.power_factor.dot(s.amplitude.col(0).cwiseAbs2()), 2.0, 4e-9) << name_of(taper);
  }
}

TEST(Spectra, FlatTopReadsAToneBetweenLinesWithinATenthOfADecibel) {
  Piece piece = cycle_piece(4096);
  piece.periodic = false;
  piece.taper = Taper::kFlatTop;
  const LineSpectrum s = line_spectrum(piece, tone(piece, 1.0, 200.5 / 0.06, 0.0, 0.0), 1e9);
  EXPECT_NEAR(20 * std::log10(s.amplitude.col(0).cwiseAbs().maxCoeff()), 0.0, 0.1);
}

TEST(Spectra, LinesEndAtTheLimitAskedFor) {
  const LineSpectrum s =
      line_spectrum(cycle_piece(720), test::random_matrix<RowMatrix>(720, 1), 1000.0);
  EXPECT_NEAR(s.frequency_hz[s.frequency_hz.size() - 1], 1000.0, 1e-9);  // order 30 at 2000 rpm
}

RunClock steady_clock(int samples_a_cycle, int n_t, double first_deg) {
  RunClock clock;
  clock.step_s = 0.06 / samples_a_cycle;
  clock.time = Eigen::VectorXd::LinSpaced(n_t, 0.0, clock.step_s * (n_t - 1));
  clock.angle_deg = first_deg + clock.time.array() * 12000.0;
  return clock;
}

TEST(Pieces, LastCycleLeavesOutTheRepeatedSampleAndFindsFiringTdc) {
  const Piece piece = last_cycle(steady_clock(720, 1441, 0.0), "run");
  EXPECT_EQ(piece.first, 720);
  EXPECT_EQ(piece.count, 720);
  EXPECT_NEAR(piece.ftdc_deg, 720.0, 1e-9);
  EXPECT_NEAR(piece.start_s(), 0.0, 1e-12);
  const Piece later = last_cycle(steady_clock(720, 1441, -360.0), "run");
  EXPECT_NEAR(later.ftdc_deg, 720.0, 1e-9);
  EXPECT_NEAR(later.start_s(), -0.03, 1e-12);
}

TEST(Pieces, WindowLiesAboutTheLastFiringTdcThatFits) {
  const Piece piece =
      window(steady_clock(720, 1441, 0.0), {"ftdc", {-10, 60, false}, Taper::kHann}, "run");
  EXPECT_EQ(piece.first, 710);
  EXPECT_EQ(piece.count, 70);
  EXPECT_NEAR(piece.ftdc_deg, 720.0, 1e-9);
  const Piece seconds =
      window(steady_clock(720, 1441, 0.0), {"w", {0.01, 0.02, true}, Taper::kNone}, "run");
  EXPECT_EQ(seconds.first, 120);
  EXPECT_EQ(seconds.count, 120);
}

TEST(Pieces, WhatTheRunDoesNotHoldIsRefused) {
  test::expect_parts(test::refusal_of([&] { last_cycle(steady_clock(720, 500, 0.0), "run"); }),
                     {"run: output/time: found 500 samples, expected a complete cycle of 720"});
  const RunClock uneven = steady_clock(720, 2000, 0.0);
  test::expect_parts(
      test::refusal_of([&] {
        window(steady_clock(720, 300, 0.0), {"w", {-10, 60, false}, Taper::kNone}, "run");
      }),
      {"run: window 'w': found -10 to 60 deg, expected a span inside the run, 0 to 299"});
  test::expect_parts(test::refusal_of([&] {
                       window(RunClock{uneven.time, {}, uneven.step_s},
                              {"w", {0, 60, false}, Taper::kNone}, "run");
                     }),
                     {"run: window 'w': degrees need a crank that turns: give a span in seconds"});
}

TEST(Lines, FrequencyAboveWhatTheBasisHoldsIsRefused) {
  test::expect_parts(test::refusal_of([&] {
                       frequency_limit({20, 5000}, 3000.0, 1e-5);
                     }),
                     {"spectrum.to_hz: found 5000 Hz, expected at most 3000 Hz, as far as the "
                      "reduced basis holds"});
  test::expect_parts(test::refusal_of([&] {
                       frequency_limit({20, 60000}, 0.0, 1e-5);
                     }),
                     {"spectrum.to_hz: found 60000 Hz, expected at most 50000 Hz, half the "
                      "sampling frequency of the run"});
  EXPECT_NEAR(frequency_limit({20, 0}, 3000.0, 1e-5).to_hz, 3000.0, 1e-12);
  EXPECT_NEAR(frequency_limit({20, 2000}, 3000.0, 1e-5).to_hz, 2000.0, 1e-12);
}

}  // namespace
}  // namespace clatter::recover
