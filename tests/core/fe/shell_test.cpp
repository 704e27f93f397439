// SPDX-License-Identifier: GPL-3.0-or-later
// Sections, axes and directors of shells; cells that are none.
#include "core/fe/shell.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "core/fe/shell_directors.hpp"
#include "shell_meshes.hpp"
#include "tests/observed.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::fe::testing {
namespace {

const Plate kSheet{.E = 3.0, .nu = 0.3, .rho = 2.0, .thickness = 0.1};

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A plane cell with straight sides that is no parallelogram.
ShellNodes cell_nodes(int n) {
  const int corners = n > 4 ? n / 2 : n;
  ShellNodes x(4, 3);
  x << 0.0, 0.0, 0.0, 1.2, 0.1, 0.0, 1.0, 0.9, 0.0, -0.1, 1.1, 0.0;
  x.conservativeResize(n, Eigen::NoChange);
  for (int i = corners; i < n; ++i)
    x.row(i) = 0.5 * (x.row(i - corners) + x.row((i - corners + 1) % corners));
  return x;
}

ShellMatrices computed(const ShellCell& cell) {
  ShellMatrices out;
  EXPECT_TRUE(compute_shell(cell, MassForm::kConsistent, out));
  return out;
}

double difference(const ShellMatrix& a, const ShellMatrix& b) {
  return (a - b).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff();
}

class ShellSections : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Cells, ShellSections, ::testing::Values(3, 4, 6, 8));

TEST_P(ShellSections, ARatioOfTwoIsTwiceTheThickness) {
  const ShellNodes x = cell_nodes(GetParam());
  ShellCell thin = cell_alone(x, kSheet);
  thin.ratio = Eigen::VectorXd::Constant(GetParam(), 2.0);
  Plate twice = kSheet;
  twice.thickness *= 2.0;
  ShellCell thick = cell_alone(x, twice);
  for (ShellCell* cell : {&thin, &thick}) {  // beside the material's
    cell->stiffness.mass.area_mass = 0.4;
    cell->stiffness.mass.total += 0.4;
  }
  EXPECT_LE(difference(computed(thick).stiffness, computed(thin).stiffness), 1e-14);
  EXPECT_LE(difference(computed(thick).mass, computed(thin).mass), 1e-14);
}

TEST_P(ShellSections, CouplingOfMembraneAndBendingIsThatOfALayerBesideTheNodes) {
  constexpr double kBeside = 0.03;
  const ShellCell at_nodes = cell_alone(cell_nodes(GetParam()), kSheet);
  ShellCell offset = at_nodes, coupled = at_nodes;
  offset.offset = kBeside;
  ShellStiffness& s = coupled.stiffness;
  s.B = kBeside * s.A;
  s.D += kBeside * kBeside * s.A;
  // u = (x + y/2, y/2 + x/2), w = x^2 - x y - y^2 / 2: constant strain and curvature.
  Eigen::VectorXd u(6 * GetParam());
  for (int i = 0; i < GetParam(); ++i) {
    const double x = at_nodes.x(i, 0), y = at_nodes.x(i, 1);
    u.segment<6>(6 * i) << x + 0.5 * y, 0.5 * y + 0.5 * x, x * x - x * y - 0.5 * y * y, -x - y,
        -2.0 * x + y, 0.0;
  }
  const Eigen::Vector3d e(1.0, 0.5, 1.0), k(-2.0, 1.0, 2.0);
  const ShellNodes& x = at_nodes.x;
  double area = 0.0;
  const int corners = GetParam() > 4 ? GetParam() / 2 : GetParam();
  for (int i = 0; i < corners; ++i) {
    const int j = (i + 1) % corners;
    area += 0.5 * (x(i, 0) * x(j, 1) - x(j, 0) * x(i, 1));
  }
  // Along the axes of the field.
  offset.axis = coupled.axis = Eigen::Vector3d::UnitX();
  const double exact = area * (e.dot(s.A * e) + 2.0 * e.dot(s.B * k) + k.dot(s.D * k));
  for (const ShellCell& cell : {offset, coupled})
    EXPECT_NEAR(u.dot(computed(cell).stiffness * u), exact, 1e-13 * exact);
}

TEST_P(ShellSections, DirectionOneIsTheAxisProjected) {
  ShellCell cell = cell_alone(cell_nodes(GetParam()), kSheet);
  cell.stiffness.A(0, 0) *= 5.0;
  const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
  cell.axis = Eigen::Vector3d(1.0, 1.0, 0.7);
  const Eigen::VectorXd u = test::random_vector(6 * GetParam());
  const ShellStrains e = shell_strains(cell, u, {0.2, 0.3});
  EXPECT_LE((e.axes.col(0) - Eigen::Vector3d(1.0, 1.0, 0.0).normalized()).norm(), 1e-14);
  // Everything turned: the same energy and strains.
  ShellCell turned = cell;
  turned.x = cell.x * Q.transpose();
  turned.directors = cell.directors * Q.transpose();
  turned.axis = Q * cell.axis;
  Eigen::VectorXd moved = u;
  for (Eigen::Index i = 0; i < 2 * GetParam(); ++i)
    moved.segment<3>(3 * i) = Q * u.segment<3>(3 * i);
  const ShellStrains f = shell_strains(turned, moved, {0.2, 0.3});
  EXPECT_LE((e.membrane - f.membrane).norm() + (e.curvature - f.curvature).norm() +
                (e.shear - f.shear).norm(),
            1e-13 * e.curvature.norm());
  const double energy = u.dot(computed(cell).stiffness * u);
  EXPECT_NEAR(moved.dot(computed(turned).stiffness * moved), energy, 1e-13 * energy);
}

TEST_P(ShellSections, ASectionMayResistAMembraneOrBendingAlone) {
  ShellCell bending = cell_alone(cell_nodes(GetParam()), kSheet), membrane = bending;
  bending.stiffness.A.setZero();
  membrane.stiffness.D.setZero();
  membrane.stiffness.S.setZero();
  for (const ShellCell& cell : {bending, membrane}) {
    const ShellMatrix K = computed(cell).stiffness;
    EXPECT_TRUE(K.allFinite());
    EXPECT_GT(K.trace(), 0.0);
  }
}

/// Directors of node `node` in cells 0, 1, ... of triangles that share it.
std::vector<Eigen::Vector3d> directors_at(const Sheet& s, int node) {
  std::vector<Eigen::Vector3d> out;
  const std::vector<RowMatrix> directors = shell_directors(s.nodes, s.shells);
  for (size_t b = 0; b < s.shells.size(); ++b)
    for (Eigen::Index c = 0; c < s.shells[b].nodes.rows(); ++c)
      for (Eigen::Index i = 0; i < s.shells[b].nodes.cols(); ++i)
        if (s.shells[b].nodes(c, i) == node)
          out.emplace_back(directors[b].row(c).segment<3>(3 * i).transpose());
  return out;
}

/// Flaps of one metre on the edge 0-1 along x, at these angles from y toward z.
Sheet flaps(const std::vector<double>& angles) {
  Sheet s;
  const int n = static_cast<int>(angles.size());
  s.nodes.resize(2 + 2 * n, 3);
  s.nodes.topRows<2>() << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0;
  s.shells.resize(1);
  s.shells[0].nodes.resize(n, 4);
  for (int i = 0; i < n; ++i) {
    const double c = std::cos(radians(angles[i])), z = std::sin(radians(angles[i]));
    s.nodes.row(2 + 2 * i) << 1.0, c, z;
    s.nodes.row(3 + 2 * i) << 0.0, c, z;
    s.shells[0].nodes.row(i) << 0, 1, 2 + 2 * i, 3 + 2 * i;
  }
  return s;
}

Eigen::Vector3d normal_of_flap(double angle) {
  return {0.0, -std::sin(radians(angle)), std::cos(radians(angle))};
}

TEST(ShellDirectors, AreMeansUpToFoldsOfTwentyDegrees) {
  // The second flap continues the first, folded by the angle; its normal points the other way.
  for (const double fold : {19.0, 21.0}) {
    const auto V = directors_at(flaps({0.0, 180.0 - fold}), 0);
    const bool smooth = fold < 20.0;
    EXPECT_LE((V[0] - normal_of_flap(smooth ? -0.5 * fold : 0.0)).norm(), 1e-14) << fold;
    EXPECT_LE((V[1] + normal_of_flap(smooth ? -0.5 * fold : -fold)).norm(), 1e-14) << fold;
  }
}

TEST(ShellDirectors, HardU4_ATurnedCellKeepsItsSide) {
  Sheet s = mapped([](double u, double v) { return Eigen::Vector3d(u, v, 0.1 * u * u); }, 2, 2,
                   Cells::kMixed);
  const auto before = directors_at(s, 4);
  s.shells[0].nodes.row(1) = s.shells[0].nodes.row(1).reverse().eval();
  const auto after = directors_at(s, 4);
  ASSERT_EQ(after.size(), before.size());
  double largest = 0.0;
  for (size_t i = 0; i < before.size(); ++i)
    largest = std::max(largest, (after[i] - (i == 1 ? -1.0 : 1.0) * before[i]).norm());
  test::expect_at_most("change of a director by a turned cell, its sign apart", largest, 1e-15);
}

TEST(ShellDirectors, HardU3_SheetsOfATeeKeepTheirNormals) {
  const auto V = directors_at(flaps({0.0, 90.0, 180.0}), 1);
  EXPECT_LE((V[0] - normal_of_flap(0.0)).norm(), 1e-15);
  EXPECT_LE((V[1] - normal_of_flap(90.0)).norm(), 1e-15);
  EXPECT_LE((V[2] - normal_of_flap(180.0)).norm(), 1e-15);
  test::observed("each sheet of a T keeps its normal");
}

bool is_shell(const ShellCell& cell) {
  ShellMatrices out;
  return compute_shell(cell, MassForm::kConsistent, out);
}

ShellNodes square_with(const Eigen::Vector3d& fourth) {
  ShellNodes x(4, 3);
  x << 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, fourth.transpose();
  return x;
}

TEST(HardU1, CellsThatAreNoShellsAreRefused) {
  EXPECT_TRUE(is_shell(cell_alone(square_with({0.0, 1.0, 0.0}), kSheet)));
  EXPECT_TRUE(is_shell(cell_alone(square_with({0.45, 0.6, 0.0}), kSheet)));
  EXPECT_TRUE(is_shell(cell_alone(square_with({0.0, 1.0, 0.5}), kSheet)));  // warped
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::map<std::string, Eigen::Vector3d> fourth = {
      {"concave", {0.7, 0.3, 0.0}},          {"a triangle", {0.5, 0.5, 0.0}},
      {"two nodes at one", {1.0, 1.0, 0.0}}, {"crossed", {1.0, -0.5, 0.0}},
      {"folded over", {0.9, 0.1, 0.3}},      {"not a number", {nan, 1.0, 0.0}}};
  for (const auto& [what, at] : fourth)
    EXPECT_FALSE(is_shell(cell_alone(square_with(at), kSheet))) << what;
  ShellNodes line = square_with({0.0, 1.0, 0.0}).topRows<3>();
  EXPECT_TRUE(is_shell(cell_alone(line, kSheet)));
  line.row(2) << 2.0, 0.0, 0.0;
  EXPECT_FALSE(is_shell(cell_alone(line, kSheet)));
  ShellCell turned = cell_alone(square_with({0.0, 1.0, 0.0}), kSheet);
  turned.directors *= -1.0;
  EXPECT_FALSE(is_shell(turned));
  test::observed("refused: concave, crossed, folded, flat as a line, not a number");
}

}  // namespace
}  // namespace clatter::fe::testing
