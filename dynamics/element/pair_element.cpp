// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/pair_element.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

std::vector<int> joined(const Port& a, const Port& b) {
  std::vector<int> all = a.coordinates();
  all.insert(all.end(), b.coordinates().begin(), b.coordinates().end());
  return all;
}

}  // namespace

PairElement::PairElement(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b,
                         std::unique_ptr<PairLaw> law)
    : ForceElement(joined(*a, *b)),
      name_(std::move(name)),
      recorded_(name_),
      a_(std::move(a)),
      b_(std::move(b)),
      law_(std::move(law)) {
  std::replace(recorded_.begin(), recorded_.end(), ' ', '_');
}

void PairElement::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                           bool with_tangent, Response& response) {
  const int n_a = a_->size(), n_b = b_->size();
  y_a_ = y.head(n_a);
  v_a_ = v.head(n_a);
  y_b_ = y.tail(n_b);
  v_b_ = v.tail(n_b);
  a_->motion(stage.time, y_a_, v_a_, at_a_);
  b_->motion(stage.time, y_b_, v_b_, at_b_);
  const Vector3d distance = at_a_.position - at_b_.position;
  last_.motion = {distance, at_a_.velocity - at_b_.velocity - at_b_.spin.cross(distance),
                  at_a_.spin - at_b_.spin};
  try {
    last_.force = law_->force(stage, last_.motion, with_tangent);
  } catch (const StepRefused& refused) {
    throw StepRefused(name_ + ": " + refused.kind(), refused.detail());
  }
  const Vector3d &force = last_.force.force, &moment = last_.force.moment;
  const Vector6 on_a = wrench(force, moment),
                on_b = wrench(-force, -moment - distance.cross(force));
  last_.input = -on_a.dot(at_a_.driven) - on_b.dot(at_b_.driven);
  response.force.resize(n_a + n_b);
  response.force.head(n_a).noalias() = at_a_.work.transpose() * on_a;
  response.force.tail(n_b).noalias() = at_b_.work.transpose() * on_b;
  if (with_tangent) add_tangent(stage.kappa, on_a, on_b, response.tangent);
}

void PairElement::add_tangent(double kappa, const Vector6& on_a, const Vector6& on_b,
                              Eigen::MatrixXd& tangent) {
  const int n_a = a_->size(), n_b = b_->size();
  Matrix6X &distance = distance_by_y_, &rate = rate_by_y_;
  distance.resize(6, n_a + n_b);
  rate.resize(6, n_a + n_b);
  distance.leftCols(n_a) = at_a_.by_y;
  distance.rightCols(n_b) = -at_b_.by_y;
  rate.leftCols(n_a) = at_a_.rate_by_y + at_a_.rate_by_v / kappa;
  rate.rightCols(n_b) = -at_b_.rate_by_y - at_b_.rate_by_v / kappa;
  const Eigen::Matrix3d turning = skew(at_b_.spin), arm = skew(last_.motion.distance);
  for (int j = 0; j < n_a + n_b; ++j) {
    Vector3d change = turning * distance.col(j).head<3>();
    if (j >= n_a) change += arm * rate.col(j).tail<3>();
    rate.col(j).head<3>() -= change;
  }
  by_a_.noalias() = last_.force.by_distance * distance;
  by_a_.noalias() += last_.force.by_rate * rate;
  by_b_ = -by_a_;
  const Eigen::Matrix3d pulled = skew(last_.force.force);
  for (int j = 0; j < n_a + n_b; ++j)
    by_b_.col(j).tail<3>() += pulled * distance.col(j).head<3>() - arm * by_a_.col(j).head<3>();
  tangent.resize(n_a + n_b, n_a + n_b);
  tangent.topRows(n_a).noalias() = at_a_.work.transpose() * by_a_;
  tangent.bottomRows(n_b).noalias() = at_b_.work.transpose() * by_b_;
  a_->add_curvature(y_a_, on_a, tangent.topLeftCorner(n_a, n_a));
  b_->add_curvature(y_b_, on_b, tangent.bottomRightCorner(n_b, n_b));
}

void PairElement::finish_stage(const Stage& stage) {
  law_->finish_stage(stage);
  finished_ = last_;
}

void PairElement::accept_step(double) {
  law_->accept_step();
  accepted_ = finished_;
}

Power PairElement::power(const VectorXd&, const VectorXd&) const {
  return {last_.force.stored, last_.force.lost, last_.input};
}

void PairElement::record(History& history) const {
  for (int k = 0; k < 3; ++k)
    history.put(recorded_ + "_force_" + "xyz"[k], "N", accepted_.force.force(k));
  law_->record(recorded_, accepted_.motion, accepted_.force, history);
}

}  // namespace clatter::dynamics
