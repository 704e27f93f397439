// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/valve_component.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/body/rigid_body.hpp"
#include "dynamics/shaft/torque_component.hpp"
#include "dynamics/valve/follower_component.hpp"
#include "dynamics/valve/valve_catalogue.hpp"
#include "dynamics/valve/valve_spring_component.hpp"

namespace clatter::dynamics {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// From the tip of the valve to where its spring stands, and to its seat [m]. They matter for the
/// moments on bodies that carry them only.
constexpr double kSpringLength = 40e-3, kValveLength = 100e-3, kAdjusterLength = 20e-3;

}  // namespace

double ValveSpec::reduced_mass() const {
  const double arm = follower.geometry.pad.x();
  return mass + follower.inertia / (arm * arm) + coil.spring.mass / 3.0;
}

std::vector<std::filesystem::path> ValveComponent::inputs() const {
  std::vector<std::filesystem::path> files;
  if (!spec_.cam.file.empty()) files.push_back(spec_.cam.file);
  if (!spec_.adjuster.sizes.supply.table.empty())
    files.push_back(spec_.adjuster.sizes.supply.table);
  return files;
}

ComponentTraits ValveComponent::traits() const {
  if (spec_.model == ValveModel::kQuasiStatic) return {};
  const bool ball = spec_.adjuster.sizes.chamber.valve.ball == CheckValveSpec::Ball::kMoving;
  const int adjuster = spec_.adjuster.is_hydraulic ? (ball ? 3 : 2) : 0;
  const int each = 4 + adjuster + spec_.coil.spring.masses;
  return {.modes = each * static_cast<int>(spec_.lobes.size())};
}

FollowerPlace ValveComponent::place(const ValveLobe& lobe) const {
  return {spec_.follower.geometry, *lobe.cam.at, spec_.plane, lobe.angle};
}

Vector3d ValveComponent::axis(const Train& train) const {
  return spec_.adjuster.axis.x() * train.place.plane.first +
         spec_.adjuster.axis.y() * train.place.plane.second;
}

/// A point of the valve's axis at rest, from its tip on.
Vector3d ValveComponent::on_axis(const Train& train, double beyond) const {
  const FollowerGeometry& at = spec_.follower.geometry;
  return train.place.point({at.pad.x(), at.pad.y() - at.pad_radius - beyond});
}

/// For a static equilibrium it is sealed: an open valve would press its oil out.
Chamber ValveComponent::chamber(const ModelBuilder& model) const {
  ChamberSpec spec = spec_.adjuster.sizes.chamber;
  if (model.at_rest) {
    spec.leak.height = 0.0;
    spec.valve.ball = spec.valve.ball == CheckValveSpec::Ball::kMoving
                          ? CheckValveSpec::Ball::kMoving
                          : CheckValveSpec::Ball::kStuckShut;
  }
  return {spec, supply_pressure(spec_.adjuster.sizes.supply, model)};
}

/// The supply's, or what holds an open valve against its spring [Pa].
double ValveComponent::start_pressure(const ModelBuilder& model, const Train& train) const {
  const HydraulicSpec& adjuster = spec_.adjuster.sizes;
  if (adjuster.start_pressure) return *adjuster.start_pressure;
  const double supply = supply_pressure(adjuster.supply, model)(model.time.begin);
  if (train.start.lift <= 0.0) return supply;
  const double valve = spec_.coil.spring.force + spec_.coil.spring.stiffness * train.start.lift;
  const double push = -valve * train.start.state.ball_force.dot(spec_.adjuster.axis);
  return std::max(
      supply, adjuster.chamber.outside + (push - adjuster.spring.force) / adjuster.chamber.area());
}

void ValveComponent::add_bodies(ModelBuilder& model) {
  trains_.clear();
  if (spec_.model == ValveModel::kQuasiStatic) return;
  profile_ = with_context(spec_.where, [&] {
    return spec_.cam.profile(spec_.follower.geometry, spec_.plane.mirrored ? -1.0 : 1.0);
  });
  for (const ValveLobe& lobe : spec_.lobes) add_train(model, lobe);
}

void ValveComponent::add_train(ModelBuilder& model, const ValveLobe& lobe) {
  Train train{
      spec_.name_of(lobe), place(lobe), {}, 0, nullptr, nullptr, nullptr, nullptr, nullptr, {}};
  train.start = follower_start(model, spec_.follower, *profile_, train.place, lobe.cam);
  const FollowerStart& start = train.start;
  ModalBody valve = make_sliding_body(train.name, spec_.mass, spec_.plane.opening, start.rate);
  valve.eta_start(0) = start.lift * std::sqrt(spec_.mass);
  model.add_body(std::move(valve), lobe.where);
  add_follower_body(model, train.name + "_follower", lobe.where, spec_.follower, train.place,
                    start);
  model.add_body(make_coil_body(train.name + "_coils", spec_.coil.spring, -spec_.plane.opening,
                                {0.0, -start.lift, 0.0, -start.rate}),
                 lobe.where);
  if (spec_.adjuster.is_hydraulic) {
    model.add_body(
        make_sliding_body(train.name + "_plunger", spec_.adjuster.plunger_mass, axis(train), 0.0),
        lobe.where);
    model.add_body(make_chamber_body(train.name + "_chamber", chamber(model), model.time.begin, 0.0,
                                     start_pressure(model, train)),
                   lobe.where);
  }
  for (const char* what : {"_lift", "_seat_force", "_cam_force", "_cam_torque", "_cam_gap",
                           "_cam_losses", "_held_open", "_spring_force", "_spring_seat_force",
                           "_coil_gap", "_adjuster_travel", "_adjuster_pressure"})
    train.recorded.push_back(train.name + what);
  trains_.push_back(std::move(train));
}

void ValveComponent::add_elements(ModelBuilder& model) {
  if (spec_.model == ValveModel::kQuasiStatic) return add_torque(model);
  for (size_t i = 0; i < trains_.size(); ++i) add_train_elements(model, spec_.lobes[i], trains_[i]);
}

void ValveComponent::add_train_elements(ModelBuilder& model, const ValveLobe& lobe, Train& train) {
  System& system = model.system;
  const std::string prefix = "valve " + spec_.name, suffix = " " + lobe.name;
  const Vector3d& opening = spec_.plane.opening;
  train.lift = system.coordinate(model.body(train.name), 0);
  const auto valve = [&](const Vector3d& at) {
    const Vector3d guide = model.position(lobe.seat, at);
    return std::make_unique<SlidePort>(train.lift, opening, at, model.port(lobe.seat, at), guide);
  };
  const Vector3d tip = on_axis(train, 0.0);

  auto seat_port = model.port(lobe.seat, on_axis(train, kValveLength));
  const PortState seat_at = model.at_start(*seat_port);
  // Lift 0 is a valve that its spring presses into the seat.
  const Vector3d pressed = spec_.coil.spring.force / spec_.seat.stiffness * opening;
  auto seat = std::make_unique<CompliantStop>(
      prefix + " seat" + suffix,
      PointOnPlane(valve(seat_at.position - pressed), std::move(seat_port),
                   seat_at.rotation.transpose() * opening),
      spec_.seat.stiffness, 1.0, spec_.seat.damping, FrictionLaw{});
  train.seat = seat.get();
  system.add_element(std::move(seat));

  auto stand = model.port(lobe.spring_seat, on_axis(train, kSpringLength));
  const Vector3d stand_at = model.at_start(*stand).position;
  std::vector<int> coils;
  for (int k = 0; k < spec_.coil.spring.masses; ++k)
    coils.push_back(system.coordinate(model.body(train.name + "_coils"), k));
  auto spring = std::make_unique<CoilSpring>(
      prefix + " spring" + suffix, CoilEnd(std::move(stand), -opening, stand_at),
      CoilEnd(valve(tip), -opening, tip), coils, spec_.coil.spring);
  train.spring = spring.get();
  system.add_element(std::move(spring));

  FollowerNeighbours neighbours{lobe.cam, add_adjuster(model, lobe, train),
                                valve(train.place.point(spec_.follower.geometry.pad))};
  train.roller =
      add_follower_elements(model, prefix, suffix, train.name + "_follower", spec_.follower,
                            train.place, *profile_, std::move(neighbours))
          .roller;
  std::vector<int> watched{train.lift};
  if (spec_.adjuster.is_hydraulic)
    watched.push_back(system.coordinate(model.body(train.name + "_plunger"), 0));
  auto watch =
      std::make_unique<ValveWatch>(prefix + " watch" + suffix, watched, *train.roller, *profile_);
  train.watch = watch.get();
  system.add_element(std::move(watch));
}

/// The port of the ball, on the plunger or at a fixed place.
std::unique_ptr<Port> ValveComponent::add_adjuster(ModelBuilder& model, const ValveLobe& lobe,
                                                   Train& train) {
  System& system = model.system;
  const Vector3d ball = train.place.plane.origin;
  if (!spec_.adjuster.is_hydraulic) {
    auto port = model.port(lobe.adjuster, ball);
    const double beside = (model.at_start(*port).position - ball).norm();
    if (beside > 1e-6)
      throw InputError(
          fmt::format("{}: found {:.4g} mm beside the ball of a rigid adjuster, "
                      "expected at it",
                      lobe.adjuster.where, beside / kMilli));
    return port;
  }
  const int s = system.coordinate(model.body(train.name + "_plunger"), 0);
  const Vector3d along = axis(train);
  const auto plunger = [&] {
    return std::make_unique<SlidePort>(s, along, ball, model.port(lobe.adjuster, ball),
                                       model.position(lobe.adjuster, ball));
  };
  auto housing = model.port(lobe.adjuster, ball - kAdjusterLength * along);
  const PortState at = model.at_start(*housing);
  const double offset = along.dot(ball - at.position);
  const int chamber_body = model.body(train.name + "_chamber");
  std::vector<int> own{system.coordinate(chamber_body, 0)};
  if (spec_.adjuster.sizes.chamber.valve.ball == CheckValveSpec::Ball::kMoving)
    own.push_back(system.coordinate(chamber_body, 1));
  auto element = std::make_unique<HydraulicElement>(
      "valve " + spec_.name + " adjuster " + lobe.name,
      PlungerAxis(std::move(housing), plunger(), at.rotation.transpose() * along, offset),
      chamber(model), spec_.adjuster.sizes.spring, HydraulicModel::kHydraulic, own, 0.0,
      model.time.begin);
  element->set_stops(spec_.adjuster.sizes.stops);
  train.adjuster = element.get();
  system.add_element(std::move(element));
  return plunger();
}

void ValveComponent::add_torque(ModelBuilder& model) {
  for (const ValveLobe& lobe : spec_.lobes) {
    const TurnAngles at = angles_of({lobe.cam.body, lobe.where, "", ""}, model);
    model.system.add_element(std::make_unique<CamTorque>("valve " + spec_.name + " " + lobe.name,
                                                         at.angle, std::nullopt,
                                                         CamTrain{*spec_.cam.law,
                                                                  {lobe.angle},
                                                                  1.0,
                                                                  spec_.coil.spring.force,
                                                                  spec_.coil.spring.stiffness,
                                                                  spec_.reduced_mass()},
                                                         [](double) { return 1.0; }));
  }
}

void ValveComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  const bool full = spec_.model == ValveModel::kFull;
  Effect& row =
      effects.add(find_effect(kValveEffects, "valve train"), "valve train " + spec_.name, full,
                  full ? fmt::format("model = \"full\": {} valves as bodies", spec_.lobes.size())
                       : fmt::format("model = \"quasi_static\": torque on {} cams by the lift law",
                                     spec_.lobes.size()));
  row.unknowns = traits().modes;
}

void ValveComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  const std::string prefix = "valve " + spec_.name;
  if (spec_.model == ValveModel::kQuasiStatic) {  // neither spring nor cam is there
    effects.add(find_effect(kValveEffects, "torque of valves"), prefix + " torque", true,
                "springs and inertia, quasi-static", prefix);
    return;
  }
  add_spring_effect(prefix + " spring", spec_.coil.spring, effects);
  effects.add(find_effect(kValveEffects, "lash adjuster of valves"), prefix + " adjuster",
              spec_.adjuster.is_hydraulic,
              spec_.adjuster.is_hydraulic
                  ? "lash_adjuster.model = \"hydraulic\": content of the chamber"
                  : "lash_adjuster.model = \"rigid\"",
              prefix + " adjuster");
  add_cam_effect(prefix + " cam", prefix + " cam", *profile_, effects);
  effects.add(find_effect(kValveEffects, "contacts of valve and follower"), prefix + " contacts",
              true, "seat, ball and pad of the follower", prefix);
}

void ValveComponent::record(const System& system, const StageState& state, History& history) const {
  if (spec_.model == ValveModel::kQuasiStatic) return Component::record(system, state, history);
  for (const Train& train : trains_) {
    size_t k = 0;
    const auto put = [&](const char* unit, double value) {
      history.put(train.recorded[k++], unit, value);
    };
    put("m", state.y(train.lift));
    put("N", train.seat->normal_force());
    put("N", train.roller->accepted().force);
    put("N m", train.place.turn * train.roller->accepted().moment);
    put("m", train.roller->accepted().gap);
    put("1", train.roller->losses().count());
    put("1", train.watch->open().count());
    put("N", train.spring->accepted().force);
    put("N", train.spring->accepted().seat_force);
    put("m", train.spring->accepted().least_gap);
    if (train.adjuster == nullptr) continue;
    put("m", train.adjuster->accepted().travel);
    put("Pa", train.adjuster->accepted().chamber.pressure.value);
  }
}

std::vector<std::string> ValveComponent::warnings() const {
  std::vector<std::string> found;
  const double turn = spec_.plane.mirrored ? -1.0 : 1.0;
  for (const Train& train : trains_) {
    const std::string lost = lost_text(train.name, *train.roller, turn);
    if (!lost.empty()) found.push_back(lost);
    const ContactWatch& open = train.watch->open();
    if (open.count() == 0) continue;
    const bool pumped = train.watch->pumped() > ValveWatch::kOpen;
    found.push_back(fmt::format(
        "{}: the valve did not close on the base circle {} times, first at {}, by up to {:.4g} um: "
        "{}",
        train.name, open.count(), first_text(open, turn), open.largest() / kMicro,
        pumped ? fmt::format("its lash adjuster pumped up by {:.4g} um",
                             train.watch->pumped() / kMicro)
               : "it bounces on its seat"));
  }
  return found;
}

}  // namespace clatter::dynamics
