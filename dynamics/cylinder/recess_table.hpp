// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Grooves, holes and windows of skirt and liner: [[contact.recess]].
#include <array>

#include "core/keys/keys.hpp"
#include "dynamics/film/recess.hpp"

namespace clatter::dynamics {

struct RecessTable {
  film::Recess recess;
  std::array<double, 2> height{}, angle{};  // from, to [m], [deg]
};
const keys::Keys<RecessTable>& recess_keys();

}  // namespace clatter::dynamics
