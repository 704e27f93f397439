// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gyroscopic moments of a disc.
#include <string>
#include <utility>
#include <vector>

#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// Moments on the tilts r1, r2 of a disc that spins with a': the change of its axial angular
/// momentum I_p a' (w + t x w), in axes that do not turn (Genta 2005, chapter 2),
///
///   M_1 = - I_p a' r2',   M_2 = I_p a' r1'
///
/// To first order in tilt; they do no work.
class DiscGyroscope : public ForceElement {
 public:
  /// @param coordinates y indices of r1, r2 and the large angle; r1, r2 and the shaft's axis are
  /// right-handed. @param polar moment of inertia [kg m2].
  DiscGyroscope(std::string name, std::vector<int> coordinates, double polar)
      : ForceElement(std::move(coordinates)), name_(std::move(name)), polar_(polar) {}
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return {}; }

 private:
  std::string name_;
  double polar_;
};

}  // namespace clatter::dynamics
