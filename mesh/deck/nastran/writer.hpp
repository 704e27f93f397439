// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mesh as a Nastran bulk data deck that our reader reads back without loss.
//
//   GRID* numbers of node_ids (else index + 1), coordinates in 16 columns. Longer ones (12 to 15
//   digits fit) are also in full in a comment before the card
//   CTETRA CPYRAM CPENTA CHEXA  numbers of CellBlock::ids (else counted on), PID = region + 1
//   CTRIA3 CQUAD4  shells, the same; T1 to T4 and ZOFFS in large fields, of 11 digits or more,
//            where the mesh has them
//   PSOLID PSHELL  one a region, material 1; no MAT cards: a mesh has no materials. T of PSHELL is
//            blank: a mesh has no sections
//   SET1     one a node set
//
// Comments hold what Nastran has no card for:
//   $ clatter region 1 block            name of PID 1
//   $ clatter set 3 mounts              name of SET1 3
//   $ clatter surface skin              begins a surface, whose faces follow
//   $ clatter tri6 1 2 3 4 5 6          nodes of one face in the order of cell.hpp
//   $ clatter at 17 0.1 0.2 0.30000000000000004   coordinates of GRID 17; they count as long as the
//                                       card says the same in fewer digits
//   $ clatter hanging 40                number of the first hanging mid-side node: cells omit them
// Fields and empty sets are not written. Regions without cells are lost when the deck is read
// again.
#include <filesystem>
#include <iosfwd>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// Lengths in metres. InputError for a mesh whose numbers are not positive.
void write_nastran(const Mesh& mesh, std::ostream& out);

/// Written under a temporary name and renamed when complete; FileError when that fails.
void write_nastran(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace clatter::mesh::deck
