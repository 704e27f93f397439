// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

void require_edges(const Eigen::VectorXd& edges, const char* what) {
  if (edges.size() < 2)
    throw InputError(
        fmt::format("film grid: {}: found {} edges, expected at least 2", what, edges.size()));
  for (Eigen::Index i = 1; i < edges.size(); ++i)
    if (!(edges[i] > edges[i - 1]))
      throw InputError(fmt::format("film grid: {}: edge {} is {}, expected more than {}", what, i,
                                   edges[i], edges[i - 1]));
}

}  // namespace

PadGrid::PadGrid(Eigen::VectorXd angle_edges, Eigen::VectorXd axial_edges, double radius,
                 bool periodic)
    : angle_edges_(std::move(angle_edges)),
      axial_edges_(std::move(axial_edges)),
      radius_(radius),
      periodic_(periodic) {
  require_edges(angle_edges_, "angle");
  require_edges(axial_edges_, "axial");
  if (!(radius_ > 0.0))
    throw InputError(fmt::format("film grid: radius: found {}, expected > 0", radius_));
  const double span = angle_edges_[angle_edges_.size() - 1] - angle_edges_[0];
  if (periodic_ && std::abs(span - 2.0 * std::numbers::pi) > 1e-9)
    throw InputError(fmt::format("film grid: periodic span: found {} rad, expected 2 pi", span));
  area_.resize(size());
  for (int i = 0; i < n_angle(); ++i)
    for (int j = 0; j < n_axial(); ++j) area_[cell(i, j)] = arc(i) * height(j);
}

PadGrid PadGrid::uniform(double angle_begin, double angle_end, int n_angle, double axial_begin,
                         double axial_end, int n_axial, double radius, bool periodic) {
  if (n_angle < 1 || n_axial < 1)
    throw InputError(
        fmt::format("film grid: found {} x {} cells, expected at least 1 x 1", n_angle, n_axial));
  return PadGrid(Eigen::VectorXd::LinSpaced(n_angle + 1, angle_begin, angle_end),
                 Eigen::VectorXd::LinSpaced(n_axial + 1, axial_begin, axial_end), radius, periodic);
}

}  // namespace clatter::film
