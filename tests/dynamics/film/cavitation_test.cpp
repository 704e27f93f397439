// SPDX-License-Identifier: GPL-3.0-or-later
// The oscillating squeeze film of Ausas, Jai and Buscaglia 2009: distinguishes conserving solvers
// from others.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "film_march.hpp"

namespace clatter::film {
namespace {

double gap_at(double t) { return 0.125 * std::cos(4.0 * std::numbers::pi * t) + 0.375; }

double gap_rate(double t) { return -0.5 * std::numbers::pi * std::sin(4.0 * std::numbers::pi * t); }

struct Cycle {
  double rupture = 0.0, close = 0.0, widest = 0.0;
  std::vector<double> widths;  // at .40, .50, .60
};

// d/dx(h^3 dp/dx) = 2 d(theta h)/dt is mu = 1/6; symmetry at 0, p = .025 at 1.
Cycle run(int cells, int steps_per_unit, bool second_order) {
  Reynolds film(strip(0.0, 1.0, cells), strip_edges(Edge::wall(), Edge::supply(0.025, 1.0)), true);
  auto uniform = [cells](double (*value)(double)) {
    return [=](double t) { return Eigen::ArrayXd::Constant(cells, value(t)).eval(); };
  };
  FilmMarch march(film, {uniform(gap_at), uniform(gap_rate)}, {.viscosity = 1.0 / 6.0}, 0.0,
                  Eigen::ArrayXd::Ones(cells));
  auto step = [&](double dt) {
    second_order ? march.step(dynamics::tr_bdf2(), dt) : march.implicit_euler(dt);
  };
  // Cells of the cavity count fully; its last one, at the moving rim, by its oil against its
  // neighbour's.
  auto width = [&] {
    int inside = 0;
    while (inside < cells && !film.is_full(inside)) ++inside;
    if (inside < 2) return static_cast<double>(inside) / cells;
    const double rim = (1.0 - film.fill()[inside - 1]) / (1.0 - film.fill()[inside - 2]);
    return (inside - 1 + std::min(rim, 1.0)) / cells;
  };
  Cycle cycle;
  const double dt = 1.0 / steps_per_unit;
  double p_1 = 0.0, t_1 = 0.0, p_2 = 0.0, t_2 = 0.0;  // p(0) one and two steps ago
  while (march.time() < 0.78 && cycle.close == 0.0) {
    // Around the rupture p(0) falls through zero within 1e-4: the step must resolve it.
    const double t = march.time();
    const bool near_rupture = t > 0.2499 - 1e-9 && t < 0.2501;
    double next = near_rupture ? 2e-6 : dt;
    for (double stop : {0.2499, 0.40, 0.50, 0.60})
      if (t < stop - 1e-12 && t + next > stop - 1e-9) next = stop - t;
    step(next);
    // p(0) = .025 - h'/h^3 continues smoothly: extrapolate the last two values to zero.
    if (cycle.rupture == 0.0 && !film.is_full(0))
      cycle.rupture = t_1 + (t_1 - t_2) * p_1 / (p_2 - p_1);
    p_2 = p_1;
    t_2 = t_1;
    p_1 = film.pressure()[0];
    t_1 = march.time();
    cycle.widest = std::max(cycle.widest, width());
    for (double stop : {0.40, 0.50, 0.60})
      if (std::abs(march.time() - stop) < 1e-9) cycle.widths.push_back(width());
    if (cycle.rupture > 0.0 && film.is_full(0) && march.time() > 0.5) cycle.close = march.time();
  }
  return cycle;
}

TEST(OscillatingSqueeze, CavityOpensGrowsAndClosesAsMassConservationWants) {
  const double widths[] = {0.97322, 0.96091, 0.93722};
  for (bool second_order : {false, true}) {
    double last = 0.0;
    for (int cells : {50, 100, 200, 400}) {
      const Cycle cycle = run(cells, 40 * cells, second_order);
      const double error = cycle.close / 0.74119 - 1.0;
      ASSERT_EQ(cycle.widths.size(), 3u);
      std::printf(
          "oscillating squeeze %s n=%3d  rupture %.7f  widest %.6f (%+.1e)  widths %+.1e %+.1e "
          "%+.1e  closes %.5f (%+.2e, order %.2f)\n",
          second_order ? "TR-BDF2" : "Euler  ", cells, cycle.rupture, cycle.widest,
          cycle.widest / 0.976992 - 1.0, cycle.widths[0] / widths[0] - 1.0,
          cycle.widths[1] / widths[1] - 1.0, cycle.widths[2] / widths[2] - 1.0, cycle.close, error,
          order(last, error));
      last = error;
      if (cells < 200) continue;
      EXPECT_NEAR(cycle.close, 0.74119, 0.01 * 0.74119);
      EXPECT_NEAR(cycle.rupture, 0.2500198, 2e-6);       // the step around the rupture
      EXPECT_NEAR(cycle.widest, 0.976992, 1.0 / cells);  // the rim lies in a cell
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(cycle.widths[k], widths[k], 1.0 / cells);
    }
  }
}

TEST(OscillatingSqueeze, ContentChangesOnlyByWhatCrossesTheEdge) {
  const int cells = 60;
  Reynolds film(strip(0.0, 1.0, cells), strip_edges(Edge::wall(), Edge::supply(0.025, 1.0)), true);
  const double dt = 1e-3;
  Eigen::ArrayXd content = Eigen::ArrayXd::Constant(cells, gap_at(0.0));
  double crossed = 0.0;
  const double start = content.sum() / cells;
  for (int k = 1; k <= 700; ++k) {
    const Eigen::ArrayXd h = Eigen::ArrayXd::Constant(cells, gap_at(k * dt));
    film.solve(smooth(h), content, {dt, 1.0 / 6.0, 0.0, 0.0, false});
    content = film.fill() * h;
    crossed += film.outflow();
  }
  EXPECT_NEAR(content.sum() / cells + crossed, start, 1e-12);  // rounding of 700 steps
}

}  // namespace
}  // namespace clatter::film
