#include "assembly/element.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <vector>

#include "mesh/quadrature.hpp"
#include "mesh/shape.hpp"

namespace clatter::assembly {
namespace {

using mesh::CellRule;

constexpr double kStraightTolerance = 1e-10;  // of an edge; the error made below it is as small

template <int N>
struct ShapeAt {
  Eigen::Matrix<double, N, 1> value;
  Eigen::Matrix<double, N, 3> gradient;
};

/// Shape functions at the points of a rule, computed once per program.
template <int N>
struct ShapeTable {
  std::vector<ShapeAt<N>> at;
  Eigen::VectorXd weights;
};

template <int N>
ShapeTable<N> tabulate(const CellRule& rule) {
  constexpr mesh::CellType kType = N == 4 ? mesh::CellType::kTet4 : mesh::CellType::kTet10;
  ShapeTable<N> table;
  table.weights = rule.weights;
  for (const auto& point : rule.points.rowwise()) {
    const mesh::CellShape shape = mesh::cell_shape(kType, point.transpose());
    table.at.push_back({shape.value, shape.gradient});
  }
  return table;
}

template <int N>
const ShapeTable<N>& stiffness_table(bool straight) {
  static const ShapeTable<N> simple = tabulate<N>(N == 4 ? mesh::tet_rule_1() : mesh::tet_rule_4());
  static const ShapeTable<N> curved = tabulate<N>(mesh::tet_rule_14());
  return straight ? simple : curved;
}

template <int N>
const ShapeTable<N>& mass_table() {
  static const ShapeTable<N> table = tabulate<N>(mesh::tet_rule_64());
  return table;
}

/// int N_a N_b over the reference cell.
template <int N>
const Eigen::Matrix<double, N, N>& reference_mass() {
  static const Eigen::Matrix<double, N, N> mass = [] {
    Eigen::Matrix<double, N, N> sum = Eigen::Matrix<double, N, N>::Zero();
    const ShapeTable<N>& table = mass_table<N>();
    for (size_t q = 0; q < table.at.size(); ++q)
      sum += table.weights(static_cast<Eigen::Index>(q)) * table.at[q].value *
             table.at[q].value.transpose();
    return sum;
  }();
  return mass;
}

/// Spreads H = int g g^T, g = (dN_1/dx, dN_1/dy, ...), to the isotropic stiffness:
///   K(a i, b j) = lambda H(a i, b j) + mu H(a j, b i) + mu delta_ij sum_k H(a k, b k).
template <int N>
void isotropic_stiffness(const Eigen::Matrix<double, 3 * N, 3 * N>& H, const Material& material,
                         Eigen::Matrix<double, 3 * N, 3 * N>& K) {
  const double lambda = material.lambda(), mu = material.mu();
  for (int b = 0; b < N; ++b) {
    for (int a = 0; a < N; ++a) {
      const Eigen::Matrix3d block = H.template block<3, 3>(3 * a, 3 * b);
      Eigen::Matrix3d stiffness = lambda * block + mu * block.transpose();
      stiffness.diagonal().array() += mu * block.trace();
      K.template block<3, 3>(3 * a, 3 * b) = stiffness;
    }
  }
}

template <int N>
void compute_stiffness(const CellNodes<N>& x, const Material& material, bool straight,
                       ElementMatrices<N>& out) {
  const ShapeTable<N>& table = stiffness_table<N>(straight);
  Eigen::Matrix<double, 3 * N, 3 * N> H = Eigen::Matrix<double, 3 * N, 3 * N>::Zero();
  out.min_jacobian = std::numeric_limits<double>::infinity();
  for (size_t q = 0; q < table.at.size(); ++q) {
    const Eigen::Matrix3d J = x.transpose() * table.at[q].gradient;  // J(i, k) = dx_i / dxi_k
    const double det = J.determinant();
    out.min_jacobian = std::min(out.min_jacobian, det);
    if (!(det > 0.0)) return;
    // Row-major so that the rows (dN_a/dx, dN_a/dy, dN_a/dz) follow one another in memory.
    const Eigen::Matrix<double, N, 3, Eigen::RowMajor> g = table.at[q].gradient * J.inverse();
    const Eigen::Map<const Eigen::Matrix<double, 3 * N, 1>> flat(g.data());
    H.noalias() += (table.weights(static_cast<Eigen::Index>(q)) * det) * flat * flat.transpose();
  }
  isotropic_stiffness<N>(H, material, out.stiffness);
}

template <int N>
void compute_mass(const CellNodes<N>& x, const Material& material, bool straight,
                  ElementMatrices<N>& out) {
  if (straight) {
    // One Jacobian for the whole cell: from the corners alone.
    Eigen::Matrix3d J;
    for (int k = 0; k < 3; ++k) J.col(k) = x.row(k + 1) - x.row(0);
    out.mass = material.density * J.determinant() * reference_mass<N>();
    return;
  }
  const ShapeTable<N>& table = mass_table<N>();
  out.mass.setZero();
  for (size_t q = 0; q < table.at.size(); ++q) {
    const double det = (x.transpose() * table.at[q].gradient).determinant();
    out.min_jacobian = std::min(out.min_jacobian, det);
    out.mass.noalias() += (material.density * det * table.weights(static_cast<Eigen::Index>(q))) *
                          table.at[q].value * table.at[q].value.transpose();
  }
}

}  // namespace

template <int N>
bool is_straight(const CellNodes<N>& x) {
  for (int e = 0; e < N - 4; ++e) {
    const auto [i, j] = mesh::kTetEdges[static_cast<size_t>(e)];
    const double sag = (x.row(4 + e) - 0.5 * (x.row(i) + x.row(j))).norm();
    if (sag > kStraightTolerance * (x.row(i) - x.row(j)).norm()) return false;
  }
  return true;
}

template <int N>
void compute_element(const CellNodes<N>& x, const Material& material, ElementMatrices<N>& out) {
  const bool straight = is_straight<N>(x);
  compute_stiffness<N>(x, material, straight, out);
  if (out.min_jacobian > 0.0) compute_mass<N>(x, material, straight, out);
}

template bool is_straight<4>(const CellNodes<4>&);
template bool is_straight<10>(const CellNodes<10>&);
template void compute_element<4>(const CellNodes<4>&, const Material&, ElementMatrices<4>&);
template void compute_element<10>(const CellNodes<10>&, const Material&, ElementMatrices<10>&);

}  // namespace clatter::assembly
