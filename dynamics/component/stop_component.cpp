// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/stop_component.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

/// Of positions given as decimal numbers: a point so far behind the plane is on it [m].
constexpr double kRounding = 1e-9;

FrictionLaw read_friction(const Config& table) {
  FrictionLaw law;
  if (!table.has("friction")) {
    for (const char* key : {"static_friction", "slip_speed_m_s"})
      if (table.has(key)) table.fail(key, "found without friction");
    return law;
  }
  law.kinetic = table.number("friction", Range::between(0.0, 10.0));
  law.at_rest = table.number_or("static_friction", law.kinetic, Range::between(0.0, 10.0));
  if (law.at_rest < law.kinetic)
    table.fail("static_friction", fmt::format("found {:g}, expected at least friction, {:g}",
                                              law.at_rest, law.kinetic));
  law.slip_speed = table.number_or("slip_speed_m_s", law.slip_speed, Range::between(1e-9, 1e3));
  return law;
}

StopSpec read_stop(const Config& table, size_t number) {
  const Range stiffness = Range::between(1e-3, 1e20);
  StopSpec stop;
  stop.name = "stop " + (table.has("name") ? read_name(table) : fmt::format("{}", number));
  stop.where = table.where();
  stop.a = read_point(table, "a");
  stop.b = read_point(table, "b");
  stop.normal = read_vector(table, "normal", 1e6);
  if (!(stop.normal.norm() > 0.0)) table.fail("normal", "found length 0, expected a direction");
  stop.normal.normalize();
  if (table.has("restitution")) {
    for (const char* key :
         {"stiffness_n_m", "exponent", "chi_s_m", "friction", "static_friction", "slip_speed_m_s"})
      if (table.has(key))
        table.fail(key,
                   "found with restitution, whose contact is rigid and without friction; a "
                   "compliant one has stiffness_n_m instead");
    stop.restitution = table.number("restitution", Range::between(0.0, 1.0));
    stop.rest_stiffness = table.number_or("rest_stiffness_n_m", 1e8, stiffness);
    return stop;
  }
  if (!table.has("stiffness_n_m"))
    table.fail("stiffness_n_m", "found neither this nor restitution, expected one of both");
  if (table.has("rest_stiffness_n_m"))
    table.fail("rest_stiffness_n_m", "found without restitution");
  stop.stiffness = table.number("stiffness_n_m", stiffness);
  stop.exponent = table.number_or("exponent", 1.0, Range::between(1.0, 4.0));
  stop.chi = table.number_or("chi_s_m", 0.0, Range::between(0.0, 1e9));
  stop.friction = read_friction(table);
  return stop;
}

PortState at_start(const ModelBuilder& model, const Port& port) {
  const System& system = model.system;
  system.start_frames(model.time.begin);
  PortState state;
  port.motion(model.time.begin, gather(system.interface(system.eta_start()), port.coordinates()),
              gather(system.interface(system.v_start()), port.coordinates()), state);
  return state;
}

std::unique_ptr<Stop> make_stop(const StopSpec& stop, ModelBuilder& model,
                                std::vector<const RigidStop*>& rigid) {
  auto a = model.port(stop.a), b = model.port(stop.b, model.position(stop.a, std::nullopt));
  if (a->size() + b->size() == 0)
    throw InputError(stop.where + ": a and b: found no body that can move, expected one");
  const PortState point = at_start(model, *a), plane = at_start(model, *b);
  const double gap = stop.normal.dot(point.position - plane.position);
  const Eigen::Vector3d normal = plane.rotation.transpose() * stop.normal;
  PointOnPlane pair(std::move(a), std::move(b), normal);
  if (!stop.restitution)
    return std::make_unique<CompliantStop>(stop.name, std::move(pair), stop.stiffness,
                                           stop.exponent, stop.chi, stop.friction);
  if (gap < -kRounding)
    throw InputError(
        fmt::format("{}: found {:.4g} mm behind the plane at the start, expected on the side to "
                    "which normal points",
                    stop.a.where, -gap / kMilli));
  auto made = std::make_unique<RigidStop>(stop.name, std::move(pair), *stop.restitution,
                                          stop.rest_stiffness);
  rigid.push_back(made.get());
  return made;
}

}  // namespace

void StopComponent::add_elements(ModelBuilder& model) {
  for (const StopSpec& stop : stops_) model.system.add_element(make_stop(stop, model, rigid_));
}

std::vector<std::string> StopComponent::warnings() const {
  std::vector<std::string> found;
  for (const RigidStop* stop : rigid_) {
    if (!stop->has_sunk()) continue;
    found.push_back(fmt::format(
        "{}: impacts followed each other too closely to be computed, and the spring "
        "rest_stiffness_n_m = {:g} that holds the point then let it sink {:.3g} um into the "
        "plane: set a higher one, or a compliant contact by stiffness_n_m",
        stop->name(), stop->rest_stiffness(), stop->deepest() / kMicro));
  }
  return found;
}

void StopComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (stops_.empty()) return;
  const auto rigid = std::count_if(stops_.begin(), stops_.end(), [](const StopSpec& stop) {
    return stop.restitution.has_value();
  });
  effects.add(find_effect(kComponentEffects, "stops"), true,
              fmt::format("[[stop]]: {} rigid with impacts, {} compliant", rigid,
                          static_cast<long>(stops_.size()) - rigid),
              "stop");
}

ComponentList read_stops(const Config& root) {
  std::vector<StopSpec> stops;
  for (const Config& table : root.tables("stop"))
    stops.push_back(read_stop(table, stops.size() + 1));
  return {std::make_shared<StopComponent>(std::move(stops))};
}

}  // namespace clatter::dynamics
