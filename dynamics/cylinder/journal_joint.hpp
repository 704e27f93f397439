// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A pin joint of the rod that an oil film holds.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>

#include "dynamics/force/anchor.hpp"
#include "dynamics/force/element.hpp"
#include "dynamics/force/joint_friction.hpp"
#include "dynamics/shaft/bearing_film.hpp"

namespace clatter::dynamics {

/// One side of a joint: its point and its rotation about x.
struct JournalSide {
  std::unique_ptr<Anchor> point;
  JointSide rotation;
};

/// The film of bearing_film.hpp between a journal and its bearing, which swings: with d of the
/// journal's centre from the bearing's and the angular velocities w_J, w_B,
///
///   F, M = film(d, d' - w_B x d, w_J - w_B) on the journal,   -F, -M - d x F on the bearing
///
/// Its power F . (d' - w_B x d) + M (w_J - w_B) is lost. Nothing bears beside the film: a journal
/// that would touch its bearing is refused, which reduces the step.
class JournalJoint : public ForceElement {
 public:
  /// @param sign of the recorded force: 1 on the journal, -1 on the bearing.
  JournalJoint(std::string name, JournalSide journal, JournalSide bearing, const BearingFilm& film,
               double sign);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_force_y`, `<name>_force_z` [N], `<name>_eccentricity` [m], `<name>_friction_moment`
  /// [N m], of the force's side, and `<name>_film_power` [W], lost.
  void record(History& history) const override;

 private:
  struct Instant {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();  // on the journal [N]
    double moment = 0.0, on_bearing = 0.0;            // [N m]
    double eccentricity = 0.0, lost = 0.0, input = 0.0;
  };
  void add_tangent(const Stage& stage, const Eigen::VectorXd& y, const FilmForce& film,
                   const JournalMotion& motion, double bearing_spin, Response& response);

  std::string name_;
  std::unique_ptr<Anchor> journal_, bearing_;
  JointSide journal_side_, bearing_side_;
  BearingFilm film_;
  double sign_;
  Eigen::Index n_j_, n_b_;
  Eigen::VectorXd turn_j_, turn_b_;  // dw_J/dv, dw_B/dv, n_e
  AnchorState at_j_, at_b_;
  PlanarRows G_;  // dd/dy, 2 x n_e
  Eigen::Matrix<double, 5, Eigen::Dynamic> motion_by_y_;
  Eigen::Matrix<double, 3, Eigen::Dynamic> film_by_y_;
  Eigen::RowVectorXd couple_by_y_;
  Instant last_, finished_, accepted_;
};

}  // namespace clatter::dynamics
