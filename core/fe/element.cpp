// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/element.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <limits>

#include "core/fe/cell_points.hpp"
#include "core/fe/cell_strain.hpp"
#include "core/fe/tet_stiffness.hpp"

namespace clatter::fe {
namespace {

using mesh::CellNodes;
using mesh::CellType;

constexpr double kStraightTolerance = 1e-10;  // of an edge; the error is as small

/// K on all modes; returns the smallest det J. Where that is not positive, K is incomplete.
double integrate_stiffness(const CellModes& modes, const CellNodes& x, const Material& material,
                           const CellPoints& points, Eigen::MatrixXd& K) {
  const auto n_points = static_cast<Eigen::Index>(points.size());
  const Eigen::Index columns = 3 * modes.count();
  Eigen::MatrixXd strain(6 * n_points, columns), stress(6 * n_points, columns);
  double smallest = std::numeric_limits<double>::infinity();
  ModeGradient g;
  Elasticity C = material.elasticity_at(x.row(0));
  for (Eigen::Index q = 0; q < n_points; ++q) {
    const CellPoint& point = points[q];
    const double det = modes.at(point, g);
    smallest = std::min(smallest, det);
    if (!(det > 0.0)) return smallest;
    if (material.axes) C = material.elasticity_at(x.transpose() * point.shape.value);
    const StrainMatrix B = strain_matrix(g);
    strain.middleRows<6>(6 * q) = B;
    stress.middleRows<6>(6 * q).noalias() = (point.weight * det * C).lazyProduct(B);
  }
  K.noalias() = strain.transpose() * stress;
  return smallest;
}

Eigen::VectorXd integrate_thermal(const CellModes& modes, const CellNodes& x,
                                  const Material& material, const CellPoints& points,
                                  const Eigen::VectorXd& dT) {
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * modes.count());
  ModeGradient g;
  for (const CellPoint& point : points) {
    const double det = modes.at(point, g);
    const Eigen::Vector3d position = x.transpose() * point.shape.value;
    const Voigt stress = material.elasticity_at(position) * material.expansion_at(position);
    force.noalias() +=
        (point.weight * det * point.shape.value.dot(dT)) * (strain_matrix(g).transpose() * stress);
  }
  return force;
}

/// A^-1 B of a small positive definite A, for each cell of a mesh: Eigen's, whose calls cost least.
Eigen::MatrixXd solve_small(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  return A.llt().solve(B);
}

/// Condenses the incompatible modes: K_uu - K_ua K_aa^-1 K_au.
Eigen::MatrixXd without_modes(const Eigen::MatrixXd& extended) {
  constexpr int kInner = 3 * kIncompatibleModes;
  const Eigen::Index n = extended.rows() - kInner;
  const Eigen::MatrixXd aa = extended.bottomRightCorner(kInner, kInner);
  const Eigen::MatrixXd au = extended.bottomLeftCorner(kInner, n);
  return extended.topLeftCorner(n, n) - au.transpose() * solve_small(aa, au);
}

/// int N_a N_b over the reference tetrahedron, by its mass quadrature.
const Eigen::MatrixXd& reference_mass(CellType type) {
  static const auto all = [] {
    std::array<Eigen::MatrixXd, 2> out;
    for (const CellType tet : {CellType::kTet4, CellType::kTet10}) {
      const Eigen::Index n = mesh::traits(tet).nodes;
      Eigen::MatrixXd& sum = out[static_cast<size_t>(tet)];
      sum = Eigen::MatrixXd::Zero(n, n);
      for (const CellPoint& point : mass_points(tet, true))
        sum += point.weight * point.shape.value * point.shape.value.transpose();
    }
    return out;
  }();
  return all[static_cast<size_t>(type)];
}

void compute_mass(CellType type, const CellNodes& x, const Material& material, bool straight,
                  ElementMatrices& out) {
  if (mesh::traits(type).corners == 4 && straight) {
    // Constant Jacobian: from the corners only.
    Eigen::Matrix3d J;
    for (int k = 0; k < 3; ++k) J.col(k) = x.row(k + 1) - x.row(0);
    out.mass = material.density * J.determinant() * reference_mass(type);
    return;
  }
  out.mass.setZero(x.rows(), x.rows());
  for (const CellPoint& point : mass_points(type, straight)) {
    const double det = jacobian(x, point).determinant();
    out.min_jacobian = std::min(out.min_jacobian, det);
    out.mass.noalias() +=
        (material.density * det * point.weight * point.shape.value) * point.shape.value.transpose();
  }
}

}  // namespace

bool is_straight(CellType type, const CellNodes& x) {
  const mesh::CellTraits& cell = mesh::traits(type);
  for (int e = 0; e < cell.nodes - cell.corners; ++e) {
    const auto [i, j] = cell.edges[e];
    const double sag = (x.row(cell.corners + e) - 0.5 * (x.row(i) + x.row(j))).norm();
    if (sag > kStraightTolerance * (x.row(i) - x.row(j)).norm()) return false;
  }
  return true;
}

void compute_element(CellType type, const CellNodes& x, const Material& material,
                     ElementMatrices& out) {
  const bool straight = is_straight(type, x);
  const CellPoints& points =
      stiffness_points(type, integration_of(type, material.integration), straight);
  out.stiffness.resize(3 * x.rows(), 3 * x.rows());
  if (mesh::traits(type).corners == 4 && material.is_isotropic()) {
    out.min_jacobian = tet_stiffness(type, x, material, points, out.stiffness);
  } else if (has_incompatible_modes(type, material.integration)) {
    Eigen::MatrixXd extended;
    out.min_jacobian = integrate_stiffness(CellModes(x, true), x, material, points, extended);
    if (out.min_jacobian > 0.0) out.stiffness = without_modes(extended);
  } else {
    out.min_jacobian = integrate_stiffness(CellModes(x, false), x, material, points, out.stiffness);
  }
  if (out.min_jacobian > 0.0) compute_mass(type, x, material, straight, out);
}

Eigen::VectorXd thermal_force(CellType type, const CellNodes& x, const Material& material,
                              const Eigen::VectorXd& dT) {
  const CellPoints& points =
      stiffness_points(type, integration_of(type, material.integration), is_straight(type, x));
  const CellModes modes(x, has_incompatible_modes(type, material.integration));
  const Eigen::VectorXd force = integrate_thermal(modes, x, material, points, dT);
  if (modes.inner() == 0) return force;
  Eigen::MatrixXd extended;
  integrate_stiffness(modes, x, material, points, extended);
  const Eigen::Index n = 3 * x.rows(), inner = 3 * modes.inner();
  return force.head(n) -
         extended.topRightCorner(n, inner) *
             solve_small(extended.bottomRightCorner(inner, inner), force.tail(inner));
}

Eigen::VectorXd with_inner_modes(CellType type, const CellNodes& x, const Material& material,
                                 const Eigen::VectorXd& u, const Eigen::VectorXd& dT) {
  const CellModes modes(x, has_incompatible_modes(type, material.integration));
  if (modes.inner() == 0) return u;
  const CellPoints& points =
      stiffness_points(type, integration_of(type, material.integration), is_straight(type, x));
  const Eigen::Index n = 3 * x.rows(), inner = 3 * modes.inner();
  Eigen::MatrixXd K;
  if (!(integrate_stiffness(modes, x, material, points, K) > 0.0)) return u;
  Eigen::VectorXd force = -(K.bottomLeftCorner(inner, n) * u);
  if (dT.size() > 0) force += integrate_thermal(modes, x, material, points, dT).tail(inner);
  Eigen::VectorXd all(n + inner);
  all << u, solve_small(K.bottomRightCorner(inner, inner), force);
  return all;
}

void lump_hrz(Eigen::MatrixXd& m) {
  const Eigen::VectorXd diagonal = m.diagonal() * (m.sum() / m.trace());
  m = diagonal.asDiagonal();
}

}  // namespace clatter::fe
