// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A rigid rod without mass between its two joints.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// The limit of a rigid rod whose mass goes to 0: at every instant the forces and moments of its
/// joints balance, so that its force acts along the line of its ends. Its deviations (dy, dz, dphi)
/// x from the ideal rod, which the dampers of the joints make states of first order, follow from
///   sum of G^T F(x, x', y, y') = 0        3 equations
/// under the tableau of the method; y are the coordinates of what the joints join.
class MasslessRod : public ForceElement {
 public:
  /// @param pin joint of a point and an end of the rod, @param crank_pin of another point and the
  /// other end, in this order; the rod's three coordinates have no indices in y: any will do.
  MasslessRod(std::string name, std::unique_ptr<ForceElement> pin,
              std::unique_ptr<ForceElement> crank_pin);

  std::string name() const override { return name_; }
  /// StepRefused when the balance is not found.
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void begin_step(double time) override;
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// The histories of both joints.
  void record(History& history) const override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

  /// Deviations of the rod at the last evaluation (dy, dz, dphi).
  const Eigen::Vector3d& deviation() const { return x_; }

 private:
  /// Forces on the rod at its deviation x_ and, with tangents, their derivative.
  Eigen::Vector3d balance(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v);

  std::string name_;
  std::unique_ptr<ForceElement> pin_, crank_pin_;
  Eigen::Index n_pin_, n_crank_;  // of the points that they join
  Response at_pin_, at_crank_;    // the rod's coordinates are the last three
  Eigen::VectorXd y_pin_, v_pin_, y_crank_, v_crank_;
  Eigen::Matrix3d by_x_;
  Eigen::Vector3d x_ = Eigen::Vector3d::Zero(), before_ = x_;  // and x~ of the stage
  Eigen::Vector3d accepted_ = x_, accepted_rate_ = x_;
  Eigen::Vector3d finished_ = x_;  // x of the last finished stage
  std::vector<Eigen::Vector3d> rates_;
};

}  // namespace clatter::dynamics
