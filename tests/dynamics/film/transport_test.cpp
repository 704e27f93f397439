// SPDX-License-Identifier: GPL-3.0-or-later
// Oil carried along by the wall where the film is cavitated.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "film_march.hpp"

namespace clatter::film {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A ring of uniform gap in which a hump of oil makes one revolution: mean error of the fill.
double error_after_one_turn(int cells, bool second_order) {
  const PadGrid ring =
      PadGrid::uniform(0.0, kTurn, cells, 0.0, 1.0, 1, 1.0 / kTurn, true);  // 1 m round
  Reynolds film(ring, {Edge::wall(), Edge::wall(), Edge::wall(), Edge::wall()}, true);
  const double gap = 1e-5;
  const FilmCells cells_of_film = smooth(Eigen::ArrayXd::Constant(cells, gap));
  Eigen::ArrayXd fill(cells);
  for (int i = 0; i < cells; ++i)
    fill[i] = 0.5 + 0.4 * std::pow(std::cos(0.5 * (ring.angle(i) - 2.0)), 8);
  const Eigen::ArrayXd first = fill;
  const int steps = 4 * cells;
  const double dt = 1.0 / steps;
  Eigen::ArrayXd content = gap * fill, rate = Eigen::ArrayXd::Zero(cells);
  for (int k = 0; k < steps; ++k) {
    // Trapezoidal rule: second order in time.
    const Eigen::ArrayXd before = content + 0.5 * dt * rate;
    FilmStage stage{0.5 * dt, 0.01, 1.0, 0.0};
    if (second_order) stage.fill_before = &fill;
    film.solve(cells_of_film, k == 0 ? content : before, stage);
    if (k == 0) {
      rate = (gap * film.fill() - content) / stage.kappa;
      const Eigen::ArrayXd again = content + 0.5 * dt * rate;
      film.solve(cells_of_film, again, stage);
      rate = (gap * film.fill() - again) / stage.kappa;
    } else {
      rate = (gap * film.fill() - before) / stage.kappa;
    }
    content = gap * film.fill();
    fill = film.fill();
    EXPECT_NEAR(content.sum() / (gap * first.sum()), 1.0, 1e-12);
    EXPECT_LT(film.residual(), 1e-12);
  }
  return (fill - first).abs().mean();
}

TEST(Transport, ALimitedSlopeCarriesOilWithSecondOrder) {
  const double coarse = error_after_one_turn(40, true), middle = error_after_one_turn(80, true),
               fine = error_after_one_turn(160, true);
  printf("    second order: %.2e %.2e %.2e, orders %.2f %.2f\n", coarse, middle, fine,
         order(coarse, middle), order(middle, fine));
  EXPECT_GT(order(middle, fine), 1.7);
  const double upwind_middle = error_after_one_turn(80, false),
               upwind_fine = error_after_one_turn(160, false);
  printf("    upwind:       %.2e %.2e, order %.2f\n", upwind_middle, upwind_fine,
         order(upwind_middle, upwind_fine));
  EXPECT_LT(order(upwind_middle, upwind_fine), 1.1);
  EXPECT_LT(fine, 0.1 * upwind_fine);
}

TEST(Transport, AFrontOfOilNeitherOvershootsNorUndershoots) {
  const PadGrid grid = strip(0.0, 1.0, 50);
  Reynolds film(grid, strip_edges(Edge::supply(0.0, 0.8), Edge::supply(0.0, 0.2)), true);
  const double gap = 1e-5;
  const FilmCells cells = smooth(Eigen::ArrayXd::Constant(50, gap));
  Eigen::ArrayXd fill = Eigen::ArrayXd::Constant(50, 0.2);
  for (int k = 0; k < 100; ++k) {
    FilmStage stage{0.005, 0.01, 0.0, 1.0};
    stage.fill_before = &fill;
    film.solve(cells, gap * fill, stage);
    const Eigen::ArrayXd next = film.fill();
    fill = next;
    EXPECT_LT(fill.maxCoeff(), 0.8 + 1e-9);
    EXPECT_GT(fill.minCoeff(), 0.2 - 1e-9);
  }
  // After half a second the front is in the middle.
  EXPECT_NEAR(fill.mean(), 0.5, 1e-3);
  EXPECT_GT(fill[20], 0.75);
  EXPECT_LT(fill[30], 0.25);
}

}  // namespace
}  // namespace clatter::film
