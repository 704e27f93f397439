// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil of a contact: tables [contact.oil] and [contact.liner_oil] of a scene.
#include <string>

#include "core/keys/keys.hpp"
#include "dynamics/film/liner_layer.hpp"
#include "dynamics/film/viscosity.hpp"

namespace clatter::dynamics {

/// [contact.oil]: laws of the viscosity. Absent: it is constant.
struct OilTable {
  film::ViscosityOptions laws;  // has those of the following that are given
  enum class Law : char { kConstant, kVogel, kWalther };
  Law law = Law::kConstant;
  film::VogelLaw vogel;
  film::WaltherLaw walther;
  film::CrossLaw cross;
  std::string where;  // "file:line"
};
const keys::Keys<OilTable>& oil_keys();

/// [contact.liner_oil]: the layer that is remembered on the liner.
const keys::Keys<film::LinerLayerOptions>& liner_oil_keys();

}  // namespace clatter::dynamics
