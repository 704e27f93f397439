// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mesh export to other programs. Each file is written under a temporary name and renamed when
// complete.
#include <filesystem>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Writes the format of the extension; lengths in metres; InputError for another extension.
///  .vtu  ParaView: cells, numbers, regions, sets, surfaces, fields (vtu_writer.hpp)
///  .msh  Gmsh MSH 2.2 text (msh_writer.hpp)
///  .med  Salome, Code_Aster (med_writer.hpp)
///  .unv  I-DEAS universal file (unv_writer.hpp)
///  .inp  Abaqus and CalculiX (deck/abaqus/writer.hpp)
///  .bdf, .nas, .dat  Nastran (deck/nastran/writer.hpp)
/// All keep the numbers of an imported mesh, its sets and surfaces; decks and .msh of solids read
/// back as the same mesh. Warns of shells whose own thickness or offset the format does not have.
void export_mesh(const Mesh& mesh, const std::filesystem::path& path);

/// InputError where export_mesh knows no format for the extension: asked before long work.
void check_export(const std::filesystem::path& path);

}  // namespace clatter::mesh
