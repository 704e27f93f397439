// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced matrices in a file of Nastran's OUTPUT4 module, for INPUTT4 and programs that read OP4
// (MSC Nastran DMAP Programmer's Guide, OUTPUT4: non-sparse format).
#include <filesystem>

#include "condense/export/exported_part.hpp"

namespace clatter::condense {

/// For "part.op4": KAA, MAA, of a damped part BAA (form 6, symmetric, both triangles), and DOFS
/// (n x 2: number of the node, component) of their rows. Rows are in Nastran's internal sequence:
/// ascending numbers of nodes, then components. Double precision: as text, 1P,3E23.16, or as
/// Fortran records of this machine's byte order where options.binary. FileError when it cannot be
/// written.
void export_op4(const ExportedPart& part, const std::filesystem::path& path);

}  // namespace clatter::condense
