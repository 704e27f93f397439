// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inertia of the small motions of an elastic rod in its turning frame.
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "dynamics/body/elastic_rod.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// Terms of eq. (9) of the paper for a rod whose frame is that of the ideal slider-crank, turned by
/// the rod's own deviation theta from it; w = phi' of the ideal rod. Of first order in theta and
/// zeta:
///   on zeta    w^2 S zeta + w' G zeta + 2 w (G zeta' + g theta')
///   on theta   -2 (w' g zeta + w g zeta')
/// The load w^2 g is part of it only where `stretch` says so. The centre of mass has mass of its
/// own and needs no term, and a rotation theta alone none: that of a rigid rod is exact. Its work
/// is energy that the prescribed motion puts in.
class RodFrame : public ForceElement {
 public:
  /// @param coordinates y indices of the modal coordinates of theta, then of zeta, 1 + n.
  RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
           const SliderCrank& crank);
  /// @param angle phi of the ideal rod over time. @param stretch share of w^2 g that acts on zeta,
  /// over time; empty: it is a load besides.
  RodFrame(std::string name, std::vector<int> coordinates, RodCoupling coupling,
           std::function<Motion<double>(double time)> angle,
           std::function<double(double time)> stretch);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  std::string name_;
  std::function<Motion<double>(double time)> angle_;
  std::function<double(double time)> stretch_;
  Eigen::MatrixXd by_square_, by_rate_;  // (1 + n) square: of w^2, w', 2 w
  Eigen::MatrixXd by_turning_;
  Eigen::VectorXd g_, load_;     // g; what the stretch adds
  Eigen::MatrixXd by_y_, by_v_;  // at the last w, w': the force is by_y y + by_v v
  Eigen::Vector2d spin_;         // w, w'
};

}  // namespace clatter::dynamics
