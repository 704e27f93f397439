// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nastran bulk data decks (MSC, NX, Simcenter) of solids and shells.
//
// Formats: small, large and free field, mixed; every form of continuation; repetitions (=, ==,
// *(d)); INCLUDE, also 'DIR:file'; any case; with executive and case control or bulk data alone;
// OptiStruct's lines before the case control. cards.cpp lists all cards that are read, passed over
// and refused.
//
// Cards and their result (names in the Deck):
//   GRID GRDSET SPOINT    nodes of cells in the order of the deck; a grid without cells that a
//                         coupling, a mass, a spring or an MPC names is a Point; others are left
//                         out, with their number in Deck::ignored. A scalar point moves along x
//                         alone
//   CORD1R/C/S CORD2R/C/S systems "cord_5", those that something in the Deck refers to
//   CTETRA CPYRAM CPENTA CHEXA  with any mid-side nodes or none; left-handed ones and those with
//                         repeated nodes are repaired (cell_repair.hpp); cells of fluids are
//                         refused, or left out with ignore "PFLUID"
//   CQUAD4 CTRIA3 ...     surface "pid_5" of those on faces of solids; others are shells
//   PSHELL                region "pid_5" of shells with its MAT1, Deck::shells
//   PSOLID                region "pid_5"; CORDM counts with MAT9; IN and ISOP: the nearest
//   integration
//                         (build_regions.cpp), said where it is another one. A deck without any
//                         PSOLID has regions without material
//   MAT1 MAT9             "mat_5". GE (damping) and stress limits are not read
//   RBE2 RBAR RBAR1 RJOINT RBE1 RBE3  "rbe2_5", "rbar_5", ...; in some directions of a CD system or
//                         with independent DoFs at several grids: equations. Rotations of nodes of
//                         solids turn freely; as members of RBE3 they are left out, and said
//   CONM1 CONM2 MPC MPCADD RROD  masses, mass matrices, equations. A CONM2 beside a node of solids,
//   or
//                         with inertia there, hangs on the nodes of the cells around it
//   CELAS1-4 PELAS CBUSH PBUSH CGAP PGAP  springs, of a gap those of the state in which it begins;
//                         CMASS1-4 PMASS mass matrices
//   DMIG                  matrices that K2GG, K2PP, M2GG and M2PP choose
//   SPC SPC1 SPCADD PS    supports "spc_5", "ps"; rotations of solids' nodes have no meaning and
//                         are passed over
//   ASET BSET CSET (1)    Deck::retained, points and directions of each grid's CD too
//   SET1                  node sets "set_5"
//   FORCE(1,2) MOMENT(1,2) GRAV ACCEL ACCEL1 RFORCE PLOAD PLOAD2 PLOAD4 SPCD LOAD TEMP TEMPD
//                         steps "subcase_1"; without case control one step "load_5" a load set.
//                         Pressures act on surfaces "pload4_5"; those that vary over a face or act
//                         along a vector are forces on its nodes
//   BGSET BSURFS          ties "bgset_5_1" of surfaces "bsurfs_5"
//   EIGRL EIGR            Step::modes
//   PARAM                 WTMASS scales densities and masses, COUPMASS chooses Deck::mass, CK2 and
//                         CM2 scale DMIG; G adds to all loss factors; ALPHA1 and ALPHA2 are
//                         offered as damping; other parameters are passed over
//
// Directions of supports, equations and couplings are those of each grid's CD. A case control alone
// chooses SPC and MPC sets; without one the deck must have at most one of each. Of a deck with
// BEGIN SUPER = n the section with solids is read. ignore takes cards, case control commands,
// "BEGIN BULK" and "BEGIN SUPER=n" (sections), and "LOOSE GRIDS": what hangs on grids of ignored
// cells alone.
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
