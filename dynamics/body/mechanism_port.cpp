// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/mechanism_port.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Matrix2d turn_by(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return Matrix2d{{c, -s}, {s, c}};
}

/// e_x times a vector (y, z).
Vector2d quarter_turn(const Vector2d& vector) { return {-vector.y(), vector.x()}; }

/// (R(angle) - 1) p by the half angle: no cancellation at small angles.
Vector2d moved_by_turn(double angle, const Vector2d& p) {
  const double s = std::sin(0.5 * angle);
  return -2.0 * s * s * p + std::sin(angle) * quarter_turn(p);
}

}  // namespace

void PointWeights::add(int coordinate, const Vector6& weight) {
  coordinates.push_back(coordinate);
  weights.conservativeResize(Eigen::NoChange, weights.cols() + 1);
  weights.rightCols<1>() = weight;
}

void PointWeights::add(int coordinate, double lateral, double stroke) {
  add(coordinate, wrench({0.0, lateral, stroke}, Vector3d::Zero()));
}

WeightedPort::WeightedPort(PointWeights point)
    : Port(std::move(point.coordinates)), weights_(std::move(point.weights)) {}

void WeightedPort::motion(double, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  const Vector6 moved = weights_ * y, rate = weights_ * v;
  state.position = moved.head<3>();
  state.velocity = rate.head<3>();
  state.spin = rate.tail<3>();
  state.rotation += skew(moved.tail<3>());
  state.by_y = state.rate_by_v = state.work = weights_;
}

RodPort::RodPort(std::vector<int> coordinates, const SliderCrank& crank, const Vector2d& arm)
    : Port(std::move(coordinates)), crank_(crank), arm_(arm) {}

void RodPort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  const Motion<double> ideal = crank_.rod_angle(time);
  const double small = y(2), spin = ideal.velocity + v(2);
  R_ = turn_by(ideal.position + small);
  Vector2d bent = Vector2d::Zero(), bent_rate = bent;
  if (size() == 5) {
    bent = R_ * y.tail<2>();
    bent_rate = R_ * v.tail<2>();
  }
  // (R(phi + small) - R(phi)) arm by the half angle: no cancellation at micrometres.
  const Vector2d swung =
      2.0 * std::sin(0.5 * small) * quarter_turn(turn_by(ideal.position + 0.5 * small) * arm_);
  out_ = R_ * arm_ + bent;
  const Vector2d across = quarter_turn(out_);
  const Vector2d driven = ideal.velocity * quarter_turn(swung + bent);
  state.position.tail<2>() = y.head<2>() + swung + bent;
  state.driven.segment<3>(1) << driven, ideal.velocity;
  state.velocity.tail<2>() = v.head<2>() + across * v(2) + bent_rate + driven;
  state.spin.x() = spin;
  state.rotation = Eigen::AngleAxisd(ideal.position + small, Vector3d::UnitX());
  state.by_y.block<2, 2>(1, 0).setIdentity();
  state.by_y.block<2, 1>(1, 2) = across;
  state.by_y(3, 2) = 1.0;
  state.rate_by_y.block<2, 1>(1, 2) = quarter_turn(bent_rate) - spin * out_;
  if (size() == 5) {
    state.by_y.block<2, 2>(1, 3) = R_;
    for (int k = 0; k < 2; ++k)
      state.rate_by_y.block<2, 1>(1, 3 + k) = spin * quarter_turn(R_.col(k));
  }
  state.rate_by_v = state.work = state.by_y;
}

void RodPort::add_curvature(const VectorXd&, const Vector6& wrench,
                            Eigen::Ref<Eigen::MatrixXd> tangent) {
  const Vector2d force = wrench.segment<2>(1);
  tangent(2, 2) -= force.dot(out_);
  for (int k = 0; k + 3 < size(); ++k) {
    const double turning = force.dot(quarter_turn(R_.col(k)));
    tangent(2, 3 + k) += turning;
    tangent(3 + k, 2) += turning;
  }
}

CrankPinPort::CrankPinPort(PointWeights centre, std::optional<int> turn, const SliderCrank& crank)
    : Port(std::move(centre.coordinates)),
      centre_(std::move(centre.weights)),
      turns_(turn.has_value()),
      crank_(crank) {
  if (turn) coordinates_.push_back(*turn);
}

void CrankPinPort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  state.clear(size());
  const auto n = centre_.cols();
  const Motion<Vector2d> pin = crank_.crank_pin(time);
  const double a = turns_ ? y(n) : 0.0, rate = turns_ ? v(n) : 0.0, clock = crank_.spin(time);
  const Vector2d moved = moved_by_turn(a, pin.position);
  const Vector2d driven = moved_by_turn(a, pin.velocity);
  out_ = pin.position + moved;
  state.position = centre_.topRows<3>() * y.head(n);
  state.position.tail<2>() += moved;
  state.driven.segment<3>(1) << driven, clock;
  state.spin.x() = clock + rate;
  state.rotation = Eigen::AngleAxisd(std::atan2(-out_.x(), out_.y()), Vector3d::UnitX());
  state.by_y.leftCols(n) = centre_;
  if (turns_) {
    state.by_y.col(n).segment<3>(1) << quarter_turn(out_), 1.0;
    state.rate_by_y.col(n).segment<2>(1) = quarter_turn(pin.velocity + driven) - rate * out_;
  }
  state.velocity = state.by_y.topRows<3>() * v;
  state.velocity.tail<2>() += driven;
  state.rate_by_v = state.work = state.by_y;
}

void CrankPinPort::add_curvature(const VectorXd&, const Vector6& wrench,
                                 Eigen::Ref<Eigen::MatrixXd> tangent) {
  if (turns_) tangent(size() - 1, size() - 1) -= wrench.segment<2>(1).dot(out_);
}

}  // namespace clatter::dynamics
