// SPDX-License-Identifier: GPL-3.0-or-later
// Temperatures of loads: of a heat, by regions, from a table.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "assembly/recipe/point_table.hpp"
#include "core/fe/fe_model.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"
#include "warm_wall.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellType;

TEST(TemperatureLoad, OfAHeatIsItsTemperatureAboveTheReference) {
  const fe::FeModel model = build_all(wall_of(CellType::kTet10), kIron + kWall + R"(
[[load]]
name = "expansion"
kind = "temperature"
heat = "warm"
reference_c = 25.0
)")
                                .model;
  const Eigen::VectorXd rise = model.heat.at("warm").temperature.array() - 298.15;
  EXPECT_LT((model.temperature_rise.at("expansion") - rise).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(TemperatureLoad, ByRegionsIsConstantInEachAndTheMeanBetween) {
  mesh::Mesh mesh = wall_of(CellType::kHex8);
  // The upper third of the wall is another region.
  mesh.regions.push_back("top");
  mesh::CellBlock top = mesh.cells[0];
  const Eigen::Index third = top.nodes.rows() / 3;
  top.region = 1;
  std::vector<Eigen::Index> above, below;
  for (Eigen::Index c = 0; c < top.nodes.rows(); ++c) {
    double z = 0.0;
    for (const int32_t node : top.nodes.row(c)) z += mesh.nodes(node, 2) / 8.0;
    (z > 0.26 ? above : below).push_back(c);
  }
  ASSERT_EQ(static_cast<Eigen::Index>(above.size()), third);
  top.nodes = IndexMatrix(mesh.cells[0].nodes(above, Eigen::all));
  mesh.cells[0].nodes = IndexMatrix(mesh.cells[0].nodes(below, Eigen::all));
  mesh.cells.push_back(top);
  std::string both = kIron;
  both.replace(both.find("\"body\""), 6, "\"body\", \"top\"");
  const fe::FeModel model =
      build_all(mesh, both +
                          "[[load]]\nname = \"t\"\nkind = \"temperature\"\nregions = { body = "
                          "10.0, top = 70.0 }\n")
          .model;
  const Eigen::VectorXd& rise = model.temperature_rise.at("t");
  std::set<double> values(rise.data(), rise.data() + rise.size());
  EXPECT_EQ(values, (std::set<double>{10.0, 40.0, 70.0}));
  test::expect_parts(test::refusal_of([&] {
                       build_all(mesh, both +
                                           "[[load]]\nname = \"t\"\nkind = \"temperature\"\n"
                                           "regions = { bdoy = 10.0 }\n");
                     }),
                     {"bdoy: found \"bdoy\", expected one of: body, top"});
}

const std::vector<TableColumn> kCelsius = {{"temperature_c", "degrees Celsius", -273.15}};

class TemperatureFile : public ::testing::Test {
 protected:
  void SetUp() override { path_ = test::scratch_path("temperature.csv"); }
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  std::filesystem::path path_;
};

TEST_F(TemperatureFile, IsReadInTheUnitsOfItsHeader) {
  write("x,y,z,temperature_c\n1,2,3,20\n4, 5, 6, -3.15\n\n");
  const PointTable table = read_point_table(path_, 1e-3, kCelsius);
  EXPECT_EQ(table.points, (RowMatrix(2, 3) << 1e-3, 2e-3, 3e-3, 4e-3, 5e-3, 6e-3).finished());
  EXPECT_EQ(table.values, (RowMatrix(2, 1) << 20.0, -3.15).finished());
}

TEST_F(TemperatureFile, ThatIsDifferentIsRefusedWithItsLine) {
  const auto message = [&](const std::string& text) {
    write(text);
    return test::refusal_of([&] { read_point_table(path_, 1.0, kCelsius); });
  };
  test::expect_parts(message("x,y,z,T\n1,2,3,4\n"),
                     {".csv:1: found \"x,y,z,T\", expected the header \"x,y,z,temperature_c\""});
  test::expect_parts(message("x,y,z,temperature_c\n1,2,3\n"), {".csv:2: found 3 numbers"});
  test::expect_parts(message("x,y,z,temperature_c\n1,2,3,nan\n"), {".csv:2: found "});
  test::expect_parts(message("x,y,z,temperature_c\n1,2,3,-400\n"),
                     {".csv:2: found -400 degrees Celsius, expected at least -273.15"});
  test::expect_parts(message("x,y,z,temperature_c\n"), {"found no point, expected at least one"});
}

TEST_F(TemperatureFile, GivesTheRiseOfALoadAtTheNodes) {
  const mesh::Mesh mesh = wall_of(CellType::kTet10);
  std::string text = "x,y,z,temperature_c\n";
  for (Eigen::Index a = mesh.nodes.rows() - 1; a >= 0; --a)
    text += fmt::format("{},{},{},{}\n", mesh.nodes(a, 0), mesh.nodes(a, 1), mesh.nodes(a, 2),
                        20.0 + 7.0 * static_cast<double>(a % 13));
  write(text);
  const fe::FeModel model =
      build_all(mesh, kIron + "[[load]]\nname = \"t\"\nkind = \"temperature\"\ntable = \"" +
                          path_.string() + "\"\n")
          .model;
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    EXPECT_NEAR(model.temperature_rise.at("t")(a), 7.0 * static_cast<double>(a % 13), 1e-9);
}

TEST_F(TemperatureFile, ThatIsFarFromThePartIsRefused) {
  const mesh::Mesh mesh = wall_of(CellType::kTet10);
  write("x,y,z,temperature_c\n0,0,100,20\n1,0,100,30\n");
  test::expect_parts(
      test::refusal_of([&] {
        build_all(mesh, kIron +
                            "[[load]]\nname = \"t\"\nkind = \"temperature\"\n"
                            "table = \"" +
                            path_.string() + "\"\n");
      }),
      {"load", "table: a node lies ", "farther than the part is large", "another length_unit?"});
}

}  // namespace
}  // namespace clatter::assembly::testing
