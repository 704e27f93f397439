// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The element between two ports.
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/law/pair_law.hpp"

namespace clatter::dynamics {

/// Joints, bushings, springs and bearings: two ports and the law of the force between them. The
/// power of what is prescribed of their motion is input.
class PairElement : public ForceElement {
 public:
  PairElement(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b,
              std::unique_ptr<PairLaw> law);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void begin_step(double) override { law_->begin_step(); }
  void finish_stage(const Stage& stage) override;
  void accept_step(double) override;
  /// Of the last evaluation: after an event that of the state that it left.
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_force_x`, `_y`, `_z` [N] on a, in the engine's axes, then what the law records; spaces
  /// of the name are underscores.
  void record(History& history) const override;
  std::vector<double> save() const override { return law_->save(); }
  void restore(const std::vector<double>& state) override { law_->restore(state); }

  struct Instant {
    PairMotion motion;
    PairForce force;
    double input = 0.0;  // [W]
  };
  /// Of the last evaluation.
  const Instant& last() const { return last_; }
  /// Of the last accepted step.
  const Instant& accepted() const { return accepted_; }

 private:
  void add_tangent(double kappa, const Vector6& on_a, const Vector6& on_b,
                   Eigen::MatrixXd& tangent);
  std::string name_, recorded_;
  std::unique_ptr<Port> a_, b_;
  std::unique_ptr<PairLaw> law_;
  Instant last_, finished_, accepted_;
  PortState at_a_, at_b_;
  Eigen::VectorXd y_a_, y_b_, v_a_, v_b_;
  Matrix6X distance_by_y_, rate_by_y_, by_a_, by_b_;  // 6 x n_e, of the last tangent
};

}  // namespace clatter::dynamics
