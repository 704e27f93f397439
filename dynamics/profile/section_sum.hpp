// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sum over the sections of a mattress.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "dynamics/profile/mattress.hpp"

namespace clatter::dynamics {

/// The same number at each section of a zone: they are computed side by side.
using Lanes = Eigen::Array<double, GaussRule::kLargest, 1>;

/// Which part of an outline is closest: the round ends or the straight backs between them.
enum class OutlinePart { kFromEnd, kBacks, kToEnd };

/// Outline and motion of a link in the axes of a part of a profile.
struct PlacedOutline {
  Eigen::Vector2d origin, axis;  // of the link
  Eigen::Vector2d velocity;      // of the origin [m/s]
  double spin;                   // [rad/s]
  double from, to, radius;       // LinkOutline

  Eigen::Vector2d normal() const { return {-axis.y(), axis.x()}; }
  Eigen::Vector2d core(double x) const { return origin + x * axis; }
  Eigen::Vector2d closest(const Eigen::Vector2d& point) const {
    return core(std::clamp(axis.dot(point - origin), from, to));
  }
};

/// Distance d = |P - Q| of points P from the core, Q the closest point of that, with derivatives by
/// the pose q = (x, y, angle). `Real` is double or Lanes.
///
/// The gradient is J = (m, lever), m = (Q - P)/d, and the Hessian [h0 t t', h1 t; h1 t', h2], t
/// being m turned by 90 deg: per change of q, m turns by k = (h0 t, h1). The slip has the gradient
/// T = (t, arm) by the rates.
template <class Real>
struct CoreDistance {
  Real d, mx, my, lever, arm, h0, h1, h2;

  CoreDistance(const PlacedOutline& link, OutlinePart part, const Real& px, const Real& py) {
    const double ax = link.axis.x(), ay = link.axis.y();
    const Real x = px - link.origin.x(), y = py - link.origin.y();
    if (part == OutlinePart::kBacks) {
      const Real height = ax * y - ay * x;
      const Real sign = sign_of(height);
      mx = sign * ay;
      my = -sign * ax;
      d = sign * height;
      lever = -sign * (ax * x + ay * y);
      arm = -d;
      h0 = 0.0 * d;
      h1 = h0 + 1.0;
      h2 = -d;
    } else {
      using std::sqrt;
      const double at = part == OutlinePart::kFromEnd ? link.from : link.to;
      const Real ex = at * ax - x, ey = at * ay - y;
      d = sqrt(ex * ex + ey * ey);
      h0 = 1.0 / d;
      mx = ex * h0;
      my = ey * h0;
      lever = at * (ax * my - ay * mx);
      const Real along = at * (ax * mx + ay * my);
      arm = along - d;
      h1 = along * h0;
      h2 = along * (h1 - 1.0);
    }
  }

 private:
  static double sign_of(double value) { return value < 0.0 ? -1.0 : 1.0; }
  static Lanes sign_of(const Lanes& value) {
    return (value < 0.0).select(Lanes::Constant(-1.0), Lanes::Constant(1.0));
  }
};

/// Sections on a zone: parameters middle + half node, in ascending order, of a curve of the
/// profile. Both depend on the pose, because the sections follow the ends of the zone.
struct ZoneSections {
  OutlinePart part;
  double middle, half;
  Eigen::Vector3d middle_by_pose, half_by_pose;
  Lanes node, weight;    // of Gauss' rule; weight 0 where there is no section
  Lanes px, py, dx, dy;  // point [m] and its derivative by the parameter
  Lanes speed, stretch;  // length of the derivative, and the derivative of that
};

/// Force, energy, power and tangent of sections, summed. The tangent is that of the sum.
class SectionSum {
 public:
  SectionSum(const MattressLaw& law, const PlacedOutline& link) : law_(&law), link_(&link) {}

  template <bool kTangent>
  void add(const ZoneSections& sections);

  Eigen::Vector3d wrench = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_pose = Eigen::Matrix3d::Zero(), by_rate = Eigen::Matrix3d::Zero();
  double stored = 0.0, lost = 0.0, load = 0.0, slide = 0.0, depth = 0.0;

 private:
  struct Factor {
    Lanes value, slope;
  };

  /// g and its derivative.
  static Factor never_pulling(const Lanes& y) {
    constexpr double kRound = 0.1;
    const Lanes above = (y + kRound).max(0.0);
    return {(y >= kRound).select(y, above.square() * (0.25 / kRound)),
            (above * (0.5 / kRound)).min(1.0)};
  }
  /// S and its derivative by the slip.
  Factor slip_share(const Lanes& slip) const {
    const double scale = 1.0 / law_->slip_speed;
    const Lanes x = (slip * scale).max(-1.0).min(1.0);
    return {x * (1.5 - 0.5 * x.square()), (1.5 * scale) * (1.0 - x.square())};
  }

  const MattressLaw* law_;
  const PlacedOutline* link_;
};

template <bool kTangent>
void SectionSum::add(const ZoneSections& z) {
  const CoreDistance<Lanes> at(*link_, z.part, z.px, z.py);
  const double vx = link_->velocity.x(), vy = link_->velocity.y(), spin = link_->spin;
  const double mu = law_->friction, chi = law_->damping, kappa_b = law_->stiffness * law_->width;
  const Lanes &mx = at.mx, &my = at.my, tx = -at.my, &ty = at.mx;
  const Lanes u = (link_->radius - at.d).max(0.0);  // ends are exact to rounding only
  const Lanes length = z.half * z.weight * z.speed;
  const Lanes apart = mx * vx + my * vy + at.lever * spin;  // rate of the distance
  const Lanes slip = tx * vx + ty * vy + at.arm * spin;
  const Factor g = never_pulling(1.0 - chi * apart), share = slip_share(slip);
  const Lanes elastic = kappa_b * u, force = elastic * g.value, friction = mu * share.value;
  const Lanes direction[3] = {mx - friction * tx, my - friction * ty, at.lever - friction * at.arm};
  depth = std::max(depth, u.maxCoeff());
  const Lanes load = length * force, sliding = load * slip;
  this->load += load.sum();
  slide += sliding.sum();
  for (int i = 0; i < 3; ++i) wrench[i] += (load * direction[i]).sum();
  stored += 0.5 * (length * elastic * u).sum();
  lost += (length * (elastic - force) * apart + friction * sliding).sum();
  if constexpr (kTangent) {
    const Lanes J[3] = {mx, my, at.lever}, T[3] = {tx, ty, at.arm};
    const Lanes flat[3] = {mx, my, Lanes::Zero()};
    const Lanes k[3] = {at.h0 * tx, at.h0 * ty, at.h1}, turn[3] = {at.h1 * tx, at.h1 * ty, at.h2};
    const Lanes spring = (u > 0.0).select(length * kappa_b * g.value, 0.0);
    const Lanes damper = length * elastic * g.slope * chi;
    const Lanes across = tx * vx + ty * vy;
    const Lanes slope = load * mu * share.slope, value = load * friction;
    Lanes pose[3][3];
    for (int j = 0; j < 3; ++j) {
      const Lanes force_by_pose = -spring * J[j] - damper * (across * k[j] + spin * turn[j]);
      const Lanes slip_by_pose = slope * (apart * k[j] + spin * flat[j]);
      const Lanes change = value * k[j];
      pose[0][j] =
          direction[0] * force_by_pose + load * tx * k[j] + tx * slip_by_pose + mx * change;
      pose[1][j] =
          direction[1] * force_by_pose + load * ty * k[j] + ty * slip_by_pose + my * change;
      pose[2][j] = direction[2] * force_by_pose + load * turn[j] + at.arm * slip_by_pose +
                   at.lever * change + value * flat[j];
      for (int i = 0; i < 3; ++i) {
        by_pose(i, j) += pose[i][j].sum();
        by_rate(i, j) -= (direction[i] * damper * J[j] + slope * T[i] * T[j]).sum();
      }
    }
    // The force depends on the point only by its position relative to the link. With the parameter
    // of a section its point and its length change.
    const Lanes area = z.weight * force;
    for (int i = 0; i < 3; ++i) {
      const Lanes with_parameter =
          z.half * area * z.stretch * direction[i] - (pose[i][0] * z.dx + pose[i][1] * z.dy);
      const double by_middle = with_parameter.sum();
      const double by_half = (with_parameter * z.node + area * z.speed * direction[i]).sum();
      by_pose.row(i) += by_middle * z.middle_by_pose + by_half * z.half_by_pose;
    }
  }
}

}  // namespace clatter::dynamics
