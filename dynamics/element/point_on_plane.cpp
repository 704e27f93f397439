// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/point_on_plane.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

PointOnPlane::PointOnPlane(std::unique_ptr<Port> a, std::unique_ptr<Port> b, const Vector3d& normal)
    : a_(std::move(a)), b_(std::move(b)), plane_(normal) {}

std::vector<int> PointOnPlane::coordinates() const {
  std::vector<int> all = a_->coordinates();
  all.insert(all.end(), b_->coordinates().begin(), b_->coordinates().end());
  return all;
}

const PlaneMotion& PointOnPlane::move(double time, const VectorXd& y, const VectorXd& v) const {
  y_a_ = y.head(a_->size());
  v_a_ = v.head(a_->size());
  y_b_ = y.tail(b_->size());
  v_b_ = v.tail(b_->size());
  a_->motion(time, y_a_, v_a_, at_a_);
  b_->motion(time, y_b_, v_b_, at_b_);
  at_.normal = at_b_.rotation * plane_;
  at_.distance = at_a_.position - at_b_.position;
  at_.velocity = at_a_.velocity - at_b_.velocity - at_b_.spin.cross(at_.distance);
  at_.gap = at_.normal.dot(at_.distance);
  at_.rate = at_.normal.dot(at_.velocity);
  at_.slip = at_.velocity - at_.rate * at_.normal;
  return at_;
}

void PointOnPlane::apply(const Vector3d& force, VectorXd& on) const {
  on.resize(a_->size() + b_->size());
  on.head(a_->size()).noalias() = at_a_.work.transpose() * wrench(force, Vector3d::Zero());
  on.tail(b_->size()).noalias() =
      at_b_.work.transpose() * wrench(-force, -at_.distance.cross(force));
}

void PointOnPlane::differentiate(double per_kappa) const {
  const int n_a = a_->size(), n_b = b_->size(), n = n_a + n_b;
  for (Matrix3X* matrix : {&distance_, &velocity_, &turn_, &normal_}) matrix->setZero(3, n);
  distance_.leftCols(n_a) = at_a_.by_y.topRows<3>();
  distance_.rightCols(n_b) = -at_b_.by_y.topRows<3>();
  velocity_.leftCols(n_a) = at_a_.rate_by_y.topRows<3>() + per_kappa * at_a_.rate_by_v.topRows<3>();
  velocity_.rightCols(n_b) =
      -at_b_.rate_by_y.topRows<3>() - per_kappa * at_b_.rate_by_v.topRows<3>();
  turn_.rightCols(n_b) = at_b_.by_y.bottomRows<3>();
  const Matrix3d arm = skew(at_.distance), spin = skew(at_b_.spin), across = skew(at_.normal);
  for (int j = 0; j < n; ++j) velocity_.col(j) -= spin * distance_.col(j);
  for (int j = 0; j < n_b; ++j)
    velocity_.col(n_a + j) +=
        arm * (at_b_.rate_by_y.col(j).tail<3>() + per_kappa * at_b_.rate_by_v.col(j).tail<3>());
  normal_.noalias() = -across * turn_;
  gap_.noalias() = at_.normal.transpose() * distance_;
  gap_.noalias() += at_.distance.transpose() * normal_;
  rate_.noalias() = at_.normal.transpose() * velocity_;
  rate_.noalias() += at_.velocity.transpose() * normal_;
}

void PointOnPlane::add_up(const Vector3d& force, const Matrix3X& by_force,
                          MatrixXd& tangent) const {
  const int n_a = a_->size(), n_b = b_->size();
  tangent.resize(n_a + n_b, n_a + n_b);
  tangent.topRows(n_a).noalias() = at_a_.work.topRows<3>().transpose() * by_force;
  const Matrix3d arm = skew(at_.distance), pull = skew(force);
  on_b_.resize(6, n_a + n_b);
  for (int j = 0; j < n_a + n_b; ++j) {
    on_b_.col(j).head<3>() = -by_force.col(j);
    on_b_.col(j).tail<3>() = pull * distance_.col(j) - arm * by_force.col(j);
  }
  tangent.bottomRows(n_b).noalias() = at_b_.work.transpose() * on_b_;
  a_->add_curvature(y_a_, wrench(force, Vector3d::Zero()), tangent.topLeftCorner(n_a, n_a));
  b_->add_curvature(y_b_, wrench(-force, -at_.distance.cross(force)),
                    tangent.bottomRightCorner(n_b, n_b));
}

Matrix3d PointOnPlane::axes() const {
  Matrix3d axes;
  const Vector3d tangent = plane_.unitOrthogonal();
  axes << at_.normal, at_b_.rotation * tangent, at_b_.rotation * plane_.cross(tangent);
  return axes;
}

void PointOnPlane::by_jumps(Matrix3X& by_y, Matrix3X& by_v) const {
  differentiate(0.0);
  by_y = velocity_;
  differentiate(1.0);
  by_v = velocity_ - by_y;
}

double PointOnPlane::input(const Vector3d& force) const {
  return at_b_.driven.dot(wrench(force, at_.distance.cross(force))) -
         at_a_.driven.head<3>().dot(force);
}

}  // namespace clatter::dynamics
