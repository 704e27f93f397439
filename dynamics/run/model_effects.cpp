// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model_effects.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clatter::dynamics {
namespace {

std::string body_size(const LoadedBody& body) {
  return fmt::format("{} coordinates, {} rigid modes, highest {:.4g} Hz", body.model.size(),
                     body.modal.rigid_modes,
                     std::sqrt(body.modal.omega_squared.maxCoeff()) / 6.283185307179586);
}

}  // namespace

EffectTable effects_of(const SceneBodies& bodies, size_t mounts, const std::string& ends) {
  const Scene& scene = bodies.scene;
  EffectTable table;
  for (const auto& body : bodies.loaded) {
    table.add(fmt::format("elastic {}", body.spec.name), body.spec.elastic,
              body.spec.elastic ? body_size(body) : body.spec.name + ".model = \"rigid\": 6 modes");
  }
  if (scene.block && !scene.block->elastic) {
    table.add("elastic block", false,
              "block.model = \"rigid\": liner and bearings at rest, no body");
  }
  if (!scene.engine) {
    table.add("mounts", mounts > 0, mounts > 0 ? "[[mount]]" : "no [[mount]]", "mount");
    table.add("gravity", scene.gravity > 0.0, "gravity_m_s2");
    return table;
  }
  table.add("inertia of the piston", true, "eq. (10): frame moves with z_B(t), does not turn");
  table.add("inertia of the rod", true, "moving and turning frame, exact in the plane");
  table.add("inertia of the block", false, "p* = 0: its frame is at rest");
  const bool balanced = scene.engine->balanced && bodies.block() != nullptr;
  table.add("balance by other cylinders", balanced,
            !balanced && scene.engine->balanced ? "no elastic block"
                                                : "engine.balanced, on the block's rigid modes");
  table.add("gas pressure", scene.gas.has_value(), scene.gas ? "[gas]" : "no [gas]");
  table.add("rod joint at the pin", true, "[small_end]", "pin");
  table.add("rod joint at the crank", true, "[big_end]", "crank_pin");
  table.add("pin guide", true, "[pin_guide]: along the pin and about y, z", "pin_guide");
  const bool contact = scene.contact.has_value();
  const auto effects = contact ? scene.contact->effects : film::ContactEffects{};
  const std::string absent = "no [contact]";
  const std::string name = contact ? scene.contact->name : "";
  table.add("oil film", contact && effects.film,
            !contact       ? absent
            : effects.film ? "contact.lubrication = \"film\" (all of the contact)"
                           : "contact.lubrication = \"none\"",
            contact && effects.film ? name : "");
  table.add("cavitation", contact && effects.film && effects.cavitation,
            !contact             ? absent
            : !effects.film      ? "no film"
            : effects.cavitation ? scene.contact->cavity == film::Cavity::kLayer
                                       ? "contact.cavitation, oil in layers on the walls"
                                       : "contact.cavitation, oil in streamers across the gap"
                                 : "contact.cavitation = false: every cell is full; "
                                   "oil_thickness_um, initial_fill, supply_fill are not used");
  table.add("asperity contact", contact && effects.asperities, "contact.asperities",
            contact && !effects.film ? name : "");
  const bool damped = contact && effects.asperities && scene.contact->damping.loss_factor > 0.0;
  table.add("damping of the contact", damped,
            contact && !effects.asperities ? "no asperities" : "contact.asperity_loss_factor");
  table.add("friction", contact && effects.friction, "contact.friction");
  table.add("ends of the liner", !ends.empty(),
            !contact       ? absent
            : ends.empty() ? "no contact.liner_bottom_mm, liner_top_mm, no elastic liner"
                           : ends);
  table.add("mounts", mounts > 0, mounts > 0 ? "[[mount]]" : "no mounted body", "mount");
  table.add("gravity", scene.gravity > 0.0, "gravity_m_s2");
  return table;
}

}  // namespace clatter::dynamics
