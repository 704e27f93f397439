// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes with groups: Gmsh's MSH 2 and 4, text and binary, through the Gmsh library; MED
// (med_reader.hpp), universal files (unv_reader.hpp) and ANSYS archives (cdb_reader.hpp) through
// readers of our own, because Debian's Gmsh reads no MED and no groups of dataset 2467.
//
//   physical group of   becomes
//   solids              a region; a cell belongs to exactly one
//   faces               a surface: faces of cells, outward; between two regions as written
//   curves and points   a node set, of both where they share a name
//
// Groups without a name are called "volume_7", "surface_7", "curve_7", "point_7". A file without
// groups of solids has the one region "solid". Numbers of nodes and cells are kept. The group
// "skin" of our own export must be the entire boundary.
#include <filesystem>

#include "core/base/child_process.hpp"
#include "mesh/deck/deck.hpp"
#include "mesh/deck/units.hpp"

namespace clatter::mesh {

/// True for the extensions .msh, .med, .unv and .cdb, any case.
bool is_mesh_file(const std::filesystem::path& path);

/// Reads the mesh as decks are read (deck/import.hpp): SI, surface "skin", every cell proved valid.
/// `options.ignore` skips, any case:
///   an element kind by Gmsh's name     "Hexahedron 27", "Triangle 3"; in other formats their own
///   a physical group by its name       its elements count as in no group
///   "NO GROUP"                         cells in no group, where there are groups of solids
/// Otherwise InputError for the first of: another element kind; a cell in no group or in two;
/// a face of a group that is not a face of a cell or lies within a region; a group without
/// elements; two groups of a dimension with one name. Faces, lines and points in no group and
/// unused nodes are only counted, in Deck::ignored. Gmsh reads the file in a child process within
/// `limits`: a crash on a corrupt file is an InputError.
deck::Deck read_mesh_file(const std::filesystem::path& path, const UnitSystem& units,
                          const deck::ReadOptions& options, const ChildLimits& limits = {});

}  // namespace clatter::mesh
