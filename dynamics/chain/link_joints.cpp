// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/chain/link_joints.hpp"
#include "dynamics/chain/plane_vector.hpp"

#include <cmath>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

using Row6 = Eigen::Matrix<double, 1, 6>;
using Matrix26 = Eigen::Matrix<double, 2, 6>;

/// s(x) of friction and its derivative.
double saturated(double x) {
  if (std::abs(x) >= 1.0) return std::copysign(1.0, x);
  return 0.5 * x * (3.0 - x * x);
}
double saturated_slope(double x) { return std::abs(x) >= 1.0 ? 0.0 : 1.5 * (1.0 - x * x); }

}  // namespace

LinkJoints::LinkJoints(std::string name, std::vector<int> coordinates, ChainMake make,
                       const JointLaw& law)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      make_(std::move(make)),
      law_(law),
      creep_(law.slip_speed, static_cast<size_t>(make_.joints())) {
  for (int j = 0; j < make_.joints(); ++j) {
    const int a = 3 * j, b = 3 * next(j);
    groups_.push_back({a, a + 1, a + 2, b, b + 1, b + 2});
  }
  halves_.resize(make_.links());
  last_ = finished_ = accepted_ = slip_ = std::vector<double>(make_.joints(), 0.0);
}

/// Each link has two joints: its sine and cosine serve both.
void LinkJoints::turn(const VectorXd& y) const {
  for (int j = 0; j < make_.links(); ++j) {
    const double angle = y(3 * j + 2);
    halves_[j] = make_.half(j) * Vector2d(std::cos(angle), std::sin(angle));
  }
}

LinkJoints::Joint LinkJoints::joint(int j, const VectorXd& y, const VectorXd& v) const {
  const int k = next(j);
  Joint at;
  at.front = halves_[j];
  at.rear = -halves_[k];
  at.d = y.segment<2>(3 * k) - y.segment<2>(3 * j) + at.rear - at.front;
  at.rate = v.segment<2>(3 * k) - v.segment<2>(3 * j) + v(3 * k + 2) * across(at.rear) -
            v(3 * j + 2) * across(at.front + at.d);
  at.spin = v(3 * k + 2) - v(3 * j + 2);
  at.length = at.d.norm();
  if (at.length > law_.clearance) {
    at.direction = at.d / at.length;
    at.pressed = at.length - law_.clearance;
  }
  return at;
}

void LinkJoints::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                          bool with_tangent, Response& response) {
  response.force.setZero(y.size());
  response.blocks.resize(groups_.size());
  const double friction = law_.friction * law_.radius * law_.stiffness;
  turn(y);
  for (int j = 0; j < make_.joints(); ++j) {
    const int k = next(j);
    const Joint at = joint(j, y, v);
    const Vector2d force = law_.stiffness * at.pressed * at.direction + law_.damping * at.rate;
    const double moment =
        friction * at.pressed * saturated(law_.radius * at.spin / law_.slip_speed);
    response.force.segment<2>(3 * j) += force;
    response.force(3 * j + 2) += cross(at.front + at.d, force) + moment;
    response.force.segment<2>(3 * k) -= force;
    response.force(3 * k + 2) -= cross(at.rear, force) + moment;
    slip_[j] = at.pressed > 0.0 ? law_.radius * at.spin : std::nan("");
    last_[j] = std::copysign(force.norm(), -force.dot(at.rear));
    if (!with_tangent) continue;
    TangentBlock& block = response.blocks[j];
    block.active = true;
    tangent(at, force, stage.kappa, v(3 * j + 2), v(3 * k + 2), block.values);
  }
}

/// d(forces on link j, link j + 1)/dy, 6 x 6.
void LinkJoints::tangent(const Joint& at, const Vector2d& force, double kappa, double spin_front,
                         double spin_rear, Eigen::MatrixXd& values) const {
  Matrix26 distance, rate;
  distance << -Matrix2d::Identity(), -across(at.front), Matrix2d::Identity(), across(at.rear);
  rate = distance / kappa;
  rate.col(2) += spin_front * at.front - across(at.d) / kappa;
  rate.col(5) -= spin_rear * at.rear;
  for (int i = 0; i < 6; ++i) rate.col(i) -= spin_front * across(distance.col(i));
  Matrix2d stiffness = Matrix2d::Zero();
  if (at.pressed > 0.0) {
    const Matrix2d along = at.direction * at.direction.transpose();
    stiffness = law_.stiffness * (along + at.pressed / at.length * (Matrix2d::Identity() - along));
  }
  const Matrix26 by_y = stiffness * distance + law_.damping * rate;

  Row6 moment = Row6::Zero();
  if (law_.friction > 0.0 && at.pressed > 0.0) {
    const double full = law_.friction * law_.radius * law_.stiffness,
                 scale = law_.radius / law_.slip_speed, x = scale * at.spin;
    moment = full * saturated(x) * at.direction.transpose() * distance;
    const double by_spin = full * at.pressed * saturated_slope(x) * scale / kappa;
    moment(2) -= by_spin;
    moment(5) += by_spin;
  }
  // A force at A: about the centre of link j its arm is front + d, about that of link j + 1 rear.
  const Vector2d arm = at.front + at.d;
  Row6 on_front = across(arm).transpose() * by_y, on_rear = across(at.rear).transpose() * by_y;
  const Vector2d pulled = -across(force);  // cross(da, force) = da . pulled
  on_front += pulled.transpose() * distance;
  on_front(2) += pulled.dot(across(at.front));
  on_rear(5) += pulled.dot(across(at.rear));
  values.resize(6, 6);
  values.topRows<2>() = by_y;
  values.row(2) = on_front + moment;
  values.middleRows<2>(3) = -by_y;
  values.row(5) = -on_rear - moment;
}

void LinkJoints::accept_step(double time) {
  accepted_ = finished_;
  if (law_.friction == 0.0) return;
  for (size_t j = 0; j < slip_.size(); ++j)
    creep_.accept_step(j, time, !std::isnan(slip_[j]), {slip_[j], 0.0});
}

std::optional<double> LinkJoints::crept() const {
  return law_.friction > 0.0 ? std::optional(creep_.longest()) : std::nullopt;
}

Power LinkJoints::power(const VectorXd& y, const VectorXd& v) const {
  Power power;
  const double friction = law_.friction * law_.radius * law_.stiffness;
  turn(y);
  for (int j = 0; j < make_.joints(); ++j) {
    const Joint at = joint(j, y, v);
    power.stored += 0.5 * law_.stiffness * at.pressed * at.pressed;
    power.lost +=
        law_.damping * at.rate.squaredNorm() +
        friction * at.pressed * saturated(law_.radius * at.spin / law_.slip_speed) * at.spin;
  }
  return power;
}

}  // namespace clatter::dynamics
