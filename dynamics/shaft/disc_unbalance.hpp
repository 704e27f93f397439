// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The unbalance of a disc.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/law/internal_state.hpp"

namespace clatter::dynamics {

/// A disc whose mass m has its centre at e r beside the axis, U = m e; r turns with the angle a, t
/// is r a quarter of a turn on. Its kinetic energy is larger by T = U a' t . x' than that of the
/// disc whose centre is on the axis at x (m e^2 is part of the polar moment), so that by Lagrange
///
///   F = - P',   P = U a' t,        M = - Q' - U a' r . x',   Q = U t . x'
///
/// exactly, also while it runs up. P and Q are internal states of which the rates are found under
/// the tableau of the step, as those of SpinElement; after an event they are those of before.
class DiscUnbalance : public ForceElement {
 public:
  /// @param coordinates y indices of the displacements along the shaft's first and second axis, and
  /// of the angle. @param unbalance U [kg m]. @param phase angle of r where a is 0 [rad].
  /// @param angle, speed a and a' at the start, where the axis is at rest.
  DiscUnbalance(std::string name, std::vector<int> coordinates, double unbalance, double phase,
                double angle, double speed);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage& stage) override { momenta_.finish_stage(stage); }
  void accept_step(double) override { momenta_.accept_step(); }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  std::vector<double> save() const override { return momenta_.save(); }
  void restore(const std::vector<double>& state) override;

 private:
  Eigen::Vector2d radial(double angle) const;
  /// (P, Q)
  Eigen::Vector3d momenta(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;

  std::string name_;
  double unbalance_, phase_;
  InternalState<Eigen::Vector3d> momenta_;  // (P, Q)
};

}  // namespace clatter::dynamics
