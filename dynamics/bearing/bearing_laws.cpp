// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/bearing/bearing_laws.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clatter::dynamics {

JournalMotion BearingLaw::journal(const PairMotion& motion) const {
  const int u = axes().first(), v = axes().second();
  return {{motion.distance(u) - place_.offset(u), motion.distance(v) - place_.offset(v)},
          {motion.velocity(u), motion.velocity(v)},
          motion.spin(axes().axis) + place_.assumed_spin};
}

PairForce BearingLaw::with_thrust(const PairMotion& motion, const FilmForce& across) const {
  const ThrustLaw& thrust = place_.thrust;
  const int u = axes().first(), v = axes().second(), w = axes().axis, rows[] = {u, v, 3 + w};
  const double stretch = motion.distance(w) - place_.offset(w), rate = motion.velocity(w);
  PairForce law;
  law.force(w) = -thrust.stiffness * stretch - thrust.damping * rate;
  law.by_distance(w, w) = -thrust.stiffness;
  law.by_rate(w, w) = -thrust.damping;
  law.stored = 0.5 * thrust.stiffness * stretch * stretch;
  law.lost = thrust.damping * rate * rate;
  // Force on u and v and moment about the axis; by offset, velocity and spin.
  law.force(u) = across.value(0);
  law.force(v) = across.value(1);
  law.moment(w) = across.value(2);
  for (int k = 0; k < 3; ++k) {
    law.by_distance(rows[k], u) = across.by_motion(k, 0);
    law.by_distance(rows[k], v) = across.by_motion(k, 1);
    law.by_rate(rows[k], u) = across.by_motion(k, 2);
    law.by_rate(rows[k], v) = across.by_motion(k, 3);
    law.by_rate(rows[k], 3 + w) = across.by_motion(k, 4);
  }
  return law;
}

PairForce RadialBearing::force(const Stage&, const PairMotion& motion, bool) {
  const JournalMotion at = journal(motion);
  const double e = at.offset.norm();
  if (!(e <= largest_))
    throw StepRefused("the journal is beyond the table of the bearing",
                      fmt::format("eccentricity {:.4g} m", e));
  const RadialPoint law = radial_point(law_, e);
  const double across = e > 0.0 ? law.force / e : law.slope;  // F / e
  FilmForce film{Eigen::Vector3d::Zero(), Eigen::Matrix<double, 3, 5>::Zero()};
  film.value.head<2>() = -across * at.offset - law.damping * at.velocity;
  for (int k = 0; k < 2; ++k) {
    film.by_motion(k, k) = -across;
    film.by_motion(k, 2 + k) = -law.damping;
  }
  if (e > 0.0) {
    const Eigen::Vector2d n = at.offset / e;
    film.by_motion.topLeftCorner<2, 2>() -=
        ((law.slope - across) * n + law.damping_slope * at.velocity) * n.transpose();
  }
  PairForce pair = with_thrust(motion, film);
  pair.stored += radial_energy(law_, e);
  pair.lost += law.damping * at.velocity.squaredNorm();
  return pair;
}

PairForce CoefficientBearing::force(const Stage&, const PairMotion& motion, bool) {
  const JournalMotion at = journal(motion);
  const double speed = std::abs(at.spin), sign = at.spin < 0.0 ? -1.0 : 1.0;
  FilmForce film{Eigen::Vector3d::Zero(), Eigen::Matrix<double, 3, 5>::Zero()};
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const Spline &k = coefficients_.stiffness[2 * i + j], &c = coefficients_.damping[2 * i + j];
      film.by_motion(i, j) = -k(speed);
      film.by_motion(i, 2 + j) = -c(speed);
      film.value(i) -= k(speed) * at.offset(j) + c(speed) * at.velocity(j);
      film.by_motion(i, 4) -=
          sign * (k.slope(speed) * at.offset(j) + c.slope(speed) * at.velocity(j));
    }
  PairForce law = with_thrust(motion, film);
  law.lost -= film.value.head<2>().dot(at.velocity);
  return law;
}

PairForce FilmedBearing::force(const Stage& stage, const PairMotion& motion,
                               bool with_derivatives) {
  const JournalMotion at = journal(motion);
  const FilmForce film = film_force(stage, at, with_derivatives);
  PairForce law = with_thrust(motion, film);
  law.lost -= film.value.head<2>().dot(at.velocity) + film.value(2) * at.spin;
  return law;
}

void FilmedBearing::record(const std::string& name, const PairMotion& motion,
                           const PairForce& force, History& history) const {
  const double eccentricity = journal(motion).offset.norm() / size().radial_clearance();
  history.put(name + "_eccentricity", "1", eccentricity);
  history.put(name + "_friction", "N m", force.moment(axes().axis));
}

}  // namespace clatter::dynamics
