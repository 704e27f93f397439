// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/journal_joint.hpp"

namespace clatter::dynamics {
namespace {

/// x cross d, for the plane (y, z) across x.
Eigen::Vector2d turned(const Eigen::Vector2d& d) { return {-d.y(), d.x()}; }

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

JournalJoint::JournalJoint(std::string name, JournalSide journal, JournalSide bearing,
                           const BearingFilm& film, double sign)
    : name_(std::move(name)),
      journal_(std::move(journal.point)),
      bearing_(std::move(bearing.point)),
      journal_side_(std::move(journal.rotation)),
      bearing_side_(std::move(bearing.rotation)),
      film_(film),
      sign_(sign),
      n_j_(std::ssize(journal_->coordinates())),
      n_b_(std::ssize(bearing_->coordinates())) {
  coordinates_ = journal_->coordinates();
  coordinates_.insert(coordinates_.end(), bearing_->coordinates().begin(),
                      bearing_->coordinates().end());
  const int at_j = place_of(journal_side_, coordinates_),
            at_b = place_of(bearing_side_, coordinates_);
  turn_j_.setZero(std::ssize(coordinates_));
  turn_b_ = turn_j_;
  if (at_j >= 0) turn_j_(at_j) = 1.0;
  if (at_b >= 0) turn_b_(at_b) = 1.0;
  G_.setZero(2, turn_j_.size());
}

void JournalJoint::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                            bool with_tangent, Response& response) {
  journal_->find(stage.time, y.head(n_j_), v.head(n_j_), at_j_);
  bearing_->find(stage.time, y.segment(n_j_, n_b_), v.segment(n_j_, n_b_), at_b_);
  const double driven_j = turning_at(journal_side_, stage.time),
               driven_b = turning_at(bearing_side_, stage.time);
  const double w_j = turn_j_.dot(v) + driven_j, w_b = turn_b_.dot(v) + driven_b;
  const Eigen::Vector2d d = at_j_.d - at_b_.d;
  const JournalMotion motion{d, at_j_.rate - at_b_.rate - w_b * turned(d), w_j - w_b};
  const FilmForce film = film_.force(motion, name_);
  const Eigen::Vector2d force = film.value.head<2>();
  const double moment = film.value(2), on_bearing = -moment - cross(d, force);
  last_ = {
      force,
      moment,
      on_bearing,
      d.norm(),
      -force.dot(motion.velocity) - moment * motion.spin,
      -force.dot(at_j_.prescribed - at_b_.prescribed) - moment * driven_j - on_bearing * driven_b};
  G_.leftCols(n_j_) = at_j_.G;
  G_.middleCols(n_j_, n_b_) = -at_b_.G;
  response.force.noalias() = G_.transpose() * force;
  response.force += moment * turn_j_ + on_bearing * turn_b_;
  if (with_tangent) add_tangent(stage, y, film, motion, w_b, response);
}

void JournalJoint::add_tangent(const Stage& stage, const Eigen::VectorXd& y, const FilmForce& film,
                               const JournalMotion& motion, double bearing_spin,
                               Response& response) {
  const Eigen::Vector2d force = film.value.head<2>(), d = motion.offset;
  motion_by_y_.resize(5, G_.cols());
  motion_by_y_.topRows<2>() = G_;
  auto rate = motion_by_y_.middleRows<2>(2);
  rate = G_ / stage.kappa;
  rate.leftCols(n_j_) += at_j_.B;
  rate.middleCols(n_j_, n_b_) -= at_b_.B;
  rate.row(0) += bearing_spin * G_.row(1);
  rate.row(1) -= bearing_spin * G_.row(0);
  rate.row(0) += d.y() / stage.kappa * turn_b_.transpose();
  rate.row(1) -= d.x() / stage.kappa * turn_b_.transpose();
  motion_by_y_.row(4) = (turn_j_ - turn_b_).transpose() / stage.kappa;
  film_by_y_.noalias() = film.by_motion * motion_by_y_;
  couple_by_y_ = -film_by_y_.row(2) - d.x() * film_by_y_.row(1) + d.y() * film_by_y_.row(0) -
                 force.y() * G_.row(0) + force.x() * G_.row(1);
  response.tangent.noalias() = G_.transpose().lazyProduct(film_by_y_.topRows<2>());
  response.tangent.noalias() += turn_j_ * film_by_y_.row(2);
  response.tangent.noalias() += turn_b_ * couple_by_y_;
  journal_->add_curvature(stage.time, y.head(n_j_), force,
                          response.tangent.topLeftCorner(n_j_, n_j_));
  bearing_->add_curvature(stage.time, y.segment(n_j_, n_b_), -force,
                          response.tangent.block(n_j_, n_j_, n_b_, n_b_));
}

Power JournalJoint::power(const Eigen::VectorXd&, const Eigen::VectorXd&) const {
  return {0.0, finished_.lost, finished_.input};
}

void JournalJoint::record(History& history) const {
  history.put(name_ + "_force_y", "N", sign_ * accepted_.force.x());
  history.put(name_ + "_force_z", "N", sign_ * accepted_.force.y());
  history.put(name_ + "_eccentricity", "m", accepted_.eccentricity);
  history.put(name_ + "_friction_moment", "N m",
              sign_ > 0.0 ? accepted_.moment : accepted_.on_bearing);
  history.put(name_ + "_film_power", "W", accepted_.lost);
}

}  // namespace clatter::dynamics
