// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/joint.hpp"

#include <utility>

namespace clatter::dynamics {
namespace {

std::vector<int> both(const Anchor& a, const Anchor& b) {
  std::vector<int> all = a.coordinates();
  all.insert(all.end(), b.coordinates().begin(), b.coordinates().end());
  return all;
}

/// dF/dd of F(e) n: slope along n, F/e across.
Eigen::Matrix2d planar_stiffness(const RadialForce& law, const RadialPoint& at,
                                 const Eigen::Vector2d& d, double e) {
  if (e < 1e-15) return radial_point(law, 0.0).slope * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d n = d / e;
  const double across = at.force / e;
  return across * Eigen::Matrix2d::Identity() + (at.slope - across) * n * n.transpose();
}

}  // namespace

Joint::Joint(std::string name, std::unique_ptr<Anchor> a, std::unique_ptr<Anchor> b,
             RadialForce law)
    : ForceElement(both(*a, *b)),
      name_(std::move(name)),
      a_(std::move(a)),
      b_(std::move(b)),
      law_(std::move(law)) {}

void Joint::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                     bool with_tangent, Response& response) {
  const auto n_a = static_cast<Eigen::Index>(a_->coordinates().size());
  const auto n_b = static_cast<Eigen::Index>(b_->coordinates().size());
  a_->find(stage.time, y.head(n_a), v.head(n_a), at_a_);
  b_->find(stage.time, y.tail(n_b), v.tail(n_b), at_b_);
  const Eigen::Vector2d d = at_a_.d - at_b_.d, rate = at_a_.rate - at_b_.rate;
  const double e = d.norm();
  const RadialPoint at = radial_point(law_, e);
  Eigen::Vector2d force = -at.damping * rate;
  if (e > 0.0) force -= at.force / e * d;
  last_ = {force, rate, at_a_.prescribed - at_b_.prescribed, e};

  G_.resize(2, n_a + n_b);
  G_.leftCols(n_a) = at_a_.G;
  G_.rightCols(n_b) = -at_b_.G;
  response.force.noalias() = G_.transpose() * force;
  if (!with_tangent) return;
  dF_.resize(2, n_a + n_b);
  dF_.noalias() = -planar_stiffness(law_, at, d, e) * G_;
  dF_ -= at.damping / stage.kappa * G_;
  dF_.leftCols(n_a) -= at.damping * at_a_.B;
  dF_.rightCols(n_b) += at.damping * at_b_.B;
  if (at.damping_slope != 0.0 && e > 0.0) {
    along_.noalias() = (at.damping_slope / e * d).transpose() * G_;
    dF_.noalias() -= rate * along_;
  }
  response.tangent.noalias() = G_.transpose().lazyProduct(dF_);
  a_->add_curvature(stage.time, y.head(n_a), force, response.tangent.topLeftCorner(n_a, n_a));
  b_->add_curvature(stage.time, y.tail(n_b), -force, response.tangent.bottomRightCorner(n_b, n_b));
}

Power Joint::power(const Eigen::VectorXd&, const Eigen::VectorXd&) const {
  const double e = finished_.eccentricity;
  return {radial_energy(law_, e), radial_point(law_, e).damping * finished_.rate.squaredNorm(),
          -finished_.force.dot(finished_.prescribed)};
}

void Joint::record(History& history) const {
  history.put(name_ + "_force_y", "N", accepted_.force.x());
  history.put(name_ + "_force_z", "N", accepted_.force.y());
  history.put(name_ + "_eccentricity", "m", accepted_.eccentricity);
}

}  // namespace clatter::dynamics
