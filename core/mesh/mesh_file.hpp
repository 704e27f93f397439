// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The mesh in a file, schema "clatter/mesh/2":
//   nodes (n x 3) [m], regions, cells/<i>/nodes with attributes type and region, shells/<i>
//   likewise, also with thickness (cells x nodes) [m] and offset (cells) [m],
//   surfaces/<name>/<face type> (f x nodes), node_sets/<name>, fields/<name> (n x k);
//   partition/part (cells) on request; node_ids and cells/<i>/ids where an imported mesh has its
//   own numbers; attribute name.
// Node numbers are zero-based, node orders are those of cell.hpp.
#include <filesystem>

#include "core/base/h5_file.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

inline constexpr const char* kMeshSchema = "clatter/mesh/2";

/// Writes `mesh` into an open file; provenance, timing and certificate are the caller's.
void write_mesh(H5File& file, const Mesh& mesh);

/// Group `cells` of meshes and FE models.
void write_cells(H5File& file, const std::vector<CellBlock>& cells);
/// InputError for unknown cell types; node numbers and regions are not checked.
std::vector<CellBlock> read_cells(const H5File& file);

/// Group `shells` of meshes and FE models.
void write_shells(H5File& file, const std::vector<ShellBlock>& shells);
std::vector<ShellBlock> read_shells(const H5File& file);

/// Group `surfaces` of meshes and FE models: one dataset per face type.
void write_surfaces(H5File& file, const std::map<std::string, Surface>& surfaces);
/// InputError, prefixed with `where`, for unknown face types and node numbers out of range.
std::map<std::string, Surface> read_surfaces(const H5File& file, int64_t n_nodes,
                                             const std::string& where);

/// Reads a mesh and checks schema, shapes, index ranges, finite values, and that every cell is
/// valid (validity.hpp); InputError names the file and the first defect.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace clatter::mesh
