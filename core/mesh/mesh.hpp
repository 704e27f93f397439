// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A finite element mesh of one part: nodes, cells by region, named surfaces and node sets.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/base/deck_origin.hpp"
#include "core/base/matrix.hpp"
#include "core/mesh/cell.hpp"

namespace clatter::mesh {

/// Cells of one type and one region.
struct CellBlock {
  CellType type = CellType::kTet10;
  int32_t region = 0;        // index into Mesh::regions
  IndexMatrix nodes;         // cells x nodes per cell, Gmsh order (cell.hpp), zero-based
  std::vector<int32_t> ids;  // cell numbers of the imported file; empty: none
};

/// Cells of a shell: mid-surfaces of sheet, of one type and one region. Their nodes have rotations
/// too.
struct ShellBlock {
  FaceType type = FaceType::kQuad4;
  int32_t region = 0;        // index into Mesh::regions; no region has both solids and shells
  IndexMatrix nodes;         // cells x nodes per cell, order of cell.hpp; their side is outward
  std::vector<int32_t> ids;  // cell numbers of the imported file; empty: none
  RowMatrix thickness;       // of each cell at its nodes [m]; empty: that of the region
  Eigen::VectorXd offset;    // of each cell: from its nodes to its mid-surface, outward [m]; or
                             // empty: that of the region
  RowMatrix axis;            // of each cell (cells x 3): direction 1 of its material, once it is
                             // projected; or empty: that of the region
};

/// Faces of one type.
struct FaceBlock {
  FaceType type = FaceType::kTri6;
  IndexMatrix nodes;  // faces x nodes per face, order of cell.hpp, outward
};

/// Boundary faces of the solid, each belonging to one cell, or to two in different regions; or
/// faces that are shells.
struct Surface {
  std::vector<FaceBlock> faces;  // each type at most once

  int64_t face_count() const;
};

/// Collects faces one by one.
class SurfaceBuilder {
 public:
  /// `face` has at least as many entries as the type has nodes.
  void add(FaceType type, std::span<const int32_t> face);
  Surface finish() const;

 private:
  std::array<std::vector<int32_t>, kFaceTypes> nodes_;
};

/// Node set of the mid-side nodes that were added to complete cells: the deck's cell was linear
/// along that edge. Their displacement is the mean of the edge's ends ([[straight_edges]] of an
/// fe.toml), so that such a cell matches adjacent linear cells.
inline constexpr const char* kHangingMidSideNodes = "hanging_mid_side_nodes";

/// One part. Every mesh has the surface "skin": all boundary faces of the solids, and all shells.
struct Mesh {
  std::string name;
  RowMatrix nodes;                   // n x 3 [m]
  std::vector<int32_t> node_ids;     // node numbers of the imported file; empty: index + 1
  std::vector<std::string> regions;  // names; each region has one material
  std::vector<CellBlock> cells;
  std::vector<ShellBlock> shells;
  std::map<std::string, Surface> surfaces;
  std::map<std::string, std::vector<int32_t>> node_sets;  // ascending
  std::map<std::string, RowMatrix> fields;  // n x k values at the nodes, k = 1 or 3 (SI)
  DeckOrigin deck;                          // the deck that it was read from
  std::vector<int32_t> turning{};           // nodes with rotations that no shell has, ascending

  int64_t cell_count() const;  // of solids and shells
  /// InputError listing the existing names when there is none of that name.
  const Surface& surface(const std::string& surface_name) const;
  const std::vector<int32_t>& node_set(const std::string& set_name) const;
};

/// Nodes that the faces use, ascending.
std::vector<int32_t> nodes_of(const Surface& surface);

/// Nodes with rotations, ascending: of shells, and Mesh::turning.
std::vector<int32_t> turning_nodes(const Mesh& mesh);

/// Checks columns and node numbers (0 ... n_nodes - 1); InputError, prefixed with `where`.
void check_surface(const Surface& surface, int64_t n_nodes, const std::string& where);

/// Checks sizes, index ranges, finite coordinates and that every node belongs to a cell.
/// InputError, prefixed with `where`, for the first defect.
void check_structure(const Mesh& mesh, const std::string& where);

}  // namespace clatter::mesh
