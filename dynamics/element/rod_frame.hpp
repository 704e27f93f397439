// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inertia of the small motions of an elastic rod in its turning frame.
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/body/elastic_rod.hpp"
#include "dynamics/element/crank_angle.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// Terms of eq. (9) of the paper for a rod whose frame is that of the ideal slider-crank, turned by
/// the rod's own deviation theta from it; w = phi' of the ideal rod. Of first order in theta and
/// zeta:
///   on zeta    w^2 S zeta + w' G zeta + 2 w (G zeta' + g theta')
///   on theta   -2 (w' g zeta + w g zeta')
/// With a free crank the ideal rod is that at its angle, from which theta then counts: its own
/// coordinate counts from the rod at the angle of the clock.
/// The load w^2 g is part of it only where `stretch` says so. The centre of mass has mass of its
/// own and needs no term, and a rotation theta alone none: that of a rigid rod is exact. Its work
/// is energy that the prescribed motion puts in.
class RodFrame : public ForceElement {
 public:
  /// @param coordinates y indices of the modal coordinates of theta, then of zeta, 1 + n.
  /// @param clock slider-crank whose rod theta's coordinate counts from. @param stretch share of
  /// w^2 g that acts on zeta, over time; empty: it is a load besides.
  RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
           const SliderCrank& clock, std::function<double(double time)> stretch = {},
           CrankAngle crank = {});

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  std::string name_;
  SliderCrank clock_;
  std::function<double(double time)> stretch_;
  CrankAngle crank_;
  double scale_;                         // theta's coordinate over theta: it has unit mass
  Eigen::MatrixXd by_square_, by_rate_;  // (1 + n) square: of w^2, w', 2 w
  Eigen::MatrixXd by_turning_;
  Eigen::VectorXd g_, load_;     // g; what the stretch adds
  Eigen::VectorXd rate_;         // of theta and zeta at the last evaluation
  double apart_ = 0.0;           // of the coordinate's rate from theta's
  Eigen::MatrixXd by_y_, by_v_;  // at the last w, w': the force is by_y y + by_v v
  Eigen::Vector2d spin_;         // w, w'
};

}  // namespace clatter::dynamics
