// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/start_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "dynamics/integrate/equilibrium.hpp"

namespace clatter::dynamics {
namespace {

/// "timing link 17, between crank and arm".
std::string body_text(const Model& model, int mode) {
  if (mode < 0) return "forces that are not finite";
  const auto& bodies = model.system.bodies();
  int body = 0;
  while (body + 1 < static_cast<int>(bodies.size()) && model.system.mode_offset(body + 1) <= mode)
    ++body;
  std::string text = bodies[static_cast<size_t>(body)].name;
  for (const auto& component : model.components)
    if (const std::string place = component->place_of(body); !place.empty()) text += ", " + place;
  return text;
}

}  // namespace

ModalStart start_state(const Scene& scene, const LoadedBodies& bodies, const Model& model) {
  ModalStart start{model.system.eta_start(), model.system.v_start()};
  const auto needs = [](const auto& component) { return component->needs_equilibrium(); };
  if (std::none_of(model.components.begin(), model.components.end(), needs)) return start;
  const auto resting = build_model(scene, bodies, true);
  const Equilibrium found = find_equilibrium(resting->system, scene.time.begin, start.eta);
  if (!found.refused.empty())
    throw NumericsError(fmt::format("no static equilibrium after {} iterations: {}",
                                    found.iterations, found.refused));
  if (!found.found)
    throw NumericsError(fmt::format(
        "no static equilibrium after {} iterations: {:.3g} N unbalanced, most of it on {}",
        found.iterations, found.residual, body_text(*resting, found.worst)));
  say(fmt::format("static equilibrium: {} iterations, {:.1e} N unbalanced", found.iterations,
                  found.residual));
  start.eta = found.eta;
  return start;
}

}  // namespace clatter::dynamics
