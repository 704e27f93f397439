// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/crank_centre.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {
namespace {

/// Shares of the bearings at `x` in a force at `centre`: those nearest to equal ones that have the
/// resultant and, where the positions differ, the moment of the force.
std::vector<double> bearing_shares(const std::vector<double>& x, double centre) {
  const Eigen::Map<const Eigen::ArrayXd> at(x.data(), std::ssize(x));
  const Eigen::ArrayXd off = at - at.mean();
  const double spread = off.square().sum();
  constexpr double kSame = 1e-6;  // [m2]: bearings closer than 1 mm count as one
  std::vector<double> shares;
  for (const double d : off) {
    const double lever = spread > kSame ? (centre - at.mean()) * d / spread : 0.0;
    shares.push_back(1.0 / static_cast<double>(x.size()) + lever);
  }
  return shares;
}

}  // namespace

PointWeights crank_centre(const CylinderBodies& bodies) {
  System& system = bodies.model.system;
  const int block = bodies.block_index();
  const Eigen::Vector3d centre(bodies.axes().pin.x(), 0.0, 0.0);
  const std::vector<std::string>& bearings = bodies.spec.bore->bearings;
  PointWeights point;
  if (bearings.empty()) {
    point.add(system.frame_coordinate(block, 1, centre), 1.0, 0.0);
    point.add(system.frame_coordinate(block, 2, centre), 0.0, 1.0);
    return point;
  }
  const rom::ReducedModel& model = bodies.block()->model;
  std::vector<double> x;
  for (const auto& set : bearings) x.push_back(model.set(set).position(0, 0));
  const std::vector<double> shares = bearing_shares(x, centre.x());
  Wrench lateral = unit_wrench(1, centre), stroke = unit_wrench(2, centre);  // not yet carried
  for (size_t i = 0; i < bearings.size(); ++i) {
    const int z = set_dof(model, bearings[i], 2, false), y = set_dof(model, bearings[i], 1, false);
    const int stroke_at = system.coordinate(block, z), lateral_at = system.coordinate(block, y);
    point.add(lateral_at, shares[i], 0.0);
    point.add(stroke_at, 0.0, shares[i]);
    lateral -= shares[i] * (model.row_of(y) * model.rigid).transpose();
    stroke -= shares[i] * (model.row_of(z) * model.rigid).transpose();
  }
  constexpr double kCarried = 1e-9;  // [m]
  for (int k = 0; k < 6; ++k) {
    if (std::max(std::abs(lateral(k)), std::abs(stroke(k))) < kCarried) continue;
    point.add(system.frame_coordinate(block, k), lateral(k), stroke(k));
  }
  return point;
}

}  // namespace clatter::dynamics
