// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_mesh.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace clatter::assembly::testing {
namespace {

using Lattice = std::array<int, 3>;  // four times the brick indices: integers for mid-side nodes

class Numbering {
 public:
  Numbering(const std::array<int, 3>& n, bool wrap) : n_(n), wrap_(wrap) {}
  int32_t of(Lattice at) {
    if (wrap_) at[0] %= 4 * n_[0];
    return ids_.emplace(at, static_cast<int32_t>(ids_.size())).first->second;
  }
  const std::map<Lattice, int32_t>& all() const { return ids_; }

 private:
  std::array<int, 3> n_;
  bool wrap_;
  std::map<Lattice, int32_t> ids_;
};

Lattice middle(const Lattice& a, const Lattice& b) {
  return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
}

/// Corners of the six tetrahedra of a brick: walks along the axes in each order (Kuhn).
constexpr int kWalks[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

std::vector<std::vector<Lattice>> tetrahedra(const Lattice& low) {
  std::vector<std::vector<Lattice>> cells;
  for (int w = 0; w < 6; ++w) {
    std::vector<Lattice> cell = {low};
    for (size_t s = 0; s < 3; ++s) {
      cell.push_back(cell.back());
      cell.back()[kWalks[w][s]] += 4;
    }
    if (w >= 3) std::swap(cell[2], cell[3]);  // odd permutations reverse the orientation
    cells.push_back(cell);
  }
  return cells;
}

/// Corners of the cells that fill one brick.
std::vector<std::vector<Lattice>> cells_of_brick(int corners, const Lattice& low) {
  if (corners == 4) return tetrahedra(low);
  constexpr int kUnit[8][3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                               {0, 0, 4}, {4, 0, 4}, {4, 4, 4}, {0, 4, 4}};
  std::vector<Lattice> brick;
  for (const auto& at : kUnit) brick.push_back({low[0] + at[0], low[1] + at[1], low[2] + at[2]});
  const auto pick = [&](std::initializer_list<size_t> ids) {
    std::vector<Lattice> cell;
    for (const size_t i : ids) cell.push_back(brick[i]);
    return cell;
  };
  if (corners == 8) return {brick};
  if (corners == 6) return {pick({0, 1, 2, 4, 5, 6}), pick({0, 2, 3, 4, 6, 7})};
  std::vector<std::vector<Lattice>> cells;  // six pyramids around the centre
  for (const auto& base : {pick({0, 1, 2, 3}), pick({4, 7, 6, 5}), pick({0, 4, 5, 1}),
                           pick({0, 3, 7, 4}), pick({1, 5, 6, 2}), pick({2, 6, 7, 3})}) {
    cells.push_back(base);
    cells.back().push_back(middle(brick[0], brick[6]));
  }
  return cells;
}

IndexMatrix to_matrix(const std::vector<std::vector<int32_t>>& rows) {
  IndexMatrix out(static_cast<Eigen::Index>(rows.size()),
                  static_cast<Eigen::Index>(rows.at(0).size()));
  for (size_t r = 0; r < rows.size(); ++r)
    for (size_t c = 0; c < rows[r].size(); ++c)
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r][c];
  return out;
}

/// Names of the cube's sides that the face lies on.
std::vector<std::string> sides_of(const mesh::CellFace& face, const std::vector<Lattice>& corners,
                                  const std::array<int, 3>& n, bool wrap_x) {
  const char* names[3][2] = {{"x0", "x1"}, {"y0", "y1"}, {"z0", "z1"}};
  std::vector<std::string> sides;
  for (size_t axis = wrap_x ? 1 : 0; axis < 3; ++axis)
    for (int end = 0; end < 2; ++end) {
      bool on = true;
      for (int v = 0; v < mesh::traits(face.type).corners; ++v)
        on = on && corners[face.nodes[v]][axis] == end * 4 * n[axis];
      if (on) sides.emplace_back(names[axis][end]);
    }
  return sides;
}

}  // namespace

mesh::Mesh block_mesh(const std::array<int, 3>& n, const Map& map, const BlockOptions& options) {
  const mesh::CellTraits& traits = mesh::traits(options.type);
  Numbering number(n, options.wrap_x);
  std::vector<std::vector<int32_t>> cells;
  std::map<std::string, mesh::SurfaceBuilder> sides;
  std::vector<std::vector<Lattice>> all_corners;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        for (auto& cell : cells_of_brick(traits.corners, {4 * i, 4 * j, 4 * k}))
          all_corners.push_back(std::move(cell));
  for (const auto& corners : all_corners) {
    std::vector<int32_t> cell;
    for (const Lattice& corner : corners) cell.push_back(number.of(corner));
    if (traits.order == 2)
      for (const auto& [a, b] : traits.edges)
        cell.push_back(number.of(middle(corners[a], corners[b])));
    for (const mesh::CellFace& face : traits.faces) {
      std::array<int32_t, mesh::kMaxFaceNodes> ids{};
      for (size_t v = 0; v < static_cast<size_t>(mesh::traits(face.type).nodes); ++v)
        ids[v] = cell[face.nodes[v]];
      for (const std::string& side : sides_of(face, corners, n, options.wrap_x)) {
        sides[side].add(face.type, ids);
        sides["skin"].add(face.type, ids);
      }
    }
    cells.push_back(cell);
  }
  mesh::Mesh mesh;
  mesh.name = "block";
  mesh.regions = {"body"};
  mesh.cells.push_back({options.type, 0, to_matrix(cells), {}});
  for (const auto& [name, builder] : sides) mesh.surfaces[name] = builder.finish();
  mesh.nodes.resize(static_cast<Eigen::Index>(number.all().size()), 3);
  for (const auto& [at, id] : number.all()) {
    mesh.nodes.row(id) = map({0.25 * at[0] / n[0], 0.25 * at[1] / n[1], 0.25 * at[2] / n[2]});
    mesh.node_sets["all"].push_back(static_cast<int32_t>(mesh.node_sets["all"].size()));
  }
  if (!options.curved && traits.order == 2)
    for (const auto& cell : cells)
      for (size_t e = 0; e < traits.edges.size(); ++e)
        mesh.nodes.row(cell[static_cast<size_t>(traits.corners) + e]) =
            0.5 *
            (mesh.nodes.row(cell[traits.edges[e][0]]) + mesh.nodes.row(cell[traits.edges[e][1]]));
  return mesh;
}

Map brick(const Eigen::Vector3d& size) {
  return [size](const Eigen::Vector3d& x) -> Eigen::Vector3d { return x.cwiseProduct(size); };
}

Map ring(double inner, double outer, double height) {
  return [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    // The angle runs backwards so that (angle, radius, z) stays right-handed.
    const double angle = -2.0 * std::numbers::pi * x(0), radius = inner + (outer - inner) * x(1);
    return {radius * std::cos(angle), radius * std::sin(angle), height * x(2)};
  };
}

Map shaken_brick(const Eigen::Vector3d& size, const std::array<int, 3>& n, double share) {
  return [=](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    // The generator is seeded by the position, so that a corner moves alike in every cell.
    std::seed_seq seed{static_cast<int>(std::lround(1e6 * x(0))),
                       static_cast<int>(std::lround(1e6 * x(1))),
                       static_cast<int>(std::lround(1e6 * x(2)))};
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-share, share);
    Eigen::Vector3d moved = x;
    for (int d = 0; d < 3; ++d) {
      const double step = uniform(generator) / n[d];
      if (x(d) > 1e-9 && x(d) < 1.0 - 1e-9) moved(d) += step;
    }
    return moved.cwiseProduct(size);
  };
}

}  // namespace clatter::assembly::testing
