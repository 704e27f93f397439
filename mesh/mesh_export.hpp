#pragma once
// The mesh for other programs. Each file is written beside its name and renamed when complete.
#include <filesystem>

#include "mesh/mesh.hpp"

namespace clatter::mesh {

/// Writes what the extension says; lengths in metres; InputError for another extension.
///  .vtu  ParaView: all cells with cell data `region`; node order of VTK
///  .inp  Abaqus and CalculiX: *NODE, *ELEMENT by region (ELSET), *NSET for each surface and node
///        set, one-based, node order of Abaqus
///  .msh  Gmsh MSH 2.2 text: regions and surfaces as physical groups, one-based
///  .bdf, .nas, .dat  Nastran bulk data without loss (deck/nastran_writer.hpp)
void export_mesh(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace clatter::mesh
