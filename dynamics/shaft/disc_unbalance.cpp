// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/disc_unbalance.hpp"

#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

Vector2d quarter_on(const Vector2d& r) { return {-r.y(), r.x()}; }

}  // namespace

DiscUnbalance::DiscUnbalance(std::string name, std::vector<int> coordinates, double unbalance,
                             double phase, double angle, double speed)
    : ForceElement(std::move(coordinates)),
      name_(std::move(name)),
      unbalance_(unbalance),
      phase_(phase),
      momenta_(momenta(Vector3d(0.0, 0.0, angle), Vector3d(0.0, 0.0, speed))) {}

Vector2d DiscUnbalance::radial(double angle) const {
  return {std::cos(angle + phase_), std::sin(angle + phase_)};
}

Vector3d DiscUnbalance::momenta(const VectorXd& y, const VectorXd& v) const {
  const Vector2d t = quarter_on(radial(y(2)));
  Vector3d both;
  both << unbalance_ * v(2) * t, unbalance_ * t.dot(v.head<2>());
  return both;
}

void DiscUnbalance::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                             bool with_tangent, Response& response) {
  const Vector2d r = radial(y(2)), t = quarter_on(r);
  const double spin = v(2), outward = r.dot(v.head<2>()), along = t.dot(v.head<2>());
  if (stage.index == 0 && momenta_.is_started())
    momenta_.keep_rate();
  else
    momenta_.set_value(stage, momenta(y, v));
  response.force = -momenta_.rate();
  response.force(2) -= unbalance_ * spin * outward;
  if (!with_tangent) return;
  const double per = 1.0 / stage.kappa, U = unbalance_;
  response.tangent.setZero(3, 3);
  response.tangent.col(2).head<2>() = -per * U * (per * t - spin * r);
  response.tangent.row(2).head<2>() = -per * U * (per * t + spin * r).transpose();
  response.tangent(2, 2) = -U * spin * along;
}

Power DiscUnbalance::power(const VectorXd& y, const VectorXd& v) const {
  return {v(2) * momenta(y, v)(2), 0.0, 0.0};
}

void DiscUnbalance::restore(const std::vector<double>& state) {
  if (state.size() != momenta_.kSaved)
    throw InputError(name_ + ": the saved state belongs to another scene");
  momenta_.restore(state);
}

}  // namespace clatter::dynamics
