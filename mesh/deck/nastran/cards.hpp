// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cards that are supported, skipped or refused; one function reads each.
#include "mesh/deck/nastran/bulk.hpp"
#include "mesh/deck/nastran/lines.hpp"

namespace clatter::mesh::deck::nastran {

/// Reads the bulk data from the current line of `source` to ENDDATA.
Bulk read_bulk(Source& source, Control control, Ignored& ignored, Refusals& refusals);

// Each reads one card. InputError with file and line for errors and unsupported fields.
void read_grid(const Card& card, Bulk& bulk);
void read_grdset(const Card& card, Bulk& bulk);
void read_cord1(const Card& card, Bulk& bulk);  // CORD1R, CORD1C, CORD1S
void read_cord2(const Card& card, Bulk& bulk);  // CORD2R, CORD2C, CORD2S
void read_cell(const Card& card, Bulk& bulk);   // CTETRA, CPYRAM, CPENTA, CHEXA
void read_psolid(const Card& card, Bulk& bulk);
void read_mat1(const Card& card, Bulk& bulk);
void read_mat9(const Card& card, Bulk& bulk);
void read_rbe2(const Card& card, Bulk& bulk);
void read_rbe3(const Card& card, Bulk& bulk);
void read_conm2(const Card& card, Bulk& bulk);
void read_celas1(const Card& card, Bulk& bulk);
void read_celas2(const Card& card, Bulk& bulk);
void read_pelas(const Card& card, Bulk& bulk);
void read_mpc(const Card& card, Bulk& bulk);
void read_mpcadd(const Card& card, Bulk& bulk);
void read_spc(const Card& card, Bulk& bulk);
void read_spc1(const Card& card, Bulk& bulk);
void read_spcadd(const Card& card, Bulk& bulk);
void read_aset(const Card& card, Bulk& bulk);   // ASET, BSET
void read_aset1(const Card& card, Bulk& bulk);  // ASET1, BSET1
void read_set1(const Card& card, Bulk& bulk);
void read_force(const Card& card, Bulk& bulk);  // FORCE, MOMENT
void read_pload4(const Card& card, Bulk& bulk);
void read_grav(const Card& card, Bulk& bulk);
void read_rforce(const Card& card, Bulk& bulk);
void read_load(const Card& card, Bulk& bulk);
void read_temp(const Card& card, Bulk& bulk);
void read_tempd(const Card& card, Bulk& bulk);
void read_eigrl(const Card& card, Bulk& bulk);
void read_eigr(const Card& card, Bulk& bulk);

/// A "$ clatter ..." comment.
void read_comment(std::string_view text, Origin origin, const Source& source, Bulk& bulk);

}  // namespace clatter::mesh::deck::nastran
