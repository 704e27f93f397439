// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/crank_component.hpp"

#include <fmt/format.h>

#include <memory>

#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/crank/crank_catalogue.hpp"
#include "dynamics/crank/crank_gyroscope.hpp"
#include "dynamics/crank/crank_load.hpp"
#include "dynamics/given/load_table.hpp"

namespace clatter::dynamics {
namespace {

/// Force of a rotating mass on the crankshaft along y or z: U (w^2 u - w' J u), u its direction.
double unbalance_force(const UnbalanceSpec& unbalance, const Motion<double>& turn, int axis) {
  const double angle = turn.position + unbalance.angle;
  const Eigen::Vector2d u = rod_direction(angle), across(-u.y(), u.x());
  return unbalance.moment *
         (turn.velocity * turn.velocity * u(axis) - turn.acceleration * across(axis));
}

}  // namespace

std::vector<std::filesystem::path> CrankComponent::inputs() const {
  std::vector<std::filesystem::path> files;
  for (const CrankBearingSpec& bearing : spec_.bearings)
    if (const auto* table = std::get_if<TableBearingSpec>(&bearing.law))
      files.push_back(table->table);
  if (!spec_.load.table.empty()) files.push_back(spec_.load.table);
  return files;
}

ComponentTraits CrankComponent::traits() const {
  ComponentTraits traits;
  traits.modes = (spec_.body.in_bearings ? 4 : 0) + (spec_.body.is_free ? 1 : 0);
  for (const CrankBearingSpec& bearing : spec_.bearings) {
    const auto* film = std::get_if<JournalFilmOptions>(&bearing.law);
    if (film == nullptr) continue;
    traits.has_film = true;
    traits.film_cells += static_cast<int64_t>(film->cells_around) * film->cells_along;
  }
  return traits;
}

void CrankComponent::add_bodies(ModelBuilder& model) {
  body_ = model.add_body(make_crank_body(spec_.body), spec_.body.where);
}

void CrankComponent::add_elements(ModelBuilder& model) {
  if (spec_.body.in_bearings) {
    coordinates_ = crank_coordinates(spec_.body, model);
    coordinates_.resize(4);
    orbits_ = add_crank_bearings(spec_, model);
    if (spec_.body.polar > 0.0)
      model.system.add_element(
          std::make_unique<CrankGyroscope>(std::vector<int>{coordinates_[2], coordinates_[3]},
                                           spec_.body.polar, spec_.clock, spec_.rotation));
  }
  if (spec_.body.is_free) add_load(model);
}

void CrankComponent::add_load(ModelBuilder& model) {
  const CrankLoadSpec& load = spec_.load;
  CrankLoadLaw law;
  law.constant = load.torque;
  switch (load.law) {
    case CrankLoadSpec::Law::kMean:
      law.controller.emplace(load.torque, spec_.body.polar, spec_.clock.cycle());
      break;
    case CrankLoadSpec::Law::kSpeed:
      law.at_speed = load.at_speed;
      break;
    case CrankLoadSpec::Law::kTable:
      law.table = read_cycle_table(load.table, load.column, "N m", load.interpolation);
      break;
    case CrankLoadSpec::Law::kConstant:
      break;
  }
  model.system.add_element(std::make_unique<CrankLoad>(
      model.system.coordinate(body_, spec_.body.turn()), spec_.clock, spec_.rotation,
      std::move(law), ramped(model.time, [](double) { return 1.0; })));
}

void CrankComponent::add_loads(ModelBuilder& model) {
  const ModalBody& body = model.system.bodies()[body_];
  const auto turn = [clock = spec_.clock, rotation = spec_.rotation](double t) {
    return turn_about_x(clock, rotation, t);
  };
  if (spec_.body.is_free && !spec_.clock.is_uniform())
    model.system.add_load({"crankshaft inertia frame", body_, -body.rigid.col(3),
                           ramped(model.time, [turn](double t) { return turn(t).acceleration; })});
  for (const UnbalanceSpec& unbalance : spec_.unbalances) {
    const Eigen::Vector3d at(unbalance.at - spec_.body.centre, 0.0, 0.0);
    for (int axis = 0; axis < 2; ++axis) {
      // q = y, z, ry, rz, of which the wrench of the force has these parts.
      const Wrench force = unit_wrench(1 + axis, at);
      Eigen::VectorXd on_dofs = Eigen::VectorXd::Zero(body.size());
      on_dofs.head<4>() << force(1), force(2), force(4), force(5);
      model.system.add_load({"unbalance of the crankshaft", body_,
                             body.shapes.transpose() * on_dofs, ramped(model.time, [=](double t) {
                               return unbalance_force(unbalance, turn(t), axis);
                             })});
    }
  }
}

void CrankComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  Effect& row = effects.add(
      find_effect(kCrankEffects, "crankshaft"), true,
      fmt::format("[crank]: rigid, {}{}{}", spec_.body.in_bearings ? "displacements and tilts" : "",
                  spec_.body.in_bearings && spec_.body.is_free ? ", " : "",
                  spec_.body.is_free ? "rotation" : ""));
  row.unknowns = traits().modes;
}

void CrankComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  const CrankBody& body = spec_.body;
  const bool gyroscope = body.in_bearings && body.polar > 0.0;
  effects
      .add(find_effect(kComponentEffects, "main bearings"), body.in_bearings,
           body.in_bearings ? "[[crank.bearing]], instead of block.bearings"
                            : "no [[crank.bearing]]: the crank follows block.bearings",
           body.in_bearings ? std::string("bearing ") + CrankBody::kName : "")
      .unknowns = traits().film_cells;
  effects.add(find_effect(kCrankEffects, "gyroscopic moments of the crank"), gyroscope,
              gyroscope ? "crank.polar_kg_m2" : "no [[crank.bearing]] or no crank.polar_kg_m2",
              gyroscope ? "gyroscope crankshaft" : "");
  effects.add(find_effect(kCrankEffects, "unbalance of the crank"), !spec_.unbalances.empty(),
              "[[crank.unbalance]]");
  effects.add(find_effect(kCrankEffects, "free rotation of the crank"), body.is_free,
              body.is_free ? "crank.speed = \"free\", [crank.load]"
                           : "crank.speed = \"prescribed\": the drive holds it",
              body.is_free ? "crank load" : "");
}

void CrankComponent::record(const System& system, const StageState& state, History& history) const {
  if (spec_.body.in_bearings) {
    const auto y = [&](size_t k) { return state.y(coordinates_[k]); };
    history.put("crankshaft_y", "m", y(0));
    history.put("crankshaft_z", "m", y(1));
    history.put("crankshaft_tilt_y", "rad", y(2));
    history.put("crankshaft_tilt_z", "rad", y(3));
    for (const BearingOrbit& orbit : orbits_) {
      const auto block = [&](int k) { return orbit.block[k] < 0 ? 0.0 : state.y(orbit.block[k]); };
      history.put(orbit.name + "_offset_y", "m", y(0) + orbit.arm * y(3) - block(0));
      history.put(orbit.name + "_offset_z", "m", y(1) - orbit.arm * y(2) - block(1));
    }
  }
  Component::record(system, state, history);
}

std::map<int, Eigen::Vector3d> CrankComponent::frames(double) const {
  return {{body_, {spec_.body.centre, 0.0, 0.0}}};
}

ComponentList read_crank(const Config& root) {
  auto crank = read_crankshaft(root);
  if (!crank) return {};
  return {std::make_shared<CrankComponent>(std::move(*crank))};
}

}  // namespace clatter::dynamics
