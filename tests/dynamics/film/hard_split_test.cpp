// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case N7: the split into full and cavitated cells on large grids.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "film_march.hpp"
#include "tests/observed.hpp"

namespace clatter::film {
namespace {

/// Solves of the first stage of a full ring with eccentricity `eps` whose shaft moves towards the
/// thinnest gap.
int solves_of_ring(double eps, int around, int along) {
  const double pi = std::numbers::pi, clearance = 50e-6, radius = 25e-3;
  const PadGrid grid =
      PadGrid::uniform(0.0, 2.0 * pi, around, -radius, radius, along, radius, true);
  Reynolds film(grid, {Edge::wall(), Edge::wall(), Edge{}, Edge{}}, true);
  Eigen::ArrayXd h(grid.size()), rate(grid.size());
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      h[grid.cell(i, j)] = clearance * (1.0 + eps * std::cos(grid.angle(i)));
      rate[grid.cell(i, j)] = 0.1 * std::cos(grid.angle(i));
    }
  const double kappa = 1e-6;
  const int solves = film.solve(smooth(h), h - kappa * rate, {.kappa = kappa, .viscosity = 0.01});
  EXPECT_LT(film.residual(), 1e-10);
  int full = 0;
  for (int c = 0; c < grid.size(); ++c) full += film.is_full(c);
  std::printf("N7: ring %3d x %2d, eps %.2f: %d solves, %d cells full\n", around, along, eps,
              solves, full);
  return solves;
}

// The edge of the cavity moves by about 48 cells on either side, one in each solve. With one-by-one
// moves after 40 solves it took 353.
TEST(HardFilm, HardN7_SolvesFollowTheWayOfTheCavityEdge) {
  test::expect_at_most("solves of a ring of 360 x 16 cells", solves_of_ring(0.9, 360, 16), 60);
}

}  // namespace
}  // namespace clatter::film
