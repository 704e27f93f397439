// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/crank_anchor.hpp"

#include <cmath>
#include <utility>

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;

Vector2d quarter_turn(const Vector2d& p) { return {-p.y(), p.x()}; }

/// (R(a) - 1) p by the half angle: no cancellation at small angles.
Vector2d turned_by(double a, const Vector2d& p) {
  const double s = std::sin(0.5 * a);
  return -2.0 * s * s * p + std::sin(a) * quarter_turn(p);
}

}  // namespace

CrankPinAnchor::CrankPinAnchor(PointWeights centre, int turn, const SliderCrank& crank)
    : Anchor(std::move(centre.coordinates)), G_(std::move(centre.G)), crank_(crank) {
  coordinates_.push_back(turn);
}

void CrankPinAnchor::find(double time, const Values& y, const Values& v, AnchorState& state) const {
  const auto n = G_.cols();
  const auto pin = crank_.crank_pin(time);
  const double a = y(n);
  const Vector2d moved = turned_by(a, pin.position), at = pin.position + moved;
  state.prescribed = turned_by(a, pin.velocity);
  state.d = moved;
  state.d.noalias() += G_ * y.head(n);
  state.G.resize(2, n + 1);
  state.G.leftCols(n) = G_;
  state.G.col(n) = quarter_turn(at);
  state.rate = state.prescribed;
  state.rate.noalias() += state.G * v;
  state.B.setZero(2, n + 1);
  state.B.col(n) = -v(n) * at + quarter_turn(pin.velocity + state.prescribed);
}

void CrankPinAnchor::add_curvature(double time, const Values& y, const Vector2d& force,
                                   Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const auto n = G_.cols();
  const Vector2d p = crank_.crank_pin(time).position;
  tangent(n, n) -= force.dot(p + turned_by(y(n), p));
}

}  // namespace clatter::dynamics
