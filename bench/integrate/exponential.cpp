// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/integrate/exponential.hpp"

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/base/error.hpp"

namespace clatter::bench {

using dynamics::Stage;
using dynamics::StageOperator;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kConverged = 0.05, kSlow = 0.3;  // as in the kernel's Newton iteration
constexpr int kMostIterations = 24;

dynamics::StepOptions with_one_stage(dynamics::StepOptions options) {
  options.method = &dynamics::predictor_corrector();
  return options;
}

}  // namespace

Exponential::Exponential(dynamics::System& system, const dynamics::StepOptions& options)
    : Integrator(system, with_one_stage(options)) {
  if ((system.inertia().array() == 0.0).any())
    throw InputError("bench: found coordinates without inertia, expected modes with inertia");
}

void Exponential::forget_history() {
  Integrator::forget_history();
  dt_before_ = 0.0;
  F_0_.resize(0);
  factored_for_ = 0.0;
}

VectorXd Exponential::modal(const VectorXd& f, double time) const {
  VectorXd F;
  system_.load_force(time, F);
  system_.add_interface_force(f, F);
  return F;
}

const Exponential::Modes& Exponential::modes_of(double dt) {
  const auto [found, is_new] = known_.try_emplace(dt);
  Modes& modes = found->second;
  if (!is_new) return modes;
  const int N = system_.modes();
  for (auto* m : {&modes.eta, &modes.v, &modes.from_0, &modes.from_1}) m->resize(N, 2);
  for (int k = 0; k < N; ++k) {
    // (eta, v, F, F'): a force that is linear in time.
    Eigen::Matrix4d rate = Eigen::Matrix4d::Zero();
    rate(0, 1) = rate(1, 2) = rate(2, 3) = 1.0;
    rate(1, 0) = -system_.omega_squared()(k);
    rate(1, 1) = -system_.damping()(k);
    const Eigen::Matrix4d map = Eigen::Matrix4d(dt * rate).exp();
    modes.eta.row(k) = map.row(0).head<2>();
    modes.v.row(k) = map.row(1).head<2>();
    for (int i = 0; i < 2; ++i) {
      modes.from_1(k, i) = map(i, 3) / dt;
      modes.from_0(k, i) = map(i, 2) - modes.from_1(k, i);
    }
  }
  const int n = system_.interface_size();
  modes.S = modes.S_v = MatrixXd::Zero(n, n);
  for (int b = 0; b < static_cast<int>(system_.bodies().size()); ++b) {
    const MatrixXd& P = system_.P(b);
    const auto of_body = modes.from_1.middleRows(system_.mode_offset(b), P.cols());
    const auto& rows = system_.rows(b);
    modes.S(rows, rows) = P * of_body.col(0).asDiagonal() * P.transpose();
    modes.S_v(rows, rows) = P * of_body.col(1).asDiagonal() * P.transpose();
  }
  return modes;
}

/// J = I - (df/dy S + df/dv S_v) in terms of the forces f.
void Exponential::factor(const Stage& stage, const Modes& modes) {
  const int n = system_.interface_size();
  const VectorXd y = y_pred_ + modes.S * f_, v = v_pred_ + modes.S_v * f_;
  // Tangents are df/dy + df/dv / kappa: two kappas give both parts.
  const auto tangent = [&](double kappa) {
    Stage own = stage;
    own.kappa = kappa;
    VectorXd f;
    system_.evaluate(own, y, v, true, f);
    MatrixXd all = MatrixXd::Zero(n, n);
    for (int e = 0; e < system_.elements(); ++e) {
      const auto& at = system_.element(e).coordinates();
      std::vector<int> rows;
      for (const int i : system_.tangent_rows(e)) rows.push_back(at[i]);
      if (rows.empty()) rows = at;
      const MatrixXd& own_tangent = system_.response(e).tangent;
      for (size_t j = 0; j < rows.size(); ++j)
        for (size_t i = 0; i < rows.size(); ++i)
          all(rows[i], rows[j]) += own_tangent(static_cast<Index>(i), static_cast<Index>(j));
    }
    return all;
  };
  const double h = stage.kappa;
  const MatrixXd whole = tangent(h), half = tangent(0.5 * h);
  const MatrixXd K_v = h * (half - whole), K_y = 2.0 * whole - half;
  matrix_.compute(MatrixXd::Identity(n, n) - K_y * modes.S - K_v * modes.S_v);
  factored_for_ = stage.kappa;
  ++statistics_.factorizations;
}

bool Exponential::solve(const Stage& stage, const Modes& modes) {
  double previous = INFINITY;
  bool fresh = factored_for_ != stage.kappa;
  VectorXd found;
  for (int i = 0; i < kMostIterations; ++i) {
    if (fresh) factor(stage, modes);
    ++statistics_.evaluations;
    system_.evaluate(stage, y_pred_ + modes.S * f_, v_pred_ + modes.S_v * f_, false, found);
    const VectorXd step = matrix_.solve(found - f_);
    f_ += step;
    const VectorXd moved = modes.S * step;
    const double size = dynamics::largest_entry(moved.cwiseProduct(weights_.displacement)).value;
    if (!std::isfinite(size)) break;
    const bool slow = size > kSlow * previous;
    if (size <= kConverged && (fresh || !slow)) return true;
    fresh = slow;
    previous = size;
  }
  factored_for_ = 0.0;
  return false;
}

Exponential::Verdict Exponential::attempt(double dt, const StageOperator&) {
  const Modes& modes = modes_of(dt);
  system_.begin_step(now_.time);
  if (F_0_.size() == 0) {
    system_.evaluate({now_.time, dt, 1, {0.0}}, now_.y, now_.v_y, false, f_);
    F_0_ = modal(f_, now_.time);
  }
  const double end = now_.time + dt;
  auto& out = stages_[0];
  const auto move = [&](const VectorXd& F_1) {
    const auto of = [&](const Eigen::MatrixX2d& E, int i) -> VectorXd {
      return E.col(0).cwiseProduct(now_.eta) + E.col(1).cwiseProduct(now_.v) +
             modes.from_0.col(i).cwiseProduct(F_0_) + modes.from_1.col(i).cwiseProduct(F_1);
    };
    out.eta = of(modes.eta, 0);
    out.v = of(modes.v, 1);
  };
  VectorXd loads;
  system_.load_force(end, loads);
  move(loads);
  y_pred_ = system_.interface(out.eta);
  v_pred_ = system_.interface(out.v);
  const Stage stage{end, dt, 1, {0.0}};
  if (!solve(stage, modes)) return Verdict::kNewton;
  F_1_ = modal(f_, end);
  move(F_1_);
  out.time = end;
  out.a =
      F_1_ - system_.damping().cwiseProduct(out.v) - system_.omega_squared().cwiseProduct(out.eta);
  out.y = system_.interface(out.eta);
  out.v_y = system_.interface(out.v);
  if (!options_.fixed) {
    // The interpolation lacks F'' s (s - dt) / 2, whose integral is -F'' dt^3 / 12; without history
    // the change of the forces stands for it.
    VectorXd lacking = F_1_ - F_0_;
    double share = 1.0 / 6.0;
    if (dt_before_ > 0.0) {
      lacking -= dt / dt_before_ * (F_0_ - F_before_);
      share = dt / (3.0 * (dt + dt_before_));
    }
    e_v_ = share * modes.from_1.col(1).cwiseProduct(lacking);
    e_eta_ = share * modes.from_1.col(0).cwiseProduct(lacking);
    last_error_ = measure(system_.interface(e_eta_));
    if (!(last_error_ <= 1.0)) return Verdict::kError;
  }
  system_.finish_stage(stage);
  return Verdict::kAccepted;
}

void Exponential::accepted() {
  dt_before_ = now_.time - before_.time;
  F_before_ = F_0_;
  F_0_ = F_1_;
}

}  // namespace clatter::bench
