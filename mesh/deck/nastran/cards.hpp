// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The role of each card; one function reads each. `clatter-mesh cards` prints these tables.
#include "mesh/deck/contents.hpp"
#include "mesh/deck/nastran/lines.hpp"
#include "mesh/deck/nastran/raw_deck.hpp"

namespace clatter::mesh::deck::nastran {

struct Role {
  std::string_view name;
  void (*read)(const Card&, RawDeck&);  // null: harmless, passed over
  size_t most_fields;                   // 0: any number
  std::string_view meaning;             // what it becomes, or what it is where it is passed over

  Fate fate() const { return read != nullptr || name == "PARAM" ? Fate::kRead : Fate::kPassed; }
};

/// A card that is refused for a known reason; all others without a role are refused, too.
struct RefusedCard {
  std::string_view name;
  std::string_view why;
};

/// The role of a card by its name in capitals; null for one that is refused by name.
const Role* role_of(std::string_view name);
/// Why a card without a role is refused; empty where the reason is that nobody reads it.
std::string_view why_refused(std::string_view name);

/// All of both tables.
std::vector<Listed> listed_cards();

// Each reads one card. InputError with file and line for errors and unsupported fields.
void read_grid(const Card& card, RawDeck& raw);
void read_grdset(const Card& card, RawDeck& raw);
void read_cord1(const Card& card, RawDeck& raw);  // CORD1R, CORD1C, CORD1S
void read_cord2(const Card& card, RawDeck& raw);  // CORD2R, CORD2C, CORD2S
void read_cell(const Card& card, RawDeck& raw);   // CTETRA, CPYRAM, CPENTA, CHEXA
void read_psolid(const Card& card, RawDeck& raw);
void read_skin(const Card& card, RawDeck& raw);    // CTRIA3, CTRIA6, CTRIAR, CQUAD4, CQUAD8, CQUADR
void read_pshell(const Card& card, RawDeck& raw);  // PSHELL, PCOMP, PCOMPG
void read_mat1(const Card& card, RawDeck& raw);
void read_mat9(const Card& card, RawDeck& raw);
void read_rbe2(const Card& card, RawDeck& raw);
void read_rbe3(const Card& card, RawDeck& raw);
void read_conm2(const Card& card, RawDeck& raw);
void read_celas1(const Card& card, RawDeck& raw);
void read_celas2(const Card& card, RawDeck& raw);
void read_pelas(const Card& card, RawDeck& raw);
void read_mpc(const Card& card, RawDeck& raw);
void read_mpcadd(const Card& card, RawDeck& raw);
void read_spc(const Card& card, RawDeck& raw);
void read_spc1(const Card& card, RawDeck& raw);
void read_spcadd(const Card& card, RawDeck& raw);
void read_aset(const Card& card, RawDeck& raw);   // ASET, BSET
void read_aset1(const Card& card, RawDeck& raw);  // ASET1, BSET1
void read_set1(const Card& card, RawDeck& raw);
void read_force(const Card& card, RawDeck& raw);  // FORCE, MOMENT
void read_pload4(const Card& card, RawDeck& raw);
void read_grav(const Card& card, RawDeck& raw);
void read_rforce(const Card& card, RawDeck& raw);
void read_load(const Card& card, RawDeck& raw);
void read_temp(const Card& card, RawDeck& raw);
void read_tempd(const Card& card, RawDeck& raw);
void read_eigrl(const Card& card, RawDeck& raw);
void read_eigr(const Card& card, RawDeck& raw);

/// A "$ clatter ..." comment.
void read_comment(std::string_view text, Origin origin, const Source& source, RawDeck& raw);

}  // namespace clatter::mesh::deck::nastran
