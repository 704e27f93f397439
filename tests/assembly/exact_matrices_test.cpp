// SPDX-License-Identifier: GPL-3.0-or-later
// Our matrices of a beam of straight C3D10 elements against exact integrals of polynomials: slow,
// and with nothing in common with the program. The comparison with those that Abaqus wrote is in
// abaqus_matrices_test.cpp.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "block_mesh.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/fe/assemble.hpp"
#include "mesh/deck/abaqus/reader.hpp"
#include "small_solver.hpp"
#include "tests/mesh/deck/deck_text.hpp"

namespace clatter::assembly::testing {
namespace {

const fe::Material kBeamSteel{208000.0, 0.3, 7.85e-9};  // N, mm, t

using Exponents = std::array<int, 4>;            // of the barycentric coordinates
using Polynomial = std::map<Exponents, double>;  // coefficients

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial out;
  for (const auto& [p, x] : a)
    for (const auto& [q, y] : b) out[{p[0] + q[0], p[1] + q[1], p[2] + q[2], p[3] + q[3]}] += x * y;
  return out;
}

Polynomial derivative(const Polynomial& a, size_t k) {
  Polynomial out;
  for (const auto& [p, x] : a) {
    if (p[k] == 0) continue;
    Exponents lower = p;
    --lower[k];
    out[lower] += x * p[k];
  }
  return out;
}

/// Mean over a tetrahedron; of L1^a L2^b L3^c L4^d it is 3! a! b! c! d! / (a + b + c + d + 3)!.
double mean(const Polynomial& a) {
  double sum = 0.0;
  for (const auto& [p, x] : a) {
    double part = 6.0 * x;
    for (const int exponent : p) part *= std::tgamma(exponent + 1.0);
    sum += part / std::tgamma(p[0] + p[1] + p[2] + p[3] + 4.0);
  }
  return sum;
}

/// L_i (2 L_i - 1) of the corners, 4 L_i L_j of the edges in the order of decks.
std::vector<Polynomial> quadratic_shapes() {
  const auto L = [](int i) {
    Exponents one{};
    one[i] = 1;
    return Polynomial{{one, 1.0}};
  };
  std::vector<Polynomial> shapes;
  for (int i = 0; i < 4; ++i) shapes.push_back(L(i) * Polynomial{{{0, 0, 0, 0}, -1.0}});
  for (size_t i = 0; i < 4; ++i) {
    Exponents two{};
    two[i] = 2;
    shapes[i][two] += 2.0;
  }
  for (const auto& [i, j] : test::edges_of_decks(4))
    shapes.push_back(L(i) * L(j) * Polynomial{{{0, 0, 0, 0}, 4.0}});
  return shapes;
}

struct DensePencil {
  Eigen::MatrixXd K, M;
};

/// lambda (div u)^2 + 2 mu |eps|^2 and rho |u|^2 of the cells, entry by entry.
DensePencil exact_matrices(const mesh::Mesh& mesh, const fe::Material& material) {
  const std::vector<Polynomial> N = quadratic_shapes();
  std::array<std::array<Eigen::Matrix4d, 10>, 10> slopes;  // means of dN_a/dL_k dN_b/dL_l
  Eigen::Matrix<double, 10, 10> products;
  for (size_t a = 0; a < 10; ++a)
    for (size_t b = 0; b < 10; ++b) {
      products(static_cast<int>(a), static_cast<int>(b)) = mean(N[a] * N[b]);
      for (size_t k = 0; k < 4; ++k)
        for (size_t l = 0; l < 4; ++l)
          slopes[a][b](static_cast<int>(k), static_cast<int>(l)) =
              mean(derivative(N[a], k) * derivative(N[b], l));
    }
  const Eigen::Index size = 3 * mesh.nodes.rows();
  DensePencil out{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
  for (const std::vector<int32_t>& cell : test::listed_cells(mesh)) {
    Eigen::Matrix4d corners;  // rows (1, x, y, z): L = (1, x) corners^-1
    for (int i = 0; i < 4; ++i) corners.row(i) << 1.0, mesh.nodes.row(cell[i]);
    const Eigen::Matrix<double, 3, 4> gradient = corners.inverse().bottomRows<3>();
    const double volume = corners.determinant() / 6.0;
    for (size_t a = 0; a < 10; ++a)
      for (size_t b = 0; b < 10; ++b) {
        const Eigen::Matrix3d S = gradient * slopes[a][b] * gradient.transpose();
        const Eigen::Matrix3d k = material.lambda() * S + material.mu() * S.transpose() +
                                  material.mu() * S.trace() * Eigen::Matrix3d::Identity();
        const double m = material.density * products(static_cast<int>(a), static_cast<int>(b));
        out.K.block<3, 3>(3 * cell[a], 3 * cell[b]) += volume * k;
        out.M.block<3, 3>(3 * cell[a], 3 * cell[b]) += volume * m * Eigen::Matrix3d::Identity();
      }
  }
  return out;
}

class BeamOfADeck : public ::testing::Test {
 protected:
  void SetUp() override {
    const mesh::Mesh block = block_mesh({1, 1, 6}, brick({20.0, 20.0, 500.0}));
    mesh_ = mesh::deck::read_abaqus_text("beam.inp", test::abaqus_beam(block)).mesh;
    ASSERT_EQ(mesh_.nodes, block.nodes);
    ours_ = fe::assemble(mesh_, materials_of(mesh_, kBeamSteel), fe::node_pattern(mesh_));
    exact_ = exact_matrices(mesh_, kBeamSteel);
    std::vector<bool> held(static_cast<size_t>(mesh_.nodes.rows()), false);
    for (const int32_t node : mesh_.node_sets.at("fixed")) held[node] = true;
    for (int dof = 0; dof < 3 * mesh_.nodes.rows(); ++dof)
      if (!held[dof / 3]) free_.push_back(dof);
  }
  mesh::Mesh mesh_;
  fe::NodalMatrices ours_;
  DensePencil exact_;
  std::vector<int> free_;
};

TEST_F(BeamOfADeck, StiffnessAgreesEntryByEntry) {
  EXPECT_LT((full(ours_.K) - exact_.K).cwiseAbs().maxCoeff(),
            1e-13 * exact_.K.cwiseAbs().maxCoeff());
}

TEST_F(BeamOfADeck, MassAgreesEntryByEntry) {
  EXPECT_LT((full(ours_.M) - exact_.M).cwiseAbs().maxCoeff(),
            1e-13 * exact_.M.cwiseAbs().maxCoeff());
  EXPECT_NEAR(exact_.M.sum(), 3.0 * 7.85e-9 * 20.0 * 20.0 * 500.0, 1e-15);
}

TEST_F(BeamOfADeck, TenFrequenciesAgree) {
  const auto kept = [&](const SparseMatrix& lower) -> SparseMatrix {
    const Eigen::MatrixXd all = full(lower);
    return Eigen::MatrixXd(Eigen::MatrixXd(all(free_, free_)).triangularView<Eigen::Lower>())
        .sparseView(0.0, 0.0);
  };
  const Eigen::VectorXd squares =
      dense::symmetric_eigen(exact_.K(free_, free_), exact_.M(free_, free_),
                             dense::EigenParts::kValues)
          .values;
  const Eigen::VectorXd hz = lowest_hz(kept(ours_.K), kept(ours_.M), 10);
  for (int k = 0; k < 10; ++k) {
    const double want = std::sqrt(squares(k)) / (2.0 * std::numbers::pi);
    // The dense solver rounds all eigenvalues to the largest one's digits.
    const double rounding =
        std::numeric_limits<double>::epsilon() * squares(squares.size() - 1) / squares(k);
    EXPECT_NEAR(hz(k) / want, 1.0, 1e-9 + rounding) << "mode " << k + 1;
    EXPECT_LT(rounding, 1e-7);
  }
}

}  // namespace
}  // namespace clatter::assembly::testing
