// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/stage_operator.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

StageOperator::StageOperator(const System& system, double kappa) : system_(&system), kappa_(kappa) {
  const Eigen::ArrayXd mu = system.inertia().array() / (kappa * kappa);
  const Eigen::ArrayXd delta = system.damping().array() / kappa;
  H_ = (mu + delta + system.omega_squared().array()).inverse();
  per_force_ = H_ / (kappa * kappa);
  per_velocity_ = system.damping() + kappa * system.omega_squared();
  from_eta_ = H_.array() * (mu + delta);
  from_v_ = H_.array() * system.inertia().array() / kappa;
  moving_share_.setZero(system.interface_size());
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const MatrixXd& P = system.P(b);
    const auto H = H_.segment(system.mode_offset(b), P.cols());
    S_.push_back((P * H.asDiagonal()) * P.transpose());
    const VectorXd all = P.cwiseAbs2() * H;
    const VectorXd moving =
        P.cwiseAbs2() * H.cwiseProduct(system.bodies()[static_cast<size_t>(b)].inertia);
    const auto& rows = system.rows(b);
    for (Eigen::Index i = 0; i < all.size(); ++i)
      if (all(i) > 0.0) moving_share_(rows[static_cast<size_t>(i)]) = moving(i) / all(i);
  }
  in_.resize(S_.size());
  out_.resize(S_.size());
}

void StageOperator::acceleration(const VectorXd& eta_tilde, const VectorXd& v_tilde,
                                 const VectorXd& F, VectorXd& a) const {
  a = per_force_.array() * (F.array() - system_->omega_squared().array() * eta_tilde.array() -
                            per_velocity_.array() * v_tilde.array());
}

void StageOperator::filter(const VectorXd& e_eta, const VectorXd& e_v, VectorXd& filtered) const {
  filtered = from_eta_.cwiseProduct(e_eta) + from_v_.cwiseProduct(e_v);
}

void StageOperator::apply_S(const VectorXd& f, VectorXd& result) const {
  result.resize(f.size());
  for (size_t b = 0; b < S_.size(); ++b) {
    const auto& rows = system_->rows(static_cast<int>(b));
    if (rows.empty()) continue;
    gather(f, rows, in_[b]);
    out_[b].noalias() = S_[b] * in_[b];
    for (size_t i = 0; i < rows.size(); ++i)
      result(rows[i]) = out_[b](static_cast<Eigen::Index>(i));
  }
}

}  // namespace clatter::dynamics
