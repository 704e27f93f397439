// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/joint.hpp"

namespace clatter::dynamics {
namespace {

std::vector<int> both(const Anchor& a, const Anchor& b) {
  std::vector<int> all = a.coordinates();
  all.insert(all.end(), b.coordinates().begin(), b.coordinates().end());
  return all;
}

/// dF/dd of F(e) n: slope along n, F/e across.
Eigen::Matrix2d planar_stiffness(const RadialLaw& law, const Eigen::Vector2d& d, double e) {
  if (e < 1e-15) return law.slope(0.0) * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d n = d / e;
  const double across = law.force(e) / e;
  return across * Eigen::Matrix2d::Identity() + (law.slope(e) - across) * n * n.transpose();
}

}  // namespace

Joint::Joint(std::string name, std::unique_ptr<Anchor> a, std::unique_ptr<Anchor> b,
             const RadialLaw& law)
    : ForceElement(both(*a, *b)),
      name_(std::move(name)),
      a_(std::move(a)),
      b_(std::move(b)),
      law_(law) {}

void Joint::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                     bool with_tangent, Response& response) {
  const auto n_a = static_cast<Eigen::Index>(a_->coordinates().size());
  const auto n_b = static_cast<Eigen::Index>(b_->coordinates().size());
  a_->find(stage.time, y.head(n_a), v.head(n_a), at_a_);
  b_->find(stage.time, y.tail(n_b), v.tail(n_b), at_b_);
  const Eigen::Vector2d d = at_a_.d - at_b_.d, rate = at_a_.rate - at_b_.rate;
  const double e = d.norm();
  Eigen::Vector2d force = -law_.damping * rate;
  if (e > 0.0) force -= law_.force(e) / e * d;
  last_ = {force, rate, at_a_.prescribed - at_b_.prescribed, e};

  G_.resize(2, n_a + n_b);
  G_.leftCols(n_a) = at_a_.G;
  G_.rightCols(n_b) = -at_b_.G;
  response.force.noalias() = G_.transpose() * force;
  if (!with_tangent) return;
  dF_.resize(2, n_a + n_b);
  dF_.noalias() = -planar_stiffness(law_, d, e) * G_;
  dF_ -= law_.damping / stage.kappa * G_;
  dF_.leftCols(n_a) -= law_.damping * at_a_.B;
  dF_.rightCols(n_b) += law_.damping * at_b_.B;
  response.tangent.noalias() = G_.transpose().lazyProduct(dF_);
  a_->add_curvature(stage.time, y.head(n_a), force, response.tangent.topLeftCorner(n_a, n_a));
  b_->add_curvature(stage.time, y.tail(n_b), -force, response.tangent.bottomRightCorner(n_b, n_b));
}

Power Joint::power(const Eigen::VectorXd&, const Eigen::VectorXd&) const {
  return {law_.energy(finished_.eccentricity), law_.damping * finished_.rate.squaredNorm(),
          -finished_.force.dot(finished_.prescribed)};
}

void Joint::record(History& history) const {
  history.put(name_ + "_force_y", "N", accepted_.force.x());
  history.put(name_ + "_force_z", "N", accepted_.force.y());
  history.put(name_ + "_eccentricity", "m", accepted_.eccentricity);
}

}  // namespace clatter::dynamics
