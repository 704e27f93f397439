// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cards of two-dimensional cells and their properties as they are in the deck.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/cell.hpp"
#include "mesh/deck/nastran/card.hpp"

namespace clatter::mesh::deck::nastran {

inline constexpr int32_t kNoSystem = -1;

/// CTRIA3, CTRIA6, CTRIAR, CQUAD4, CQUAD8, CQUADR: a face of solids, or a shell.
struct RawSkin {
  std::string kind;
  FaceType type = FaceType::kTri3;
  int32_t id = 0, property = 0;
  Origin origin = 0;
  std::array<int32_t, kMaxFaceNodes> grids{};
  int32_t missing = 0;                // mid-side grids, where it has others and is linear
  double offset = 0.0;                // ZOFFS
  double angle = 0.0;                 // THETA [degrees]
  int32_t system = kNoSystem;         // MCID
  bool is_relative = false;           // TFLAG: thickness over that of the property
  std::array<double, 4> thickness{};  // at the corners; NaN: that of the property
};

struct RawPly {
  int32_t material = 0;
  double thickness = 0.0, angle = 0.0;  // [degrees]
};

struct RawShell {  // PSHELL, PCOMP, PCOMPG
  Origin origin = 0;
  std::string card;
  std::string refusal;                 // why no shell can have it; "" for none
  int32_t material = 0;                // 0: none; also of the next two
  int32_t bending = 0;                 // MID2
  int32_t shear = 0;                   // MID3
  double thickness = 0.0;              // 0: not known
  double inertia = 1.0;                // 12 I / T^3
  double shear_ratio = 0.0;            // TS / T
  double area_mass = 0.0;              // NSM
  std::vector<RawPly> plies;           // of PCOMP and PCOMPG
  double bottom = 0.0;                 // Z0
  double reference_temperature = 0.0;  // TREF
  std::optional<double> loss_factor;   // GE of PCOMP and PCOMPG
};

}  // namespace clatter::mesh::deck::nastran
