#pragma once
// Writes a mesh as an input deck of Abaqus and CalculiX.
#include <filesystem>
#include <string>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// Writes *NODE, *ELEMENT by region (ELSET), *NSET and *SURFACE (TYPE=ELEMENT), lengths in metres.
/// read_abaqus() gives the same mesh again: numbers, regions, sets and surfaces with their names
/// and order, and coordinates as abaqus_number() has them. Fields have no place in a deck.
///
/// Numbers of nodes and cells are those of the imported file; without them, or where they are not
/// different from each other, they go from 1. The file is written beside its name and renamed when
/// complete. InputError for a pyramid13, which Abaqus does not have, for names that differ in case
/// only or hold quotes, and for a face that belongs to no cell; FileError when the file cannot be
/// written.
void write_abaqus(const Mesh& mesh, const std::filesystem::path& path);

/// A number in at most 20 characters, all that CalculiX reads: the shortest text that gives the
/// same double again, or, where that is longer, as many digits as fit. Above 0.01 nothing is lost;
/// smaller numbers of 17 digits lose up to 5e-15 of their value (5e-14 below 1e-80).
std::string abaqus_number(double value);

}  // namespace clatter::mesh::deck
