// SPDX-License-Identifier: GPL-3.0-or-later
// Shape functions, node orders and det J bounds of every cell.
#include "core/mesh/shape.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numeric>
#include <random>

#include "core/mesh/cube_bernstein.hpp"
#include "core/mesh/validity.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {
namespace {

constexpr CellType kAll[] = {CellType::kTet4,     CellType::kTet10,    CellType::kHex8,
                             CellType::kHex20,    CellType::kWedge6,   CellType::kWedge15,
                             CellType::kPyramid5, CellType::kPyramid13};

class EveryCell : public ::testing::TestWithParam<CellType> {};
INSTANTIATE_TEST_SUITE_P(Shape, EveryCell, ::testing::ValuesIn(kAll),
                         [](const auto& info) { return std::string(traits(info.param).name); });

Eigen::Vector3d inner_point(CellType type) {
  return traits(type).corners == 8 ? Eigen::Vector3d(0.3, -0.4, 0.2)
                                   : Eigen::Vector3d(0.2, 0.3, 0.1);
}

TEST_P(EveryCell, FunctionsAreOneAtTheirNodeAndZeroAtTheOthers) {
  const CellNodes nodes = reference_nodes(GetParam());
  for (Eigen::Index b = 0; b < nodes.rows(); ++b) {
    const auto value = cell_shape(GetParam(), nodes.row(b).transpose()).value;
    // At the pyramid's apex the quotient is taken 1e-14 below it.
    for (Eigen::Index a = 0; a < nodes.rows(); ++a)
      EXPECT_NEAR(value(a), a == b ? 1.0 : 0.0, 1e-12);
  }
}

TEST_P(EveryCell, GradientsAreTheDifferenceQuotientsOfTheValues) {
  const Eigen::Vector3d at = inner_point(GetParam());
  const double h = 1e-5;
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(d);
    const Eigen::VectorXd slope =
        (cell_shape(GetParam(), at + step).value - cell_shape(GetParam(), at - step).value) /
        (2.0 * h);
    // h^2 of third derivatives of order 10, and rounding of 1e-16 / h.
    EXPECT_LT((slope - cell_shape(GetParam(), at).gradient.col(d)).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST_P(EveryCell, FunctionsReproduceEveryPolynomialOfTheirOrder) {
  const CellNodes nodes = reference_nodes(GetParam());
  const Eigen::Vector3d at = inner_point(GetParam());
  const auto value = cell_shape(GetParam(), at).value;
  const auto polynomial = [&](const Eigen::Vector3d& x) {
    const double linear = 1.0 + 2.0 * x(0) - x(1) + 0.5 * x(2);
    return traits(GetParam()).order == 1 ? linear : linear * (x(0) + x(1) - 3.0 * x(2) + 0.7);
  };
  double sum = 0.0;
  for (Eigen::Index a = 0; a < nodes.rows(); ++a) sum += value(a) * polynomial(nodes.row(a));
  EXPECT_NEAR(sum, polynomial(at), 1e-13);
}

TEST_P(EveryCell, FacesPointOutwardAndTheirMidSideNodesLieOnTheirEdges) {
  const CellNodes x = reference_nodes(GetParam());
  const Eigen::RowVector3d centre = x.colwise().mean();
  for (const CellFace& face : traits(GetParam()).faces) {
    const auto node = [&](int i) { return x.row(face.nodes[i]); };
    const Eigen::Vector3d a = node(1) - node(0), b = node(2) - node(0);
    EXPECT_GT(a.cross(b).dot((node(0) - centre).transpose()), 0.0);
    const FaceTraits& kind = traits(face.type);
    for (int e = 0; kind.corners + e < kind.nodes; ++e)
      EXPECT_EQ(node(kind.corners + e), 0.5 * (node(e) + node((e + 1) % kind.corners)));
  }
}

TEST_P(EveryCell, OrdersOfOtherProgramsPutMidSideNodesWhereTheirManualsSay) {
  const CellTraits& cell = traits(GetParam());
  // Corner pairs of the mid-side nodes, one-based, as printed in the manuals.
  using Edges = std::vector<std::pair<int, int>>;
  const Edges tet = {{1, 2}, {2, 3}, {1, 3}, {1, 4}, {2, 4}, {3, 4}};
  const Edges pyramid = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 5}, {3, 5}, {4, 5}};
  const Edges hex_vtk = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7},
                         {7, 8}, {8, 5}, {1, 5}, {2, 6}, {3, 7}, {4, 8}};
  const Edges hex_nastran = {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 6},
                             {3, 7}, {4, 8}, {5, 6}, {6, 7}, {7, 8}, {8, 5}};
  const Edges wedge_vtk = {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}};
  const Edges wedge_nastran = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5},
                               {3, 6}, {4, 5}, {5, 6}, {6, 4}};
  const Edges& vtk = cell.corners == 4   ? tet
                     : cell.corners == 5 ? pyramid
                     : cell.corners == 6 ? wedge_vtk
                                         : hex_vtk;
  const Edges& nastran = cell.corners == 6 ? wedge_nastran : cell.corners == 8 ? hex_nastran : vtk;
  const CellNodes x = reference_nodes(GetParam());
  std::vector<int> same(static_cast<size_t>(cell.corners));
  std::iota(same.begin(), same.end(), 0);
  const std::vector<int> over = cell.corners == 4   ? std::vector<int>{0, 2, 1, 3}
                                : cell.corners == 5 ? std::vector<int>{0, 3, 2, 1, 4}
                                : cell.corners == 6 ? std::vector<int>{0, 2, 1, 3, 5, 4}
                                                    : std::vector<int>{0, 3, 2, 1, 4, 7, 6, 5};
  const auto check = [&](std::span<const int> p, const Edges& edges,
                         const std::vector<int>& corners) {
    ASSERT_EQ(p.size(), static_cast<size_t>(cell.nodes));
    EXPECT_EQ(std::vector<int>(p.begin(), p.begin() + cell.corners), corners);
    for (int e = 0; cell.corners + e < cell.nodes; ++e) {
      const auto [a, b] = edges[e];
      EXPECT_EQ(x.row(p[cell.corners + e]), 0.5 * (x.row(corners[a - 1]) + x.row(corners[b - 1])));
    }
  };
  // vtkWedge and vtkQuadraticWedge are turned over (tests/pipeline/vtk_test.py asks VTK).
  check(cell.to_vtk, vtk, cell.corners == 6 ? over : same);
  check(cell.to_abaqus, vtk, same);
  check(cell.to_nastran, nastran, same);
  check(cell.to_med, vtk, over);
}

CellNodes shaken(CellType type, double amount, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-amount, amount);
  CellNodes x = reference_nodes(type);
  for (double& value : x.reshaped()) value += shift(random);
  return x;
}

Eigen::Vector3d random_point(CellType type, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  if (traits(type).corners != 4)
    return from_cube(type, {unit(random), unit(random), 0.999 * unit(random)});
  Eigen::Vector4d l(unit(random), unit(random), unit(random), unit(random));
  l /= l.sum();
  return l.tail<3>();
}

TEST_P(EveryCell, JacobianBoundIsBelowEverySampleAndVerdictIsRight) {
  int folded = 0, valid = 0;
  for (unsigned trial = 0; trial < 150; ++trial) {
    const double amount = 0.02 + 0.009 * trial;
    const CellNodes x = shaken(GetParam(), amount, trial);
    const JacobianBounds bounds = jacobian_bounds(GetParam(), x);
    std::mt19937 random(trial);
    double lowest = 1e300;
    for (int s = 0; s < 300; ++s) {
      const Eigen::Matrix3d J =
          x.transpose() * cell_shape(GetParam(), random_point(GetParam(), random)).gradient;
      lowest = std::min(lowest, J.determinant());
    }
    EXPECT_LE(bounds.min, lowest + 1e-11);  // coefficients of degree 5 carry some 100 roundings
    if (bounds.min > 0.0) ++valid;
    if (lowest < 0.0) {
      ++folded;
      EXPECT_LE(bounds.min, 0.0);
    }
  }
  EXPECT_GT(valid, 5);  // the cases reach both sides
  EXPECT_GT(folded, 5);
}

class CubeCell : public EveryCell {};  // tetrahedra have their own form
INSTANTIATE_TEST_SUITE_P(Shape, CubeCell, ::testing::ValuesIn(std::span(kAll).subspan(2)),
                         [](const auto& info) { return std::string(traits(info.param).name); });

TEST_P(CubeCell, JacobianPolynomialIsExact) {
  const CellNodes x = shaken(GetParam(), 0.15, 3);
  const CubePolynomial p = jacobian_polynomial(GetParam(), x);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3d at(unit(random), unit(random), 0.999 * unit(random));
    double value = 0.0;
    for (int i = 0; i <= p.degree[0]; ++i)
      for (int j = 0; j <= p.degree[1]; ++j)
        for (int k = 0; k <= p.degree[2]; ++k) {
          double term = p.coefficients(p.index(i, j, k));
          const int index[3] = {i, j, k};
          for (int d = 0; d < 3; ++d) {
            const int n = p.degree[d];
            term *= std::tgamma(n + 1) / std::tgamma(index[d] + 1) / std::tgamma(n - index[d] + 1) *
                    std::pow(at(d), index[d]) * std::pow(1.0 - at(d), n - index[d]);
          }
          value += term;
        }
    const Eigen::Matrix3d J =
        x.transpose() * cell_shape(GetParam(), from_cube(GetParam(), at)).gradient;
    EXPECT_NEAR(value, J.determinant(), 1e-10);
  }
}

TEST_P(EveryCell, StraightCellHasScaledJacobianOneAndItsVolume) {
  const CellNodes x = reference_nodes(GetParam());
  EXPECT_NEAR(jacobian_bounds(GetParam(), x).ratio(), 1.0, 1e-12);
  const int corners = traits(GetParam()).corners;
  const double volume = corners == 4 ? 1.0 / 6 : corners == 5 ? 4.0 / 3 : corners == 6 ? 1.0 : 8.0;
  EXPECT_NEAR(volume_of(GetParam(), x), volume, 1e-13);
}

TEST_P(EveryCell, DihedralAnglesOfTheReferenceCellAreKnown) {
  const auto angles = dihedral_angles(GetParam(), reference_nodes(GetParam()));
  const auto [low, high] = std::minmax_element(angles.begin(), angles.end());
  const double degree = 180.0 / M_PI;
  switch (traits(GetParam()).corners) {
    case 4:
      EXPECT_NEAR(*low, std::acos(1 / std::sqrt(3.0)) * degree, 1e-12);
      EXPECT_NEAR(*high, 90.0, 1e-12);
      break;
    case 5:  // height 1 over a square of side 2: sides at 45 deg, 120 deg between them
      EXPECT_NEAR(*low, 45.0, 1e-12);
      EXPECT_NEAR(*high, 120.0, 1e-12);
      break;
    case 6:
      EXPECT_NEAR(*low, 45.0, 1e-12);
      EXPECT_NEAR(*high, 90.0, 1e-12);
      break;
    default:
      EXPECT_NEAR(*low, 90.0, 1e-12);
      EXPECT_NEAR(*high, 90.0, 1e-12);
  }
}

}  // namespace
}  // namespace clatter::mesh
