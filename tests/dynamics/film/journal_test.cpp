// SPDX-License-Identifier: GPL-3.0-or-later
// Journal bearings: long with the Reynolds condition at rupture, short (Ocvirk).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "film_march.hpp"

namespace clatter::film {
namespace {

struct Journal {
  double load, attitude, rupture, peak, residual;
};

// Oil is supplied in full at the widest gap (angle 0), where p = 0: there JFO and the Reynolds
// condition agree, because nothing re-forms downstream of the rupture. R = c = mu = 1, surface
// speed 1.
Journal solve(double eccentricity, int around, double length, int rows) {
  const PadGrid grid =
      PadGrid::uniform(0.0, 2.0 * std::numbers::pi, around, -0.5 * length, 0.5 * length, rows, 1.0);
  const bool is_long = rows == 1;
  const Edge side = is_long ? Edge::wall() : Edge{};
  Reynolds film(grid, {Edge{}, Edge{}, side, side}, true);
  Eigen::ArrayXd h(grid.size());
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < rows; ++j)
      h[grid.cell(i, j)] = 1.0 + eccentricity * std::cos(grid.angle(i));
  const FilmCells cells = smooth(h);
  film.solve(cells, {}, {1.0, 1.0, 0.5, 0.0, true});
  double along_line = 0.0, across_line = 0.0;
  int last_full = 0;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < rows; ++j) {
      const double force = film.pressure()[grid.cell(i, j)] * grid.area()[grid.cell(i, j)];
      along_line -= force * std::cos(grid.angle(i));
      across_line += force * std::sin(grid.angle(i));
      if (film.is_full(grid.cell(i, j))) last_full = std::max(last_full, i);
    }
  return {std::hypot(along_line, across_line),
          std::atan2(across_line, along_line) * 180.0 / std::numbers::pi,
          grid.angle_edges()[last_full + 1] * 180.0 / std::numbers::pi, film.pressure().maxCoeff(),
          film.residual()};
}

TEST(LongJournal, ReynoldsConditionFiguresAreReached) {
  // eps = .5: W* = 6.455556, attitude 58.296 deg, rupture 219.694 deg, p* = 4.474988.
  double last = 0.0;
  for (int around : {90, 180, 360, 720, 1440}) {
    const Journal journal = solve(0.5, around, 1.0, 1);
    const double error = journal.load / 6.455556 - 1.0;
    std::printf(
        "long journal n=%4d W* %.6f (%+.2e, order %.2f) attitude %.4f (%+.1e) rupture %.3f p* %.6f "
        "(%+.1e)\n",
        around, journal.load, error, order(last, error), journal.attitude,
        journal.attitude / 58.296 - 1.0, journal.rupture, journal.peak,
        journal.peak / 4.474988 - 1.0);
    last = error;
    if (around < 1440) continue;
    EXPECT_NEAR(error, 0.0, 1e-4);
    EXPECT_NEAR(journal.attitude, 58.296, 0.02);
    EXPECT_NEAR(journal.rupture, 219.694, 2.0 * 360.0 / around);  // on a face
    EXPECT_NEAR(journal.peak / 4.474988, 1.0, 1e-4);
  }
}

TEST(ShortJournal, LoadTendsToOcvirk) {
  // W = mu U L^3 / c^2 X, X = eps / (4 (1 - eps^2)^2) sqrt(16 eps^2 + pi^2 (1 - eps^2)) = .750381.
  const double limit = 0.750381;
  double last = 0.0;
  for (double length : {0.4, 0.2, 0.1}) {
    const Journal journal = solve(0.5, 360, length, 64);
    const double x = journal.load / (length * length * length);
    const double error = x / limit - 1.0;
    std::printf("short journal L/R=%.2f X %.6f (%+.2e, order %.2f in L)\n", length, x, error,
                order(last, error));
    last = error;
  }
  EXPECT_LT(std::abs(last), 3e-3);  // L^2 and 2 / rows^2
}

TEST(ShortJournal, HardR5_ResidualStaysSmallUpToEccentricity099) {
  for (double eccentricity : {0.1, 0.3, 0.5, 0.7, 0.9, 0.95, 0.99}) {
    const double length = 0.05;
    const Journal journal = solve(eccentricity, 720, length, 32);
    const double q = 1.0 - eccentricity * eccentricity;
    const double x =
        eccentricity / (4.0 * q * q) *
        std::sqrt(16.0 * eccentricity * eccentricity + std::numbers::pi * std::numbers::pi * q);
    std::printf("short journal eps=%.2f  X ratio %.4f  residual %.1e\n", eccentricity,
                journal.load / std::pow(length, 3) / x, journal.residual);
    EXPECT_LT(journal.residual, 1e-10);  // required
    // Short-bearing theory is a limit: the ratio falls off when the pressure ridge gets as short as
    // the bearing.
    EXPECT_NEAR(journal.load / std::pow(length, 3) / x, 1.0, eccentricity < 0.95 ? 0.02 : 0.2);
  }
}

}  // namespace
}  // namespace clatter::film
