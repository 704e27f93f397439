#include "assembly/coupling.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "assembly/cluster.hpp"
#include "core/error.hpp"

namespace clatter::assembly {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kNoRotation = 1e-8;  // smallest over largest eigenvalue of the scaled A
constexpr double kRounding = 1e-14;   // of a row's largest entry: weights that are zero in theory

constexpr std::array<const char*, 6> kSuffix = {"x", "y", "z", "rx", "ry", "rz"};

/// Area-weighted groups of a face's nodes; single nodes on a small face.
struct Group {
  std::vector<int32_t> nodes;
  std::vector<double> weights;  // sum to one
  double area = 0.0;
};

std::vector<Group> group_nodes(const RowMatrix& coordinates, const std::vector<int32_t>& nodes,
                               const std::vector<double>& areas) {
  std::map<int32_t, double> area_of;
  double largest = 0.0;
  for (size_t k = 0; k < nodes.size(); ++k) largest = std::max(largest, std::abs(areas[k]));
  std::vector<int32_t> loaded;  // corners of flat quadratic faces carry nothing
  for (size_t k = 0; k < nodes.size(); ++k) {
    if (std::abs(areas[k]) <= kRounding * largest) continue;
    area_of[nodes[k]] = areas[k];
    loaded.push_back(nodes[k]);
  }
  const size_t limit = loaded.size() > kLargeFace ? kGroupNodes : 1;
  std::vector<Group> groups;
  for (const std::vector<int32_t>& members : cluster_nodes(coordinates, loaded, limit)) {
    Group group;
    group.nodes = members;
    for (const int32_t node : members) group.area += area_of[node];
    for (const int32_t node : members) group.weights.push_back(area_of[node] / group.area);
    groups.push_back(std::move(group));
  }
  return groups;
}

/// The rows C (m x 3 groups) as a coupling; direct when each group is one node.
void set_rows(const Eigen::MatrixXd& C, const std::vector<Group>& groups, Coupling& coupling) {
  const bool direct = std::all_of(groups.begin(), groups.end(),
                                  [](const Group& group) { return group.nodes.size() == 1; });
  std::vector<int32_t> id(static_cast<size_t>(C.cols()), -1);
  for (Eigen::Index c = 0; c < C.cols(); ++c) {
    const Group& group = groups[static_cast<size_t>(c / 3)];
    const auto d = static_cast<int32_t>(c % 3);
    if (C.col(c).isZero(0.0)) continue;  // a direction that no row asks for
    id[static_cast<size_t>(c)] =
        direct ? 3 * group.nodes[0] + d : static_cast<int32_t>(coupling.means.size());
    if (direct) continue;
    Functional mean;
    for (const int32_t node : group.nodes) mean.dofs.push_back(3 * node + d);
    mean.values = group.weights;
    coupling.means.push_back(std::move(mean));
  }
  for (Eigen::Index r = 0; r < C.rows(); ++r) {
    const double least = kRounding * C.row(r).cwiseAbs().maxCoeff();
    Functional row;
    for (Eigen::Index c = 0; c < C.cols(); ++c) {
      if (std::abs(C(r, c)) <= least) continue;
      row.dofs.push_back(id[static_cast<size_t>(c)]);
      row.values.push_back(C(r, c));
    }
    coupling.rows.push_back(std::move(row));
  }
}

/// A weighted with the face's own length, so that displacements and rotations compare.
void require_definite(const Matrix6& A, double area, const std::string& where) {
  const double length = std::sqrt(area);
  Eigen::Matrix<double, 6, 1> scale;
  scale << 1.0, 1.0, 1.0, 1.0 / length, 1.0 / length, 1.0 / length;
  const Matrix6 scaled = scale.asDiagonal() * A * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(scaled, Eigen::EigenvaluesOnly);
  if (eigen.eigenvalues()(0) > kNoRotation * eigen.eigenvalues()(5)) return;
  throw InputError(
      fmt::format("{}: found a face that defines no rotation (a line or a point), expected a face "
                  "with area",
                  where));
}

}  // namespace

std::vector<Functional> Coupling::nodal_rows() const {
  if (means.empty()) return rows;
  std::vector<Functional> nodal;
  for (const Functional& row : rows) {
    Functional flat;
    for (size_t k = 0; k < row.dofs.size(); ++k) {
      const Functional& mean = means[static_cast<size_t>(row.dofs[k])];
      for (size_t a = 0; a < mean.dofs.size(); ++a) {
        flat.dofs.push_back(mean.dofs[a]);
        flat.values.push_back(row.values[k] * mean.values[a]);
      }
    }
    nodal.push_back(std::move(flat));
  }
  return nodal;
}

Eigen::Matrix<double, 3, 6> rigid_motion(const Eigen::Vector3d& x, const Eigen::Vector3d& point) {
  const Eigen::Vector3d r = x - point;
  Eigen::Matrix<double, 3, 6> motion;
  motion.leftCols<3>().setIdentity();
  motion.rightCols<3>() << 0.0, r.z(), -r.y(), -r.z(), 0.0, r.x(), r.y(), -r.x(), 0.0;
  return motion;
}

Coupling distributing_coupling(const std::string& name, const std::string& kind,
                               const RowMatrix& coordinates, const SurfaceIntegrals& surface,
                               const std::optional<Eigen::Vector3d>& point, int n_dofs,
                               const std::string& where) {
  const Eigen::Vector3d centre = point.value_or(surface.centroid);
  const std::vector<Group> groups =
      group_nodes(coordinates, surface.nodes, {surface.weight.begin(), surface.weight.end()});
  Eigen::MatrixXd weighted(3 * static_cast<Eigen::Index>(groups.size()), 6);  // W_p R_p
  Matrix6 A = Matrix6::Zero();
  for (size_t p = 0; p < groups.size(); ++p) {
    Eigen::Matrix<double, 3, 6> R = Eigen::Matrix<double, 3, 6>::Zero();
    for (size_t k = 0; k < groups[p].nodes.size(); ++k)
      R += groups[p].weights[k] *
           rigid_motion(coordinates.row(groups[p].nodes[k]).transpose(), centre);
    weighted.middleRows<3>(3 * static_cast<Eigen::Index>(p)) = groups[p].area * R;
    A += groups[p].area * R.transpose() * R;
  }
  require_definite(A, surface.area, where);

  Coupling coupling;
  const Eigen::MatrixXd C = A.ldlt().solve(weighted.transpose());
  set_rows(C.topRows(n_dofs), groups, coupling);
  coupling.set.kind = kind;
  coupling.set.position = centre.transpose().replicate(n_dofs, 1);
  coupling.set.direction = Eigen::MatrixXd::Zero(n_dofs, 3);
  for (int d = 0; d < n_dofs; ++d) {
    coupling.set.labels.push_back(name + "." + kSuffix[static_cast<size_t>(d)]);
    coupling.set.direction(d, d % 3) = 1.0;
    coupling.set.is_rotation.push_back(d < 3 ? 0 : 1);
  }
  return coupling;
}

Coupling mean_displacement(const std::string& name, const RowMatrix& coordinates,
                           const SurfaceIntegrals& surface, const Eigen::Vector3d& direction,
                           const std::optional<std::pair<double, double>>& range,
                           const std::string& where) {
  std::vector<int32_t> nodes;
  std::vector<double> areas;
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  double area = 0.0;
  for (size_t k = 0; k < surface.nodes.size(); ++k) {
    const Eigen::RowVector3d x = coordinates.row(surface.nodes[k]);
    const double along = x.dot(direction);
    if (range && (along < range->first || along > range->second)) continue;
    nodes.push_back(surface.nodes[k]);
    areas.push_back(surface.weight(static_cast<Eigen::Index>(k)));
    centre += areas.back() * x;
    area += areas.back();
  }
  if (!(area > 0.0))
    throw InputError(
        fmt::format("{}: found no node of the surface in the range, expected some", where));
  const std::vector<Group> groups = group_nodes(coordinates, nodes, areas);
  Eigen::MatrixXd row(1, 3 * static_cast<Eigen::Index>(groups.size()));
  for (size_t p = 0; p < groups.size(); ++p)
    row.middleCols<3>(3 * static_cast<Eigen::Index>(p)) =
        groups[p].area / area * direction.transpose();
  Coupling coupling;
  set_rows(row, groups, coupling);
  coupling.set.kind = "mean";
  coupling.set.labels = {name};
  coupling.set.position = centre / area;
  coupling.set.direction = direction.transpose();
  coupling.set.is_rotation = {0};
  return coupling;
}

}  // namespace clatter::assembly
