// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/elastic_rod_anchor.hpp"

#include <cmath>

namespace clatter::dynamics {
namespace {

Eigen::Matrix2d turn_by(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return Eigen::Matrix2d{{c, -s}, {s, c}};
}

/// e_x times a vector (y, z).
Eigen::Vector2d turned_right(const Eigen::Vector2d& vector) { return {-vector.y(), vector.x()}; }

}  // namespace

ElasticRodAnchor::ElasticRodAnchor(std::vector<int> coordinates, const SliderCrank& crank,
                                   const Eigen::Vector2d& arm)
    : Anchor(std::move(coordinates)), crank_(crank), arm_(arm) {}

void ElasticRodAnchor::find(double time, const Values& y, const Values& v,
                            AnchorState& state) const {
  const Motion<double> ideal = crank_.rod_angle(time);
  const double small = y(2), spin = ideal.velocity + v(2);
  const Eigen::Matrix2d R = turn_by(ideal.position + small);
  const Eigen::Vector2d bent = R * y.tail<2>(), bent_rate = R * v.tail<2>();
  // (R(phi + small) - R(phi)) arm by the half-angle form: no cancellation at micrometres.
  const Eigen::Vector2d swung =
      2.0 * std::sin(0.5 * small) * turned_right(turn_by(ideal.position + 0.5 * small) * arm_);
  const Eigen::Vector2d across = turned_right(R * arm_ + bent);
  state.d = y.head<2>() + swung + bent;
  state.prescribed = ideal.velocity * turned_right(swung + bent);
  state.rate = v.head<2>() + across * v(2) + bent_rate + state.prescribed;
  state.G.resize(2, 5);
  state.G << Eigen::Matrix2d::Identity(), across, R;
  state.B.setZero(2, 5);
  state.B.col(2) = spin * turned_right(across) + turned_right(bent_rate);
  for (int k = 0; k < 2; ++k) state.B.col(3 + k) = spin * turned_right(R.col(k));
}

void ElasticRodAnchor::add_curvature(double time, const Values& y, const Eigen::Vector2d& force,
                                     Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const Eigen::Matrix2d R = turn_by(crank_.rod_angle(time).position + y(2));
  tangent(2, 2) -= force.dot(R * (arm_ + y.tail<2>()));
  for (int k = 0; k < 2; ++k) {
    const double turning = force.dot(turned_right(R.col(k)));
    tangent(2, 3 + k) += turning;
    tangent(3 + k, 2) += turning;
  }
}

}  // namespace clatter::dynamics
