// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/shaft_elements.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/element/pair_element.hpp"
#include "dynamics/shaft/disc_gyroscope.hpp"
#include "dynamics/shaft/disc_unbalance.hpp"
#include "dynamics/shaft/shaft_beam.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kBeside = 1e-3;  // [m]: a housing's point may be so far beside the axis

std::vector<int> in_system(System& system, const std::vector<BodyDof>& dofs) {
  std::vector<int> y;
  for (const BodyDof& one : dofs) y.push_back(system.coordinate(one.body, one.dof));
  return y;
}

int in_system(System& system, const BodyDof& dof) { return system.coordinate(dof.body, dof.dof); }

void add_beams(const ShaftSpec& shaft, const ShaftBodies& bodies, System& system) {
  for (size_t i = 0; i + 1 < bodies.stations.size(); ++i) {
    const ShaftStation &a = bodies.stations[i], &b = bodies.stations[i + 1];
    const ShaftFlexibility piece = shaft.sections->flexibility(a.at, b.at);
    const BodyDof angle_a = bodies.station_angle(shaft, i),
                  angle_b = bodies.station_angle(shaft, i + 1);
    if (!bodies.bends) {
      const double k = 1.0 / piece.torsion;
      system.add_element(std::make_unique<TorsionSpring>(
          fmt::format("torsion {} {}", shaft.name, i + 1), in_system(system, angle_a),
          in_system(system, angle_b), TorsionLaw{k, shaft.loss_time * k, 0.0}));
      continue;
    }
    std::vector<BodyDof> dofs = bodies.coordinates(shaft, i, angle_a);
    const std::vector<BodyDof> other = bodies.coordinates(shaft, i + 1, angle_b);
    dofs.insert(dofs.end(), other.begin(), other.end());
    system.add_element(std::make_unique<ShaftBeam>(
        fmt::format("beam {} {}", shaft.name, i + 1), in_system(system, dofs), shaft.axes,
        BeamEnds{b.at - a.at, a.at - a.centre, b.at - b.centre}, piece, shaft.loss_time));
  }
}

void add_gyroscope(const ShaftSpec& shaft, const std::string& name, int body, const BodyDof& angle,
                   double polar, System& system) {
  const std::vector<BodyDof> dofs{
      {body, 3 + shaft.axes.first()}, {body, 3 + shaft.axes.second()}, angle};
  system.add_element(std::make_unique<DiscGyroscope>(
      fmt::format("gyroscope {} {}", shaft.name, name), in_system(system, dofs), polar));
}

void add_gyroscopes(const ShaftSpec& shaft, const ShaftBodies& bodies, System& system) {
  for (size_t i = 0; i < bodies.stations.size(); ++i) {
    const ShaftStation& station = bodies.stations[i];
    add_gyroscope(shaft, station.name, bodies.body[i], bodies.station_angle(shaft, i),
                  station.inertia.polar, system);
    for (const size_t d : station.discs)
      if (bodies.wheel[d] >= 0)
        add_gyroscope(shaft, shaft.discs[d].name, bodies.body[i], bodies.disc_angle(shaft, d),
                      shaft.discs[d].inertia.polar, system);
  }
}

void add_unbalances(const ShaftSpec& shaft, const ShaftBodies& bodies, System& system) {
  for (size_t d = 0; d < shaft.discs.size(); ++d) {
    const ShaftDiscSpec& disc = shaft.discs[d];
    if (disc.unbalance == 0.0) continue;
    const size_t station = station_of_disc(bodies.stations, d);
    const DiscInertia& own = bodies.stations[station].inertia;
    // A mass that turns about the axis at the distance U / m has at least U^2 / m about it.
    const double polar = bodies.wheel[d] >= 0 ? disc.inertia.polar : own.polar,
                 most = std::sqrt(own.mass * polar);
    if (!(disc.unbalance < most))
      throw InputError(fmt::format(
          "{}: disc \"{}\": unbalance_g_mm: found {:g}, expected below {:.4g}, the root of mass "
          "times polar moment there",
          shaft.where, disc.name, disc.unbalance / 1e-6, most / 1e-6));
    const int body = bodies.body[station];
    const std::vector<BodyDof> dofs{
        {body, shaft.axes.first()}, {body, shaft.axes.second()}, bodies.disc_angle(shaft, d)};
    system.add_element(std::make_unique<DiscUnbalance>(
        fmt::format("unbalance {} {}", shaft.name, disc.name), in_system(system, dofs),
        disc.unbalance, disc.phase, shaft.start.angle, shaft.start.speed));
  }
}

void add_phasers(const ShaftSpec& shaft, const ShaftBodies& bodies, System& system) {
  for (size_t d = 0; d < shaft.discs.size(); ++d) {
    if (bodies.wheel[d] < 0) continue;
    const BodyDof hub = bodies.station_angle(shaft, station_of_disc(bodies.stations, d));
    system.add_element(std::make_unique<TorsionSpring>(
        fmt::format("phaser {} {}", shaft.name, shaft.discs[d].name),
        in_system(system, bodies.disc_angle(shaft, d)), in_system(system, hub),
        *shaft.discs[d].phaser));
  }
}

void add_bearing(const ShaftSpec& shaft, const ShaftBodies& bodies, size_t index,
                 ModelBuilder& model) {
  const ShaftBearingSpec& spec = shaft.bearings[index];
  const size_t station = station_of_bearing(bodies.stations, index);
  const Eigen::Vector3d point = shaft.point(spec.at);
  const Eigen::Vector3d offset = point - model.position(spec.on, point);
  const double beside = offset.cross(shaft.axes.unit()).norm();
  if (beside > kBeside)
    throw InputError(
        fmt::format("{}: the point of \"{}\" is {:.4g} mm beside the axis of \"{}\", "
                    "expected on it",
                    spec.on.where, spec.on.body, beside / kMilli, shaft.name));
  auto journal =
      shaft_port(shaft, bodies.stations[station].centre,
                 bodies.coordinates(shaft, station, bodies.station_angle(shaft, station)),
                 model.system, point);
  auto housing = model.port(spec.on, point);
  const std::string name = fmt::format("bearing {} {}", shaft.name, spec.name);
  const BearingPlace place{shaft.axes, offset, spec.thrust,
                           model.at_rest ? shaft.start.speed : 0.0};
  std::unique_ptr<PairLaw> law;
  if (spec.film) {
    law = std::make_unique<ImpedanceBearing>(place, BearingFilm(spec.size, *spec.film));
  } else if (spec.coefficients) {
    law = std::make_unique<CoefficientBearing>(place, *spec.coefficients);
  } else {
    law = std::make_unique<RadialBearing>(place,
                                          RadialLaw{0.0, spec.stiffness, 0.0, 1.0, spec.damping});
  }
  model.system.add_element(
      std::make_unique<PairElement>(name, std::move(journal), std::move(housing), std::move(law)));
}

}  // namespace

BodyDof ShaftBodies::station_angle(const ShaftSpec& shaft, size_t station) const {
  return {body[station], bends ? 3 + shaft.axes.axis : 0};
}

BodyDof ShaftBodies::disc_angle(const ShaftSpec& shaft, size_t disc) const {
  if (wheel[disc] >= 0) return {wheel[disc], 0};
  return station_angle(shaft, station_of_disc(stations, disc));
}

std::vector<BodyDof> ShaftBodies::coordinates(const ShaftSpec& shaft, size_t station,
                                              const BodyDof& angle) const {
  if (!bends) return {angle};
  std::vector<BodyDof> dofs;
  for (int k = 0; k < 6; ++k) dofs.push_back({body[station], k});
  dofs[3 + shaft.axes.axis] = angle;
  return dofs;
}

std::unique_ptr<DiscPort> shaft_port(const ShaftSpec& shaft, double mass_centre,
                                     const std::vector<BodyDof>& coordinates, System& system,
                                     const Eigen::Vector3d& at) {
  const Eigen::Vector3d centre = shaft.point(mass_centre);
  const Eigen::AngleAxisd back(-shaft.start.angle, shaft.axes.unit());
  return std::make_unique<DiscPort>(in_system(system, coordinates), shaft.axes, centre,
                                    back * (at - centre));
}

void add_shaft_elements(const ShaftSpec& shaft, const ShaftBodies& bodies, ModelBuilder& model) {
  if (shaft.model == ShaftModel::kRigid) return;
  add_beams(shaft, bodies, model.system);
  add_phasers(shaft, bodies, model.system);
  if (!bodies.bends) return;
  add_gyroscopes(shaft, bodies, model.system);
  add_unbalances(shaft, bodies, model.system);
  for (size_t b = 0; b < shaft.bearings.size(); ++b) add_bearing(shaft, bodies, b, model);
}

}  // namespace clatter::dynamics
