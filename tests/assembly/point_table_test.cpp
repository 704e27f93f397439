// SPDX-License-Identifier: GPL-3.0-or-later
// Tables of values at points: temperatures, pressures, films and fluxes at nodes.
#include "assembly/recipe/point_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "core/base/log.hpp"
#include "core/fe/fe_model.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"
#include "warm_wall.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellType;

/// `count` random points in a box from `low`, of `size`.
RowMatrix cloud(Eigen::Index count, const Eigen::RowVector3d& low, const Eigen::RowVector3d& size,
                unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RowMatrix points(count, 3);
  for (double& x : points.reshaped()) x = unit(random);
  return (points.array().rowwise() * size.array()).matrix().rowwise() + low;
}

TEST(PointTable, LinearFieldsAreInterpolatedExactly) {
  PointTable table{cloud(200, {0, 0, 0}, {1, 1, 1}, 5), {}};
  const RowMatrix nodes = cloud(50, {0, 0, 0}, {1, 1, 1}, 6);
  Eigen::Matrix<double, 3, 2> slope;
  slope << 30.0, 1e5, -20.0, 3e5, 50.0, -2e5;
  const Eigen::RowVector2d at_origin(300.0, 1e6), scale(100.0, 1e6);
  const auto error = [&](const RowMatrix& exact) {
    return ((values_at(table, nodes).values - exact).array().rowwise() / scale.array())
        .abs()
        .maxCoeff();
  };
  table.values = (table.points * slope).rowwise() + at_origin;
  EXPECT_LT(error((nodes * slope).rowwise() + at_origin), 1e-11);
  EXPECT_LT(values_at(table, nodes).residuals.cwiseQuotient(scale).maxCoeff(), 1e-11);
  // Points in a plane: the field of the plane, constant across it.
  table.points.col(2).setZero();
  table.values = (table.points * slope).rowwise() + at_origin;
  EXPECT_LT(error((nodes.leftCols(2) * slope.topRows(2)).rowwise() + at_origin), 1e-10);
  // One point: its values everywhere.
  const PointTable one{RowMatrix::Zero(1, 3), RowMatrix::Constant(1, 2, 333.0)};
  EXPECT_LT((values_at(one, nodes).values.array() - 333.0).abs().maxCoeff(), 1e-12);
}

// The eight nearest points lie in one plane wherever planes are farther apart than points in them.
TEST(PointTable, HardF15_GradientsAcrossPlanesOfPointsAreExact) {
  PointTable table{RowMatrix(13 * 17 * 10, 3), {}};
  Eigen::Index k = 0;
  for (int plane = 0; plane < 13; ++plane)
    for (int i = 0; i < 17; ++i)
      for (int j = 0; j < 10; ++j) table.points.row(k++) << 2.5 * i, 4.4 * j, 10.0 * plane;
  table.values = (table.points.col(2) * (100.0 / 120.0)).array() + 300.0;
  const RowMatrix nodes = cloud(60, {0, 0, -2}, {40.0, 39.6, 124.0}, 7);
  const Eigen::VectorXd exact = (nodes.col(2) * (100.0 / 120.0)).array() + 300.0;
  const TableValues found = values_at(table, nodes);
  EXPECT_LT((found.values.col(0) - exact).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT(found.farthest, 4.0);
  EXPECT_LT(found.farthest, std::hypot(1.25, 2.2, 5.0));
}

// Halved distances of points: a quarter of the error and of the residual.
TEST(PointTable, TheErrorOfAQuadraticFieldIsOfSecondOrderAndTheResidualShowsIt) {
  const auto field = [](const RowMatrix& x) -> Eigen::VectorXd {
    return 40.0 * x.col(0).array().square() - 30.0 * x.col(1).array() * x.col(2).array();
  };
  const RowMatrix nodes = cloud(200, {0.3, 0.3, 0.3}, {0.4, 0.4, 0.4}, 8);
  std::vector<double> errors, residuals;
  for (const int n : {10, 20}) {
    PointTable table{RowMatrix((n + 1) * (n + 1) * (n + 1), 3), {}};
    for (Eigen::Index k = 0; k < table.points.rows(); ++k)
      table.points.row(k) << double(k % (n + 1)) / n, double(k / (n + 1) % (n + 1)) / n,
          double(k / (n + 1) / (n + 1)) / n;
    table.values = field(table.points);
    const TableValues found = values_at(table, nodes);
    errors.push_back((found.values.col(0) - field(nodes)).cwiseAbs().maxCoeff());
    residuals.push_back(found.residuals(0));
  }
  // The largest of 200 errors has some scatter: orders of 1.6 to 2.4.
  for (const auto& sizes : {errors, residuals}) {
    EXPECT_GT(sizes[0] / sizes[1], 3.0);
    EXPECT_LT(sizes[0] / sizes[1], 5.3);
  }
  EXPECT_LT(errors[0], 4.0 * residuals[0]);
}

class PointTableFile : public ::testing::Test {
 protected:
  void SetUp() override { path_ = test::scratch_path("table.csv"); }
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  /// A row of values at each point.
  void write(const std::string& columns, const RowMatrix& points,
             const std::function<std::string(const Eigen::RowVector3d&)>& row) const {
    std::string text = "x,y,z," + columns + "\n";
    for (const auto& x : points.rowwise())
      text += fmt::format("{:.17g},{:.17g},{:.17g},{}\n", x(0), x(1), x(2), row(x));
    write(text);
  }
  std::string pressure() const {
    return kIron +
           "[[load]]\nname = \"p\"\nkind = \"pressure\"\nsurface = \"z1\"\n"
           "table = \"" +
           path_.string() + "\"\n";
  }
  std::string refused(const std::string& toml) const {
    return test::refusal_of([&] { build_all(wall_of(CellType::kTet10), toml); });
  }
  std::filesystem::path path_;
};

// p = p0 + a x + b y on the face 0.1 x 0.2 at z = 0.4: resultant and moments about the origin in
// closed form. The cloud of points holds no node.
TEST_F(PointTableFile, HardF15_ALinearPressureHasItsResultantAndMoments) {
  const double p0 = 2e5, a = 3e6, b = -1e6, lx = 0.1, ly = 0.2;
  write("pressure", cloud(400, {-0.02, -0.02, 0.38}, {0.14, 0.24, 0.04}, 11),
        [&](const Eigen::RowVector3d& x) {
          return fmt::format("{:.17g}", p0 + a * x(0) + b * x(1));
        });
  for (const CellType type : {CellType::kTet10, CellType::kHex8, CellType::kHex20}) {
    const fe::FeModel model = build_all(wall_of(type), pressure()).model;
    EXPECT_EQ(model.load_units.at("p"), "1");
    const Eigen::VectorXd sum = model.rigid.transpose() * model.loads.at("p");
    const double force = lx * ly * (p0 + a * lx / 2 + b * ly / 2);
    EXPECT_NEAR(sum(2), -force, 1e-9 * force);
    EXPECT_NEAR(sum.head(2).norm(), 0.0, 1e-9 * force);
    const double about_x = lx * ly * (p0 * ly / 2 + a * lx * ly / 4 + b * ly * ly / 3);
    const double about_y = lx * ly * (p0 * lx / 2 + a * lx * lx / 3 + b * lx * ly / 4);
    EXPECT_NEAR(sum(3), -about_x, 1e-9 * force);
    EXPECT_NEAR(sum(4), about_y, 1e-9 * force);
    EXPECT_NEAR(sum(5), 0.0, 1e-9 * force);
  }
}

TEST_F(PointTableFile, OfAPressureSaysItsDistanceAndResidualAndWarnsWhereItIsCoarse) {
  const auto said = [&](const std::function<double(double)>& p) {
    write("pressure", cloud(60, {0, 0, 0.4}, {0.1, 0.2, 0}, 12),
          [&](const Eigen::RowVector3d& x) { return fmt::format("{:.17g}", p(x(1))); });
    std::string lines;
    set_log_sink([&](bool warning, const std::string& line) {
      lines += (warning ? "warning: " : "") + line + "\n";
    });
    build_all(wall_of(CellType::kTet10), pressure());
    set_log_sink({});
    return lines;
  };
  const std::string smooth = said([](double y) { return 1e6 * y; });
  EXPECT_NE(smooth.find(": pressure: nodes are at most "), std::string::npos) << smooth;
  EXPECT_NE(smooth.find(" mm from a point; linear fits to the points leave at most "),
            std::string::npos)
      << smooth;
  EXPECT_EQ(smooth.find("coarse"), std::string::npos) << smooth;
  // A constant pressure leaves rounding only.
  EXPECT_EQ(said([](double) { return 3e5; }).find("coarse"), std::string::npos);
  const std::string rough = said([](double y) { return 1e5 * std::sin(400.0 * y); });
  EXPECT_NE(rough.find("warning: clatter"), std::string::npos) << rough;
  EXPECT_NE(rough.find("the table is coarse for its field"), std::string::npos) << rough;
}

// Coefficient and temperature linear along x: the same field as of lists at positions.
TEST_F(PointTableFile, OfAFilmAndAFluxGivesTheHeatOfTheSameLinearProfiles) {
  const std::string start = kIron + "[[heat]]\nname = \"warm\"\n";
  const std::string lists = start + R"(
[[heat.film]]
surface = "z0"
coefficient = [300.0, 800.0]
temperature_c = [20.0, 90.0]
along = [1.0, 0.0, 0.0]
at = [0.0, 0.1]
[[heat.flux]]
surface = "z1"
flux = [1e4, 5e4]
along = [1.0, 0.0, 0.0]
at = [0.0, 0.1]
)";
  const std::filesystem::path flux = test::scratch_path("flux.csv");
  const RowMatrix points = cloud(300, {-0.01, -0.02, -0.02}, {0.12, 0.24, 0.04}, 13);
  std::ofstream(flux) << "x,y,z,flux\n0,0,0.4,1e4\n0,0.2,0.4,1e4\n0.1,0,0.4,5e4\n";
  write("coefficient,temperature_c", points, [](const Eigen::RowVector3d& x) {
    return fmt::format("{:.17g},{:.17g}", 300.0 + 5000.0 * x(0), 20.0 + 700.0 * x(0));
  });
  const std::string tables = start + fmt::format(
                                         "[[heat.film]]\nsurface = \"z0\"\ntable = \"{}\"\n"
                                         "[[heat.flux]]\nsurface = \"z1\"\ntable = \"{}\"\n",
                                         path_.string(), flux.string());
  for (const CellType type : {CellType::kTet10, CellType::kHex8}) {
    const mesh::Mesh mesh = wall_of(type);
    const fe::HeatField expected = build_all(mesh, lists).model.heat.at("warm");
    const fe::HeatField found = build_all(mesh, tables).model.heat.at("warm");
    EXPECT_LT((found.temperature - expected.temperature).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((found.heat - expected.heat).cwiseAbs().maxCoeff(),
              1e-9 * expected.heat.cwiseAbs().maxCoeff());
  }
  std::filesystem::remove(flux);
}

// Beyond the points a line through 900 and 100 W/(m2 K) falls below 0.
TEST_F(PointTableFile, OfAFilmHasNoCoefficientBelowItsLeast) {
  write("coefficient,temperature_c", cloud(80, {0, 0, -0.01}, {0.03, 0.2, 0.02}, 14),
        [](const Eigen::RowVector3d& x) { return fmt::format("{:.17g},80", 900 - 26000 * x(0)); });
  const std::string toml = kIron +
                           "[[heat]]\nname = \"w\"\n[[heat.film]]\nsurface = \"z0\"\ntable = \"" +
                           path_.string() + "\"\n[[heat.flux]]\nsurface = \"z1\"\nflux = 1000.0\n";
  const fe::HeatField field = build_all(wall_of(CellType::kTet10), toml).model.heat.at("w");
  // Heat flows out through the film only where the wall is warmer than 80 degrees: everywhere.
  EXPECT_GT(field.temperature.minCoeff(), 273.15 + 80.0);
}

TEST_F(PointTableFile, ThatIsWrongIsRefusedWithTheWayOut) {
  write("x,y,z,p\n0,0,0.4,1\n");
  test::expect_parts(refused(pressure()),
                     {".csv:1: found \"x,y,z,p\"", "the header \"x,y,z,pressure\""});
  write("x,y,z,pressure\n0,0,400,1\n0,1,400,2\n");
  test::expect_parts(refused(pressure()), {"table: a node lies ", "farther than the part is large",
                                           "another length_unit?"});
  const std::string film = kIron +
                           "[[heat]]\nname = \"w\"\n[[heat.film]]\nsurface = \"z0\"\n"
                           "table = \"" +
                           path_.string() + "\"\n";
  write("x,y,z,coefficient,temperature_c\n0,0,0,0,20\n");
  test::expect_parts(refused(film), {".csv:2: found 0 W/(m2 K), expected above 0"});
  write("x,y,z,coefficient,temperature_c\n0,0,0,50,-300\n");
  test::expect_parts(refused(film), {"found -300 degrees Celsius, expected at least -273.15"});
  test::expect_parts(refused(film + "coefficient = 5.0\n"),
                     {"table: coefficient and table exclude each other"});
  test::expect_parts(refused(kIron + "[[heat]]\nname = \"w\"\n[[heat.flux]]\nsurface = \"z0\"\n"
                                     "flux = 1.0\ntable = \"x.csv\"\n"),
                     {"table: flux and table exclude each other"});
}

}  // namespace
}  // namespace clatter::assembly::testing
