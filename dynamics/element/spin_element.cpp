// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/spin_element.hpp"

#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr int kStates = kSpatial - kTurn;  // p and L

}  // namespace

SpinElement::SpinElement(std::string body, std::vector<int> coordinates,
                         std::shared_ptr<SpatialFrame> frame, const VectorXd& y_start,
                         const VectorXd& v_start)
    : ForceElement(std::move(coordinates)), body_(std::move(body)), frame_(std::move(frame)) {
  time_ = frame_->free().start();
  rotate(y_start, v_start);
  h_rate_ = VectorXd::Zero(frame_->modes());
  stage_rate_.fill(h_rate_);
  h_ = frame_->modes() > 0 ? VectorXd(state_.H.transpose() * state_.w) : h_rate_;
}

void SpinElement::rotate(const VectorXd& y, const VectorXd& v) const {
  all_y_.setZero(kTurn + y.size());
  all_v_.setZero(kTurn + v.size());
  all_y_.tail(y.size()) = y;
  all_v_.tail(v.size()) = v;
  frame_->rotate(time_, all_y_, all_v_, state_);
}

void SpinElement::evaluate(const Stage& stage, const VectorXd& y, const VectorXd& v,
                           bool with_tangent, Response& response) {
  const int size = static_cast<int>(y.size());
  time_ = stage.time;
  rotate(y, v);
  Eigen::Matrix4d by_p;
  Matrix43 by_spin;
  response.force.setZero(size);
  response.force.head<4>() = frame_->turn_rate(stage.time, all_y_, state_.spin, &by_p, &by_spin);
  if (with_tangent) {
    frame_->differentiate(all_y_, state_);
    response.tangent.setZero(size, size);
    response.tangent.topRows<4>() =
        by_spin * (state_.spin_by_y + state_.spin_by_v / stage.kappa).rightCols(size);
    response.tangent.topLeftCorner<4, 4>() += by_p;
  }
  if (frame_->modes() > 0) add_modes(stage, with_tangent, response);
}

void SpinElement::add_modes(const Stage& stage, bool with_tangent, Response& response) {
  const int n = frame_->modes();
  const auto& product = frame_->invariants().product;
  const Vector3d& w = state_.w;
  const Matrix3d weight = w.squaredNorm() * Matrix3d::Identity() - w * w.transpose();
  h_stage_ = state_.H.transpose() * w;
  const bool again = stage.index == 0 && started_;  // after an event: the state itself
  if (again) {
    h_ = h_stage_;
    h_rate_ = stage_rate_[0];
  } else {
    h_before_ = h_;
    for (int j = 0; j < stage.index; ++j) h_before_ += stage.weights[j] * stage_rate_[j];
    h_rate_ = (h_stage_ - h_before_) / stage.kappa;
  }
  auto force = response.force.tail(n);
  force = 0.5 * state_.J_w.transpose() * w + state_.drift.transpose() * w - h_rate_;
  if (!with_tangent) return;

  // w . (N_a x N_b), skew, and the centrifugal softening.
  const MatrixXd coriolis = w.x() * (product[5] - product[7]) + w.y() * (product[6] - product[2]) +
                            w.z() * (product[1] - product[3]);
  MatrixXd softening = MatrixXd::Zero(n, n);
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) softening += weight(k, l) * product[3 * k + l];
  const double per_kappa = 1.0 / stage.kappa;
  const Matrix3X change = (state_.w_by_y + state_.w_by_v * per_kappa).rightCols(kStates + n);
  const double share = again ? 0.0 : per_kappa;  // of h in its rate
  auto rows = response.tangent.bottomRows(n);
  rows = (state_.J_w + state_.drift - share * state_.H).transpose() * change;
  rows.rightCols(n) += softening + (per_kappa + share) * coriolis;
}

void SpinElement::begin_step(double) { stages_ = 0; }

void SpinElement::finish_stage(const Stage& stage) {
  stage_rate_[stage.index] = h_rate_;
  stages_ = stage.index;
}

void SpinElement::accept_step(double) {
  started_ = true;
  if (frame_->modes() == 0) return;
  h_ = h_stage_;
  stage_rate_[0] = stage_rate_[stages_];
}

Power SpinElement::power(const VectorXd& y, const VectorXd& v) const {
  rotate(y, v);
  double stored = 0.5 * state_.w.dot(state_.J * state_.w);
  if (frame_->modes() > 0) stored += state_.w.dot(state_.H * v.tail(frame_->modes()));
  return {stored, 0.0, 0.0};
}

std::vector<double> SpinElement::save() const {
  const Attitude& at = frame_->free().first();
  std::vector<double> state{frame_->free().start()};
  const auto add = [&](const auto& values) {
    state.insert(state.end(), values.data(), values.data() + values.size());
  };
  add(at.q);
  add(at.spin);
  add(h_);
  add(stage_rate_[0]);
  return state;
}

void SpinElement::restore(const std::vector<double>& state) {
  const int n = frame_->modes();
  if (static_cast<int>(state.size()) != 8 + 2 * n)
    throw InputError(body_ + " rotation: the saved state belongs to another scene");
  const Eigen::Map<const VectorXd> all(state.data(), static_cast<Eigen::Index>(state.size()));
  frame_->restart(all(0), all.segment<4>(1), all.segment<3>(5));
  h_ = all.segment(8, n);
  stage_rate_[0] = all.tail(n);
  started_ = true;
}

}  // namespace clatter::dynamics
