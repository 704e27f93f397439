// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nastran bulk data decks (MSC, NX, Simcenter) of solids.
//
// Formats: small, large and free field, mixed; every form of continuation; INCLUDE; any case; with
// executive and case control or bulk data alone.
//
// Cards and their result (names in the Deck):
//   GRID GRDSET           nodes of cells in the order of the deck; a grid without cells that a
//                         coupling, a mass or an MPC names is a Point; others are left out, with
//                         their number in Deck::ignored
//   CORD1R/C/S CORD2R/C/S systems "cord_5", those that something in the Deck refers to
//   CTETRA CPYRAM CPENTA CHEXA  with any mid-side nodes or none
//   PSOLID                region "pid_5"; CORDM counts with MAT9. A deck without any PSOLID has
//                         regions without material
//   MAT1 MAT9             "mat_5". GE (damping) and stress limits are not read
//   RBE2 RBE3             "rbe2_5", "rbe3_5"; RBE2 in some directions of a CD system: equations
//   CONM2 MPC MPCADD      masses, equations
//   CELAS1 CELAS2 PELAS   springs
//   SPC SPC1 SPCADD PS    supports "spc_5", "ps"; rotations of solids' nodes have no meaning and
//                         are passed over
//   ASET ASET1 BSET BSET1 Deck::retained
//   SET1                  node sets "set_5"
//   FORCE MOMENT GRAV RFORCE PLOAD4 LOAD TEMP TEMPD
//                         steps "subcase_1"; without case control one step "load_5" a load set.
//                         Pressures act on surfaces "pload4_5"
//   EIGRL EIGR            Step::modes
//   PARAM                 WTMASS scales densities and masses; other parameters are passed over
//   PLOTEL ECHOON ECHOOFF passed over
//
// Directions of supports, equations and couplings are those of each grid's CD. A case control alone
// chooses SPC and MPC sets; without one the deck must have at most one of each.
#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck {

/// Reads a deck and all included files, in the deck's own units. Surface "skin" is not made here.
/// InputError "file:line: ..." for invalid or unsupported cards (unless in options.ignore),
/// FileError when the file cannot be read.
Deck read_nastran(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same from text in memory, without includes; `name` is for messages.
Deck read_nastran_text(const std::string& name, std::string_view text,
                       const ReadOptions& options = {});

}  // namespace clatter::mesh::deck
