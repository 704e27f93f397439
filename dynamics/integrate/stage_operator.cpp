// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/stage_operator.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void scatter(const VectorXd& values, const std::vector<int>& indices, VectorXd& all) {
  for (size_t i = 0; i < indices.size(); ++i)
    all(indices[i]) = values(static_cast<Eigen::Index>(i));
}

}  // namespace

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
    const VectorXd all = P.cwiseAbs2() * H;
    const VectorXd moving =
        P.cwiseAbs2() * H.cwiseProduct(system.bodies()[static_cast<size_t>(b)].inertia);
    const auto& rows = system.rows(b);
    for (Eigen::Index i = 0; i < all.size(); ++i)
      if (all(i) > 0.0) moving_share_(rows[static_cast<size_t>(i)]) = moving(i) / all(i);
  }
  for (auto* scratch : {&part_, &modal_}) scratch->resize(system.bodies().size());
  for (auto* scratch : {&picked_, &scaled_}) scratch->resize(system.bodies().size());
}

void StageOperator::acceleration(const VectorXd& eta_tilde, const VectorXd& v_tilde,
                                 const VectorXd& F, VectorXd& a) const {
  a = per_force_.array() * (F.array() - system_->omega_squared().array() * eta_tilde.array() -
                            per_velocity_.array() * v_tilde.array());
}

void StageOperator::filter(const VectorXd& e_eta, const VectorXd& e_v, VectorXd& filtered) const {
  filtered = from_eta_.cwiseProduct(e_eta) + from_v_.cwiseProduct(e_v);
}

void StageOperator::form_S(int body, const std::vector<int>& rows, MatrixXd& S) const {
  const MatrixXd& P = system_->P(body);
  const auto n = static_cast<Eigen::Index>(rows.size());
  MatrixXd &picked = picked_[static_cast<size_t>(body)],
           &scaled = scaled_[static_cast<size_t>(body)];
  picked.resize(n, P.cols());
  for (Eigen::Index i = 0; i < n; ++i) picked.row(i) = P.row(rows[static_cast<size_t>(i)]);
  scaled = picked * H_.segment(system_->mode_offset(body), P.cols()).asDiagonal();
  S.resize(n, n);
  S.noalias() = scaled * picked.transpose();
}

void StageOperator::form_all_S() const {
  size_t entries = 0;
  for (size_t b = 0; b < system_->bodies().size(); ++b) {
    S_starts_.push_back(entries);
    const size_t n = system_->rows(static_cast<int>(b)).size();
    entries += n * n;
  }
  S_.resize(entries);
  for (size_t b = 0; b < S_starts_.size(); ++b) {
    const MatrixXd& P = system_->P(static_cast<int>(b));
    const auto H = H_.segment(system_->mode_offset(static_cast<int>(b)), P.cols());
    Eigen::Map<MatrixXd> S(S_.data() + S_starts_[b], P.rows(), P.rows());
    if (system_->has_single_rows(static_cast<int>(b)))
      S = (P.cwiseAbs2() * H).asDiagonal();
    else
      S.noalias() = P * H.asDiagonal() * P.transpose();
  }
}

Eigen::Map<const MatrixXd> StageOperator::S(int body) const {
  if (S_starts_.empty()) form_all_S();
  const auto n = static_cast<Eigen::Index>(system_->rows(body).size());
  return {S_.data() + S_starts_[static_cast<size_t>(body)], n, n};
}

void StageOperator::apply_S(const VectorXd& f, VectorXd& result) const {
  result.resize(f.size());
  const SingleRows& singles = system_->single_rows();
  for (size_t i = 0; i < singles.y.size(); ++i)
    result(singles.y[i]) =
        singles.scale[i] * singles.scale[i] * H_(singles.mode[i]) * f(singles.y[i]);
  for (size_t b = 0; b < part_.size(); ++b) {
    const int body = static_cast<int>(b);
    const auto& rows = system_->rows(body);
    if (rows.empty() || system_->has_single_rows(body)) continue;
    const MatrixXd& P = system_->P(body);
    gather(f, rows, part_[b]);
    if (!S_.empty() && P.rows() < 2 * P.cols()) {
      modal_[b].noalias() = S(body) * part_[b];
      scatter(modal_[b], rows, result);
      continue;
    }
    modal_[b].noalias() = P.transpose() * part_[b];
    modal_[b].array() *= H_.segment(system_->mode_offset(body), P.cols()).array();
    part_[b].noalias() = P * modal_[b];
    scatter(part_[b], rows, result);
  }
}

}  // namespace clatter::dynamics
