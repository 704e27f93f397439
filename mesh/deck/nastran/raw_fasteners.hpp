// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cards of fasteners and spot welds.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/deck/nastran/card.hpp"

namespace clatter::mesh::deck::nastran {

/// CFAST, CWELD: a short bar between patches of two sheets.
struct RawFastener {
  /// What an end is: the shells of a property, one shell and its neighbours, the face on some
  /// grids, or a grid.
  enum class End { kProperty, kShell, kGrids, kGrid };

  Origin origin = 0;
  std::string card;
  int32_t id = 0, property = 0;
  std::array<End, 2> kinds{};
  std::array<int32_t, 2> numbers{};  // of the property, shell or grid
  std::array<std::vector<int32_t>, 2> grids;
  int32_t place = 0;                        // GS; 0: `at`, or the piercing points
  std::array<int32_t, 2> piercing{};        // GA, GB; 0: where GS is projected
  std::optional<std::array<double, 3>> at;  // XS YS ZS
};

struct RawFastenerProperty {  // PFAST, PWELD
  Origin origin = 0;
  std::string card;
  double diameter = 0.0;
  // PFAST
  int32_t system = -1;       // MCID; -1: along the fastener
  bool is_absolute = false;  // MFLAG
  std::array<double, 6> stiffness{};
  double mass = 0.0, loss_factor = 0.0;
  // PWELD
  int32_t material = 0;
  bool is_spot = false;                  // its length is half of both thicknesses
  double shortest = 0.2, longest = 5.0;  // length over diameter, LDMIN and LDMAX
};

}  // namespace clatter::mesh::deck::nastran
