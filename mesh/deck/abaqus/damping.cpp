// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/damping.hpp"

namespace clatter::mesh::deck::abaqus {

std::optional<Damping> rayleigh_of(const Card& card, const Source& source) {
  const Keyword& keyword = card.keyword();
  Damping damping{source.where(card.origin()), keyword.name};
  if (keyword.key == "MODALDAMPING") {
    if (!keyword.has("RAYLEIGH") && keyword.choice("VISCOUS", "") != "RAYLEIGH") return {};
    if (card.size() == 0) return {};
    const Fields fields = card.line(0, source);
    damping.mass = fields.number_or(2, "alpha", 0.0);
    damping.stiffness = fields.number_or(3, "beta", 0.0);
  } else {
    if (keyword.choice("FIELD", "ALL") == "ACOUSTIC") return {};
    const auto value = [&](const char* name) {
      const bool given = keyword.has(name) && keyword.choice(name, "") != "TABULAR";
      return given ? Fields(*keyword.find(name), source, card.origin()).number(0, name) : 0.0;
    };
    damping.mass = value("ALPHA");
    damping.stiffness = value("BETA");
  }
  if (damping.mass == 0.0 && damping.stiffness == 0.0) return {};
  return damping;
}

}  // namespace clatter::mesh::deck::abaqus
