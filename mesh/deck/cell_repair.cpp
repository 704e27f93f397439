// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/cell_repair.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh::deck {
namespace {

using Nodes = std::vector<int32_t>;

struct Cell {
  CellType type;
  Nodes nodes;
};

/// A reflection of the reference cell: corners, then the mid-side nodes that follow.
std::vector<int> mirror_of(CellType type) {
  const CellTraits& cell = traits(type);
  std::vector<int> p(static_cast<size_t>(cell.nodes));
  for (int i = 0; i < cell.corners; ++i) p[i] = i;
  if (cell.corners == 4 || cell.corners == 6) std::swap(p[1], p[2]);
  if (cell.corners == 6) std::swap(p[4], p[5]);
  if (cell.corners == 5 || cell.corners == 8) std::swap(p[1], p[3]);
  if (cell.corners == 8) std::swap(p[5], p[7]);
  for (int e = 0; e < cell.nodes - cell.corners; ++e) {
    const auto [a, b] = cell.edges[e];
    const auto image = std::minmax(p[a], p[b]);
    const auto at = std::find_if(cell.edges.begin(), cell.edges.end(), [&](const Edge& edge) {
      return std::minmax(edge[0], edge[1]) == image;
    });
    p[cell.corners + e] = cell.corners + static_cast<int>(at - cell.edges.begin());
  }
  return p;
}

Nodes mirrored(CellType type, const Nodes& nodes) {
  Nodes out;
  for (const int i : mirror_of(type)) out.push_back(nodes[i]);
  return out;
}

/// The corners of a face without those that follow themselves.
Nodes distinct_cycle(Nodes corners) {
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

/// Faces of three corners or more of a cell with repeated nodes, outward if it is positive.
std::vector<Nodes> faces_of(CellType type, const Nodes& nodes) {
  std::vector<Nodes> faces;
  for (const CellFace& face : traits(type).faces) {
    Nodes corners;
    for (int i = 0; i < traits(face.type).corners; ++i) corners.push_back(nodes[face.nodes[i]]);
    corners = distinct_cycle(corners);
    if (corners.size() >= 3) faces.push_back(std::move(corners));
  }
  return faces;
}

/// The corner that an edge joins to `corner` and that is not in `face`; -1 if there is none.
int32_t opposite(const std::vector<Nodes>& faces, const Nodes& face, int32_t corner) {
  for (const Nodes& other : faces)
    for (size_t i = 0; i < other.size(); ++i) {
      if (other[i] != corner) continue;
      for (const size_t j : {(i + 1) % other.size(), (i + other.size() - 1) % other.size()})
        if (std::find(face.begin(), face.end(), other[j]) == face.end()) return other[j];
    }
  return -1;
}

/// The cell whose faces are the given ones.
std::optional<Cell> cell_with(const std::vector<Nodes>& faces) {
  const auto count = [&](size_t corners) {
    return std::count_if(faces.begin(), faces.end(),
                         [&](const Nodes& face) { return face.size() == corners; });
  };
  const auto triangles = count(3), quads = count(4);
  std::set<int32_t> corners;
  for (const Nodes& face : faces) corners.insert(face.begin(), face.end());
  const bool tet = triangles == 4 && quads == 0 && corners.size() == 4;
  const bool pyramid = triangles == 4 && quads == 1 && corners.size() == 5;
  const bool wedge = triangles == 2 && quads == 3 && corners.size() == 6;
  if (!tet && !pyramid && !wedge) return std::nullopt;
  Nodes base = *std::find_if(faces.begin(), faces.end(),
                             [&](const Nodes& face) { return face.size() == (pyramid ? 4U : 3U); });
  std::reverse(base.begin(), base.end());  // the base of a positive cell is seen from inside
  Cell cell{tet ? CellType::kTet4 : pyramid ? CellType::kPyramid5 : CellType::kWedge6, base};
  for (size_t k = 0; k < (wedge ? 3U : 1U); ++k) {
    const int32_t top = opposite(faces, base, base[k]);
    if (top < 0) return std::nullopt;
    cell.nodes.push_back(top);
  }
  return cell;
}

/// Adds the mid-side nodes of `old` to the corners of `made`; false when a collapsed edge had
/// another node or two nodes lie between the same corners.
bool add_mid_side_nodes(CellType type, const Nodes& old, Cell& made) {
  const CellTraits& from = traits(type);
  std::map<std::pair<int32_t, int32_t>, int32_t> middle;
  for (int e = 0; e < from.nodes - from.corners; ++e) {
    const auto [a, b] = from.edges[e];
    const int32_t i = old[a], j = old[b];
    const int32_t node = old[from.corners + e];
    if (i == j && node != i) return false;
    if (i != j && middle.emplace(std::minmax(i, j), node).first->second != node) return false;
  }
  for (const CellType quadratic : {CellType::kTet10, CellType::kPyramid13, CellType::kWedge15})
    if (traits(quadratic).corners == traits(made.type).corners) made.type = quadratic;
  for (const auto& [a, b] : traits(made.type).edges) {
    const auto at = middle.find(std::minmax(made.nodes[a], made.nodes[b]));
    if (at == middle.end()) return false;
    made.nodes.push_back(at->second);
  }
  return true;
}

bool has_repeats(std::span<const int32_t> corners) {
  for (size_t i = 1; i < corners.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      if (corners[i] == corners[j]) return true;
  return false;
}

std::span<const int32_t> corners_of(const CellBlock& block, Eigen::Index cell) {
  return {block.nodes.row(cell).data(), static_cast<size_t>(traits(block.type).corners)};
}

/// The edge in whose middle each mid-side node lies, its distance at most a quarter of the edge;
/// empty when some have none or share one.
std::vector<int> edges_by_position(CellType type, const CellNodes& x) {
  constexpr double kNear = 0.25;
  const CellTraits& cell = traits(type);
  std::vector<int> edge_of;
  for (int m = cell.corners; m < cell.nodes; ++m) {
    for (int e = 0; e < cell.nodes - cell.corners; ++e) {
      const auto [a, b] = cell.edges[e];
      const double away = (x.row(m) - 0.5 * (x.row(a) + x.row(b))).norm();
      if (away > kNear * (x.row(a) - x.row(b)).norm()) continue;
      if (std::ranges::count(edge_of, e) > 0) return {};
      edge_of.push_back(e);
      break;
    }
    if (static_cast<int>(edge_of.size()) != m - cell.corners + 1) return {};
  }
  return edge_of;
}

class CellRepair {
 public:
  CellRepair(Mesh& mesh, const std::string& where) : mesh_(mesh), where_(where) {}

  std::vector<Repair> run() {
    simplify_cells();
    mirror_cells();
    sort_mid_side_nodes();
    std::vector<Repair> done;
    for (const auto& [types, count] : simplified_)
      done.push_back(
          {count, fmt::format("{}: {} cells {} with repeated nodes are read as {}", where_, count,
                              traits(types.first).name, traits(types.second).name)});
    if (mirrored_ > 0)
      done.push_back({mirrored_, fmt::format("{}: {} of {} cells are left-handed: their nodes are "
                                             "renumbered",
                                             where_, mirrored_, mesh_.cell_count())});
    if (sorted_ > 0)
      done.push_back(
          {sorted_, fmt::format("{}: {} of {} cells have mid-side nodes that lie on other edges "
                                "than their order says: they are sorted by their positions",
                                where_, sorted_, mesh_.cell_count())});
    if (!done.empty()) repair_surfaces();
    return done;
  }

 private:
  /// Cells of one new type.
  struct Made {
    Nodes nodes;
    std::vector<int32_t> ids;
  };

  void simplify_cells() {
    std::vector<CellBlock> all;
    for (CellBlock& block : mesh_.cells) {
      std::map<CellType, Made> made;
      std::vector<Eigen::Index> kept;
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        if (!has_repeats(corners_of(block, c))) {
          kept.push_back(c);
          continue;
        }
        const Cell cell = simple_cell(block, c);
        Made& of_type = made[cell.type];
        of_type.nodes.insert(of_type.nodes.end(), cell.nodes.begin(), cell.nodes.end());
        if (!block.ids.empty()) of_type.ids.push_back(block.ids[c]);
        ++simplified_[{block.type, cell.type}];
      }
      if (!made.empty()) keep(block, kept);
      const int32_t region = block.region;
      if (block.nodes.rows() > 0) all.push_back(std::move(block));
      for (auto& [type, cells] : made) all.push_back(block_of(type, region, std::move(cells)));
    }
    mesh_.cells = std::move(all);
  }

  static void keep(CellBlock& block, const std::vector<Eigen::Index>& rows) {
    block.nodes = block.nodes(rows, Eigen::all).eval();
    std::vector<int32_t> ids;
    for (const Eigen::Index c : rows)
      if (!block.ids.empty()) ids.push_back(block.ids[c]);
    block.ids = std::move(ids);
  }

  static CellBlock block_of(CellType type, int32_t region, Made cells) {
    const Eigen::Index columns = traits(type).nodes;
    CellBlock block;
    block.type = type;
    block.region = region;
    block.nodes = Eigen::Map<const IndexMatrix>(
        cells.nodes.data(), static_cast<Eigen::Index>(cells.nodes.size()) / columns, columns);
    block.ids = std::move(cells.ids);
    return block;
  }

  Cell simple_cell(const CellBlock& block, Eigen::Index c) const {
    const auto row = block.nodes.row(c);
    const Nodes old(row.begin(), row.end());
    std::optional<Cell> made = cell_with(faces_of(block.type, old));
    if (made && (traits(block.type).order == 1 || add_mid_side_nodes(block.type, old, *made)))
      return *made;
    throw InputError(fmt::format(
        "{}: cell {}: found a {} with repeated nodes that is no wedge, pyramid or tetrahedron",
        where_, cell_label(block, c), traits(block.type).name));
  }

  void mirror_cells() {
    for (CellBlock& block : mesh_.cells) {
      const CellType linear = linear_cell(block.type);
      const auto gradient = cell_shape(linear, centre_of(linear)).gradient;
      const auto corners = gradient.rows();
      Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 8, 3> x(corners, 3);
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        for (Eigen::Index i = 0; i < corners; ++i) x.row(i) = mesh_.nodes.row(block.nodes(c, i));
        if (!((x.transpose() * gradient).determinant() < 0.0)) continue;
        const auto row = block.nodes.row(c);
        const Nodes turned = mirrored(block.type, Nodes(row.begin(), row.end()));
        std::copy(turned.begin(), turned.end(), block.nodes.row(c).data());
        ++mirrored_;
      }
    }
  }

  void sort_mid_side_nodes() {
    for (CellBlock& block : mesh_.cells) {
      const CellTraits& cell = traits(block.type);
      for (Eigen::Index c = 0; cell.order == 2 && c < block.nodes.rows(); ++c) {
        if (!is_displaced(block, c)) continue;
        const CellNodes x = cell_nodes(mesh_, block, c);
        const std::vector<int> edge_of = edges_by_position(block.type, x);
        if (edge_of.empty() || jacobian_bounds(block.type, x).min > 0.0) continue;
        const auto row = block.nodes.row(c);
        const Nodes old(row.begin(), row.end());
        for (size_t m = 0; m < edge_of.size(); ++m)
          block.nodes(c, cell.corners + edge_of[m]) = old[static_cast<size_t>(cell.corners) + m];
        ++sorted_;
      }
    }
  }

  /// A mid-side node lies farther from the middle of its edge than the edge's ends: det J changes
  /// its sign there.
  bool is_displaced(const CellBlock& block, Eigen::Index c) const {
    const CellTraits& cell = traits(block.type);
    const auto at = [&](int i) { return mesh_.nodes.row(block.nodes(c, i)); };
    for (int e = 0; e < cell.nodes - cell.corners; ++e) {
      const auto [a, b] = cell.edges[e];
      if ((2.0 * at(cell.corners + e) - at(a) - at(b)).squaredNorm() >
          (at(a) - at(b)).squaredNorm())
        return true;
    }
    return false;
  }

  static CellType linear_cell(CellType type) {
    for (const CellType linear :
         {CellType::kTet4, CellType::kPyramid5, CellType::kWedge6, CellType::kHex8})
      if (traits(linear).corners == traits(type).corners) return linear;
    return type;
  }

  /// Mean of the corners of the reference cell.
  static Eigen::Vector3d centre_of(CellType linear) {
    return reference_nodes(linear).colwise().mean().transpose();
  }

  /// Faces as the cells have them now, by their distinct corners.
  void repair_surfaces() {
    if (mesh_.surfaces.empty()) return;
    std::map<FaceKey, std::pair<FaceType, Nodes>> by_corners;
    for (const CellBlock& block : mesh_.cells)
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
        for (const CellFace& face : traits(block.type).faces) {
          Nodes nodes;
          for (int i = 0; i < traits(face.type).nodes; ++i)
            nodes.push_back(block.nodes(c, face.nodes[i]));
          by_corners.emplace(face_key(face.type, nodes), std::pair(face.type, nodes));
        }
    for (auto& [name, surface] : mesh_.surfaces) surface = repaired(surface, by_corners);
  }

  static Surface repaired(const Surface& surface,
                          const std::map<FaceKey, std::pair<FaceType, Nodes>>& by_corners) {
    SurfaceBuilder out;
    for (const FaceBlock& block : surface.faces)
      for (Eigen::Index f = 0; f < block.nodes.rows(); ++f) {
        const auto row = block.nodes.row(f);
        const Nodes corners =
            distinct_cycle(Nodes(row.begin(), row.begin() + traits(block.type).corners));
        if (corners.size() < 3) continue;
        const FaceType type = corners.size() == 3 ? FaceType::kTri3 : FaceType::kQuad4;
        const auto found = by_corners.find(face_key(type, corners));
        if (found == by_corners.end()) {
          out.add(block.type, Nodes(row.begin(), row.end()));
        } else {
          Nodes nodes = found->second.second;
          nodes.resize(kMaxFaceNodes);
          out.add(found->second.first, nodes);
        }
      }
    return out.finish();
  }

  Mesh& mesh_;
  const std::string& where_;
  std::map<std::pair<CellType, CellType>, int64_t> simplified_;
  int64_t mirrored_ = 0, sorted_ = 0;
};

}  // namespace

std::vector<Repair> repair_cells(Mesh& mesh, const std::string& where) {
  return CellRepair(mesh, where).run();
}

bool has_repeated_corners(const Mesh& mesh) {
  for (const CellBlock& block : mesh.cells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
      if (has_repeats(corners_of(block, c))) return true;
  return false;
}

}  // namespace clatter::mesh::deck
