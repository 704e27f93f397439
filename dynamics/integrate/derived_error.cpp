// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/derived_error.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

DerivedError::DerivedError(const System& system, const Accuracy& accuracy)
    : system_(system), force_limit_(accuracy.tolerance * accuracy.force_scale) {
  if (accuracy.acceleration_scale == 0.0) return;
  for (const ModalBody& body : system.bodies())
    acceleration_limit_.push_back(accuracy.tolerance * accuracy.acceleration_scale *
                                  (body.mass > 0.0 ? std::sqrt(body.mass) : 1.0));
}

double DerivedError::measure(const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
                             const Eigen::VectorXd& e_y) {
  double largest = 0.0;
  if (force_limit_ > 0.0) largest = force_error(e_y);
  if (acceleration_limit_.empty() || std::isnan(largest)) return largest;
  const double acceleration = acceleration_error(e_eta, e_v, e_y);
  return acceleration <= largest ? largest : acceleration;  // a NaN is kept
}

double DerivedError::force_error(const Eigen::VectorXd& e_y) {
  double largest = 0.0;
  for (int e = 0; e < system_.elements(); ++e) {
    const Eigen::VectorXd& change = system_.tangent_forces(e, e_y);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < change.size(); ++i)
      if (!system_.is_rotation(system_.tangent_row(e, i))) sum += std::abs(change(i));
    const double error = sum / force_limit_;
    if (!(error <= largest)) largest = error;
    if (std::isnan(largest)) break;
  }
  return largest;
}

double DerivedError::acceleration_error(const Eigen::VectorXd& e_eta, const Eigen::VectorXd& e_v,
                                        const Eigen::VectorXd& e_y) {
  f_.setZero(e_y.size());
  system_.add_tangent_forces(e_y, f_);
  a_ = -system_.damping().cwiseProduct(e_v) - system_.omega_squared().cwiseProduct(e_eta);
  system_.add_interface_force(f_, a_);
  a_.array() *= system_.inertia().array();
  double largest = 0.0;
  for (size_t b = 0; b < acceleration_limit_.size(); ++b) {
    const int body = static_cast<int>(b);
    const double error = a_.segment(system_.mode_offset(body), system_.bodies()[b].modes()).norm() /
                         acceleration_limit_[b];
    if (!(error <= largest)) largest = error;
    if (std::isnan(largest)) break;
  }
  return largest;
}

}  // namespace clatter::dynamics
