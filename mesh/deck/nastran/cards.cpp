// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/cards.hpp"

#include <algorithm>
#include <array>

namespace clatter::mesh::deck::nastran {
namespace {

// Sorted by name. Harmless ones control solvers, output or plots and do not change the model.
constexpr std::array kRoles = {Role{"ASET", read_aset, 8},      Role{"ASET1", read_aset1, 0},
                               Role{"BSET", read_aset, 8},      Role{"BSET1", read_aset1, 0},
                               Role{"CELAS1", read_celas1, 8},  Role{"CELAS2", read_celas2, 8},
                               Role{"CHEXA", read_cell, 24},    Role{"CONM2", read_conm2, 16},
                               Role{"CORD1C", read_cord1, 8},   Role{"CORD1R", read_cord1, 8},
                               Role{"CORD1S", read_cord1, 8},   Role{"CORD2C", read_cord2, 16},
                               Role{"CORD2R", read_cord2, 16},  Role{"CORD2S", read_cord2, 16},
                               Role{"CPENTA", read_cell, 24},   Role{"CPYRA", read_cell, 16},
                               Role{"CPYRAM", read_cell, 16},   Role{"CQUAD4", read_skin, 16},
                               Role{"CQUAD8", read_skin, 24},   Role{"CQUADR", read_skin, 16},
                               Role{"CTETRA", read_cell, 16},   Role{"CTRIA3", read_skin, 16},
                               Role{"CTRIA6", read_skin, 16},   Role{"CTRIAR", read_skin, 16},
                               Role{"ECHOOFF", nullptr, 0},     Role{"ECHOON", nullptr, 0},
                               Role{"EIGR", read_eigr, 16},     Role{"EIGRL", read_eigrl, 0},
                               Role{"FORCE", read_force, 8},    Role{"GRAV", read_grav, 8},
                               Role{"GRDSET", read_grdset, 8},  Role{"GRID", read_grid, 8},
                               Role{"LOAD", read_load, 0},      Role{"MAT1", read_mat1, 16},
                               Role{"MAT9", read_mat9, 32},     Role{"MOMENT", read_force, 8},
                               Role{"MPC", read_mpc, 0},        Role{"MPCADD", read_mpcadd, 0},
                               Role{"PARAM", nullptr, 8},       Role{"PCOMP", read_pshell, 0},
                               Role{"PCOMPG", read_pshell, 0},  Role{"PELAS", read_pelas, 8},
                               Role{"PLOAD4", read_pload4, 16}, Role{"PLOTEL", nullptr, 8},
                               Role{"PSHELL", read_pshell, 16}, Role{"PSOLID", read_psolid, 8},
                               Role{"RBE2", read_rbe2, 0},      Role{"RBE3", read_rbe3, 0},
                               Role{"RFORCE", read_rforce, 24}, Role{"SET1", read_set1, 0},
                               Role{"SPC", read_spc, 8},        Role{"SPC1", read_spc1, 0},
                               Role{"SPCADD", read_spcadd, 0},  Role{"TEMP", read_temp, 8},
                               Role{"TEMPD", read_tempd, 8}};

static_assert(std::is_sorted(kRoles.begin(), kRoles.end(),
                             [](const Role& a, const Role& b) { return a.name < b.name; }));

}  // namespace

const Role* role_of(std::string_view name) {
  const auto at =
      std::lower_bound(kRoles.begin(), kRoles.end(), name,
                       [](const Role& role, std::string_view n) { return role.name < n; });
  return at != kRoles.end() && at->name == name ? &*at : nullptr;
}

}  // namespace clatter::mesh::deck::nastran
