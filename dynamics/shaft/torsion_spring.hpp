// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A torsion spring and damper, with backlash, between two angles.
#include <string>
#include <utility>

#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

struct TorsionLaw {
  double stiffness = 0.0;  // [N m/rad]
  double damping = 0.0;    // [N m s/rad]
  double backlash = 0.0;   // from stop to stop [rad]
};

/// Moment on angle a by x = a - b: - k <|x| - g/2> x/|x| - c x'. Between the stops of the backlash
/// g only the damper acts, as in a cam phaser filled with oil.
class TorsionSpring : public ForceElement {
 public:
  TorsionSpring(std::string name, int a, int b, const TorsionLaw& law)
      : ForceElement({a, b}), name_(std::move(name)), law_(law) {}
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  /// Beyond the stops, with sign [rad].
  double beyond(const Eigen::VectorXd& y) const;
  std::string name_;
  TorsionLaw law_;
};

}  // namespace clatter::dynamics
