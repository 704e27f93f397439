// SPDX-License-Identifier: GPL-3.0-or-later
// Analysis over the crank angle at varying speed: resampling, cycles and windows by angle.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/artefact.hpp"
#include "recover/run/resample.hpp"
#include "recover/spectrum/analysis.hpp"
#include "recover/spectrum/piece_samples.hpp"
#include "synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

using namespace testing;
constexpr double kPi = std::numbers::pi;

TEST(Resampling, TonesBelowThePassbandComeBackWithinTheStatedError) {
  const int n = 400;
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(1777, 30.0, 360.0);
  double worst = 0.0;
  for (double share : {0.0, 0.05, 0.21, 0.5, 0.63, 0.72, 0.79, kPassband})
    for (double phase : {0.0, 0.9, 2.3}) {
      RowMatrix x(n, 1);
      for (int i = 0; i < n; ++i) x(i, 0) = std::cos(kPi * share * i + phase);
      const Eigen::ArrayXd exact = (kPi * share * at.array() + phase).cos();
      worst = std::max(worst, (resample(x, at).col(0).array() - exact).abs().maxCoeff());
    }
  EXPECT_LT(worst, kResamplingError);
  EXPECT_GT(worst, 0.1 * kResamplingError);  // the statement is not idle
}

TEST(Resampling, SamplesThemselvesAndConstantsAreKept) {
  RowMatrix x = RowMatrix::Random(100, 3);
  const Eigen::VectorXd at = Eigen::VectorXd::LinSpaced(50, 25.0, 74.0);
  EXPECT_LT((resample(x, at) - x.middleRows(25, 50)).cwiseAbs().maxCoeff(), 1e-13);
  x.setConstant(4.2);
  const Eigen::VectorXd between = Eigen::VectorXd::LinSpaced(33, 25.0, 70.3);
  EXPECT_LT((resample(x, between).array() - 4.2).abs().maxCoeff(), 1e-13);
}

TEST(Resampling, TimeOfAnAngleConvergesWithOrderSix) {
  double error[2];
  for (int k : {0, 1}) {
    const int n = 40 << k;
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n + 1, 0.0, 1.0);
    const Eigen::VectorXd y = 10.0 * t.array() + (3.0 * t.array()).sin();
    error[k] = 0.0;
    for (int i = 0; i < 300; ++i) {  // inside: ends have one-sided polynomials
      const double exact = 0.2 + 0.6 * i / 300.0;
      error[k] = std::max(
          error[k], std::abs(interpolate(y, t, 10.0 * exact + std::sin(3.0 * exact)) - exact));
    }
  }
  EXPECT_LT(error[1], 1e-9);
  EXPECT_GT(std::log2(error[0] / error[1]), 5.5);
}

/// A shaft that runs up linearly from `from_rpm` to `to_rpm` in `seconds`; the response is exactly
/// cos(order angle) in q, v and a of coordinate 0, and a tone fixed in time in coordinate 1.
struct RunUp {
  double from_rpm = 1200.0, to_rpm = 3600.0, seconds = 0.5, order = 2.0, fixed_hz = 300.0;
  int samples = 8000;
  double angle_deg(double t) const {
    return 6.0 * (from_rpm * t + 0.5 * (to_rpm - from_rpm) / seconds * t * t) - 100.0;
  }
};

std::filesystem::path write_run_up(const std::filesystem::path& folder,
                                   const rom::ReducedModel& model, const RunUp& plan) {
  const auto steady = write_run(folder, model, {}, [&](double) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.size());
    return Motion{zero, zero, zero};
  });
  const int n = plan.samples + 1;
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(n, 0.0, plan.seconds);
  const Eigen::VectorXd angle = time.unaryExpr([&](double t) { return plan.angle_deg(t); });
  RowMatrix x = RowMatrix::Zero(n, model.size());
  x.col(0) = (plan.order * kPi / 180.0 * angle.array() + 0.4).cos() * 3.0;
  x.col(1) = (2.0 * kPi * plan.fixed_hz * time.array()).sin();
  H5File run = H5File::create(folder / "up.run.h5");
  const H5File source = H5File::open(steady);
  write_provenance(run, {"clatter/run/1", "", {}});
  run.write("output/time", time);
  run.write("output/crank_angle_deg", angle);
  for (const char* name : {"bodies/block/q", "bodies/block/v", "bodies/block/a"})
    run.write(name, x);
  for (const char* name : {"rom", "rom_sha256"})
    run.set("bodies/block", name, source.get_string("bodies/block", name));
  run.commit();
  return folder / "up.run.h5";
}

class Orders : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fresh_folder(test->name());
    T_ = RowMatrix::Zero(mesh_.nodes.size(), 2);
    for (Eigen::Index a = 0; a < mesh_.nodes.rows(); ++a) T_(3 * a, 0) = T_(3 * a + 1, 1) = 1.0;
    model_ = model_on(mesh_, T_, 0.0);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Analysis analyse_piece(const RunBody& body, const Piece& piece) const {
    const SkinGeometry geometry = measure_skin(mesh_.nodes, mesh_.triangles);
    const auto panels = choose_panels({{.name = "skin"}}, model_.skin, geometry);
    const rom::SkinRows T(T_);
    const auto forms = normal_velocity_forms(model_.skin, T, geometry, panels);
    static const std::vector<Sensor> sensors = find_sensors({}, model_, T, geometry);
    return analyse(body, piece, Options{}, 1e9, forms, sensors);
  }

  std::filesystem::path folder_;
  Mesh6 mesh_ = box({1, 1, 1}, 1);
  RowMatrix T_;
  rom::ReducedModel model_;
};

TEST_F(Orders, OrderTwoOfAChirpedShaftIsOneLineThatTheTimeTransformSmears) {
  const RunUp plan;
  const RunBody body(write_run_up(folder_, model_, plan), "");
  const Piece piece = last_cycle(body.clock(), "run");
  EXPECT_EQ(piece.domain, Domain::kAngle);
  EXPECT_NEAR(piece.step_deg * static_cast<double>(piece.count), 720.0, 1e-9);
  const Analysis a = analyse_piece(body, piece);
  const Eigen::VectorXd orders = a.velocity.frequency_hz / a.speed_hz;
  EXPECT_NEAR(orders[4], 2.0, 1e-12);
  const Eigen::VectorXcd line = a.sensors[0].velocity_lines.col(0);
  // Order 2 lies at 0.01 of the passband, where the resampling is as accurate as stated.
  EXPECT_LT(std::abs(line[4] - std::polar(3.0, 0.4)), 3.0 * kResamplingError);
  Eigen::VectorXd others = line.cwiseAbs();
  others[4] = 0.0;
  EXPECT_LT(others.maxCoeff(), 3.0 * kResamplingError);
  // Half of the area moves with it, along x: <v_n^2> = 1/3 3^2 / 2.
  EXPECT_NEAR(a.panels[0].mean_square_velocity[4], 1.5, 1e-4);

  // Over time the same tone is spread over the 80 Hz that the order sweeps: by the method of
  // stationary phase its highest line is A / (T sqrt(160 Hz/s)) / mean(w) = 0.32 A.
  const Span all{0.0, plan.seconds, true};
  const Analysis time = analyse_piece(
      body, window(body.clock(), {.name = "t", .span = all, .taper = Taper::kHann}, "run"));
  const double highest = time.sensors[0].velocity_lines.col(0).cwiseAbs().maxCoeff();
  EXPECT_NEAR(highest / 3.0, 0.32, 0.02);
}

TEST_F(Orders, WindowOverTheAngleFollowsTheOrderThroughTheEntireRunUp) {
  const RunUp plan;
  const RunBody body(write_run_up(folder_, model_, plan), "");
  WindowRule rule{.name = "run_up", .span = {0.0, 5760.0}, .taper = Taper::kHann};
  rule.domain = Domain::kAngle;
  const Analysis whole = analyse_piece(body, window(body.clock(), rule, "run"));
  // 16 revolutions: lines 1/16 order apart, order 2 is line 32.
  EXPECT_NEAR(whole.velocity.frequency_hz[32] / whole.speed_hz, 2.0, 1e-9);
  EXPECT_NEAR(std::abs(whole.sensors[0].velocity_lines(32, 0)), 3.0, 3e-5);
  // The speed varies threefold: orders end where they leave the passband at the highest speed.
  const double last = whole.velocity.frequency_hz.tail(1)[0] / whole.speed_hz;
  EXPECT_NEAR(last, kPassband * 0.5 / body.clock().step_s / whole.piece.highest_speed_hz, 0.1);

  rule.segments = {.length = 1440.0, .overlap = 0.5};
  const Analysis averaged = analyse_piece(body, window(body.clock(), rule, "run"));
  EXPECT_EQ(averaged.piece.segments(), 7);
  // Mean square of a tone of amplitude 3, in the three lines of a Hann taper: 4.5.
  EXPECT_NEAR(averaged.sensors[0].velocity_powers.col(0).segment(6, 5).sum(), 4.5, 1e-4);
}

TEST_F(Orders, TimesAndAnglesOfTheValuesBelongTogether) {
  const RunUp plan;
  const RunBody body(write_run_up(folder_, model_, plan), "");
  const Piece piece = last_cycle(body.clock(), "run");
  const Analysis a = analyse_piece(body, piece);
  // Solve angle(t) = 720 n for the time of firing TDC, then compare each value.
  const double b = 0.5 * (plan.to_rpm - plan.from_rpm) / plan.seconds;
  const double c = -(piece.ftdc_deg + 100.0) / 6.0;
  const double ftdc =
      (-plan.from_rpm + std::sqrt(plan.from_rpm * plan.from_rpm - 4 * b * c)) / (2 * b);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < a.time_s.size(); ++i)
    worst = std::max(
        worst, std::abs(plan.angle_deg(a.time_s[i] + ftdc) - piece.ftdc_deg - a.angle_deg[i]));
  EXPECT_LT(worst, 1e-6);  // degrees
}

TEST_F(Orders, CycleThatIsNoIntegerNumberOfStepsIsAnalysedByAngle) {
  // Steady at 2000 rpm, 700.3 steps a cycle: order 12 comes back with its amplitude and phase.
  RunUp plan{.from_rpm = 2000.0, .to_rpm = 2000.0, .order = 12.0};
  plan.seconds = 0.06 * 8000 / 700.3;
  const RunBody body(write_run_up(folder_, model_, plan), "");
  ASSERT_TRUE(body.clock().steady());
  const Analysis a = analyse_piece(body, last_cycle(body.clock(), "run"));
  EXPECT_EQ(a.piece.domain, Domain::kAngle);
  EXPECT_NEAR(a.velocity.frequency_hz[24], 400.0, 1e-6);
  EXPECT_LT(std::abs(a.sensors[0].velocity_lines(24, 0) - std::polar(3.0, 0.4)),
            3.0 * kResamplingError);
  EXPECT_GT(piece_samples(body, a.piece, "v", -a.piece.count, a.piece.count)->rows(), 0);
  EXPECT_LT(
      cycle_to_cycle_difference(body, a.piece, {"skin", 1.0, Eigen::MatrixXd{{1, 0}, {0, 0}}}),
      1e-5);
}

TEST_F(Orders, NothingAliasesBelowTheLimitOfTheOrders) {
  // A tone fixed in time near half the sampling frequency: resampled with too few values a cycle it
  // would fold onto low orders. What remains below the limit is the taper's and the kernel's error.
  RunUp plan{.fixed_hz = 7900.0};  // of 8000
  const RunBody body(write_run_up(folder_, model_, plan), "");
  WindowRule rule{.name = "w", .span = {0.0, 2880.0}, .taper = Taper::kHann};
  rule.domain = Domain::kAngle;
  const Piece piece = window(body.clock(), rule, "run");
  const RowMatrix v = piece_samples(body, piece, "v");
  const LineSpectrum lines = line_spectrum(piece, v, 1000.0);
  EXPECT_LT(lines.amplitude.col(1).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_GT(v.col(1).cwiseAbs().maxCoeff(), 0.1);  // it is there
}

TEST_F(Orders, RunsTooShortOrTooSlowAreRefused) {
  RunUp plan{.from_rpm = 1200.0, .to_rpm = 1500.0, .seconds = 0.0999, .samples = 100};
  const RunBody body(write_run_up(folder_, model_, plan), "");
  test::expect_parts(test::refusal_of([&] { last_cycle(body.clock(), "run"); }),
                     {"run: output/crank_angle_deg: found", "20 samples at each end"});
  WindowRule rule{.name = "w", .span = {0.0, 800.0}};
  rule.domain = Domain::kAngle;
  test::expect_parts(test::refusal_of([&] { window(body.clock(), rule, "run"); }),
                     {"run: window 'w': found", "expected a span inside"});
  RunUp start{.from_rpm = 10.0, .to_rpm = 3000.0};
  const RunBody slow(write_run_up(folder_, model_, start), "");
  rule.span = {0.0, 0.4, true};
  rule.span.from = 0.002;
  test::expect_parts(test::refusal_of([&] { window(slow.clock(), rule, "run"); }),
                     {"run: 'w': found speeds of", "expected at most a ratio of 20"});
}

}  // namespace
}  // namespace clatter::recover
