// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The role of each card; one function reads each. `clatter-mesh cards` prints this table.
#include <string>
#include <vector>

#include "mesh/deck/contents.hpp"
#include "mesh/deck/nastran/lines.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"

namespace clatter::mesh::deck::nastran {

struct Role {
  std::string_view name;
  Fate fate;
  void (*read)(const Card&, RawDeck&);  // null unless it is read
  size_t most_fields;                   // after them no continuation is expected; 0: any number
  size_t first_grid, grids;             // fields of a refused cell with its GRID numbers
  const char* meaning;  // what it becomes; why it is passed over; the remedy where it is refused
};

/// The role of a card by its name in capitals; null for one that is not known.
const Role* role_of(std::string_view name);
/// What to do about a card that is refused.
std::string advice_of(const Role& role);
/// The entire table.
std::vector<Listed> listed_cards();

// Each reads one card. InputError with file and line for errors and unsupported fields.
void read_accel(const Card& card, RawDeck& raw);
void read_accel1(const Card& card, RawDeck& raw);
void read_aset(const Card& card, RawDeck& raw);   // ASET, BSET, CSET
void read_aset1(const Card& card, RawDeck& raw);  // ASET1, BSET1, CSET1
void read_baror(const Card& card, RawDeck& raw);  // BAROR, BEAMOR
void read_bgset(const Card& card, RawDeck& raw);
void read_bsurfs(const Card& card, RawDeck& raw);
void read_cbar(const Card& card, RawDeck& raw);  // CBAR, CBEAM
void read_cbush(const Card& card, RawDeck& raw);
void read_celas1(const Card& card, RawDeck& raw);  // CELAS1, CMASS1
void read_celas2(const Card& card, RawDeck& raw);  // CELAS2, CMASS2
void read_celas3(const Card& card, RawDeck& raw);  // CELAS3, CMASS3
void read_celas4(const Card& card, RawDeck& raw);  // CELAS4, CMASS4
void read_cell(const Card& card, RawDeck& raw);    // CTETRA, CPYRAM, CPENTA, CHEXA
void read_cfast(const Card& card, RawDeck& raw);
void read_cgap(const Card& card, RawDeck& raw);
void read_conm1(const Card& card, RawDeck& raw);
void read_conm2(const Card& card, RawDeck& raw);
void read_cord1(const Card& card, RawDeck& raw);  // CORD1R, CORD1C, CORD1S
void read_cord2(const Card& card, RawDeck& raw);  // CORD2R, CORD2C, CORD2S
void read_conrod(const Card& card, RawDeck& raw);
void read_crod(const Card& card, RawDeck& raw);  // CROD, CTUBE
void read_cweld(const Card& card, RawDeck& raw);
void read_dmig(const Card& card, RawDeck& raw);
void read_eigr(const Card& card, RawDeck& raw);
void read_eigrl(const Card& card, RawDeck& raw);
void read_force(const Card& card, RawDeck& raw);   // FORCE, MOMENT
void read_force1(const Card& card, RawDeck& raw);  // FORCE1, MOMENT1
void read_force2(const Card& card, RawDeck& raw);  // FORCE2, MOMENT2
void read_grav(const Card& card, RawDeck& raw);
void read_grdset(const Card& card, RawDeck& raw);
void read_grid(const Card& card, RawDeck& raw);
void read_load(const Card& card, RawDeck& raw);
void read_mat1(const Card& card, RawDeck& raw);
void read_mat2(const Card& card, RawDeck& raw);
void read_mat8(const Card& card, RawDeck& raw);
void read_mat9(const Card& card, RawDeck& raw);
void read_mpc(const Card& card, RawDeck& raw);
void read_mpcadd(const Card& card, RawDeck& raw);
void read_other_material(const Card& card, RawDeck& raw);  // the same for materials
void read_other_property(const Card& card,
                         RawDeck& raw);  // properties that solids cannot have here
void read_pbar(const Card& card, RawDeck& raw);
void read_pbarl(const Card& card, RawDeck& raw);
void read_pbeam(const Card& card, RawDeck& raw);
void read_pbeaml(const Card& card, RawDeck& raw);
void read_pbush(const Card& card, RawDeck& raw);
void read_pelas(const Card& card, RawDeck& raw);
void read_pfast(const Card& card, RawDeck& raw);
void read_pgap(const Card& card, RawDeck& raw);
void read_pload(const Card& card, RawDeck& raw);
void read_pload2(const Card& card, RawDeck& raw);
void read_pload4(const Card& card, RawDeck& raw);
void read_pmass(const Card& card, RawDeck& raw);
void read_prod(const Card& card, RawDeck& raw);
void read_pshell(const Card& card, RawDeck& raw);  // PSHELL, PCOMP, PCOMPG
void read_psolid(const Card& card, RawDeck& raw);
void read_ptube(const Card& card, RawDeck& raw);
void read_pweld(const Card& card, RawDeck& raw);
void read_rbar(const Card& card, RawDeck& raw);
void read_rbar1(const Card& card, RawDeck& raw);  // RBAR1, RJOINT
void read_rbe1(const Card& card, RawDeck& raw);
void read_rbe2(const Card& card, RawDeck& raw);
void read_rbe3(const Card& card, RawDeck& raw);
void read_rforce(const Card& card, RawDeck& raw);
void read_rrod(const Card& card, RawDeck& raw);
void read_set1(const Card& card, RawDeck& raw);
void read_skin(const Card& card, RawDeck& raw);  // CQUAD4, CTRIA3 and the like
void read_spc(const Card& card, RawDeck& raw);
void read_spc1(const Card& card, RawDeck& raw);
void read_spcadd(const Card& card, RawDeck& raw);
void read_spcd(const Card& card, RawDeck& raw);
void read_spoint(const Card& card, RawDeck& raw);
void read_temp(const Card& card, RawDeck& raw);
void read_tempd(const Card& card, RawDeck& raw);

/// A "$ clatter ..." comment.
void read_comment(std::string_view text, Origin origin, const Source& source, RawDeck& raw);

}  // namespace clatter::mesh::deck::nastran
