// SPDX-License-Identifier: GPL-3.0-or-later
// The piston-liner contact where the skirt passes the ends of the liner.
#include <algorithm>
#include <cmath>

#include "dynamics/film/pad_state.hpp"

namespace clatter::film {

// Ends that are not given are those of the patches.
void PistonLiner::find_ends(const rom::ContactGrid& grid) {
  LinerEnds& ends = options_.ends;
  if (grid.axial_edges.size() < 2) return;
  const double origin = grid.axis_point.z(), first = grid.axial_edges[0] * grid.axis.z(),
               last = grid.axial_edges[grid.axial_edges.size() - 1] * grid.axis.z();
  if (std::isinf(ends.bottom)) ends.bottom = origin + std::min(first, last);
  if (std::isinf(ends.top)) ends.top = origin + std::max(first, last);
}

void PistonLiner::update_cover(Pad& pad, double height) const {
  pad.ends->at(height, pad.cover);
  const int columns = pad.grid.n_angle();
  pad.area = pad.grid.area() * pad.cover.of_cells(columns);
  pad.area_slope = pad.grid.area() * pad.cover.share_slope.replicate(columns, 1);
}

Eigen::Array<bool, Eigen::Dynamic, 1> PistonLiner::Pad::carrying() const {
  if (!recesses) return area > 0.0;
  return area > 0.0 && recesses->cells.share < 1.0;
}

// Smallest gap that can carry [m]; infinite when the pad is outside the liner.
double PistonLiner::lowest_gap(const Pad& pad) const {
  return pad.carrying().select(pad.gap, INFINITY).minCoeff();
}

// Force along the stroke on the piston where asperities are pressed together as a row slides in
// over the end of the liner: minus the derivative of their energy by height.
double PistonLiner::end_force(const Pad& pad) const {
  return asperity_ && pad.ends ? -(pad.area_slope * pad.contact_energy).sum() : 0.0;
}

// What changes with the cover: the load by the height, and the force at the end of the liner.
void PistonLiner::add_end_tangent(Pad& pad) const {
  const Eigen::VectorXd& height = pad.map.height_by_column();
  Eigen::ArrayXd load_slope = Eigen::ArrayXd::Zero(pad.grid.size());
  if (pad.film) load_slope += pad.area_slope * pad.film->pressure();
  double curve = 0.0;
  if (asperity_) {
    const Eigen::ArrayXd by_gap = pad.area_slope * pad.contact_elastic;
    load_slope += pad.area_slope * pad.contact;
    pad.tangent += height * (pad.gap_by_y.transpose() * by_gap.matrix()).transpose();
    const Eigen::ArrayXd area_curve =
        pad.grid.area() * pad.cover.share_curve.replicate(pad.grid.n_angle(), 1);
    curve = -(area_curve * pad.contact_energy).sum();
  }
  pad.tangent +=
      (pad.gap_by_y.transpose() * load_slope.matrix() + curve * height) * height.transpose();
}

}  // namespace clatter::film
