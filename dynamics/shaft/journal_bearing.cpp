// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/journal_bearing.hpp"

#include <algorithm>
#include <utility>

namespace clatter::dynamics {
namespace {

std::string history_name(const std::string& name, const char* what) {
  std::string whole = name + what;
  std::replace(whole.begin(), whole.end(), ' ', '_');
  return whole;
}

}  // namespace

ShaftBearing::ShaftBearing(std::string name, std::unique_ptr<Port> journal,
                           std::unique_ptr<Port> housing, const ShaftAxes& axes,
                           const Eigen::Vector3d& offset, const ThrustLaw& thrust)
    : PortElement(std::move(name), std::move(journal), std::move(housing)),
      axes_(axes),
      offset_(offset),
      thrust_(thrust) {}

PairForce ShaftBearing::thrust_force(const PairMotion& motion) const {
  const int w = axes_.axis;
  const double stretch = motion.distance(w) - offset_(w), rate = motion.velocity(w);
  PairForce law;
  law.force.setZero();
  law.moment.setZero();
  law.by_distance.setZero();
  law.by_rate.setZero();
  law.force(w) = -thrust_.stiffness * stretch - thrust_.damping * rate;
  law.by_distance(w, w) = -thrust_.stiffness;
  law.by_rate(w, w) = -thrust_.damping;
  law.stored = 0.5 * thrust_.stiffness * stretch * stretch;
  law.lost = thrust_.damping * rate * rate;
  return law;
}

JournalMotion ShaftBearing::journal(const PairMotion& motion) const {
  const int u = axes_.first(), v = axes_.second();
  return {{motion.distance(u) - offset_(u), motion.distance(v) - offset_(v)},
          {motion.velocity(u), motion.velocity(v)},
          motion.spin(axes_.axis) + assumed_spin_};
}

FilmedBearing::FilmedBearing(std::string name, std::unique_ptr<Port> journal,
                             std::unique_ptr<Port> housing, const ShaftAxes& axes,
                             const Eigen::Vector3d& offset, const ThrustLaw& thrust)
    : ShaftBearing(std::move(name), std::move(journal), std::move(housing), axes, offset, thrust),
      eccentricity_name_(history_name(this->name(), "_eccentricity")),
      friction_name_(history_name(this->name(), "_friction")) {}

PairForce FilmedBearing::force(double, const PairMotion& motion) const {
  PairForce law = thrust_force(motion);
  const JournalMotion at = journal(motion);
  const FilmForce film = film_force(at);
  // Force on u and v and moment about the axis; by offset, velocity and spin.
  const int u = axes_.first(), v = axes_.second(), w = axes_.axis, rows[] = {u, v, 3 + w};
  for (int k = 0; k < 3; ++k) {
    law.by_distance(rows[k], u) = film.by_motion(k, 0);
    law.by_distance(rows[k], v) = film.by_motion(k, 1);
    law.by_rate(rows[k], u) = film.by_motion(k, 2);
    law.by_rate(rows[k], v) = film.by_motion(k, 3);
    law.by_rate(rows[k], 3 + w) = film.by_motion(k, 4);
  }
  law.force(u) = film.value(0);
  law.force(v) = film.value(1);
  law.moment(w) = film.value(2);
  law.lost -= film.value.head<2>().dot(at.velocity) + film.value(2) * at.spin;
  last_ = {at.offset.norm() / size().radial_clearance(), film.value(2)};
  return law;
}

void FilmedBearing::finish_stage(const Stage& stage) {
  PortElement::finish_stage(stage);
  finished_ = last_;
}

void FilmedBearing::accept_step(double time) {
  PortElement::accept_step(time);
  accepted_ = finished_;
}

void FilmedBearing::record(History& history) const {
  PortElement::record(history);
  history.put(eccentricity_name_, "1", accepted_.eccentricity);
  history.put(friction_name_, "N m", accepted_.friction);
}

LinearBearing::LinearBearing(std::string name, std::unique_ptr<Port> journal,
                             std::unique_ptr<Port> housing, const ShaftAxes& axes,
                             const Eigen::Vector3d& offset, const ThrustLaw& thrust,
                             double stiffness, double damping)
    : ShaftBearing(std::move(name), std::move(journal), std::move(housing), axes, offset, thrust),
      stiffness_(stiffness),
      damping_(damping) {}

PairForce LinearBearing::force(double, const PairMotion& motion) const {
  PairForce law = thrust_force(motion);
  const JournalMotion at = journal(motion);
  const int rows[] = {axes_.first(), axes_.second()};
  for (int k = 0; k < 2; ++k) {
    law.force(rows[k]) = -stiffness_ * at.offset(k) - damping_ * at.velocity(k);
    law.by_distance(rows[k], rows[k]) = -stiffness_;
    law.by_rate(rows[k], rows[k]) = -damping_;
  }
  law.stored += 0.5 * stiffness_ * at.offset.squaredNorm();
  law.lost += damping_ * at.velocity.squaredNorm();
  return law;
}

}  // namespace clatter::dynamics
