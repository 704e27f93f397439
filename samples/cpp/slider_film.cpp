// SPDX-License-Identifier: GPL-3.0-or-later
// The oil film below an inclined slider: load and largest pressure, compared with Reynolds (1886).
//   slider_film [cells]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "dynamics/film/reynolds.hpp"

int main(int argc, char** argv) {
  using namespace clatter::film;
  const int cells = argc > 1 ? std::max(2, std::atoi(argv[1])) : 200;
  const double length = 0.02, width = 1.0, inlet = 20e-6, outlet = 10e-6;  // [m]
  const double viscosity = 0.01, speed = 5.0;                              // [Pa s], [m/s]

  // One row of cells along the axis; walls at both sides, ambient pressure at both ends.
  const PadGrid grid = PadGrid::uniform(0.0, 1.0, 1, 0.0, length, cells, width);
  const Edges edges{Edge::wall(), Edge::wall(), Edge::supply(0.0, 1.0), Edge::supply(0.0, 1.0)};
  Eigen::ArrayXd gap(grid.size());
  for (int j = 0; j < cells; ++j)
    gap[grid.cell(0, j)] = inlet + (outlet - inlet) * grid.axial(j) / length;

  FilmCells film;
  film.set_smooth(gap);
  FilmStage stage;
  stage.viscosity = viscosity;
  stage.speed_axial = 0.5 * speed;  // the mean of both walls
  stage.steady = true;
  Reynolds reynolds(grid, edges, true);
  reynolds.solve(film, {}, stage);

  const double load = (reynolds.pressure() * grid.area()).sum();
  const double unit = viscosity * speed * length * length * width / (outlet * outlet);
  std::printf("load %.6g N, exact %.6g N\n", load, (6.0 * std::log(2.0) - 4.0) * unit);
  std::printf("largest pressure %.4g MPa\n", 1e-6 * reynolds.pressure().maxCoeff());
}
