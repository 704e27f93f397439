// SPDX-License-Identifier: GPL-3.0-or-later
// Windows of several segments: averaged powers.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "core/base/artefact.hpp"
#include "recover/spectrum/analysis.hpp"
#include "recover/spectrum/piece_samples.hpp"
#include "synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;

/// White noise of variance 1 in two coordinates.
MotionLaw noise() {
  auto random = std::make_shared<std::mt19937_64>(5);
  return [random](double) {
    std::normal_distribution<double> normal;
    Motion m;
    m.q = m.v = m.a = Eigen::Vector2d(normal(*random), normal(*random));
    return m;
  };
}

class Averages : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fresh_folder(test->name());
    mesh_ = box({1, 1, 1}, 1);
    T_ = RowMatrix::Zero(mesh_.nodes.size(), 2);
    for (Eigen::Index a = 0; a < mesh_.nodes.rows(); ++a) T_(3 * a, 0) = T_(3 * a + 1, 1) = 1.0;
    model_ = model_on(mesh_, T_, 0.0);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Analysis analyse_window(const RunBody& body, const WindowRule& rule, double to_hz = 1e9) const {
    const SkinGeometry geometry = measure_skin(mesh_.nodes, mesh_.triangles);
    const auto panels = choose_panels({{.name = "skin"}}, model_.skin, geometry);
    const rom::SkinRows T(T_);
    const auto forms = normal_velocity_forms(model_.skin, T, geometry, panels);
    static const std::vector<Sensor> sensors = find_sensors({}, model_, T, geometry);
    return analyse(body, window(body.clock(), rule, "run"), Options{}, to_hz, forms, sensors);
  }

  std::filesystem::path folder_;
  Mesh6 mesh_;
  RowMatrix T_;
  rom::ReducedModel model_;
};

TEST_F(Averages, OneSegmentIsTheUndividedWindowToTheBit) {
  const RunBody body(write_run(folder_, model_, {}, noise()), "");
  const WindowRule undivided{.name = "w", .span = {-300.0, 200.0}, .taper = Taper::kHann};
  WindowRule one = undivided;
  one.segments = {.length = 500.0, .overlap = 0.75};
  const Analysis a = analyse_window(body, undivided), b = analyse_window(body, one);
  EXPECT_EQ(b.piece.segments(), 1);
  EXPECT_EQ(a.piece.count, b.piece.segment);
  EXPECT_EQ(a.panels[0].erp, b.panels[0].erp);
  EXPECT_EQ(a.panels[0].band_erp_dba, b.panels[0].band_erp_dba);
  EXPECT_EQ(a.velocity.amplitude, b.velocity.amplitude);
  EXPECT_EQ(a.sensors[0].acceleration_lines, b.sensors[0].acceleration_lines);
  EXPECT_EQ(equivalent_averages(a.piece), 1.0);
}

TEST_F(Averages, BlocksOfAPieceAreItsSamplesToTheBit) {
  const RunBody body(write_run(folder_, model_, {.cycles = 4}, noise()), "");
  for (const Domain domain : {Domain::kTime, Domain::kAngle}) {
    WindowRule rule{.name = "w", .span = {-300.0, 701.0}};
    rule.domain = domain;
    const Piece piece = window(body.clock(), rule, "run");
    const RowMatrix all = piece_samples(body, piece, "a");
    int64_t next = 0, blocks = 0;
    for_each_block(body, piece, "a", 1 << 20, [&](int64_t first, const RowMatrix& rows) {
      EXPECT_EQ(first, next);
      EXPECT_LE(rows.rows(), 64);
      EXPECT_EQ(rows, all.middleRows(first, rows.rows()));
      next += rows.rows();
      ++blocks;
    });
    EXPECT_EQ(next, piece.count);
    EXPECT_GT(blocks, 10);
  }
  EXPECT_EQ(block_rows(1000), 2096);  // 16.8 MB of 8 bytes
  EXPECT_EQ(block_rows(0) % 4, 0);
}

TEST_F(Averages, PowersAreTheMeanOfTheSegmentsAnalysedOneByOne) {
  const RunBody body(write_run(folder_, model_, {.cycles = 4}, noise()), "");
  WindowRule rule{.name = "w", .span = {0.0, 2880.0}, .taper = Taper::kHann};
  rule.segments = {.length = 600.0, .overlap = 0.6};
  const Analysis all = analyse_window(body, rule);
  // 2880 samples, segments of 600, each 240 after the last: 1 + (2880 - 600) / 240 = 10.
  ASSERT_EQ(all.piece.segments(), 10);
  EXPECT_EQ(all.piece.segment, 600);
  EXPECT_EQ(all.piece.hop, 240);
  Eigen::VectorXd erp = Eigen::VectorXd::Zero(301);
  Eigen::MatrixXd sensor = Eigen::MatrixXd::Zero(301, 1);
  for (int k = 0; k < 10; ++k) {
    WindowRule one{.name = "w", .taper = Taper::kHann};
    const double step = body.clock().step_s;
    one.span = {240 * k * step, (240 * k + 600) * step, true};
    const Analysis segment = analyse_window(body, one);
    ASSERT_EQ(segment.piece.count, 600);
    erp += segment.panels[0].erp / 10.0;
    const auto& lines = segment.sensors[0].acceleration_lines;
    sensor += segment.velocity.power_factor.asDiagonal() * lines.cwiseAbs2() / 10.0;
  }
  EXPECT_LT((all.panels[0].erp - erp).norm(), 1e-13 * erp.norm());
  EXPECT_LT((all.sensors[0].acceleration_powers - sensor).norm(), 1e-13 * sensor.norm());
  EXPECT_EQ(all.velocity.amplitude.size(), 0);
  EXPECT_EQ(all.sensors[0].velocity_lines.size(), 0);
  EXPECT_EQ(all.panels[0].instant_mean_square.size(), 2880);
}

TEST_F(Averages, NoiseScattersAsTheEquivalentNumberOfAveragesSays) {
  const RunBody body(write_run(folder_, model_, {.cycles = 60}, noise()), "");
  for (const double overlap : {0.0, 0.5, 0.75}) {
    WindowRule rule{.name = "w", .span = {0.0, 43200.0}, .taper = Taper::kHann};
    rule.segments = {.length = 2000.0, .overlap = overlap};
    const Analysis a = analyse_window(body, rule);
    const Eigen::VectorXd lines = a.sensors[0].acceleration_powers.col(0).segment(10, 980);
    const double mean = lines.mean();
    // Variance 1 over 1000 lines of one-sided spectrum, without the noise bandwidth of the taper
    // in their sum (power_factor is divided by it): 1.
    EXPECT_NEAR(a.sensors[0].acceleration_powers.sum(), 1.0, 0.02) << overlap;
    const double scatter = std::sqrt((lines.array() - mean).square().mean()) / mean;
    const double expected = 1.0 / std::sqrt(equivalent_averages(a.piece));
    // Neighbouring lines of the Hann taper depend on each other: about 500 independent values, 3 %.
    EXPECT_NEAR(scatter / expected, 1.0, 0.12) << overlap;
  }
}

TEST_F(Averages, OverlapOfHannSegmentsCountsAsWelchSays) {
  // Welch 1967: for half-overlapping segments of a Hann taper rho_1 = 1/36.
  Piece window{.name = "w", .count = 100 * 1000, .step_s = 1e-4, .taper = Taper::kHann};
  window.segment = 2000;
  window.hop = 1000;
  const double n = 99.0;
  EXPECT_NEAR(equivalent_averages(window), n / (1.0 + 2.0 * (n - 1.0) / n / 36.0), 1e-6 * n);
  window.hop = 2000;
  EXPECT_NEAR(equivalent_averages(window), 50.0, 1e-12);
}

TEST_F(Averages, SegmentsThatDoNotFitAreRefused) {
  const RunBody body(write_run(folder_, model_, {}, noise()), "");
  const auto refusal = [&](SegmentRule segments) {
    WindowRule rule{.name = "w", .span = {-300.0, 200.0}};
    rule.segments = segments;
    return test::refusal_of([&] { window(body.clock(), rule, "run"); });
  };
  EXPECT_EQ(refusal({.length = 720.0}),
            "run: window 'w': found segments of 720 deg, 720 samples, expected 8 to 500 samples");
  EXPECT_EQ(refusal({.length = 5e-4, .in_seconds = true}),
            "run: window 'w': found segments of 0.0005 s, 6 samples, expected 8 to 500 samples");
}

}  // namespace
}  // namespace clatter::recover
