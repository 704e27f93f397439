#include "mesh/smooth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>

#include "core/error.hpp"
#include "mesh/boundary.hpp"
#include "mesh/quality.hpp"

namespace clatter::mesh {
namespace {

constexpr int kSweeps = 6;
constexpr int kHalvings = 7;         // the last step is a thousandth of an edge
constexpr double kFirstStep = 0.25;  // of the mean edge around the node

using Corners = Eigen::Matrix<double, 4, 3>;

// Two ways from a cell to its nodes and back, over all blocks.
class Stars {
 public:
  explicit Stars(const Mesh& mesh) : first_(static_cast<size_t>(mesh.nodes.rows()) + 1, 0) {
    for (const CellBlock& block : mesh.cells) {
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        cells_.push_back(
            {block.nodes(c, 0), block.nodes(c, 1), block.nodes(c, 2), block.nodes(c, 3)});
        for (int32_t n : cells_.back()) ++first_[static_cast<size_t>(n) + 1];
      }
    }
    for (size_t n = 1; n < first_.size(); ++n) first_[n] += first_[n - 1];
    around_.resize(first_.back());
    std::vector<size_t> next(first_.begin(), first_.end() - 1);
    for (size_t c = 0; c < cells_.size(); ++c) {
      for (int32_t n : cells_[c]) around_[next[static_cast<size_t>(n)]++] = c;
    }
  }
  size_t cell_count() const { return cells_.size(); }
  const std::array<int32_t, 4>& cell(size_t c) const { return cells_[c]; }
  std::span<const size_t> around(int32_t node) const {
    const auto n = static_cast<size_t>(node);
    return {around_.data() + first_[n], first_[n + 1] - first_[n]};
  }

 private:
  std::vector<std::array<int32_t, 4>> cells_;
  std::vector<size_t> first_, around_;
};

// Smallest dihedral angle; negative for a cell that is inside out.
double angle_of(const Mesh& mesh, const std::array<int32_t, 4>& cell) {
  Corners x;
  for (int i = 0; i < 4; ++i) x.row(i) = mesh.nodes.row(cell[i]);
  const Eigen::Vector3d a = x.row(1) - x.row(0), b = x.row(2) - x.row(0), c = x.row(3) - x.row(0);
  if (a.dot(b.cross(c)) <= 0.0) return -1.0;
  return dihedral_angles(x).minCoeff();
}

double angle_around(const Mesh& mesh, const Stars& stars, int32_t node) {
  double smallest = 180.0;
  for (size_t c : stars.around(node)) smallest = std::min(smallest, angle_of(mesh, stars.cell(c)));
  return smallest;
}

double mean_edge(const Mesh& mesh, const Stars& stars, int32_t node) {
  double sum = 0.0;
  int count = 0;
  for (size_t c : stars.around(node)) {
    for (int32_t other : stars.cell(c)) {
      if (other == node) continue;
      sum += (mesh.nodes.row(other) - mesh.nodes.row(node)).norm();
      ++count;
    }
  }
  return sum / count;
}

// The 26 neighbours of a cube's centre.
std::vector<Eigen::RowVector3d> directions() {
  std::vector<Eigen::RowVector3d> all;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        if (i != 0 || j != 0 || k != 0) {
          all.push_back(Eigen::RowVector3d(i, j, k).normalized());
        }
      }
    }
  }
  return all;
}

// Moves one node to where the smallest angle around it is largest; true when it moved.
bool improve(Mesh& mesh, const Stars& stars, int32_t node) {
  static const std::vector<Eigen::RowVector3d> kDirections = directions();
  double best = angle_around(mesh, stars, node);
  double step = kFirstStep * mean_edge(mesh, stars, node);
  bool moved = false;
  for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
    const Eigen::RowVector3d from = mesh.nodes.row(node);
    Eigen::RowVector3d to = from;
    for (const Eigen::RowVector3d& direction : kDirections) {
      mesh.nodes.row(node) = from + step * direction;
      const double angle = angle_around(mesh, stars, node);
      if (angle > best) {
        best = angle;
        to = mesh.nodes.row(node);
        moved = true;
      }
    }
    mesh.nodes.row(node) = to;
  }
  return moved;
}

}  // namespace

int64_t lift_slivers(Mesh& mesh, double target_deg) {
  for (const CellBlock& block : mesh.cells) {
    if (block.type != CellType::kTet4) throw InputError("lift_slivers: expected a tet4 mesh");
  }
  const Stars stars(mesh);
  std::vector<bool> fixed(static_cast<size_t>(mesh.nodes.rows()), false);
  // Faces between blocks are boundaries of the geometry too.
  for (const CellBlock& block : mesh.cells) {
    Mesh alone;
    alone.cells = {block};
    for (const auto& entry : boundary_faces(alone)) {
      for (int32_t n : entry.first) fixed[static_cast<size_t>(n)] = true;
    }
  }
  int64_t bad = 0;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bad = 0;
    bool moved = false;
    for (size_t c = 0; c < stars.cell_count(); ++c) {
      if (angle_of(mesh, stars.cell(c)) >= target_deg) continue;
      for (int32_t n : stars.cell(c)) {
        if (!fixed[static_cast<size_t>(n)]) moved = improve(mesh, stars, n) || moved;
      }
      if (angle_of(mesh, stars.cell(c)) < target_deg) ++bad;
    }
    if (bad == 0 || !moved) break;
  }
  return bad;
}

}  // namespace clatter::mesh
