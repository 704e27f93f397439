#pragma once
// The mesh in a file, schema "clatter/mesh/1":
//   nodes (n x 3) [m], regions, cells/<i>/nodes with attributes type and region,
//   surfaces/<name> (f x 6 or f x 3), node_sets/<name>; root attribute name.
// Node numbers are zero-based, node orders are those of cell.hpp.
#include <filesystem>

#include "core/h5_file.hpp"
#include "mesh/mesh.hpp"

namespace clatter::mesh {

inline constexpr const char* kMeshSchema = "clatter/mesh/1";

/// Writes `mesh` into an open file; provenance, timing and certificate are the caller's.
void write_mesh(H5File& file, const Mesh& mesh);

/// Reads a mesh and checks schema, shapes, index ranges, finite values, and that every cell is
/// valid (validity.hpp); InputError names the file and the first thing that is wrong.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace clatter::mesh
