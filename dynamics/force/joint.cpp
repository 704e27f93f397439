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
  const auto A = a_->state(stage.time, y.head(n_a), v.head(n_a));
  const auto B = b_->state(stage.time, y.tail(n_b), v.tail(n_b));
  const Eigen::Vector2d d = A.d - B.d, rate = A.rate - B.rate;
  const double e = d.norm();
  Eigen::Vector2d force = -law_.damping * rate;
  if (e > 0.0) force -= law_.force(e) / e * d;
  last_ = {force, rate, A.prescribed - B.prescribed, e};

  Eigen::Matrix<double, 2, Eigen::Dynamic> G(2, n_a + n_b), dG(2, n_a + n_b);
  G << A.G, -B.G;
  response.force = G.transpose() * force;
  if (!with_tangent) return;
  dG << A.B, -B.B;
  const Eigen::Matrix<double, 2, Eigen::Dynamic> dF =
      -planar_stiffness(law_, d, e) * G - law_.damping * (dG + G / stage.kappa);
  response.tangent = G.transpose() * dF;
  const Eigen::MatrixXd at_a = a_->curvature(stage.time, y.head(n_a), force);
  const Eigen::MatrixXd at_b = b_->curvature(stage.time, y.tail(n_b), -force);
  if (at_a.size() > 0) response.tangent.topLeftCorner(n_a, n_a) += at_a;
  if (at_b.size() > 0) response.tangent.bottomRightCorner(n_b, n_b) += at_b;
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
