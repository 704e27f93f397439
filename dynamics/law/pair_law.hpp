// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The interface of laws: forces between two points by their relative motion. Laws know no bodies.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/law/history.hpp"
#include "dynamics/law/stage.hpp"

namespace clatter::dynamics {

/// Distance [m] and relative rates of two points, a as seen by an observer who turns with b, in the
/// engine's axes.
struct PairMotion {
  Eigen::Vector3d distance = Eigen::Vector3d::Zero(), velocity = distance, spin = distance;
};

/// Force and moment on point a of a pair; the reaction on b acts at the same point of space, so
/// that force and moment balance to rounding.
struct PairForce {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = force;  // [N], [N m]
  /// d(force, moment) by d(distance, rotation of a relative to b) and by their rates.
  Matrix6 by_distance = Matrix6::Zero(), by_rate = Matrix6::Zero();
  double stored = 0.0, lost = 0.0;  // [J], [W]
};

/// A law of PairElement, which calls it in the order of ForceElement.
class PairLaw {
 public:
  virtual ~PairLaw() = default;
  /// At a trial state of a stage. Throws StepRefused; the element adds its name.
  virtual PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) = 0;

  // Of laws with a state of their own, such as the oil in a film.
  virtual void begin_step() {}
  virtual void finish_stage(const Stage&) {}
  virtual void accept_step() {}
  virtual std::vector<double> save() const { return {}; }
  virtual void restore(const std::vector<double>&) {}

  /// Scalars of the last accepted state besides the force; their names begin with `name`.
  virtual void record(const std::string& /*name*/, const PairMotion&, const PairForce&,
                      History&) const {}
};

}  // namespace clatter::dynamics
