// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What impacts need of the elements that are rigid contacts.
#include <Eigen/Core>
#include <optional>

#include "dynamics/body/rotation.hpp"
#include "dynamics/law/impact_law.hpp"

namespace clatter::dynamics {

/// A contact that touches, at a state; vectors along its normal and two tangents.
struct Touch {
  ImpactLaw law;
  Eigen::Vector3d velocity;  // [m/s], the normal one below 0 where it closes
  Eigen::MatrixXd impulses;  // on the element's coordinates by unit impulses, n_e x 3
  Matrix3X by_y, by_v;       // change of `velocity` by changes of the coordinates' y and v, 3 x n_e
};

/// An element that takes part in impacts (impact_law.hpp). Its event function kTouch finds them.
class RigidContact {
 public:
  static constexpr int kTouch = 0;
  virtual ~RigidContact() = default;
  /// None where it does not touch. `y`, `v`: n_e each.
  virtual std::optional<Touch> touch(double time, const Eigen::VectorXd& y,
                                     const Eigen::VectorXd& v) const = 0;
  /// The impact gave it `impulse` along its normal [N s]; `mass` is that of the contact [kg].
  virtual void take_impulse(double impulse, double mass) = 0;
};

}  // namespace clatter::dynamics
