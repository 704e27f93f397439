// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nonlinear spring-damper between two points in the plane of the crank: pin and rod, rod and crank.
#include <memory>

#include "dynamics/force/anchor.hpp"
#include "dynamics/force/element.hpp"
#include "dynamics/force/radial_table.hpp"

namespace clatter::dynamics {

/// Force on point A: -F(e) n - c(e) d', with d = d_A - d_B, e = |d|, n = d / e; the opposite on B.
/// Its power balance, force . v + dE/dt + lost = input, holds exactly; `input` is the power of the
/// rod's prescribed rotation on the joint's force.
class Joint : public ForceElement {
 public:
  Joint(std::string name, std::unique_ptr<Anchor> a, std::unique_ptr<Anchor> b, RadialForce law);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_force_y`, `<name>_force_z` [N] on A, `<name>_eccentricity` [m].
  void record(History& history) const override;

  struct Instant {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();       // on A [N]
    Eigen::Vector2d rate = Eigen::Vector2d::Zero();        // d' [m/s]
    Eigen::Vector2d prescribed = Eigen::Vector2d::Zero();  // prescribed part of it
    double eccentricity = 0.0;
  };
  const Instant& accepted() const { return accepted_; }

 protected:
  /// Of the last evaluation, and dF/dy of its last tangent, 2 x n_e.
  const Instant& last() const { return last_; }
  const PlanarRows& force_by_y() const { return dF_; }

 private:
  std::string name_;
  std::unique_ptr<Anchor> a_, b_;
  RadialForce law_;
  AnchorState at_a_, at_b_;
  PlanarRows G_, dF_;         // dd/dy and dF/dy, 2 x n_e
  Eigen::RowVectorXd along_;  // dc/dy, of a damping that varies
  Instant last_, finished_, accepted_;
};

}  // namespace clatter::dynamics
