#pragma once
// The mesh for other programs. Each file is written beside its name and renamed when complete.
#include <filesystem>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Writes what the extension says; lengths in metres; InputError for another extension.
///  .vtu  ParaView: cells, numbers, regions, sets, surfaces, fields (vtu_writer.hpp)
///  .msh  Gmsh MSH 2.2 text (msh_writer.hpp)
///  .med  Salome, Code_Aster (med_writer.hpp)
///  .unv  I-DEAS universal file (unv_writer.hpp)
///  .inp  Abaqus and CalculiX (deck/abaqus_writer.hpp)
///  .bdf, .nas, .dat  Nastran (deck/nastran_writer.hpp)
/// All carry the numbers of an imported mesh, its sets and surfaces; decks and .msh read back the
/// same.
void export_mesh(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace clatter::mesh
