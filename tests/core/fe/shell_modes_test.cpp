// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies of shells against closed forms and series, and on the same meshes against the same
// formulations in another language (numpy).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "shell_meshes.hpp"

namespace clatter::fe::testing {
namespace {

constexpr double kPi = std::numbers::pi;
const Plate kSteel{.E = 210e9, .nu = 0.3, .rho = 7850.0, .thickness = 1e-3};

class ShellModes : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, ShellModes, ::testing::Values(Cells::kQuads, Cells::kTriangles));

void expect_values(const Eigen::VectorXd& found, const std::vector<double>& expected,
                   double tolerance) {
  for (size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found(static_cast<Eigen::Index>(i)) / expected[i], 1.0, tolerance) << i;
}

/// 10 m x 10 m of NAFEMS, bending alone: x y rz held.
Eigen::VectorXd square_plate(int n, Cells cells, double thickness,
                             const std::vector<int>& held_at_x0, const std::vector<int>& held_at_x,
                             const std::vector<int>& held_at_y) {
  const Plate plate{.E = 200e9, .nu = 0.3, .rho = 8000.0, .thickness = thickness};
  const Sheet s = mapped(
      [](double u, double v) { return Eigen::Vector3d(10.0 * u, 10.0 * v, 0.0); }, n, n, cells);
  const auto end = [](double a) { return a < 1e-9 || a > 1.0 - 1e-9; };
  const std::vector<int> fixed =
      joined({dofs_where(s, {0, 1, 5}, [](double, double) { return true; }),
              dofs_where(s, held_at_x0, [](double u, double) { return u < 1e-9; }),
              dofs_where(s, held_at_x, [&](double u, double) { return end(u); }),
              dofs_where(s, held_at_y, [&](double, double v) { return end(v); })});
  return frequencies(assemble(s, plate), fixed, 12, 0.1);
}

/// Frequencies for h to 0 from those of 8 x 8 and 16 x 16 cells, whose error is h^2.
template <class Model>
Eigen::VectorXd extrapolated(const Model& at) {
  return (4.0 * at(16) - at(8)) / 3.0;
}

TEST_P(ShellModes, FreeSquarePlateFv12) {
  const auto at = [&](int n) {
    return Eigen::VectorXd(square_plate(n, GetParam(), 0.05, {}, {}, {}).tail(9));
  };
  // Mindlin, by Ritz with Legendre polynomials; what is left of the error is h^4.
  expect_values(extrapolated(at), {1.62057, 2.35927, 2.92193, 4.18747, 4.18747}, 1e-3);
  if (GetParam() == Cells::kQuads)
    expect_values(at(16), {1.62429, 2.37047, 2.94356, 4.21399, 4.21399, 7.52221, 7.52221}, 1e-5);
  else
    expect_values(at(16), {1.62223, 2.36889, 2.94016, 4.21253, 4.22499, 7.49084, 7.50755}, 1e-5);
}

TEST_P(ShellModes, CantileverSquarePlateFv16) {
  const auto at = [&](int n) {
    return Eigen::VectorXd(square_plate(n, GetParam(), 0.05, {2, 3, 4}, {}, {}));
  };
  expect_values(extrapolated(at), {0.41793, 1.02424, 2.56279, 3.27491, 3.72724, 6.52432}, 1e-3);
  if (GetParam() == Cells::kQuads)
    expect_values(at(16), {0.41824, 1.02557, 2.58589, 3.29506, 3.75638, 6.58584}, 2e-5);
  else
    expect_values(at(16), {0.41832, 1.0263, 2.58128, 3.2993, 3.76225, 6.63507}, 2e-5);
}

TEST_P(ShellModes, ThickSimplySupportedPlateFv52) {
  const auto at = [&](int n) {
    return Eigen::VectorXd(square_plate(n, GetParam(), 1.0, {}, {2, 3}, {2, 4}));
  };
  expect_values(extrapolated(at), {45.911, 109.53, 109.53, 168.07}, 1.5e-3);
  if (GetParam() == Cells::kQuads)
    expect_values(at(16), {46.1001, 111.0847, 111.0847, 170.5898, 211.552}, 1e-5);
  else
    expect_values(at(16), {46.3012, 111.4444, 112.0659, 173.3687, 212.5863}, 1e-5);
}

TEST_P(ShellModes, HardU6_AFreePlateHasSixMotionsAndNoSeventh) {
  Plate plate = kSteel;
  plate.thickness = 1.5e-3;
  const Sheet s = mapped([](double u, double v) { return Eigen::Vector3d(0.3 * u, 0.2 * v, 0.0); },
                         30, 20, GetParam());
  const Eigen::VectorXd hz = frequencies(assemble(s, plate), {}, 14, 20.0);
  EXPECT_LE(hz(5), 0.1);  // rounding: 1e-10 of lambda at 10 kHz
  // Mindlin, by Ritz.
  expect_values(hz.tail(8), {83.337, 88.892, 192.213, 207.166, 239.468, 278.099}, 6e-3);
  if (GetParam() == Cells::kQuads)
    expect_values(hz.tail(8), {83.451, 89.040, 192.730, 207.988, 240.673, 279.616}, 1e-5);
  else
    expect_values(hz.tail(8), {83.383, 89.015, 192.742, 207.874, 240.522, 279.604}, 1e-5);
}

/// Half of the circle and half of the length of a cylinder with diaphragms: R = 100 mm, l = 200 mm.
Eigen::VectorXd cylinder(int around, int along, Cells cells) {
  const Sheet s = mapped(
      [](double u, double v) {
        return Eigen::Vector3d(0.1 * std::cos(kPi * u), 0.1 * std::sin(kPi * u), 0.1 * v);
      },
      around, along, cells);
  const std::vector<int> fixed = joined(
      {dofs_where(s, {0, 1}, [](double, double v) { return v < 1e-9; }),
       dofs_where(s, {2, 3, 4}, [](double, double v) { return v > 1.0 - 1e-9; }),
       dofs_where(s, {1, 3, 5}, [](double u, double) { return u < 1e-9 || u > 1.0 - 1e-9; })});
  return frequencies(assemble(s, kSteel), fixed, 6, 300.0);
}

TEST_P(ShellModes, CylinderWithDiaphragms) {
  // Fluegge, m = 1; n = 5, 6, 4, 7, 8, 3. The error is that of facets, (n h/R)^4, beside h^2.
  const std::vector<double> exact = {969.433, 1056.466, 1143.369, 1303.488, 1645.682, 1689.511};
  const Eigen::VectorXd fine = cylinder(48, 12, GetParam());
  expect_values(fine, exact, 0.035);
  const Eigen::VectorXd coarse = cylinder(24, 6, GetParam());
  EXPECT_GE((coarse(0) - exact[0]) / (fine(0) - exact[0]), 4.0);
  if (GetParam() == Cells::kQuads)
    // Of the entire cylinder; directors on the planes of symmetry are those of one side here.
    expect_values(fine, {978.33, 1072.0, 1150.38, 1332.34, 1696.18, 1696.45}, 1e-4);
}

class QuadraticShellModes : public ::testing::TestWithParam<Cells> {};
INSTANTIATE_TEST_SUITE_P(Cells, QuadraticShellModes,
                         ::testing::Values(Cells::kQuads8, Cells::kTriangles6));

TEST_P(QuadraticShellModes, PlatesHaveTheFrequenciesOfMindlin) {
  expect_values(square_plate(8, GetParam(), 0.05, {}, {}, {}).tail(9),
                {1.62057, 2.35927, 2.92193, 4.18747, 4.18747}, 5e-3);
  expect_values(square_plate(8, GetParam(), 0.05, {2, 3, 4}, {}, {}),
                {0.41793, 1.02424, 2.56279, 3.27491, 3.72724, 6.52432}, 5e-3);
  expect_values(square_plate(8, GetParam(), 1.0, {}, {2, 3}, {2, 4}),
                {45.911, 109.53, 109.53, 168.07}, 5e-3);
}

TEST_P(QuadraticShellModes, HardU6_AFreePlateHasSixMotionsAndNoSeventh) {
  Plate plate = kSteel;
  plate.thickness = 1.5e-3;
  const Sheet s = mapped([](double u, double v) { return Eigen::Vector3d(0.3 * u, 0.2 * v, 0.0); },
                         15, 10, GetParam());
  const Eigen::VectorXd hz = frequencies(assemble(s, plate), {}, 14, 20.0);
  EXPECT_LE(hz(5), 0.1);  // rounding: 1e-10 of lambda at 10 kHz
  expect_values(hz.tail(8), {83.337, 88.892, 192.213, 207.166, 239.468, 278.099}, 1e-3);
}

TEST_P(QuadraticShellModes, CylinderWithDiaphragms) {
  // Fluegge, as above, with half as many cells each way.
  expect_values(cylinder(24, 6, GetParam()),
                {969.433, 1056.466, 1143.369, 1303.488, 1645.682, 1689.511},
                GetParam() == Cells::kQuads8 ? 5e-3 : 0.03);
}

/// A sphere of R = 100 mm from a cube of 6 n^2 quadrilaterals.
Sheet sphere(int n, Cells cells) {
  std::map<std::array<int64_t, 3>, int32_t> numbers;
  std::vector<Eigen::Vector3d> points;
  const auto node = [&](int axis, double side, double a, double b) {
    Eigen::Vector3d p;
    p(axis) = side;
    p((axis + 1) % 3) = std::tan(a);
    p((axis + 2) % 3) = std::tan(b);
    p *= 0.1 / p.norm();
    const std::array<int64_t, 3> key = {std::llround(1e9 * p(0)), std::llround(1e9 * p(1)),
                                        std::llround(1e9 * p(2))};
    const auto [at, added] = numbers.try_emplace(key, static_cast<int32_t>(points.size()));
    if (added) points.push_back(p);
    return at->second;
  };
  Sheet s;
  IndexMatrix quads(6 * n * n, 4);
  Eigen::Index row = 0;
  const auto angle = [&](int i) { return kPi / 4.0 * (2.0 * i / n - 1.0); };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const int di = side > 0.0 ? 1 : 0, dj = 1 - di;  // outward
          quads.row(row++) << node(axis, side, angle(i), angle(j)),
              node(axis, side, angle(i + di), angle(j + dj)),
              node(axis, side, angle(i + 1), angle(j + 1)),
              node(axis, side, angle(i + dj), angle(j + di));
        }
  s.nodes.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (size_t i = 0; i < points.size(); ++i)
    s.nodes.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
  s.shells = blocks_of(quads, cells);
  if (cells == Cells::kQuads8) {
    add_middles(s);
    s.nodes.rowwise().normalize();
    s.nodes *= 0.1;
  }
  return s;
}

TEST(ShellSphere, HardU13_ModesOfQuadraticCellsAreFiveSevenAndNineFold) {
  for (const MassForm form : {MassForm::kConsistent, MassForm::kHrz}) {
    Plate plate = kSteel;
    plate.mass = form;
    const Eigen::VectorXd hz =
        frequencies(assemble(sphere(5, Cells::kQuads8), plate), {}, 27, 1000.0);
    EXPECT_LE(hz(5), 1.0);
    expect_values(hz.segment(6, 5), std::vector<double>(5, 6049.2), 4e-3);
    expect_values(hz.segment(11, 7), std::vector<double>(7, 7165.7), 6e-3);
    expect_values(hz.segment(18, 9), std::vector<double>(9, 7611.1), 8e-3);
  }
}

TEST(ShellSphere, ModesOfAClosedSphereAreFiveSevenAndNineFold) {
  const Eigen::VectorXd hz =
      frequencies(assemble(sphere(8, Cells::kQuads), kSteel), {}, 27, 1000.0);
  EXPECT_LE(hz(5), 1.0);  // rounding of lambda at 100 kHz
  // A. P. Junger and D. Feit; the mesh has the symmetry of the cube: 2 + 3, 3 + 3 + 1, 1 + 3 + 3
  // + 2.
  expect_values(hz.segment(6, 5), std::vector<double>(5, 6049.2), 0.01);
  expect_values(hz.segment(11, 7), std::vector<double>(7, 7165.7), 0.035);
  expect_values(hz.segment(18, 9), std::vector<double>(9, 7611.1), 0.06);
  // The other program integrates the mass by 2 x 2 points: 1e-5 on warped cells.
  expect_values(hz.segment(6, 16),
                {6090.78, 6090.78, 6105.33, 6105.33, 6105.33, 7237.00, 7237.00, 7237.00, 7302.91,
                 7302.91, 7302.91, 7414.81, 7620.05, 7752.50, 7752.50, 7752.50},
                5e-5);
}

}  // namespace
}  // namespace clatter::fe::testing
