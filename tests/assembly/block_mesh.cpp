#include "block_mesh.hpp"

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace clatter::assembly::testing {
namespace {

using Lattice = std::array<int, 3>;  // twice the cell numbers, so that middles are integers

/// Corners of the six tetrahedra of a brick: walks along the axes in each order (Kuhn).
constexpr int kWalks[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};

class Numbering {
 public:
  Numbering(const std::array<int, 3>& n, bool wrap) : n_(n), wrap_(wrap) {}
  int32_t of(Lattice at) {
    if (wrap_) at[0] %= 2 * n_[0];
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

std::vector<std::array<Lattice, 4>> tetrahedra(const std::array<int, 3>& n) {
  std::vector<std::array<Lattice, 4>> cells;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < n[2]; ++k)
        for (int w = 0; w < 6; ++w) {
          std::array<Lattice, 4> cell;
          cell[0] = {2 * i, 2 * j, 2 * k};
          for (size_t s = 0; s < 3; ++s) {
            cell[s + 1] = cell[s];
            cell[s + 1][static_cast<size_t>(kWalks[w][s])] += 2;
          }
          if (w >= 3) std::swap(cell[2], cell[3]);  // odd orders turn the wrong way round
          cells.push_back(cell);
        }
  return cells;
}

void set_rows(const std::vector<std::vector<int32_t>>& rows, IndexMatrix& out) {
  out.resize(static_cast<Eigen::Index>(rows.size()),
             rows.empty() ? 6 : static_cast<Eigen::Index>(rows[0].size()));
  for (size_t r = 0; r < rows.size(); ++r)
    for (size_t c = 0; c < rows[r].size(); ++c)
      out(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = rows[r][c];
}

}  // namespace

mesh::Mesh block_mesh(const std::array<int, 3>& n, const Map& map, const BlockOptions& options) {
  const mesh::CellTraits& traits = mesh::traits(options.type);
  Numbering number(n, options.wrap_x);
  std::vector<std::vector<int32_t>> cells;
  std::map<std::string, std::vector<std::vector<int32_t>>> sides;
  const char* names[3][2] = {{"x0", "x1"}, {"y0", "y1"}, {"z0", "z1"}};
  for (const auto& corners : tetrahedra(n)) {
    std::vector<int32_t> cell;
    for (const Lattice& corner : corners) cell.push_back(number.of(corner));
    if (traits.order == 2)
      for (const auto& [a, b] : mesh::kTetEdges)
        cell.push_back(
            number.of(middle(corners[static_cast<size_t>(a)], corners[static_cast<size_t>(b)])));
    for (const auto& face : mesh::kTetFaces) {
      std::vector<int32_t> ids;
      for (int v = 0; v < traits.face_nodes; ++v)
        ids.push_back(cell[static_cast<size_t>(face[static_cast<size_t>(v)])]);
      for (size_t axis = options.wrap_x ? 1 : 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
          const int plane = end * 2 * n[axis];
          bool on = true;
          for (size_t v = 0; v < 3; ++v)
            on = on && corners[static_cast<size_t>(face[v])][axis] == plane;
          if (!on) continue;
          sides[names[axis][end]].push_back(ids);
          sides["skin"].push_back(ids);
        }
    }
    cells.push_back(cell);
  }
  mesh::Mesh mesh;
  mesh.name = "block";
  mesh.regions = {"body"};
  mesh.cells.resize(1);
  mesh.cells[0].type = options.type;
  set_rows(cells, mesh.cells[0].nodes);
  for (const auto& [name, rows] : sides) set_rows(rows, mesh.surfaces[name].triangles);
  mesh.nodes.resize(static_cast<Eigen::Index>(number.all().size()), 3);
  for (const auto& [at, id] : number.all()) {
    mesh.nodes.row(id) = map({0.5 * at[0] / n[0], 0.5 * at[1] / n[1], 0.5 * at[2] / n[2]});
    mesh.node_sets["all"].push_back(static_cast<int32_t>(mesh.node_sets["all"].size()));
  }
  if (!options.curved && traits.order == 2)
    for (const auto& cell : cells)
      for (size_t e = 0; e < 6; ++e)
        mesh.nodes.row(cell[4 + e]) =
            0.5 * (mesh.nodes.row(cell[static_cast<size_t>(mesh::kTetEdges[e][0])]) +
                   mesh.nodes.row(cell[static_cast<size_t>(mesh::kTetEdges[e][1])]));
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
    // A generator seeded by the place: the same corner moves alike in every cell.
    std::seed_seq seed{static_cast<int>(std::lround(1e6 * x(0))),
                       static_cast<int>(std::lround(1e6 * x(1))),
                       static_cast<int>(std::lround(1e6 * x(2)))};
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-share, share);
    Eigen::Vector3d moved = x;
    for (int d = 0; d < 3; ++d) {
      const double step = uniform(generator) / n[static_cast<size_t>(d)];
      if (x(d) > 1e-9 && x(d) < 1.0 - 1e-9) moved(d) += step;
    }
    return moved.cwiseProduct(size);
  };
}

}  // namespace clatter::assembly::testing
