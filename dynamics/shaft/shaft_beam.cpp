// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/shaft_beam.hpp"

#include <Eigen/LU>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix2d;
using Eigen::VectorXd;

ShaftBeam::ShaftBeam(std::string name, std::vector<int> coordinates, const ShaftAxes& axes,
                     const BeamEnds& ends, const ShaftFlexibility& flexibility, double loss_time)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      turn_(3 + axes.axis),
      loss_time_(loss_time) {
  const int u[] = {axes.first(), axes.second()};
  // The slopes of the two planes are s_1 = t_2 and s_2 = -t_1.
  const int tilt[] = {3 + axes.second(), 3 + axes.first()};
  const double sign[] = {1.0, -1.0};
  const Matrix2d stiffness = flexibility.bending.inverse();
  B_.setZero();
  K_.setZero();
  for (int plane = 0; plane < 2; ++plane) {
    const int row = 2 * plane;
    B_(row, u[plane]) = -1.0;
    B_(row, 6 + u[plane]) = 1.0;
    B_(row, tilt[plane]) = -sign[plane] * (ends.arm_i + ends.length);
    B_(row, 6 + tilt[plane]) = sign[plane] * ends.arm_j;
    B_(row + 1, tilt[plane]) = -sign[plane];
    B_(row + 1, 6 + tilt[plane]) = sign[plane];
    K_.block<2, 2>(row, row) = 0.5 * (stiffness + stiffness.transpose());
  }
  quarter_turn_.setZero();
  quarter_turn_.topRightCorner<2, 2>() = -Matrix2d::Identity();
  quarter_turn_.bottomLeftCorner<2, 2>() = Matrix2d::Identity();
  along_.setZero();
  along_(0, turn_) = along_(1, axes.axis) = -1.0;
  along_(0, 6 + turn_) = along_(1, 6 + axes.axis) = 1.0;
  k_along_ << 1.0 / flexibility.torsion, 1.0 / flexibility.axial;
}

ShaftBeam::Deformation ShaftBeam::deform(const VectorXd& y, const VectorXd& v) const {
  Deformation at;
  at.bent.noalias() = B_ * y;
  at.across.noalias() = quarter_turn_ * at.bent;
  at.spin = 0.5 * (v(turn_) + v(6 + turn_));
  at.rate.noalias() = B_ * v;
  at.rate -= at.spin * at.across;
  at.along.noalias() = along_ * y;
  at.along_rate.noalias() = along_ * v;
  return at;
}

void ShaftBeam::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                         bool with_tangent, Response& response) {
  const Deformation at = deform(y, v);
  const Eigen::Vector4d pull = K_ * (at.bent + loss_time_ * at.rate);
  const Eigen::Vector2d along = k_along_.cwiseProduct(at.along + loss_time_ * at.along_rate);
  const Eigen::Vector4d k_across = K_ * at.across;
  const double drag = 0.5 * loss_time_ * at.rate.dot(k_across);
  response.force.resize(12);
  response.force.noalias() = -(B_.transpose() * pull);
  response.force.noalias() -= along_.transpose() * along;
  response.force(turn_) += drag;
  response.force(6 + turn_) += drag;
  if (!with_tangent) return;

  const double per_rate = 1.0 / stage.kappa;
  // d(rate) = by_bent dD - across dW, dW = spin_by . dy.
  const Eigen::Matrix4d by_bent = per_rate * Eigen::Matrix4d::Identity() - at.spin * quarter_turn_;
  Eigen::Matrix<double, 4, 12> rate = by_bent * B_;
  rate.col(turn_) -= 0.5 * per_rate * at.across;
  rate.col(6 + turn_) -= 0.5 * per_rate * at.across;
  const Eigen::Matrix<double, 4, 12> moved = K_ * (B_ + loss_time_ * rate);
  const Eigen::Matrix<double, 2, 12> stretched =
      ((1.0 + loss_time_ * per_rate) * k_along_).asDiagonal() * along_;
  response.tangent.resize(12, 12);
  response.tangent.noalias() = -(B_.transpose() * moved);
  response.tangent.noalias() -= along_.transpose() * stretched;
  const Eigen::Matrix<double, 1, 12> dragged =
      0.5 * loss_time_ *
      (k_across.transpose() * rate + (K_ * at.rate).transpose() * (quarter_turn_ * B_));
  response.tangent.row(turn_) += dragged;
  response.tangent.row(6 + turn_) += dragged;
}

Power ShaftBeam::power(const VectorXd& y, const VectorXd& v) const {
  const Deformation at = deform(y, v);
  const double stored =
      0.5 * (at.bent.dot(K_ * at.bent) + at.along.dot(k_along_.cwiseProduct(at.along)));
  const double lost = loss_time_ * (at.rate.dot(K_ * at.rate) +
                                    at.along_rate.dot(k_along_.cwiseProduct(at.along_rate)));
  return {stored, lost, 0.0};
}

}  // namespace clatter::dynamics
