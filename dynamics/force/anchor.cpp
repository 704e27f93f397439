// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/force/anchor.hpp"

#include <cmath>

namespace clatter::dynamics {

void PointWeights::add(int coordinate, double lateral, double stroke) {
  coordinates.push_back(coordinate);
  G.conservativeResize(Eigen::NoChange, G.cols() + 1);
  G.rightCols<1>() << lateral, stroke;
}

LinearAnchor::LinearAnchor(PointWeights point)
    : Anchor(std::move(point.coordinates)), G_(std::move(point.G)) {}

void LinearAnchor::find(double, const Values& y, const Values& v, AnchorState& state) const {
  state.G = G_;
  state.B.setZero(2, G_.cols());
  state.d.noalias() = G_ * y;
  state.rate.noalias() = G_ * v;
  state.prescribed.setZero();
}

RodAnchor::RodAnchor(std::vector<int> coordinates, const SliderCrank& crank, double arm)
    : Anchor(std::move(coordinates)), crank_(crank), arm_(arm) {}

void RodAnchor::find(double time, const Values& y, const Values& v, AnchorState& state) const {
  const auto ideal = crank_.rod_angle(time);
  const double small = y(2), phi = ideal.position + small;
  // u(phi) - u(ideal) by the half-angle form: no cancellation at micrometre deviations.
  const double middle = ideal.position + 0.5 * small, chord = 2.0 * std::sin(0.5 * small);
  const Eigen::Vector2d turned = -chord * Eigen::Vector2d(std::cos(middle), std::sin(middle));
  const auto across = [](double angle) {
    return Eigen::Vector2d(-std::cos(angle), -std::sin(angle));  // du/dphi
  };
  const Eigen::Vector2d along = rod_direction(phi);
  state.d = y.head<2>() + arm_ * turned;
  state.prescribed = arm_ * ideal.velocity * (across(phi) - across(ideal.position));
  state.G.setZero(2, 3);
  state.G.leftCols<2>().setIdentity();
  state.G.col(2) = arm_ * across(phi);
  state.rate = v.head<2>() + state.G.col(2) * v(2) + state.prescribed;
  state.B.setZero(2, 3);
  state.B.col(2) = -arm_ * (v(2) + ideal.velocity) * along;
}

void RodAnchor::add_curvature(double time, const Values& y, const Eigen::Vector2d& force,
                              Eigen::Ref<Eigen::MatrixXd> tangent) const {
  const double phi = crank_.rod_angle(time).position + y(2);
  tangent(2, 2) -= arm_ * rod_direction(phi).dot(force);
}

}  // namespace clatter::dynamics
