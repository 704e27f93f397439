// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/plunger_axis.hpp"

#include <Eigen/Geometry>
#include <utility>

namespace clatter::dynamics {

using Eigen::Vector3d;
using Eigen::VectorXd;

PlungerAxis::PlungerAxis(std::unique_ptr<Port> housing, std::unique_ptr<Port> plunger,
                         const Vector3d& axis, double offset)
    : housing_(std::move(housing)), plunger_(std::move(plunger)), axis_(axis), offset_(offset) {}

std::vector<int> PlungerAxis::coordinates() const {
  std::vector<int> all = housing_->coordinates();
  all.insert(all.end(), plunger_->coordinates().begin(), plunger_->coordinates().end());
  return all;
}

void PlungerAxis::move(double time, const VectorXd& y, const VectorXd& v) {
  const int n_a = housing_->size(), n_b = plunger_->size();
  y_housing_ = y.head(n_a);
  v_housing_ = v.head(n_a);
  y_plunger_ = y.segment(n_a, n_b);
  v_plunger_ = v.segment(n_a, n_b);
  housing_->motion(time, y_housing_, v_housing_, at_housing_);
  plunger_->motion(time, y_plunger_, v_plunger_, at_plunger_);
  distance_ = at_plunger_.position - at_housing_.position;
  turned_ = at_housing_.rotation * axis_;
  const Vector3d arm = distance_.cross(turned_);
  travel_ = turned_.dot(distance_) - offset_;
  rate_ = turned_.dot(at_plunger_.velocity - at_housing_.velocity) - arm.dot(at_housing_.spin);
  const Vector6 on_plunger = wrench(turned_, Vector3d::Zero());
  const Vector6 on_housing = wrench(-turned_, -arm);
  direction_.resize(n_a + n_b);
  direction_.head(n_a).noalias() = at_housing_.work.transpose() * on_housing;
  direction_.tail(n_b).noalias() = at_plunger_.work.transpose() * on_plunger;
  gradient_.resize(n_a + n_b);
  gradient_.head(n_a).noalias() = on_housing.transpose() * at_housing_.by_y;
  gradient_.tail(n_b).noalias() = on_plunger.transpose() * at_plunger_.by_y;
}

void PlungerAxis::add_curvature(double force, Eigen::Ref<Eigen::MatrixXd> tangent) {
  const int n_a = housing_->size(), n_b = plunger_->size(), n = n_a + n_b;
  on_housing_.resize(6, n);
  on_plunger_.setZero(6, n);
  for (int j = 0; j < n; ++j) {
    Vector3d turned = Vector3d::Zero(), moved;
    if (j < n_a) {
      turned = at_housing_.by_y.col(j).tail<3>().cross(turned_);
      moved = -at_housing_.by_y.col(j).head<3>();
    } else {
      moved = at_plunger_.by_y.col(j - n_a).head<3>();
    }
    on_plunger_.col(j).head<3>() = force * turned;
    on_housing_.col(j).head<3>() = -force * turned;
    on_housing_.col(j).tail<3>() = -force * (moved.cross(turned_) + distance_.cross(turned));
  }
  tangent.topRows(n_a).noalias() += at_housing_.work.transpose() * on_housing_;
  tangent.bottomRows(n_b).noalias() += at_plunger_.work.transpose() * on_plunger_;
  const Vector3d pushed = force * turned_;
  housing_->add_curvature(y_housing_, wrench(-pushed, -distance_.cross(pushed)),
                          tangent.topLeftCorner(n_a, n_a));
  plunger_->add_curvature(y_plunger_, wrench(pushed, Vector3d::Zero()),
                          tangent.bottomRightCorner(n_b, n_b));
}

double PlungerAxis::driven_power(double force) const {
  const Vector3d pushed = force * turned_;
  return at_housing_.driven.dot(wrench(pushed, distance_.cross(pushed))) -
         at_plunger_.driven.head<3>().dot(pushed);
}

}  // namespace clatter::dynamics
