// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The joints of a chain: pins in bushes.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/chain/link.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/law/creep_watch.hpp"

namespace clatter::dynamics {

/// Force units between links.
struct JointLaw {
  double stiffness = 1e7;    // of pin, bush and plates beyond the clearance [N/m]
  double clearance = 0.0;    // radial [m]
  double damping = 200.0;    // [N s/m]
  double friction = 0.0;     // of the pin in its bush
  double radius = 1.65e-3;   // of the pin [m]
  double slip_speed = 0.02;  // friction is less than full below [m/s]
};

/// All joints of a chain, with d = A - B from the front pin B of link j to the rear pin A of
/// link j + 1 and d' its rate as seen from link j,
///
///   F = k <|d| - c> d / |d| + c_d d'   on link j at A, -F on link j + 1 at A,
///   M = mu r k <|d| - c> s(r w / v_0)  on link j, -M on link j + 1,
///
/// w = the spin of link j + 1 relative to link j; s(x) = x (3 - x^2) / 2 up to 1, then 1: friction
/// is full above the slip speed v_0 and has a continuous slope. Each joint couples two links.
class LinkJoints : public ForceElement {
 public:
  /// @param coordinates y indices of u, v, angle of all links, 3 n.
  LinkJoints(std::string name, std::vector<int> coordinates, ChainMake make, const JointLaw& law);

  std::string name() const override { return name_; }
  const std::vector<std::vector<int>>& groups() const override { return groups_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void begin_step(double time) override { creep_.begin_step(time); }
  void accept_step(double time) override;
  void archive(Archive& archive) override { creep_.archive(archive); }
  std::optional<double> crept() const override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

  /// Force in joint j at the last accepted state, positive where it pulls link j + 1 [N].
  const std::vector<double>& tensions() const { return accepted_; }

 private:
  /// One joint at the state of the last turn().
  struct Joint {
    Eigen::Vector2d front, rear;  // from the centres of links j and j + 1 to B and A [m]
    Eigen::Vector2d d, rate;      // [m], [m/s] as seen from link j
    double spin = 0.0;            // of link j + 1 relative to link j [rad/s]
    Eigen::Vector2d direction = Eigen::Vector2d::Zero();  // d / |d|
    double pressed = 0.0;                                 // <|d| - c> [m]
    double length = 0.0;                                  // |d| [m]
  };
  void turn(const Eigen::VectorXd& y) const;
  Joint joint(int j, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  void tangent(const Joint& at, const Eigen::Vector2d& force, double kappa, double spin_front,
               double spin_rear, Eigen::MatrixXd& values) const;
  int next(int j) const { return j + 1 == make_.links() ? 0 : j + 1; }

  std::string name_;
  ChainMake make_;
  JointLaw law_;
  std::vector<std::vector<int>> groups_;
  // Mutable: working memory, as power() places the links too.
  mutable std::vector<Eigen::Vector2d> halves_;     // from the centre of each link to its front pin
  std::vector<double> last_, finished_, accepted_;  // tensions
  std::vector<double> slip_;  // of the pins in their bushes at the last state; nan: not pressed
  CreepWatch creep_;
};

}  // namespace clatter::dynamics
