// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cards of bars, beams and rods as they are in the deck.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/recipe/recipe.hpp"
#include "mesh/deck/nastran/card.hpp"

namespace clatter::mesh::deck::nastran {

struct RawBar {      // CBAR, CBEAM, CROD, CONROD, CTUBE
  std::string name;  // "cbar_5"
  Origin origin = 0;
  int32_t id = 0;
  int32_t property = 0;
  std::array<int32_t, 2> grids{};
  int32_t orientation_grid = 0;  // G0
  std::optional<std::array<double, 3>> orientation{};
  bool orientation_is_basic = false;  // else along the axes of the first grid
  std::array<DofMask, 2> released{};
  std::array<std::array<double, 3>, 2> offset{};
};

struct RawBarProperty {  // PBAR, PBARL, PBEAM, PBEAML, PROD, PTUBE; CONROD
  std::string card;      // its name
  Origin origin = 0;
  int32_t material = 0;
  std::string refusal{};                        // why no bar can have it; "" for none
  std::vector<double> shear_factors{};          // along y and z, or none
  std::vector<recipe::BeamSection> sections{};  // in the deck's units
};

}  // namespace clatter::mesh::deck::nastran
