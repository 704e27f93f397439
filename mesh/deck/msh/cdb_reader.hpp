// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Archives of ANSYS (CDWRITE): blocked nodes and elements, components, materials.
//
//   NBLOCK             nodes
//   EBLOCK, SOLID      SOLID185, 186, 187 and their predecessors 45, 92, 95, with repeated nodes as
//                      wedges, pyramids and tetrahedra
//   ET, KEYOPT         the integration of SOLID185 and 186
//   MP, MPDATA         EX, EY, EZ, NUXY, PRXY, PRYZ, PRXZ, GXY, GYZ, GXZ, DENS, ALPX, ALPD, BETD
//   CMBLOCK            components of nodes are node sets; of elements, regions where they are
//   complete
//                      materials
//
// A material is a region. Supports, loads, contact and couplings are left out, with a note that
// counts them; other elements are refused. Sources: ANSYS Mechanical APDL Command Reference,
// Programmer's Reference ("Mechanical APDL Coded Database File Commands").
#include <filesystem>
#include <iosfwd>

#include "mesh/deck/msh/foreign_mesh.hpp"

namespace clatter::mesh {

/// InputError with file and line; `ignore` takes element types ("SURF154", "154").
ForeignMesh read_cdb(const std::filesystem::path& path, const std::vector<std::string>& ignore);
/// The same from an open file, called `name` in messages.
ForeignMesh read_cdb(std::istream& file, const std::string& name,
                     const std::vector<std::string>& ignore);

}  // namespace clatter::mesh
