// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Writes a mesh as an input deck of Abaqus and CalculiX.
#include <filesystem>
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// Writes *NODE, *ELEMENT by region (ELSET), *NSET and *SURFACE (TYPE=ELEMENT), lengths in metres.
/// read_abaqus() reads the same mesh again: numbers, regions, sets and surfaces with their names
/// and order, and coordinates as abaqus_number() writes them. Fields are not written.
///
/// Numbers of nodes and cells are those of the imported file; if missing or not unique they count
/// from 1. The file is written under a temporary name and renamed when complete. InputError for a
/// pyramid13, which Abaqus does not have, for names that differ only in case or contain quotes, and
/// for a face that belongs to no cell; FileError when the file cannot be written.
void write_abaqus(const Mesh& mesh, const std::filesystem::path& path);

/// A number in at most 20 characters, the limit of CalculiX: the shortest text that reads back as
/// the same double, or, if that is longer, as many digits as fit. Numbers above 0.01 are exact;
/// smaller numbers of 17 digits lose up to 5e-15 of their value (5e-14 below 1e-80).
std::string abaqus_number(double value);

}  // namespace clatter::mesh::deck
