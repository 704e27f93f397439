// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The content of a Gmsh file that Gmsh's own reader drops.
//
// Gmsh reads anything that does not begin with $MeshFormat as a script, so that line is checked
// first. In MSH 2 every element names its physical group, but Gmsh gives all elements of an
// elementary entity the groups of all others there; here each element keeps its own. Names of
// groups without elements are lost in Gmsh too. Source: Gmsh reference manual 4.8, section 9.
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <unordered_map>
#include <vector>

namespace clatter::mesh {

/// A line of $PhysicalNames.
struct MshGroupName {
  int dim, number;
  std::string name;
};

struct MshScan {
  int version = 2;  // 2 or 4
  bool binary = false;
  int64_t nodes = 0;  // Gmsh forgets those of no element
  std::vector<MshGroupName> names;
  std::unordered_map<uint64_t, int> group_of;  // MSH 2: element -> physical group, 0: none
};

/// InputError for another format, another version, a truncated or contradictory file.
MshScan scan_msh(const std::filesystem::path& path);
/// The same from an open file, called `name` in messages.
MshScan scan_msh(std::istream& file, const std::string& name);

}  // namespace clatter::mesh
