// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/effect_catalogue.hpp"

#include <fmt/format.h>

#include "dynamics/chain/chain_catalogue.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/crank/crank_catalogue.hpp"
#include "dynamics/cylinder/cylinder_catalogue.hpp"
#include "dynamics/hydraulic/hydraulic_catalogue.hpp"
#include "dynamics/shaft/shaft_catalogue.hpp"
#include "dynamics/valve/valve_catalogue.hpp"

namespace clatter::dynamics {
namespace {

/// The text of a cell of a table: a bar would end it.
std::string cell(std::string_view text) {
  std::string made;
  for (const char c : text) made += c == '|' ? std::string("\\|") : std::string(1, c);
  return made;
}

}  // namespace

const std::vector<EffectFamily>& effect_catalogue() {
  static const std::vector<EffectFamily> families{
      {"Bodies, joints, mounts", kComponentEffects},
      {"Cylinders", kCylinderEffects},
      {"Crankshaft", kCrankEffects},
      {"Shafts and torques", kShaftEffects},
      {"Chains", kChainEffects},
      {"Tensioners and lash adjusters", kHydraulicEffects},
      {"Valve trains", kValveEffects}};
  return families;
}

std::string effect_tables() {
  std::string text;
  for (const EffectFamily& family : effect_catalogue()) {
    text += fmt::format(
        "## {}\n\n| effect | equation | needs | switch | measured |\n|---|---|---|---|---|\n",
        family.heading);
    for (const EffectEntry& entry : family.entries)
      text += fmt::format("| {} | {} | {} | {} | {} |\n", cell(entry.name),
                          fmt::format("`{}`", cell(entry.equation)), cell(entry.needs),
                          cell(entry.key), cell(entry.measured));
    text += "\n";
  }
  return text;
}

}  // namespace clatter::dynamics
