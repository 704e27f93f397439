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

SpatialBody add_rotation(System& system, int body) {
  const ModalBody& owner = system.bodies()[static_cast<size_t>(body)];
  SpatialBody added{body, {}, owner.frame};
  const int modes = owner.frame->modes();
  for (int k = 0; k < kSpatial; ++k) added.coordinates.push_back(system.coordinate(body, k));
  for (int k = 0; k < modes; ++k)
    added.coordinates.push_back(system.modal_coordinate(body, kSpatial + k));
  const int own = kSpatial - kTurn + modes;
  system.add_element(std::make_unique<SpinElement>(
      owner.name, std::vector<int>(added.coordinates.begin() + kTurn, added.coordinates.end()),
      owner.frame, owner.eta_start.tail(own), owner.v_start.tail(own)));
  return added;
}

SpatialBody add_spatial_body(System& system, ModalBody body) {
  return add_rotation(system, system.add_body(std::move(body)));
}

}  // namespace clatter::dynamics
