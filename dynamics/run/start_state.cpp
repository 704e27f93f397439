// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/start_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "dynamics/integrate/equilibrium.hpp"

namespace clatter::dynamics {
namespace {

int body_of(const System& system, int mode) {
  int body = 0;
  while (body + 1 < static_cast<int>(system.bodies().size()) &&
         system.mode_offset(body + 1) <= mode)
    ++body;
  return body;
}

std::string place_of(const Model& model, int body) {
  for (const MovingRow* row : components_of<MovingRow>(model))
    if (std::string place = row->place_of(body); !place.empty()) return place;
  return "";
}

/// Where forces do not balance: "exhaust; chain link 17, between crank and arm". The second part is
/// the worst of the bodies that have a place on a component, where the worst of all has none.
std::string unbalanced_text(const Model& model, const Equilibrium& found) {
  if (found.worst < 0) return "forces that are not finite";
  const auto& bodies = model.system.bodies();
  const auto name = [&](int body) { return bodies[body].name; };
  const int worst = body_of(model.system, found.worst);
  if (const std::string place = place_of(model, worst); !place.empty())
    return name(worst) + ", " + place;
  std::string text = name(worst);
  double most = 0.0;
  for (int b = 0; b < static_cast<int>(bodies.size()); ++b) {
    const double force =
        found.unbalanced.segment(model.system.mode_offset(b), bodies[b].modes()).maxCoeff();
    const std::string place = force > most ? place_of(model, b) : "";
    if (place.empty()) continue;
    most = force;
    text = fmt::format("{}; {}, {}", name(worst), name(b), place);
  }
  return text;
}

}  // namespace

ModalStart start_state(const Scene& scene, const LoadedBodies& bodies, const Model& model) {
  ModalStart start{model.system.eta_start(), model.system.v_start()};
  const auto needs = [](const auto& component) { return component->traits().needs_equilibrium; };
  if (std::none_of(model.components.begin(), model.components.end(), needs)) return start;
  const auto resting = build_model(scene, bodies, true);
  const Equilibrium found = find_equilibrium(resting->system, scene.time.begin, start.eta);
  if (!found.refused.empty())
    throw NumericsError(fmt::format("no static equilibrium after {} iterations: {}",
                                    found.iterations, found.refused));
  if (!found.found)
    throw NumericsError(fmt::format(
        "no static equilibrium after {} iterations: {:.3g} N unbalanced, most of it on {}",
        found.iterations, found.residual, unbalanced_text(*resting, found)));
  say(fmt::format("static equilibrium: {} iterations, {:.1e} N unbalanced", found.iterations,
                  found.residual));
  start.eta = found.eta;
  return start;
}

ModalStart first_state(const Scene& scene, const LoadedBodies& bodies, Model& model) {
  const std::filesystem::path& other = scene.time.start;
  return other.empty() ? start_state(scene, bodies, model) : read_end(other, model, bodies);
}

}  // namespace clatter::dynamics
