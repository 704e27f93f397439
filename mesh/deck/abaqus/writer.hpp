// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Writes a mesh as an input deck of Abaqus and CalculiX.
#include <filesystem>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// Writes *NODE, *ELEMENT by region (ELSET), *NSET and *SURFACE (TYPE=ELEMENT), lengths in metres.
/// read_abaqus() reads the same mesh again: numbers, regions, sets and surfaces with their names
/// and order, and coordinates as abaqus_number() (number.hpp) writes them. Fields are not written.
/// Shells are S3 and S4, their faces SPOS or SNEG; a comment (kShellMark) lets the reader take them
/// without a *SHELL SECTION. Their thickness and offset are not written.
///
/// Numbers of nodes and cells are those of the imported file; if missing or not unique they count
/// from 1. The file is written under a temporary name and renamed when complete. InputError for a
/// pyramid13, which Abaqus does not have, for names that differ only in case or contain quotes, and
/// for a face that belongs to no cell; FileError when the file cannot be written.
void write_abaqus(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace clatter::mesh::deck
