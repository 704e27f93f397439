// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/gravity_component.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/model_builder.hpp"

namespace clatter::dynamics {
namespace {

/// InputError for a part with supports without its inertia forces: M_rr rigid lacks the weight that
/// the modes of the interior carry.
void check_weight(const LoadedBody& body) {
  const rom::ReducedModel& model = body.model;
  if (model.inertia_force.rows() > 0 || body.modal.rigid_modes == 6) return;
  const Eigen::MatrixXd motions = model.rigid.leftCols<3>();
  const Eigen::Vector3d found = (motions.transpose() * model.M_rr * motions).diagonal();
  // Reduced mass properties are accepted up to 1e-9 of the full model's.
  constexpr double kComplete = 1e-6;
  if (((found.array() - model.mass.mass).abs() <= kComplete * model.mass.mass).all()) return;
  throw InputError(
      fmt::format("{}: gravity_m_s2: {}: found no inertia_force, expected it of a part with "
                  "supports: condense the part again with this version",
                  body.spec.where, body.spec.rom.string()));
}

}  // namespace

void GravityComponent::add_loads(ModelBuilder& model) {
  if (gravity_ <= 0.0) return;
  double felt = 0.0;
  for (const auto& [name, body] : model.bodies())
    felt = std::max(felt, frame_force(model.system, body, 2).cwiseAbs().maxCoeff());
  if (felt == 0.0)
    warn(
        "gravity_m_s2 has no effect: it acts along -z, across the plane in which each body moves "
        "(motion = \"xz\", \"yz\" or \"space\" feels it)");
  for (const auto& [name, body] : model.bodies()) {
    const LoadedBody* loaded = find_body(model.loaded, name);
    if (loaded != nullptr) check_weight(*loaded);
    const Shaft* shaft = loaded == nullptr ? nullptr : model.shaft_of(loaded->spec);
    if (shaft == nullptr) {
      model.system.add_load({"gravity", body, frame_force(model.system, body, 2),
                             ramped(model.time, [g = gravity_](double) { return g; })});
      continue;
    }
    // Of the axes of a frame that turns, the vertical has components that change.
    const double begin = shaft->drive.at(model.time.begin).position;
    for (int k = 0; k < 3; ++k) {
      const auto along = [g = gravity_, k, begin, shaft = *shaft](double t) {
        const Eigen::AngleAxisd turn(shaft.drive.at(t).position - begin, shaft.axis);
        return g * (turn * Eigen::Vector3d::Unit(k)).z();
      };
      model.system.add_load(
          {"gravity", body, frame_force(model.system, body, k), ramped(model.time, along)});
    }
  }
}

void GravityComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  effects.add(find_effect(kComponentEffects, "gravity"), gravity_ > 0.0, "gravity_m_s2");
}

const keys::Keys<GravitySpec>& gravity_keys() {
  static const keys::Keys<GravitySpec> keys(
      "gravity", "the weight of all bodies, along -z", [](auto& key, GravitySpec& gravity) {
        key.shared();
        key.number("gravity_m_s2", gravity.acceleration, Range::between(0.0, 1e5),
                   "acceleration of gravity, along -z");
      });
  return keys;
}

ComponentList read_gravity(const Config& root) {
  return {std::make_shared<GravityComponent>(gravity_keys().read(root).acceleration)};
}

}  // namespace clatter::dynamics
