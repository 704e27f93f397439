// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/hydraulic_component.hpp"

#include <fmt/format.h>

#include <memory>

#include "core/base/error.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/given/csv_table.hpp"
#include "dynamics/given/load_table.hpp"
#include "dynamics/hydraulic/hydraulic_catalogue.hpp"

namespace clatter::dynamics {
namespace {

const char* text_of(CheckValveSpec::Ball ball) {
  switch (ball) {
    case CheckValveSpec::Ball::kQuasiStatic:
      return "ball without mass";
    case CheckValveSpec::Ball::kMoving:
      return "ball with mass, seat and stop";
    case CheckValveSpec::Ball::kStuckShut:
      return "stuck shut: no oil comes in";
    case CheckValveSpec::Ball::kStuckOpen:
      return "stuck open: no pressure is held";
  }
  return "";
}

/// The fluid's law needs a pressure above 0.
void require_pressures(const SupplySpec& supply) {
  const CsvColumns rows = read_csv(supply.table, supply.column);
  for (size_t i = 0; i < rows.y.size(); ++i)
    if (!(rows.y[i] >= 100.0 && rows.y[i] <= 1e9))
      throw InputError(fmt::format(
          "{}:{}: {}: found {:g} bar, expected an absolute pressure from 0.001 to 10000 bar",
          supply.table.string(), rows.lines[i], rows.name, 1e-5 * rows.y[i]));
}

ComponentList read_all(const Config& root, const std::string& kind,
                       const Keys<HydraulicSpec>& keys) {
  ComponentList list;
  for (HydraulicSpec& spec : read_named(root, kind, keys))
    list.push_back(std::make_shared<HydraulicComponent>(std::move(spec)));
  return list;
}

}  // namespace

std::vector<std::filesystem::path> HydraulicComponent::inputs() const {
  if (spec_.supply.table.empty()) return {};
  return {spec_.supply.table};
}

ComponentTraits HydraulicComponent::traits() const {
  return {.modes = !is_hydraulic() ? 0 : has_moving_ball() ? 2 : 1};
}

TimeFunction supply_pressure(const SupplySpec& given, const ModelBuilder& model) {
  if (given.table.empty()) return [p = given.pressure](double) { return p; };
  if (model.clock) {
    const Spline table = read_cycle_table(given.table, given.column, "Pa", given.interpolation);
    require_pressures(given);
    return [table, clock = *model.clock](double t) { return table(clock.angle(t)); };
  }
  Spline table = read_time_table(given.table, given.column, "Pa", given.interpolation,
                                 model.time.begin, model.time.end);
  require_pressures(given);
  return table;
}

PlungerAxis HydraulicComponent::axis(ModelBuilder& model) const {
  auto housing = model.port(spec_.a);
  auto plunger = model.port(spec_.b, model.position(spec_.a, std::nullopt));
  const PortState a = model.at_start(*housing), b = model.at_start(*plunger);
  const double offset = spec_.axis.dot(b.position - a.position) - spec_.travel;
  return {std::move(housing), std::move(plunger), a.rotation.transpose() * spec_.axis, offset};
}

void HydraulicComponent::add_bodies(ModelBuilder& model) {
  if (!is_hydraulic()) return;
  const TimeFunction pressure = supply_pressure(spec_.supply, model);
  const double start = spec_.start_pressure.value_or(pressure(model.time.begin));
  model.add_body(make_chamber_body(spec_.name + "_chamber", Chamber(spec_.chamber, pressure),
                                   model.time.begin, spec_.travel, start),
                 spec_.where);
}

void HydraulicComponent::add_elements(ModelBuilder& model) {
  std::vector<int> own;
  if (is_hydraulic()) {
    const int body = model.body(spec_.name + "_chamber");
    for (int k = 0; k < (has_moving_ball() ? 2 : 1); ++k)
      own.push_back(model.system.coordinate(body, k));
  }
  PlungerAxis along = axis(model);
  auto element = std::make_unique<HydraulicElement>(
      element_name(), std::move(along),
      Chamber(spec_.chamber, supply_pressure(spec_.supply, model)), spec_.spring, spec_.model, own,
      spec_.travel, model.time.begin);
  element->set_stops(spec_.stops);
  model.system.add_element(std::move(element));
}

void HydraulicComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  const char* why = spec_.model == HydraulicModel::kHydraulic
                        ? "model = \"hydraulic\": content of the chamber"
                    : spec_.model == HydraulicModel::kConstantPressure
                        ? "model = \"constant_pressure\": that of the supply"
                        : "model = \"constant_force\": that of the start";
  Effect& row = effects.add(find_effect(kHydraulicEffects, "hydraulic element"), element_name(),
                            true, why, element_name());
  row.unknowns = traits().modes;
}

void HydraulicComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  const ChamberSpec& chamber = spec_.chamber;
  using Ball = CheckValveSpec::Ball;
  effects.add(find_effect(kHydraulicEffects, "oil of the chamber"), element_name() + " oil",
              is_hydraulic() && !chamber.dry,
              chamber.dry ? "dry: chamber and supply are full of air" : "free air, leak gap");
  effects.add(find_effect(kHydraulicEffects, "check valve"), element_name() + " check valve",
              is_hydraulic() && chamber.valve.ball != Ball::kStuckShut,
              text_of(chamber.valve.ball));
  effects.add(find_effect(kHydraulicEffects, "relief valve"), element_name() + " relief valve",
              is_hydraulic() && chamber.relief.opening > 0.0, "relief");
}

ComponentList read_tensioners(const Config& root) {
  return read_all(root, "tensioner", tensioner_keys());
}

ComponentList read_lash_adjusters(const Config& root) {
  return read_all(root, "lash_adjuster", lash_adjuster_keys());
}

}  // namespace clatter::dynamics
