// SPDX-License-Identifier: GPL-3.0-or-later
// The oil beyond the edges of a pad.
#include <cmath>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

void Reynolds::set_outside_layers(const Eigen::ArrayXd& begin, const Eigen::ArrayXd& end) {
  for (Rim& rim : rims_)
    if (rim.axial) rim.edge.layer = (rim.sign < 0.0 ? begin : end)[rim.cell / grid_.n_axial()];
}

void Reynolds::leaving(const Eigen::ArrayXd& flows, Eigen::ArrayXd& rate) const {
  const int n = grid_.size();
  const auto ends = static_cast<Eigen::Index>(faces_.size() + rims_.size());
  rate = flows.segment(ends, n);
  if (reservoirs_) rate += flows.tail(n);
  Eigen::Index k = 0;
  for (const Face& face : faces_) {
    rate[face.a] += flows[k];
    rate[face.b] -= flows[k++];
  }
  for (const Rim& rim : rims_) rate[rim.cell] += flows[k++];
  rate /= grid_.area();
}

void Reynolds::add_up_edges(const Eigen::ArrayXd& moved, EdgeVolumes& volumes) const {
  volumes.lower.setZero(grid_.n_angle());
  volumes.upper.setZero(grid_.n_angle());
  volumes.sides = volumes.sides_moved = 0.0;
  auto k = static_cast<Eigen::Index>(faces_.size());
  for (const Rim& rim : rims_) {
    const double volume = moved[k++];
    if (rim.axial) {
      (rim.sign < 0.0 ? volumes.lower : volumes.upper)[rim.cell / grid_.n_axial()] += volume;
    } else {
      volumes.sides += volume;
      volumes.sides_moved += std::abs(volume);
    }
  }
  volumes.ends = moved.segment(k, grid_.size()).sum();
  volumes.ends_moved = moved.segment(k, grid_.size()).abs().sum();
  if (!reservoirs_) return;
  volumes.recesses = moved.tail(grid_.size()).sum();
  volumes.recesses_moved = moved.tail(grid_.size()).abs().sum();
}

}  // namespace clatter::film
