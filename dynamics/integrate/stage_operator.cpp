// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/stage_operator.hpp"

#include "dynamics/integrate/exact_mode.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

void scatter(const VectorXd& values, const std::vector<int>& indices, VectorXd& all) {
  for (size_t i = 0; i < indices.size(); ++i)
    all(indices[i]) = values(static_cast<Eigen::Index>(i));
}

}  // namespace

StageOperator::StageOperator(const System& system, double kappa, double diagonal)
    : system_(&system), kappa_(kappa) {
  const auto N = system.modes();
  const VectorXd &mu = system.inertia(), &delta = system.damping(),
                 &omega_squared = system.omega_squared();
  alpha_.setZero(N);
  beta_.setOnes(N);
  VectorXd* const columns[] = {&H_,         &per_force_, &per_velocity_, &v_of_v_, &v_of_a_,
                               &rate_of_v_, &rate_of_a_, &from_eta_,     &from_v_};
  for (VectorXd* column : columns) column->resize(N);
  for (Eigen::Index k = 0; k < N; ++k) {
    const bool moves = mu(k) > 0.0;
    const ExactMode fit = moves && diagonal > 0.0
                              ? exact_mode(omega_squared(k), delta(k), kappa / diagonal, diagonal)
                              : ExactMode{};
    alpha_(k) = fit.alpha;
    beta_(k) = fit.beta;
    const double c = 1.0 - kappa * fit.alpha,
                 per_omega = fit.alpha == 0.0 ? 0.0 : fit.alpha / omega_squared(k);
    v_of_v_(k) = 1.0 / c;
    v_of_a_(k) = kappa * fit.beta / c;
    rate_of_v_(k) = fit.beta - per_omega * delta(k);
    rate_of_a_(k) = -per_omega;
    per_velocity_(k) = delta(k) + v_of_a_(k) * omega_squared(k);
    per_force_(k) = moves ? 1.0 / (c + kappa * fit.beta * per_velocity_(k))
                          : 1.0 / (kappa * delta(k) + kappa * kappa * omega_squared(k));
    H_(k) = kappa * (rate_of_v_(k) * v_of_a_(k) + rate_of_a_(k)) * per_force_(k);
    // A stage without forces that begins at (e_eta, e_v).
    const double eta_of_a = kappa * (rate_of_v_(k) * v_of_a_(k) + rate_of_a_(k));
    from_eta_(k) = 1.0 - eta_of_a * per_force_(k) * omega_squared(k);
    from_v_(k) =
        moves ? kappa * rate_of_v_(k) * v_of_v_(k) - eta_of_a * per_force_(k) * per_velocity_(k)
              : 0.0;
  }
  moving_share_.setZero(system.interface_size());
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b) {
    const MatrixXd& P = system.P(b);
    const auto H = H_.segment(system.mode_offset(b), P.cols());
    const VectorXd all = P.cwiseAbs2() * H;
    const VectorXd moving = P.cwiseAbs2() * H.cwiseProduct(system.bodies()[b].inertia);
    const auto& rows = system.rows(b);
    for (Eigen::Index i = 0; i < all.size(); ++i)
      if (all(i) > 0.0) moving_share_(rows[i]) = moving(i) / all(i);
  }
  for (auto* scratch : {&part_, &modal_}) scratch->resize(system.bodies().size());
  for (auto* scratch : {&picked_, &scaled_}) scratch->resize(system.bodies().size());
}

void StageOperator::settle(const VectorXd& eta_tilde, const VectorXd& v_tilde, const VectorXd& F,
                           StageState& out) const {
  out.a = per_force_.array() * (F.array() - system_->omega_squared().array() * eta_tilde.array() -
                                per_velocity_.array() * v_tilde.array());
  out.v = v_of_v_.cwiseProduct(v_tilde) + v_of_a_.cwiseProduct(out.a);
  out.eta = eta_tilde + kappa_ * (rate_of_v_.cwiseProduct(out.v) + rate_of_a_.cwiseProduct(out.a));
}

void StageOperator::rates(const StageState& state, VectorXd& eta, VectorXd& v) const {
  eta = rate_of_v_.cwiseProduct(state.v) + rate_of_a_.cwiseProduct(state.a);
  v = beta_.cwiseProduct(state.a) + alpha_.cwiseProduct(state.v);
}

void StageOperator::filter(const VectorXd& e_eta, const VectorXd& e_v, VectorXd& filtered) const {
  filtered = from_eta_.cwiseProduct(e_eta) + from_v_.cwiseProduct(e_v);
}

void StageOperator::form_S(int body, const std::vector<int>& rows, MatrixXd& S) const {
  const MatrixXd& P = system_->P(body);
  const auto n = static_cast<Eigen::Index>(rows.size());
  MatrixXd &picked = picked_[body], &scaled = scaled_[body];
  picked.resize(n, P.cols());
  for (Eigen::Index i = 0; i < n; ++i) picked.row(i) = P.row(rows[i]);
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
  return {S_.data() + S_starts_[body], n, n};
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
