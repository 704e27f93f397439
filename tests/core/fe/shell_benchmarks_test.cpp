// SPDX-License-Identifier: GPL-3.0-or-later
// Shells against the benchmarks of MacNeal and Harder 1985 and others named below: displacement
// over the published one. Prints the table of docs/validation.md.
//
// The expected ratios are those of the same formulations in another language (numpy, written for
// the choice of elements), on the same meshes, so that any error of a term is seen, and not those
// of this program. That errors fall by the square is in shell_order_test.cpp.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shell_meshes.hpp"

namespace clatter::fe::testing {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Load {
  Eigen::Vector2d at;  // u, v
  Eigen::Vector3d force;
};

struct Benchmark {
  Map map;
  int per_u = 1, per_v = 1;  // cells of a mesh of n = 1
  Plate plate;
  std::function<std::vector<int>(const Sheet&)> fixed;
  std::vector<Load> points;
  Eigen::Vector3d per_area = Eigen::Vector3d::Zero();
  Eigen::Vector3d per_length = Eigen::Vector3d::Zero();  // on the side u = 1
  Load measured;                                         // where, and along what
  double reference = 1.0;
};

bool near(double a, double b) { return std::abs(a - b) < 1e-9; }

/// DoFs of the side u = 0, u = 1, v = 0, v = 1; empty: none.
std::vector<int> sides(const Sheet& s, const std::array<std::vector<int>, 4>& dofs) {
  std::vector<std::vector<int>> all;
  for (int side = 0; side < 4; ++side)
    all.push_back(dofs_where(
        s, dofs[side], [side](double u, double v) { return near(side < 2 ? u : v, side % 2); }));
  return joined(all);
}

auto held(const std::array<std::vector<int>, 4>& dofs) {
  return [dofs](const Sheet& s) { return sides(s, dofs); };
}

const std::vector<int> kAll = {0, 1, 2, 3, 4, 5};

/// Scordelis and Lo 1964: a quarter of the roof.
Benchmark scordelis_lo() {
  return {
      .map = [](double u, double v) -> Eigen::Vector3d {
        return {25.0 * std::sin(40.0 * kDegree * u), 25.0 * v, 25.0 * std::cos(40.0 * kDegree * u)};
      },
      .plate = {.E = 4.32e8, .nu = 0.0, .thickness = 0.25},
      .fixed = held({{{0, 4, 5}, {}, {0, 2, 4}, {1, 3, 5}}}),
      .points = {},
      .per_area = {0.0, 0.0, -90.0},
      .measured = {{1.0, 1.0}, {0.0, 0.0, -1.0}},
      .reference = 0.3024};
}

/// An eighth of the cylinder with diaphragms.
Benchmark pinched_cylinder() {
  return {.map = [](double u, double v) -> Eigen::Vector3d {
            return {300.0 * std::sin(90.0 * kDegree * u), 300.0 * v,
                    300.0 * std::cos(90.0 * kDegree * u)};
          },
          .plate = {.E = 3e6, .nu = 0.3, .thickness = 3.0},
          .fixed = held({{{0, 4, 5}, {2, 3, 4}, {0, 2, 4}, {1, 3, 5}}}),
          .points = {{{0.0, 1.0}, {0.0, 0.0, -0.25}}},
          .measured = {{0.0, 1.0}, {0.0, 0.0, -1.0}},
          .reference = 1.8248e-5};
}

/// A quarter, with the hole of 18 degrees.
Benchmark hemisphere() {
  const auto fixed = [](const Sheet& s) {
    return joined(
        {sides(s, {{{1, 3, 5}, {0, 4, 5}, {}, {}}}),
         dofs_where(s, {2}, [](double u, double v) { return near(u, 0) && near(v, 0); })});
  };
  return {.map = [](double u, double v) -> Eigen::Vector3d {
            const double a = 90.0 * kDegree * u, b = 72.0 * kDegree * v;
            return 10.0 * Eigen::Vector3d(std::cos(b) * std::cos(a), std::cos(b) * std::sin(a),
                                          std::sin(b));
          },
          .plate = {.E = 6.825e7, .nu = 0.3, .thickness = 0.04},
          .fixed = fixed,
          .points = {{{0.0, 0.0}, {1.0, 0.0, 0.0}}, {{1.0, 0.0}, {0.0, -1.0, 0.0}}},
          .measured = {{0.0, 0.0}, {1.0, 0.0, 0.0}},
          .reference = 0.0924};
}

Benchmark twisted_beam(bool thin, bool in_plane) {
  // At the tip the width is along z.
  const Eigen::Vector3d along = in_plane ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const double reference = thin ? (in_plane ? 5.256e-3 : 1.294e-3) : in_plane ? 5.424e-3 : 1.754e-3;
  return {.map = [](double u, double v) -> Eigen::Vector3d {
            const double a = 90.0 * kDegree * u, y = 1.1 * (v - 0.5);
            return {12.0 * u, y * std::cos(a), y * std::sin(a)};
          },
          .per_u = 6,
          .plate = {.E = 29e6, .nu = 0.22, .thickness = thin ? 0.0032 : 0.32},
          .fixed = held({{kAll, {}, {}, {}}}),
          .points = {{{1.0, 0.5}, (thin ? 1e-6 : 1.0) * along}},
          .measured = {{1.0, 0.5}, along},
          .reference = reference};
}

/// Knight 1997: needs shear and coupled drilling rotations.
Benchmark raasch_hook() {
  const auto map = [](double u, double v) -> Eigen::Vector3d {
    const double s = 210.0 * u, a = s * kDegree, sixty = 60.0 * kDegree;
    if (s <= 60.0) return {14.0 * std::sin(a), 14.0 * std::cos(a), 20.0 * v};
    const double b = 150.0 * kDegree + a;
    return {60.0 * std::sin(sixty) + 46.0 * std::cos(b),
            60.0 * std::cos(sixty) + 46.0 * std::sin(b), 20.0 * v};
  };
  return {.map = map,
          .per_u = 7,
          .plate = {.E = 3300.0, .nu = 0.35, .thickness = 2.0},
          .fixed = held({{kAll, {}, {}, {}}}),
          .points = {},
          .per_length = {0.0, 0.0, 0.05},
          .measured = {{1.0, 0.0}, {0.0, 0.0, 1.0}},
          .reference = 5.012};
}

/// Bathe, Iosilevich and Chapelle 2000: clamped along one side.
Benchmark hypar(double slenderness, double reference) {
  return {.map = [](double u, double v) -> Eigen::Vector3d {
            const double x = u - 0.5, y = v - 0.5;
            return {x, y, x * x - y * y};
          },
          .plate = {.E = 2e11, .nu = 0.3, .thickness = 1.0 / slenderness},
          .fixed = held({{kAll, {}, {}, {}}}),
          .points = {},
          .per_area = {0.0, 0.0, -8000.0 / slenderness},
          .measured = {{1.0, 0.5}, {0.0, 0.0, -1.0}},
          .reference = reference};
}

Eigen::Index node_at(const Sheet& s, const Eigen::Vector2d& uv) {
  Eigen::Index node = 0;
  (s.uv.rowwise() - uv.transpose()).rowwise().squaredNorm().minCoeff(&node);
  return node;
}

bool is_quadratic(Cells cells) { return cells == Cells::kQuads8 || cells == Cells::kTriangles6; }

/// A load per area, which is its acceleration of one kilogram per area. Linear triangles have that
/// of quadrilaterals, so that they differ in the stiffness alone.
Eigen::VectorXd area_force(const Benchmark& b, const Sheet& s) {
  Eigen::VectorXd a = Eigen::VectorXd::Zero(6 * s.nodes.rows());
  if (b.per_area.isZero()) return a;
  for (Eigen::Index i = 0; i < s.nodes.rows(); ++i) a.segment<3>(6 * i) = b.per_area;
  const bool is_linear = mesh::traits(s.shells[0].type).order == 1;
  const Sheet quads{s.nodes, s.uv, blocks_of(s.grid, Cells::kQuads), s.grid};
  Plate loaded = b.plate;
  loaded.mass = MassForm::kNodes;
  return times(assemble(is_linear ? quads : s, loaded).M, a) / b.plate.thickness;
}

Eigen::VectorXd force_of(const Benchmark& b, const Sheet& s) {
  Eigen::VectorXd f = area_force(b, s);
  for (const Load& load : b.points) f.segment<3>(6 * node_at(s, load.at)) += load.force;
  if (b.per_length.isZero()) return f;
  std::vector<std::pair<double, Eigen::Index>> side;  // u = 1, straight, v ascending
  for (Eigen::Index i = 0; i < s.nodes.rows(); ++i)
    if (near(s.uv(i, 0), 1.0)) side.emplace_back(s.uv(i, 1), i);
  std::ranges::sort(side);
  const bool is_linear = mesh::traits(s.shells[0].type).order == 1;
  const std::vector<double> weights =  // trapezoids, or Simpson's
      is_linear ? std::vector<double>{0.5, 0.5} : std::vector<double>{1.0 / 6, 4.0 / 6, 1.0 / 6};
  for (size_t first = 0; first + 1 < side.size(); first += weights.size() - 1) {
    const Eigen::Index a = side[first].second, e = side[first + weights.size() - 1].second;
    const double length = (s.nodes.row(e) - s.nodes.row(a)).norm();
    for (size_t k = 0; k < weights.size(); ++k)
      f.segment<3>(6 * side[first + k].second) += weights[k] * length * b.per_length;
  }
  return f;
}

double ratio_of(const Benchmark& b, int n, Cells cells, bool distorted, double drilling = 1e-4) {
  if (is_quadratic(cells)) n /= 2;  // about as many nodes
  const Sheet s = mapped(b.map, b.per_u * n, b.per_v * n, cells, distorted);
  Plate plate = b.plate;
  plate.drilling = drilling;
  const Sparse K = assemble(s, plate).K;
  const Eigen::VectorXd u = solve(K, force_of(b, s), b.fixed(s), Eigen::VectorXd::Zero(K.rows()));
  return u.segment<3>(6 * node_at(s, b.measured.at)).dot(b.measured.force) / b.reference;
}

/// Regular and distorted, quadrilaterals and triangles; 0: not computed there.
struct Expected {
  double quads, distorted_quads, triangles, distorted_triangles;
};

/// Both programs have the same terms, apart from the axes in which strains of a warped cell are
/// enhanced and the triangle's bubble on curved cells: less than the tolerance.
void expect_ratios(const std::string& name, const Benchmark& b, int n, const Expected& expected) {
  constexpr double kTolerance = 1e-3;
  const auto checked = [&](Cells cells, bool distorted, double value) -> std::string {
    if (value == 0.0) return "";
    const double ratio = ratio_of(b, n, cells, distorted);
    EXPECT_NEAR(ratio, value, kTolerance) << name;
    return fmt::format("{:.4f}", ratio);
  };
  // Quadratic ones, which were written here alone: printed, and compared with the published value
  // below.
  const auto quadratic = [&](Cells cells, bool distorted, double linear) -> std::string {
    return linear == 0.0 ? "" : fmt::format("{:.4f}", ratio_of(b, n, cells, distorted));
  };
  fmt::print("| {}, n = {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name, n,
             checked(Cells::kQuads, false, expected.quads),
             checked(Cells::kQuads, true, expected.distorted_quads),
             checked(Cells::kTriangles, false, expected.triangles),
             checked(Cells::kTriangles, true, expected.distorted_triangles),
             quadratic(Cells::kQuads8, false, expected.quads),
             quadratic(Cells::kQuads8, true, expected.distorted_quads),
             quadratic(Cells::kTriangles6, false, expected.triangles),
             quadratic(Cells::kTriangles6, true, expected.distorted_triangles));
}

TEST(ShellBenchmark, ScordelisLoRoof) {
  expect_ratios("Scordelis-Lo roof", scordelis_lo(), 8, {1.00565, 1.18116, 0.86410, 0.98475});
}

TEST(ShellBenchmark, PinchedCylinder) {
  expect_ratios("pinched cylinder", pinched_cylinder(), 16, {0.93312, 0.79202, 0.89784, 0.68503});
}

TEST(ShellBenchmark, HemisphereWithAHole) {
  expect_ratios("hemisphere", hemisphere(), 8, {1.01200, 0.98356, 1.00272, 0.90413});
}

TEST(ShellBenchmark, TwistedBeam) {
  expect_ratios("twisted beam, in plane", twisted_beam(false, true), 4,
                {0.99749, 0.95886, 0.99070, 0.58152});
  expect_ratios("twisted beam, out of plane", twisted_beam(false, false), 4,
                {0.99678, 0.85554, 0.92527, 0.28465});
}

TEST(ShellBenchmark, ThinTwistedBeam) {
  expect_ratios("thin twisted beam, in plane", twisted_beam(true, true), 8,
                {0.99825, 0.77636, 0.99350, 0.29680});
  expect_ratios("thin twisted beam, out of plane", twisted_beam(true, false), 8,
                {0.99831, 0.63816, 0.99570, 0.09413});
}

TEST(ShellBenchmark, RaaschHook) {
  expect_ratios("Raasch hook", raasch_hook(), 8, {0.98330, 0.0, 0.97857, 0.0});
  expect_ratios("Raasch hook", raasch_hook(), 16, {0.99666, 0.0, 0.99286, 0.0});
}

TEST(ShellBenchmark, HalfClampedHypar) {
  expect_ratios("hypar, L/t = 100", hypar(1e2, 9.3355e-5), 16,
                {0.97595, 0.95668, 0.89655, 0.80518});
  expect_ratios("hypar, L/t = 1000", hypar(1e3, 6.3941e-3), 16,
                {0.96434, 0.91855, 0.89156, 0.73974});
  expect_ratios("hypar, L/t = 10000", hypar(1e4, 0.52988), 16,
                {0.97961, 0.83731, 0.91051, 0.68497});
}

TEST(ShellBenchmark, QuadraticCellsReachThePublishedValues) {
  const auto expect_reached = [](const Benchmark& b, int n, double quads, double triangles) {
    EXPECT_NEAR(ratio_of(b, n, Cells::kQuads8, false), 1.0, quads);
    EXPECT_NEAR(ratio_of(b, n, Cells::kTriangles6, false), 1.0, triangles);
  };
  // By MacNeal and Harder 0.3024 is a little more than the limit of shell theory, 0.3008.
  expect_reached(scordelis_lo(), 16, 7e-3, 7e-3);
  expect_reached(pinched_cylinder(), 16, 2e-3, 0.1);
  expect_reached(hemisphere(), 16, 8e-3, 0.03);
  expect_reached(twisted_beam(false, true), 8, 3e-3, 3e-3);
  expect_reached(twisted_beam(false, false), 8, 2e-3, 2e-3);
  expect_reached(twisted_beam(true, true), 8, 2e-3, 0.07);
  expect_reached(twisted_beam(true, false), 8, 2e-3, 0.07);
  expect_reached(raasch_hook(), 16, 2e-3, 2e-3);
  expect_reached(hypar(1e2, 9.3355e-5), 32, 0.01, 0.03);
  expect_reached(hypar(1e3, 6.3941e-3), 32, 0.015, 0.1);
}

TEST(ShellBenchmark, DrillingChangesNoDigit) {
  // On curved sheet it shrinks with the angles between the cells: here 10 degrees.
  constexpr double kTolerance = 2e-4;
  for (const Benchmark& b : {scordelis_lo(), hemisphere(), twisted_beam(true, false)})
    for (const Cells cells : {Cells::kQuads, Cells::kTriangles})
      EXPECT_NEAR(ratio_of(b, 8, cells, false, 1e-6) / ratio_of(b, 8, cells, false), 1.0,
                  kTolerance);
}

}  // namespace
}  // namespace clatter::fe::testing
