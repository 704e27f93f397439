// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/spatial_frame.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Eigen::VectorXd;

namespace {

Matrix3d inertia_of(const Matrix3d& place) { return place.trace() * Matrix3d::Identity() - place; }

Vector3d in_space(const Vector4d& rotation, const Vector3d& spin) {
  return rotation_matrix(rotation) * spin;
}

/// (0, w) * q as a matrix that multiplies q.
Matrix4d spin_before(const Vector3d& w) {
  Matrix4d L;
  L << 0.0, -w.transpose(), w, skew(w);
  return L;
}

/// (0, w) * q as a matrix that multiplies w.
Matrix43 before(const Vector4d& q) {
  Matrix43 Q;
  Q.row(0) = -q.tail<3>().transpose();
  Q.bottomRows<3>() = q(0) * Matrix3d::Identity() - skew(q.tail<3>());
  return Q;
}

Vector4d conjugate(const Vector4d& q) { return {q(0), -q(1), -q(2), -q(3)}; }

Vector4d times(const Vector4d& a, const Vector4d& b) {
  Vector4d product;
  product(0) = a(0) * b(0) - a.tail<3>().dot(b.tail<3>());
  const Vector3d u = a.tail<3>(), v = b.tail<3>();
  product.tail<3>() = a(0) * v + b(0) * u + u.cross(v);
  return product;
}

/// The integrals of b x N_a, 3 x n, by those of N_k,a b_l at [3 k + l].
template <class Integrals>
void cross_rows(const Integrals& g, Matrix3X& rows) {
  rows.resize(3, g[0].size());
  rows.row(0) = (g[7] - g[5]).transpose();
  rows.row(1) = (g[2] - g[6]).transpose();
  rows.row(2) = (g[3] - g[1]).transpose();
}

}  // namespace

SpatialFrame::SpatialFrame(const Matrix3d& inertia, const Vector4d& rotation, const Vector3d& spin)
    : rigid_(inertia), free_(inertia, 0.0, rotation, in_space(rotation, spin)) {}

SpatialFrame::SpatialFrame(const rom::InertiaInvariants& invariants, const Vector4d& rotation,
                           const Vector3d& spin)
    : modes_(static_cast<int>(invariants.size())),
      invariants_(invariants),
      rigid_(inertia_of(invariants.place)),
      free_(rigid_, 0.0, rotation, in_space(rotation, spin)) {}

void SpatialFrame::arms(const VectorXd& eta, std::array<VectorXd, 9>& g) const {
  for (size_t k = 0; k < 3; ++k)
    for (size_t l = 0; l < 3; ++l) {
      g[3 * k + l] = invariants_.moment[3 * l + k];
      g[3 * k + l].noalias() += invariants_.product[3 * k + l] * eta;
    }
}

Matrix3d SpatialFrame::inertia(const VectorXd& eta) const {
  Matrix3d place = invariants_.place;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const auto& moment = invariants_.moment;
      const auto kl = static_cast<size_t>(3 * k + l), lk = static_cast<size_t>(3 * l + k);
      place(k, l) += (moment[kl] + moment[lk]).dot(eta) + eta.dot(invariants_.product[kl] * eta);
    }
  return inertia_of(place);
}

Vector3d SpatialFrame::momentum(const VectorXd& eta, const VectorXd& rate,
                                const Vector3d& w) const {
  if (modes_ == 0) return rigid_ * w;
  std::array<VectorXd, 9> g;
  arms(eta, g);
  Matrix3X H;
  cross_rows(g, H);
  return inertia(eta) * w + H * rate;
}

void SpatialFrame::rotate(double time, const VectorXd& y, const VectorXd& v,
                          SpatialState& state) const {
  state.A = rotation_matrix(y.segment<4>(kTurn)) * free_.at(time).A;
  const Vector3d momentum = state.A.transpose() * y.segment<3>(kMomentum);
  if (modes_ == 0) {
    state.J = rigid_;
    state.w = state.J.inverse() * momentum;
  } else {
    const VectorXd eta = y.tail(modes_), rate = v.tail(modes_);
    std::array<VectorXd, 9> g;
    arms(eta, g);
    cross_rows(g, state.H);
    state.J = inertia(eta);
    state.w = state.J.inverse() * (momentum - state.H * rate);
    std::array<VectorXd, 9> moved;
    for (size_t k = 0; k < 9; ++k) moved[k] = invariants_.product[k] * rate;
    cross_rows(moved, state.drift);
    state.drift = -state.drift;
    state.J_w.resize(3, modes_);
    for (int a = 0; a < modes_; ++a) {
      Matrix3d G;
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) G(k, l) = g[3 * k + l](a);
      state.J_w.col(a) = 2.0 * G.trace() * state.w - (G + G.transpose()) * state.w;
    }
  }
  state.spin = state.A * state.w;
}

void SpatialFrame::differentiate(const VectorXd& y, SpatialState& state) const {
  const Matrix3d inverse = state.J.inverse(), A_T = state.A.transpose();
  const Vector3d L = y.segment<3>(kMomentum);
  state.turn = turn_by_quaternion(y.segment<4>(kTurn));
  state.w_by_y.setZero(3, kSpatial + modes_);
  state.w_by_v.setZero(3, kSpatial + modes_);
  state.w_by_y.middleCols<4>(kTurn) = inverse * A_T * skew(L) * state.turn;
  state.w_by_y.middleCols<3>(kMomentum) = inverse * A_T;
  if (modes_ > 0) {
    state.w_by_y.rightCols(modes_) = -inverse * (state.drift + state.J_w);
    state.w_by_v.rightCols(modes_) = -inverse * state.H;
  }
  state.spin_by_y = state.A * state.w_by_y;
  state.spin_by_y.middleCols<4>(kTurn) -= skew(state.spin) * state.turn;
  state.spin_by_v = state.A * state.w_by_v;
}

Vector4d SpatialFrame::turn_rate(double time, const VectorXd& y, const Vector3d& spin,
                                 Matrix4d* by_p, Matrix43* by_spin) const {
  const Vector4d p = y.segment<4>(kTurn);
  const Vector3d free = free_.at(time).spin;
  // (0, spin) * p - p * (0, free): the difference first, which is zero for a body without moments.
  Matrix4d rate;
  rate << 0.0, -(spin - free).transpose(), spin - free, skew(spin + free);
  rate *= 0.5;
  if (by_p != nullptr) *by_p = rate;
  if (by_spin != nullptr) *by_spin = 0.5 * before(p);
  return rate * p;
}

VectorXd SpatialFrame::rate_jump(double time, const VectorXd& y, const Vector3d& moment,
                                 const VectorXd& impulse) const {
  SpatialState at;
  rotate(time, y, VectorXd::Zero(y.size()), at);
  const Matrix3d held = at.J - at.H * at.H.transpose();
  const Vector3d w_jump = held.inverse() * (at.A.transpose() * moment - at.H * impulse);
  return impulse - at.H.transpose() * w_jump;
}

Vector4d SpatialFrame::quaternion(double time, const Vector4d& p) const {
  return times(p.normalized(), free_.at(time).q);
}

Vector3d SpatialFrame::spin(double time, const Vector4d& p, const Vector4d& rate) const {
  // 2 p' p^-1 + R(p) free, by p' = (spin * p - p * free) / 2.
  const Vector4d turned = times(rate, conjugate(p)) * (2.0 / p.squaredNorm());
  return turned.tail<3>() + rotation_matrix(p) * free_.at(time).spin;
}

void SpatialFrame::localise(double time, const Vector4d& quaternion, const Vector3d& spin,
                            Vector4d& p, Vector4d& rate) const {
  const Attitude& free = free_.at(time);
  p = times(quaternion, conjugate(free.q));
  rate = 0.5 * (spin_before(spin) - spin_matrix(free.spin)) * p;
}

}  // namespace clatter::dynamics
