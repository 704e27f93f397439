// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/spatial_body.hpp"

#include <utility>

#include "dynamics/force/spin_element.hpp"

namespace clatter::dynamics {

using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

std::unique_ptr<Port> SpatialBody::port(const Vector3d& arm, const Matrix3X& shape,
                                        const Matrix3X& slope) const {
  return std::make_unique<SpatialPort>(coordinates, frame, arm, shape, slope);
}

Vector4d SpatialBody::quaternion(const StageState& state) const {
  return frame->quaternion(state.time, gather(state.y, coordinates).segment<4>(kTurn));
}

Vector3d SpatialBody::spin(const StageState& state) const {
  SpatialState at;
  frame->rotate(state.time, gather(state.y, coordinates), gather(state.v_y, coordinates), at);
  return at.w;
}

SpatialBody add_spatial_body(System& system, ModalBody body) {
  SpatialBody added;
  const auto frame = body.frame;
  const std::string name = body.name;
  const VectorXd y_start = body.eta_start, v_start = body.v_start;
  added.body = system.add_body(std::move(body));
  added.frame = frame;
  for (int k = 0; k < kSpatial; ++k) added.coordinates.push_back(system.coordinate(added.body, k));
  for (int k = 0; k < frame->modes(); ++k)
    added.coordinates.push_back(system.modal_coordinate(added.body, kSpatial + k));
  const int own = kSpatial - kTurn + frame->modes();
  system.add_element(std::make_unique<SpinElement>(
      name, std::vector<int>(added.coordinates.begin() + kTurn, added.coordinates.end()), frame,
      y_start.tail(own), v_start.tail(own)));
  return added;
}

}  // namespace clatter::dynamics
