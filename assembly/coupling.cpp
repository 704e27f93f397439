#include "assembly/coupling.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "core/error.hpp"

namespace clatter::assembly {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kNoRotation = 1e-8;  // smallest over largest eigenvalue of the scaled A
constexpr double kRounding = 1e-14;   // of a row's largest entry: weights that are zero in theory

constexpr std::array<const char*, 6> kSuffix = {"x", "y", "z", "rx", "ry", "rz"};

/// Rows of `dense` (m x 3 n_s) as functionals on the surface's nodes, without rounding dust.
std::vector<Functional> to_functionals(const Eigen::MatrixXd& dense,
                                       const std::vector<int32_t>& nodes) {
  std::vector<Functional> rows(static_cast<size_t>(dense.rows()));
  for (Eigen::Index r = 0; r < dense.rows(); ++r) {
    const double least = kRounding * dense.row(r).cwiseAbs().maxCoeff();
    Functional& row = rows[static_cast<size_t>(r)];
    for (Eigen::Index c = 0; c < dense.cols(); ++c) {
      if (std::abs(dense(r, c)) <= least) continue;
      row.dofs.push_back(3 * nodes[static_cast<size_t>(c / 3)] + static_cast<int32_t>(c % 3));
      row.values.push_back(dense(r, c));
    }
  }
  return rows;
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
  const auto n = static_cast<Eigen::Index>(surface.nodes.size());
  Eigen::MatrixXd R(3 * n, 6);
  for (Eigen::Index k = 0; k < n; ++k)
    R.middleRows<3>(3 * k) =
        rigid_motion(coordinates.row(surface.nodes[static_cast<size_t>(k)]).transpose(), centre);
  // G R with G = gram (x) I_3: the integrals int N_k R dA, since R is linear and N reproduces it.
  Eigen::MatrixXd GR = Eigen::MatrixXd::Zero(3 * n, 6);
  for (Eigen::Index col = 0; col < surface.gram.outerSize(); ++col)
    for (SparseMatrix::InnerIterator entry(surface.gram, col); entry; ++entry)
      GR.middleRows<3>(3 * entry.row()) += entry.value() * R.middleRows<3>(3 * col);
  const Matrix6 A = R.transpose() * GR;
  require_definite(A, surface.area, where);

  Coupling coupling;
  const Eigen::MatrixXd C = A.ldlt().solve(GR.transpose());
  coupling.rows = to_functionals(C.topRows(n_dofs), surface.nodes);
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
  const auto n = static_cast<Eigen::Index>(surface.nodes.size());
  Eigen::MatrixXd row = Eigen::MatrixXd::Zero(1, 3 * n);
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  double area = 0.0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::RowVector3d x = coordinates.row(surface.nodes[static_cast<size_t>(k)]);
    const double along = x.dot(direction);
    if (range && (along < range->first || along > range->second)) continue;
    row.middleCols<3>(3 * k) = surface.weight(k) * direction.transpose();
    centre += surface.weight(k) * x;
    area += surface.weight(k);
  }
  if (!(area > 0.0))
    throw InputError(
        fmt::format("{}: found no node of the surface in the range, expected some", where));
  Coupling coupling;
  coupling.rows = to_functionals(row / area, surface.nodes);
  coupling.set.kind = "mean";
  coupling.set.labels = {name};
  coupling.set.position = centre / area;
  coupling.set.direction = direction.transpose();
  coupling.set.is_rotation = {0};
  return coupling;
}

}  // namespace clatter::assembly
