// SPDX-License-Identifier: GPL-3.0-or-later
// The film of a full journal bearing on a grid.
#include "dynamics/bearing/journal_film.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/base/units.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

const Stage kSteady{0.0, 1e3, 0, {}};  // one implicit step of 1000 s

JournalFilmOptions options_of(double width, int around = 72, int along = 6) {
  JournalFilmOptions options;
  options.size = {24e-3, width, 2e-3, 10e-3};
  options.cells_around = around;
  options.cells_along = along;
  options.groove = 0.5 * std::numbers::pi;  // toward -y: where the gap of a journal at +y is widest
  options.supply_pressure = 0.0;
  return options;
}

/// The steady force at a relative eccentricity; bearings are full at the start.
FilmForce steady(const JournalFilmOptions& options, const Vector2d& e, double spin) {
  JournalFilm film(options);
  const double c = options.size.radial_clearance();
  return film.force({c * e, Vector2d::Zero(), spin}, kSteady, true);
}

TEST(JournalFilm, ASteadyFilmIsThatOfTheImpedances) {
  const JournalFilmOptions options = options_of(12e-3);
  for (const double e : {0.3, 0.6, 0.9}) {
    const Vector2d found = steady(options, {e, 0.0}, 178.0).value.head<2>();
    for (const BearingModel model : {BearingModel::kButenschoen, BearingModel::kMoes}) {
      const double c = options.size.radial_clearance();
      const Vector2d known = BearingFilm(options.size, model)
                                 .force({{c * e, 0.0}, Vector2d::Zero(), 178.0})
                                 .value.head<2>();
      const double turn = (std::atan2(found.y(), found.x()) - std::atan2(known.y(), known.x()));
      std::printf("e %.1f, model %d: %8.2f N, film over impedance %+.1f %%, %+.1f deg\n", e,
                  static_cast<int>(model), found.norm(),
                  100.0 * (found.norm() / known.norm() - 1.0), turn / kDegree);
      // Butenschoen's fit leaves 6 %, Moes' up to 20 % at this width.
      const double left = model == BearingModel::kMoes ? 0.25 : 0.08;
      EXPECT_NEAR(found.norm(), known.norm(), left * known.norm());
      EXPECT_NEAR(turn, 0.0, (model == BearingModel::kMoes ? 6.0 : 4.0) * kDegree);
    }
  }
}

TEST(JournalFilm, TheStaticEccentricityUnderALoadIsThatOfTheReference) {
  // 100 and 1000 N at 1700 rpm: e = .551326, .890935 by Butenschoen (shaft/README.md).
  const double expected[2][2] = {{100.0, 0.551326}, {1000.0, 0.890935}};
  for (const auto& [load, e] : expected) {
    double low = 0.1, high = 0.99;
    for (int i = 0; i < 20; ++i) {
      const double middle = 0.5 * (low + high);
      const double found =
          steady(options_of(16e-3), {middle, 0.0}, 1700.0 * std::numbers::pi / 30.0)
              .value.head<2>()
              .norm();
      (found < load ? low : high) = middle;
    }
    std::printf("%.0f N: e = %.4f, by Butenschoen %.4f\n", load, low, e);
    EXPECT_NEAR(1.0 - low, 1.0 - e, 0.05 * (1.0 - e));  // of the smallest gap; the fit leaves 6 %
  }
}

TEST(JournalFilm, ACentredShortBearingIsSqueezedAsOcvirkSays) {
  // Full film, b/d = 0.05: F = - pi eta R b^3 v / c^3, less the flow around of order (b/d)^2.
  JournalFilmOptions options = options_of(1.2e-3);
  options.cavitation = false;
  options.bulk_modulus = 0.0;
  const double c = options.size.radial_clearance(), v = 1e-3;
  const double exact =
      std::numbers::pi * options.size.viscosity * 12e-3 * std::pow(1.2e-3, 3) / std::pow(c, 3);
  double error[2];
  for (int k = 0; k < 2; ++k) {
    options.cells_along = 4 << k;
    JournalFilm film(options);
    // From centred with the velocity v to v kappa: a short stage, so that it stays centred.
    const Stage stage{0.0, 1e-9, 0, {}};
    const FilmForce found = film.force({{v * stage.kappa, 0.0}, {v, 0.0}, 0.0}, stage, false);
    error[k] = found.value(0) / (-exact * v) - 1.0;
    std::printf("%d cells: %+.3f %%\n", options.cells_along, 100.0 * error[k]);
    EXPECT_NEAR(found.value(1), 0.0, 1e-9 * exact * v);
  }
  EXPECT_NEAR(error[1], 0.0, 0.01);  // 0.5 / 64 by the grid's parabola, (b/d)^2 of the rest
  EXPECT_LT(std::abs(error[1] + 0.001), 0.5 * std::abs(error[0] + 0.001));
}

TEST(JournalFilm, TheForceConvergesWithTheGrid) {
  const Vector2d fine = steady(options_of(12e-3, 288, 24), {0.8, 0.0}, 178.0).value.head<2>();
  double last = 0.0;
  for (const int along : {3, 6, 12}) {
    const Vector2d found =
        steady(options_of(12e-3, 12 * along, along), {0.8, 0.0}, 178.0).value.head<2>();
    const double error = (found - fine).norm() / fine.norm();
    std::printf("%3d x %2d cells: %.3f %%\n", 12 * along, along, 100.0 * error);
    if (last > 0.0) {
      EXPECT_LT(error, 0.6 * last);  // first order at least: where the film ruptures
    }
    last = error;
  }
  EXPECT_LT(last, 0.01);
}

TEST(JournalFilm, ACentredJournalIsDraggedByPetroffsMoment) {
  const JournalFilmOptions options = options_of(16e-3);
  const double spin = 178.0;
  const double petroff = 0.5 * std::numbers::pi * 10e-3 * 16e-3 * 24e-3 * 24e-3 * spin / 2e-3;
  const FilmForce found = steady(options, Vector2d::Zero(), spin);
  EXPECT_NEAR(found.value(2), -petroff, 1e-12 * petroff);
  EXPECT_LT(found.value.head<2>().norm(), 1e-9);
  EXPECT_NEAR(found.by_motion(2, 4) * spin, found.value(2), 1e-12 * petroff);
}

TEST(JournalFilm, AJournalThatTurnsBackwardIsMirrored) {
  JournalFilmOptions options = options_of(12e-3);
  options.groove = 0.0;
  options.supply_pressure = 2e5;
  const FilmForce one = steady(options, {0.5, -0.4}, 178.0),
                  other = steady(options, {-0.5, -0.4}, -178.0);
  const double size = one.value.head<2>().norm();
  EXPECT_GT(size, 10.0);
  EXPECT_NEAR(other.value(0), -one.value(0), 1e-9 * size);
  EXPECT_NEAR(other.value(1), one.value(1), 1e-9 * size);
  EXPECT_NEAR(other.value(2), -one.value(2), 1e-9 * std::abs(one.value(2)));
}

TEST(JournalFilm, DerivativesAreDifferenceQuotients) {
  JournalFilmOptions options = options_of(12e-3, 36, 4);
  const double c = options.size.radial_clearance();
  for (const double kappa : {1e-5, 1e-3}) {
    const Stage stage{0.0, kappa, 0, {}};
    const Vector2d before = c * Vector2d(0.45, -0.3), at = c * Vector2d(0.47, -0.31);
    const auto force = [&](const Vector2d& offset) {
      JournalFilm film(options);  // its content is that of the gap before
      return film.force({offset, (offset - before) / kappa, 178.0}, stage, true);
    };
    const FilmForce found = force(at);
    const double step = 1e-7 * c;
    for (int k = 0; k < 2; ++k) {
      const Vector2d d = step * Vector2d::Unit(k);
      const Eigen::Vector3d difference = (force(at + d).value - force(at - d).value) / (2.0 * step);
      for (int row = 0; row < 3; ++row)
        // No cell changes between full and cavitated within the step.
        EXPECT_NEAR(found.by_motion(row, k), difference(row),
                    1e-5 * found.by_motion.row(row).head<2>().cwiseAbs().maxCoeff())
            << row << " by " << k << " at " << kappa;
    }
  }
}

TEST(JournalFilm, ItsStateIsRestoredAndAJournalThatTouchesIsRefused) {
  const JournalFilmOptions options = options_of(12e-3, 36, 4);
  const double c = options.size.radial_clearance();
  JournalFilm film(options), copy(options);
  const auto step = [&](JournalFilm& one, double e) {
    const Stage stage{0.0, 1e-4, 0, {}};
    one.begin_step();
    const FilmForce found = one.force({{c * e, 0.0}, {0.0, 0.0}, 178.0}, stage, false);
    one.finish_stage(stage);
    one.accept_step();
    return found.value;
  };
  for (const double e : {0.3, 0.5, 0.4}) step(film, e);
  copy.restore(film.save());
  EXPECT_EQ(step(film, 0.45), step(copy, 0.45));
  EXPECT_THROW(copy.restore({1.0}), InputError);
  for (const double e : {1.0, 1.3, std::nan("")}) try {
      step(film, e);
      FAIL() << e;
    } catch (const StepRefused& refused) {
      EXPECT_EQ(refused.kind(), "the journal touches the bearing");
    }
}

}  // namespace
}  // namespace clatter::dynamics
