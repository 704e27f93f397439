// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case R9: fronts of oil that the liner carries below the skirt.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dynamics/film/piston_liner.hpp"
#include "film_march.hpp"
#include "stroke_march.hpp"
#include "tests/observed.hpp"

namespace clatter::film {
namespace {

constexpr double kMicron = 1e-6;

StrokeConditions sliding(double layer, std::function<double(double)> speed) {
  StrokeConditions conditions;
  conditions.layer = layer;
  conditions.speed = std::move(speed);
  return conditions;
}

/// Marches with a given gap and returns the largest part of the oil that was missing; contents are
/// never below 0.
double missing(StrokeMarch& march, int steps, double dt,
               const std::function<Eigen::ArrayXd(double)>& gap) {
  const double first = march.oil();
  double worst = 0.0;
  for (int k = 0; k < steps; ++k) {
    march.step(dynamics::tr_bdf2(), dt, gap);
    EXPECT_GE(march.content().minCoeff(), 0.0);
    worst = std::max(worst, std::abs(march.oil() / first - 1.0));
  }
  return worst;
}

// Ridges on the liner and on the skirt run into each other.
TEST(HardR9, TwoFrontsThatMeetInACell) {
  const int cells = 37;
  StrokeMarch march(cells, sliding(2.0 * kMicron, [](double) { return 3.0; }));
  const Eigen::ArrayXd h =
      march.at_cells([](double z) { return (12.0 + 2000.0 * (z - 0.03) * (z - 0.03)) * kMicron; });
  march.start(
      0.0, [](double z) { return z > 0.01 && z < 0.0177 ? 6.0 * kMicron : 2.0 * kMicron; },
      [](double z) { return z > 0.0301 && z < 0.0404 ? 5.9 * kMicron : 0.0; });
  test::expect_at_most("oil missing", missing(march, 400, 2e-5, [&](double) { return h; }), 1e-12);
  EXPECT_GT(march.stages, 0);
}

// The stroke reverses while the ridge is below the edge of full film and below the skirt's edge.
TEST(HardR9, FrontsAtReversalAndAtTheEdges) {
  StrokeMarch march(40, sliding(3.0 * kMicron, [](double t) { return 2.0 * std::sin(400.0 * t); }));
  march.start(
      0.0, [](double z) { return z > 0.052 ? 8.0 * kMicron : 3.0 * kMicron; },
      [](double) { return 0.0; });
  const auto gap = [&](double t) {
    return march.at_cells([t](double z) {
      return (9.0 + 4.0 * std::sin(900.0 * t) + 8000.0 * (z - 0.025) * (z - 0.025)) * kMicron;
    });
  };
  test::expect_at_most("oil missing", missing(march, 1500, 3e-5, gap), 1e-12);
}

// A gap far above its oil closes within a few steps on cells that are dry.
TEST(HardR9, AGapThatClosesOnDryCells) {
  StrokeMarch march(32, sliding(1.0 * kMicron, [](double) { return 5.0; }));
  march.start(
      0.0, [](double) { return 1.0 * kMicron; }, [](double) { return 0.0; });
  const auto gap = [&](double t) {
    return Eigen::ArrayXd::Constant(32, std::max(30.0 * kMicron - 0.5 * t, 0.4 * kMicron)).eval();
  };
  test::expect_at_most("oil missing", missing(march, 100, 1e-6, gap), 1e-12);
  EXPECT_GT(march.load(), 0.0);
}

TEST(HardR9, LayersOfANanometre) {
  StrokeMarch march(32, sliding(1e-9, [](double t) { return 5.0 * std::cos(300.0 * t); }));
  march.start(
      0.0, [](double z) { return z < 0.03 ? 1e-9 : 2e-9; }, [](double) { return 0.0; });
  const Eigen::ArrayXd h = march.at_cells([](double z) { return 20.0 * kMicron + 1e-4 * z; });
  test::expect_at_most("oil missing", missing(march, 1000, 2e-5, [&](double) { return h; }), 1e-11);
}

// One column: the pieces of a step are listed in the time of the cells.
TEST(HardR9, AMillionCells) {
  const int cells = 1000000;
  StrokeMarch march(cells, sliding(2.0 * kMicron, [](double) { return 1.0; }));
  march.start(
      0.0, [](double) { return 2.0 * kMicron; }, [](double) { return 0.0; });
  const Eigen::ArrayXd h = Eigen::ArrayXd::Constant(cells, 20.0 * kMicron);
  test::expect_at_most("oil missing", missing(march, 1, 2e-8, [&](double) { return h; }), 1e-9);
  EXPECT_NEAR(march.content().maxCoeff(), 2.0 * kMicron, 1e-9 * kMicron);
}

}  // namespace
}  // namespace clatter::film
