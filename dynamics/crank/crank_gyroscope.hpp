// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gyroscopic moments of a crankshaft.
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/body/crank_port.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// Moments M_y = -I_p w rz', M_z = I_p w ry' on the tilts of a crankshaft, with the angular
/// velocity w of the clock (Genta 2005, chapter 2). They do no work.
class CrankGyroscope : public ForceElement {
 public:
  /// @param tilts y indices of ry, rz. @param polar moment of inertia [kg m2].
  CrankGyroscope(std::vector<int> tilts, double polar, CrankClock clock, Rotation rotation)
      : ForceElement(std::move(tilts)),
        polar_(polar),
        clock_(std::move(clock)),
        rotation_(rotation) {}
  std::string name() const override { return "gyroscope crankshaft"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd&, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override {
    const double momentum = polar_ * turn_about_x(clock_, rotation_, stage.time).velocity;
    response.force = Eigen::Vector2d(-momentum * v(1), momentum * v(0));
    if (!with_tangent) return;
    response.tangent.setZero(2, 2);
    response.tangent(0, 1) = -momentum / stage.kappa;
    response.tangent(1, 0) = momentum / stage.kappa;
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return {}; }

 private:
  double polar_;
  CrankClock clock_;
  Rotation rotation_;
};

}  // namespace clatter::dynamics
