// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases R2, R3, R4 of the film kernel.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "film_march.hpp"
#include "tests/observed.hpp"

namespace clatter::film {
namespace {

// A skirt pad: barrel, tilt and waves; not symmetric in any way.
Eigen::ArrayXd skewed_gap(const PadGrid& grid, double mirror_angle, double mirror_axial) {
  Eigen::ArrayXd h(grid.size());
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j) {
      const double a = mirror_angle * grid.angle(i), z = mirror_axial * grid.axial(j) / 0.035;
      h[grid.cell(i, j)] = 1e-6 * (8.0 + 20.0 * (z - 0.2) * (z - 0.2) + 15.0 * a * a + 4.0 * a * z +
                                   3.0 * std::sin(5.0 * a + 2.0 * z));
    }
  return h;
}

PadGrid symmetric_pad() { return PadGrid::uniform(-0.7, 0.7, 14, -0.035, 0.035, 16, 0.0535); }

void expect_complementary(const Reynolds& film) {
  double worst = 0.0;
  for (int c = 0; c < film.grid().size(); ++c) {
    worst = std::max(worst, film.pressure()[c] * (1.0 - film.fill()[c]));
    EXPECT_GE(film.pressure()[c], 0.0);
    EXPECT_LE(film.fill()[c], 1.0);
    EXPECT_GE(film.fill()[c], 0.0);
  }
  EXPECT_LT(worst, 1e-10);            // required; [Pa], zero by construction
  EXPECT_LT(film.residual(), 1e-10);  // required
}

TEST(HardFilm, HardR2_SwitchingCavitiesStayComplementaryAndConserveMass) {
  // A pad that slides up and down while its gap oscillates: cavities open, move, close and reverse.
  const PadGrid grid = symmetric_pad();
  Reynolds film(grid, {}, true);
  const double dt = 1e-4;
  Eigen::ArrayXd content = 0.4 * skewed_gap(grid, 1.0, 1.0);
  double volume = (content * grid.area()).sum(), worst = 0.0, crossed = 0.0;
  const double start = volume;
  int most = 0, cavities = 0, total = 0;
  for (int k = 1; k <= 600; ++k) {
    const double t = k * dt;
    const Eigen::ArrayXd h = skewed_gap(grid, 1.0, 1.0) * (1.0 + 0.5 * std::sin(300.0 * t));
    const int solves =
        film.solve(smooth(h), content, {dt, 0.01, 0.0, 5.0 * std::cos(200.0 * t), false});
    most = std::max(most, solves);
    total += solves;
    content = film.fill() * h;
    crossed += film.outflow();
    expect_complementary(film);
    worst = std::max(worst, film.residual());
    for (int c = 0; c < grid.size(); ++c) cavities += !film.is_full(c);
  }
  volume = (content * grid.area()).sum();
  std::printf(
      "R2: worst residual %.1e, most solves in a step %d, mean %.2f, mean cavitated cells %.1f of "
      "%d, volume error %.1e\n",
      worst, most, total / 600.0, cavities / 600.0, grid.size(),
      (volume + crossed - start) / start);
  test::expect_at_most("residual of mass", worst, 1e-10);
  test::expect_at_most("error of the balance of oil", std::abs((volume + crossed) / start - 1.0),
                       1e-11);  // rounding of 600 steps
  EXPECT_GT(cavities, 600);
  EXPECT_LT(most, 40);  // never in the slow one-by-one search
}

TEST(HardFilm, HardR2_DimplesCavitateEachAndReForm) {
  // A textured slider in the manner of Fowell et al. 2007: pockets in a parallel pad, full supply.
  const PadGrid grid = strip(0.0, 20e-3, 800);
  Reynolds film(grid, strip_edges(Edge::supply(1e5, 1.0), Edge::supply(1e5, 1.0)), true);
  const FilmCells cells =
      smooth(along(grid, [](double x) { return std::fmod(x, 4e-3) >= 2e-3 ? 6e-6 : 1e-6; }));
  const int solves = film.solve(cells, {}, {1.0, 0.01, 0.0, 0.5, true});
  expect_complementary(film);
  int cavities = 0;
  for (int c = 1; c < grid.size(); ++c) cavities += film.is_full(c - 1) && !film.is_full(c);
  std::printf("R2: textured slider, %d separate cavities, %d solves\n", cavities, solves);
  EXPECT_GE(cavities, 1);
  // Steady flow: inflow equals outflow.
  EXPECT_LT(std::abs(film.outflow()), 1e-11 * 0.5 * 1e-6);  // of the flow through the land
}

TEST(HardFilm, HardR3_SignFlipOfTheSpeedMirrorsThePressure) {
  const PadGrid grid = symmetric_pad();
  Reynolds forward(grid, {}, true), backward(grid, {}, true);
  const Eigen::ArrayXd h = skewed_gap(grid, 1.0, 1.0), mirrored = skewed_gap(grid, 1.0, -1.0);
  forward.solve(smooth(h), h, {1e-4, 0.01, 0.0, 4.0, false});
  backward.solve(smooth(mirrored), mirrored, {1e-4, 0.01, 0.0, -4.0, false});
  double worst = 0.0;
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j) {
      const int there = grid.cell(i, grid.n_axial() - 1 - j);
      worst = std::max(worst,
                       std::abs(forward.pressure()[grid.cell(i, j)] - backward.pressure()[there]));
    }
  test::expect_at_most("asymmetry of the pressure", worst / forward.pressure().maxCoeff(), 1e-12);
}

TEST(HardFilm, HardR3_ZeroSpeedIsPureSqueezeAndPassingThroughZeroIsSmooth) {
  const int cells = 50;
  const Eigen::ArrayXd h = Eigen::ArrayXd::Constant(cells, 10e-6);
  Reynolds film(strip(0.0, 10e-3, cells), strip_edges(), true);
  const double kappa = 1e-5;
  const Eigen::ArrayXd before = h + kappa * 1e-3;
  Eigen::ArrayXd p_rest;
  for (double speed : {0.0, 1e-9, -1e-9}) {
    film.solve(smooth(h), before, {kappa, 0.01, 0.0, speed, false});
    if (speed == 0.0) p_rest = film.pressure();
    // A full parallel film does not depend on sliding.
    test::expect_at_most("difference from pure squeeze",
                         (film.pressure() - p_rest).abs().maxCoeff() / p_rest.maxCoeff(), 1e-9);
  }
  EXPECT_NEAR(load(film), 1e4 * (1.0 + 2.0 / (cells * cells)),
              1e-3);  // 2/n^2 from the half cells at the ends
}

TEST(HardFilm, HardR4_MirroredSkirtGivesMirroredPressure) {
  const PadGrid grid = symmetric_pad();
  Reynolds one(grid, {}, true), other(grid, {}, true);
  const Eigen::ArrayXd h = skewed_gap(grid, 1.0, 1.0), mirrored = skewed_gap(grid, -1.0, 1.0);
  // Several steps from partial fill, so that cavities are included.
  Eigen::ArrayXd content = 0.8 * h, content_mirrored = 0.8 * mirrored;
  double worst = 0.0, highest = 0.0;
  for (int k = 1; k <= 30; ++k) {
    const double shrink = 1.0 - 0.015 * k;
    one.solve(smooth(shrink * h), content, {1e-4, 0.01, 0.0, 3.0, false});
    other.solve(smooth(shrink * mirrored), content_mirrored, {1e-4, 0.01, 0.0, 3.0, false});
    content = one.fill() * shrink * h;
    content_mirrored = other.fill() * shrink * mirrored;
    highest = one.pressure().maxCoeff();
    for (int i = 0; i < grid.n_angle(); ++i)
      for (int j = 0; j < grid.n_axial(); ++j) {
        const int there = grid.cell(grid.n_angle() - 1 - i, j);
        if (highest > 0.0)
          worst = std::max(
              worst, std::abs(one.pressure()[grid.cell(i, j)] - other.pressure()[there]) / highest);
      }
  }
  std::printf("R4: largest mirror defect %.1e of the peak %.3g Pa\n", worst, highest);
  EXPECT_GT(highest, 0.0);
  test::expect_at_most("asymmetry of the mirrored pressure", worst, 1e-12);
}

TEST(HardFilm, HardR4_SymmetricFilmMakesNoTiltMoment) {
  const PadGrid grid = symmetric_pad();
  Reynolds film(grid, {}, true);
  Eigen::ArrayXd h(grid.size());
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j)
      h[grid.cell(i, j)] =
          5e-6 + 1e-2 * grid.axial(j) * grid.axial(j) + 1e-5 * grid.angle(i) * grid.angle(i);
  film.solve(smooth(h), 1.02 * h, {1e-4, 0.01, 0.0, 0.0, false});
  double moment = 0.0, size = 0.0;
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j) {
      const double part = film.pressure()[grid.cell(i, j)] * grid.axial(j);
      moment += part;
      size += std::abs(part);
    }
  test::expect_at_most("tilt moment of a symmetric film", std::abs(moment) / size, 1e-12);
}

TEST(HardFilm, HardR5_GapSpreadOfAThousandKeepsTheResidual) {
  // h from 1 um to 1 mm: h^3 spreads by 1e9 from cell to cell.
  const PadGrid grid = symmetric_pad();
  Reynolds film(grid, {}, true);
  Eigen::ArrayXd h(grid.size());
  unsigned seed = 3;
  for (int c = 0; c < grid.size(); ++c) {
    seed = seed * 1664525u + 1013904223u;
    h[c] = 1e-6 * std::pow(10.0, 3.0 * static_cast<double>(seed >> 8) / 16777216.0);
  }
  film.solve(smooth(h), h * 1.001, {1e-5, 0.01, 0.0, 5.0, false});
  std::printf("R5: residual %.1e at a spread of h^3 of %.1e\n", film.residual(),
              std::pow(h.maxCoeff() / h.minCoeff(), 3));
  test::expect_at_most("residual of mass", film.residual(), 1e-10);
  expect_complementary(film);
}

}  // namespace
}  // namespace clatter::film
