// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/roller_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

using Matrix25 = Eigen::Matrix<double, 2, 5>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

std::vector<int> joined(const Port& a, const Port& b) {
  std::vector<int> all = a.coordinates();
  all.insert(all.end(), b.coordinates().begin(), b.coordinates().end());
  return all;
}

/// Turned by 90 degrees to the left.
Vector2d left(const Vector2d& a) { return {-a.y(), a.x()}; }

Vector2d back(const Vector2d& direction, const Vector2d& a) {
  return {direction.dot(a), direction.x() * a.y() - direction.y() * a.x()};
}

}  // namespace

RollerContact::RollerContact(std::string name, std::unique_ptr<Port> roller, CamCarrier cam,
                             std::shared_ptr<const Profile> profile, double radius,
                             const MattressLaw& law)
    : ForceElement(joined(*roller, *cam.port)),
      name_(std::move(name)),
      roller_(std::move(roller)),
      cam_(std::move(cam)),
      profile_(std::move(profile)),
      contact_(*profile_, LinkOutline::circle(0.0, radius), law) {
  std::string prefix = name_;
  std::replace(prefix.begin(), prefix.end(), ' ', '_');
  recorded_ = {prefix + "_force", prefix + "_moment", prefix + "_gap", prefix + "_losses"};
}

void RollerContact::move(double time, const VectorXd& y, const VectorXd& v, bool with_rows) {
  const int n_a = roller_->size(), n_b = cam_.port->size();
  y_roller_ = y.head(n_a);
  v_roller_ = v.head(n_a);
  y_cam_ = y.tail(n_b);
  v_cam_ = v.tail(n_b);
  roller_->motion(time, y_roller_, v_roller_, at_roller_);
  cam_.port->motion(time, y_cam_, v_cam_, at_cam_);
  const Vector3d &e = cam_.plane.first, &f = cam_.plane.second, normal = e.cross(f);
  const auto flat = [&](const Vector3d& a) { return Vector2d(a.dot(e), a.dot(f)); };
  motion_.distance = flat(at_roller_.position - at_cam_.position);
  motion_.velocity = flat(at_roller_.velocity - at_cam_.velocity);
  motion_.spin = at_cam_.spin.dot(normal);
  motion_.direction = flat(at_cam_.rotation * cam_.direction).normalized();
  pose_ = {back(motion_.direction, motion_.distance), 1.0, 0.0};
  rate_ = {back(motion_.direction, motion_.velocity) - motion_.spin * left(pose_.position), 0.0};
  const auto rows = [&](const Matrix6X& roller, const Matrix6X& cam, Planar& all) {
    all.setZero(5, n_a + n_b);
    all.row(0).head(n_a).noalias() = e.transpose() * roller.topRows<3>();
    all.row(1).head(n_a).noalias() = f.transpose() * roller.topRows<3>();
    all.row(2).tail(n_b).noalias() = e.transpose() * cam.topRows<3>();
    all.row(3).tail(n_b).noalias() = f.transpose() * cam.topRows<3>();
    all.row(4).tail(n_b).noalias() = normal.transpose() * cam.bottomRows<3>();
  };
  rows(at_roller_.work, at_cam_.work, motion_.work);
  if (!with_rows) return;
  rows(at_roller_.by_y, at_cam_.by_y, motion_.by_y);
  rows(at_roller_.rate_by_y, at_cam_.rate_by_y, motion_.rate_by_y);
  rows(at_roller_.rate_by_v, at_cam_.rate_by_v, motion_.rate_by_v);
}

void RollerContact::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                             bool with_tangent, Response& response) {
  move(stage.time, y, v, with_tangent);
  contact_.evaluate(pose_, rate_, with_tangent, hint_, force_);
  if (force_.too_deep) throw StepRefused(name_ + ": the roller is too deep in the cam", "");
  last_ = {};
  last_.angle = std::atan2(motion_.direction.y(), motion_.direction.x());
  last_.place = pose_.position;
  last_.depth = force_.depth;
  response.force.setZero(y.size());
  if (with_tangent) response.tangent.setZero(y.size(), y.size());
  if (!(force_.depth > 0.0)) return;
  const Vector2d local = force_.wrench.head<2>();
  last_.on_roller = local.x() * motion_.direction + local.y() * left(motion_.direction);
  last_.force = local.norm();
  last_.moment = -left(pose_.position).dot(local);
  last_.stored = force_.stored;
  last_.lost = force_.lost;
  last_.input = driven_power();
  Eigen::Matrix<double, 5, 1> all;
  all << last_.on_roller, -last_.on_roller, last_.moment;
  response.force.noalias() = motion_.work.transpose() * all;
  if (with_tangent) fill_tangent(stage.kappa, response.tangent);
}

/// Forces (F; -F, -r x f), F = R f, of the distance r = R^T (roller - cam) and its rate.
void RollerContact::fill_tangent(double kappa, MatrixXd& tangent) {
  const Vector2d &d = motion_.direction, &r = pose_.position;
  Matrix2d back;
  back << d.x(), d.y(), -d.y(), d.x();
  Matrix25 lead;  // dr/d(roller; cam), and of their rates by the rates
  lead << back, -back, -left(r);
  Matrix25 drag;  // d(rate)/d(roller; cam)
  for (int k = 0; k < 2; ++k) {
    drag.col(k) = -motion_.spin * left(back.col(k));
    drag.col(2 + k) = -drag.col(k);
  }
  drag.col(4) = -left(rate_.velocity);
  const Matrix2d by_r = force_.by_pose.topLeftCorner<2, 2>(),
                 by_v = force_.by_rate.topLeftCorner<2, 2>();
  const Vector2d f = force_.wrench.head<2>();
  const auto spread = [&](const Matrix25& local, bool turns) {
    Matrix5 all;
    all.topRows<2>() = back.transpose() * local;
    if (turns) all.topRows<2>().col(4) += back.transpose() * left(f);
    all.middleRows<2>(2) = -all.topRows<2>();
    all.row(4) = -left(r).transpose() * local;
    if (turns) all.row(4) += left(f).transpose() * lead;
    return all;
  };
  const Matrix5 by_place = spread(by_r * lead + by_v * drag, true);
  const Matrix5 by_rate = spread(by_v * lead, false);
  const Matrix5 by_speed = by_rate / kappa;
  change_.noalias() = by_place * motion_.by_y;
  change_.noalias() += by_rate * motion_.rate_by_y;
  change_.noalias() += by_speed * motion_.rate_by_v;
  tangent.noalias() = motion_.work.transpose() * change_;
  const Vector3d force =
      last_.on_roller.x() * cam_.plane.first + last_.on_roller.y() * cam_.plane.second;
  const Vector3d moment = last_.moment * cam_.plane.first.cross(cam_.plane.second);
  const int n_a = roller_->size(), n_b = cam_.port->size();
  roller_->add_curvature(y_roller_, wrench(force, Vector3d::Zero()),
                         tangent.topLeftCorner(n_a, n_a));
  cam_.port->add_curvature(y_cam_, wrench(-force, moment), tangent.bottomRightCorner(n_b, n_b));
}

/// What drives put in against the contact.
double RollerContact::driven_power() const {
  const Vector3d force =
      last_.on_roller.x() * cam_.plane.first + last_.on_roller.y() * cam_.plane.second;
  const Vector3d normal = cam_.plane.first.cross(cam_.plane.second);
  return -force.dot(at_roller_.driven.head<3>()) -
         wrench(-force, last_.moment * normal).dot(at_cam_.driven);
}

void RollerContact::accept_step(double time) {
  accepted_ = finished_;
  accepted_.gap = -accepted_.depth;
  if (!(accepted_.depth > 0.0))
    accepted_.gap = profile_->closest(accepted_.place).distance - contact_.outline().radius;
  losses_.look(time, accepted_.gap > (losses_.is_open() ? 0.0 : kLostGap), accepted_.gap,
               accepted_.angle);
}

Power RollerContact::power(const VectorXd&, const VectorXd&) const {
  return {last_.stored, last_.lost, last_.input};
}

void RollerContact::record(History& history) const {
  history.put(recorded_[0], "N", accepted_.force);
  history.put(recorded_[1], "N m", accepted_.moment);
  history.put(recorded_[2], "m", accepted_.gap);
  history.put(recorded_[3], "1", losses_.count());
}

}  // namespace clatter::dynamics
