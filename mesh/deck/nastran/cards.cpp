// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/cards.hpp"

#include <algorithm>
#include <array>

namespace clatter::mesh::deck::nastran {
namespace {

constexpr const char* kRetained = "boundary DoFs of a condensation";
constexpr const char* kSystem = "coordinate system";
constexpr const char* kCell = "cells, with any mid-side nodes or none";
constexpr const char* kEcho = "printing";
constexpr const char* kSkin = "surface where it is a face of a solid";

// Sorted by name.
constexpr std::array kRoles = {
    Role{"ASET", read_aset, 8, kRetained},
    Role{"ASET1", read_aset1, 0, kRetained},
    Role{"BSET", read_aset, 8, kRetained},
    Role{"BSET1", read_aset1, 0, kRetained},
    Role{"CELAS1", read_celas1, 8, "spring"},
    Role{"CELAS2", read_celas2, 8, "spring"},
    Role{"CHEXA", read_cell, 24, kCell},
    Role{"CONM2", read_conm2, 16, "mass with inertia, at an offset on points"},
    Role{"CORD1C", read_cord1, 8, kSystem},
    Role{"CORD1R", read_cord1, 8, kSystem},
    Role{"CORD1S", read_cord1, 8, kSystem},
    Role{"CORD2C", read_cord2, 16, kSystem},
    Role{"CORD2R", read_cord2, 16, kSystem},
    Role{"CORD2S", read_cord2, 16, kSystem},
    Role{"CPENTA", read_cell, 24, kCell},
    Role{"CPYRA", read_cell, 16, kCell},
    Role{"CPYRAM", read_cell, 16, kCell},
    Role{"CQUAD4", read_skin, 16, kSkin},
    Role{"CQUAD8", read_skin, 24, kSkin},
    Role{"CQUADR", read_skin, 16, kSkin},
    Role{"CTETRA", read_cell, 16, kCell},
    Role{"CTRIA3", read_skin, 16, kSkin},
    Role{"CTRIA6", read_skin, 16, kSkin},
    Role{"CTRIAR", read_skin, 16, kSkin},
    Role{"ECHOOFF", nullptr, 0, kEcho},
    Role{"ECHOON", nullptr, 0, kEcho},
    Role{"EIGR", read_eigr, 16, "number of modes of a step"},
    Role{"EIGRL", read_eigrl, 0, "number of modes of a step"},
    Role{"FORCE", read_force, 8, "force"},
    Role{"GRAV", read_grav, 8, "acceleration"},
    Role{"GRDSET", read_grdset, 8, "systems and supports that a GRID leaves blank"},
    Role{"GRID", read_grid, 8, "node, or point where a coupling or mass names it"},
    Role{"LOAD", read_load, 0, "sum of load sets"},
    Role{"MAT1", read_mat1, 16, "isotropic material; damping and stress limits are not read"},
    Role{"MAT9", read_mat9, 32, "anisotropic material"},
    Role{"MOMENT", read_force, 8, "moment"},
    Role{"MPC", read_mpc, 0, "equation"},
    Role{"MPCADD", read_mpcadd, 0, "sum of sets of equations"},
    Role{"PARAM", nullptr, 8, "WTMASS scales densities and masses; others are passed over"},
    Role{"PCOMP", read_pshell, 0, "of skins"},
    Role{"PCOMPG", read_pshell, 0, "of skins"},
    Role{"PELAS", read_pelas, 8, "stiffness of springs"},
    Role{"PLOAD4", read_pload4, 16, "pressure on a surface"},
    Role{"PLOTEL", nullptr, 8, "line of a plot"},
    Role{"PSHELL", read_pshell, 16, "of skins"},
    Role{"PSOLID", read_psolid, 8, "region with its material"},
    Role{"RBE2", read_rbe2, 0, "rigid coupling; in some directions of a CD system: equations"},
    Role{"RBE3", read_rbe3, 0, "distributing coupling"},
    Role{"RFORCE", read_rforce, 24, "rotation"},
    Role{"SET1", read_set1, 0, "node set"},
    Role{"SPC", read_spc, 8, "supports, prescribed displacements"},
    Role{"SPC1", read_spc1, 0, "supports"},
    Role{"SPCADD", read_spcadd, 0, "sum of sets of supports"},
    Role{"TEMP", read_temp, 8, "temperatures of nodes"},
    Role{"TEMPD", read_tempd, 8, "temperature of all other nodes"},
};

constexpr const char* kNoBeams = "no beams yet";
constexpr const char* kNoShells = "no shells yet";

// Sorted by name.
constexpr std::array kRefused = {
    RefusedCard{"CBAR", kNoBeams},  RefusedCard{"CBEAM", kNoBeams},
    RefusedCard{"CBEND", kNoBeams}, RefusedCard{"CONROD", kNoBeams},
    RefusedCard{"CROD", kNoBeams},  RefusedCard{"CSHEAR", kNoShells},
    RefusedCard{"CTUBE", kNoBeams},
};

constexpr auto kByName = [](const auto& a, const auto& b) { return a.name < b.name; };
static_assert(std::is_sorted(kRoles.begin(), kRoles.end(), kByName));
static_assert(std::is_sorted(kRefused.begin(), kRefused.end(), kByName));

template <class Rows>
auto row_of(const Rows& rows, std::string_view name) -> decltype(&*rows.begin()) {
  const auto at =
      std::lower_bound(rows.begin(), rows.end(), name,
                       [](const auto& row, std::string_view n) { return row.name < n; });
  return at != rows.end() && at->name == name ? &*at : nullptr;
}

}  // namespace

const Role* role_of(std::string_view name) { return row_of(kRoles, name); }

std::string_view why_refused(std::string_view name) {
  const RefusedCard* row = row_of(kRefused, name);
  return row == nullptr ? std::string_view() : row->why;
}

std::vector<Listed> listed_cards() {
  std::vector<Listed> rows;
  for (const Role& role : kRoles)
    rows.push_back({std::string(role.name), role.fate(), std::string(role.meaning)});
  for (const RefusedCard& card : kRefused)
    rows.push_back({std::string(card.name), Fate::kRefused, std::string(card.why)});
  return rows;
}

}  // namespace clatter::mesh::deck::nastran
