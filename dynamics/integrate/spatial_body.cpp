// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/spatial_body.hpp"

#include <utility>

#include "dynamics/element/spin_element.hpp"

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

std::vector<int> coordinates_in_space(System& system, int body) {
  const int modes = system.bodies()[body].frame->modes();
  std::vector<int> y;
  for (int k = 0; k < kSpatial; ++k) y.push_back(system.coordinate(body, k));
  for (int k = 0; k < modes; ++k) y.push_back(system.modal_coordinate(body, kSpatial + k));
  return y;
}

SpatialBody add_rotation(System& system, int body) {
  const ModalBody& owner = system.bodies()[body];
  const SpatialBody added{body, coordinates_in_space(system, body), owner.frame};
  const int own = kSpatial - kTurn + owner.frame->modes();
  system.add_element(std::make_unique<SpinElement>(
      owner.name, std::vector<int>(added.coordinates.begin() + kTurn, added.coordinates.end()),
      owner.frame, owner.eta_start.tail(own), owner.v_start.tail(own)));
  return added;
}

SpatialBody add_spatial_body(System& system, ModalBody body) {
  return add_rotation(system, system.add_body(std::move(body)));
}

}  // namespace clatter::dynamics
