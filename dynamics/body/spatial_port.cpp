// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/spatial_port.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Matrix3X or_none(Matrix3X values, int modes) {
  if (values.size() > 0) return values;
  return Matrix3X::Zero(3, modes);
}

}  // namespace

SpatialPort::SpatialPort(std::vector<int> coordinates, std::shared_ptr<const SpatialFrame> frame,
                         const Vector3d& arm, Matrix3X shape, Matrix3X slope)
    : Port(std::move(coordinates)),
      frame_(std::move(frame)),
      arm_(arm),
      shape_(or_none(std::move(shape), frame_->modes())),
      slope_(or_none(std::move(slope), frame_->modes())) {}

void SpatialPort::motion(double time, const VectorXd& y, const VectorXd& v, PortState& state) {
  const int n = frame_->modes();
  state.clear(size());
  frame_->rotate(time, y, v, at_);
  frame_->differentiate(y, at_);
  const Matrix3d& A = at_.A;
  const Vector3d& spin = at_.spin;
  out_ = A * (arm_ + shape_ * y.tail(n));
  const Vector3d moved = A * (shape_ * v.tail(n)), bent = A * (slope_ * v.tail(n));
  state.position = y.segment<3>(kCentre) + out_;
  state.velocity = v.segment<3>(kCentre) + spin.cross(out_) + moved;
  state.spin = spin + bent;
  state.rotation = A + A * skew(slope_ * y.tail(n));

  const Matrix3d across = skew(out_);
  auto by_y = state.by_y.topRows<3>();
  auto turned_by_y = state.by_y.bottomRows<3>();
  by_y.middleCols<3>(kCentre).setIdentity();
  by_y.middleCols<4>(kTurn) = -across * at_.turn;
  turned_by_y.middleCols<4>(kTurn) = at_.turn;
  by_y.rightCols(n) = A * shape_;
  turned_by_y.rightCols(n) = A * slope_;

  auto rate_by_y = state.rate_by_y.topRows<3>();
  auto spin_by_y = state.rate_by_y.bottomRows<3>();
  rate_by_y = -across * at_.spin_by_y;
  rate_by_y.middleCols<4>(kTurn) -= (skew(spin) * across + skew(moved)) * at_.turn;
  rate_by_y.rightCols(n) += skew(spin) * by_y.rightCols(n);
  spin_by_y = at_.spin_by_y;
  spin_by_y.middleCols<4>(kTurn) -= skew(bent) * at_.turn;

  auto rate_by_v = state.rate_by_v.topRows<3>();
  auto spin_by_v = state.rate_by_v.bottomRows<3>();
  rate_by_v = -across * at_.spin_by_v;
  rate_by_v.middleCols<3>(kCentre).setIdentity();
  rate_by_v.rightCols(n) += by_y.rightCols(n);
  spin_by_v = at_.spin_by_v;
  spin_by_v.rightCols(n) += turned_by_y.rightCols(n);

  state.work.topRows<3>().middleCols<3>(kCentre).setIdentity();
  state.work.topRows<3>().middleCols<3>(kMomentum) = -across;
  state.work.bottomRows<3>().middleCols<3>(kMomentum).setIdentity();
  state.work.topRows<3>().rightCols(n) = by_y.rightCols(n);
  state.work.bottomRows<3>().rightCols(n) = turned_by_y.rightCols(n);
}

void SpatialPort::add_curvature(const VectorXd&, const Vector6& wrench,
                                Eigen::Ref<Eigen::MatrixXd> tangent) {
  const int n = frame_->modes();
  const Matrix3d pull = skew(wrench.head<3>()), turn = skew(wrench.tail<3>());
  const Matrix3d back = at_.A.transpose();
  tangent.block<3, 4>(kMomentum, kTurn) += pull * skew(out_) * at_.turn;
  tangent.middleRows<3>(kMomentum).rightCols(n) -= pull * at_.A * shape_;
  tangent.bottomRows(n).middleCols<4>(kTurn) +=
      (shape_.transpose() * back * pull + slope_.transpose() * back * turn) * at_.turn;
}

}  // namespace clatter::dynamics
