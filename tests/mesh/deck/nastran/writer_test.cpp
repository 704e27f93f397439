// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <sstream>

#include "mesh/deck/field_text.hpp"
#include "mesh/deck/nastran/number.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/mesh/deck/sheet_mesh.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::test {
namespace {

using mesh::CellType;
using mesh::Mesh;
using mesh::deck::nastran_number;
using mesh::deck::to_number;
using testing::HasSubstr;

TEST(NastranReal, IsShortAndHasAPoint) {
  EXPECT_EQ(nastran_number(5.0, 16), "5.");
  EXPECT_EQ(nastran_number(-0.25, 16), "-.25");
  EXPECT_EQ(nastran_number(0.0, 16), "0.");
  EXPECT_EQ(nastran_number(-2.5e-7, 16), "-2.5-7");
  EXPECT_EQ(nastran_number(1e23, 16), "1.+23");
  EXPECT_EQ(nastran_number(0.1 + 0.2, 16), ".3");
  EXPECT_EQ(nastran_number(1.0 / 3.0, 8), ".3333333");
  EXPECT_EQ(nastran_number(-1e5 / 3.0, 8), "-33333.3");
  EXPECT_EQ(nastran_number(99999999.96, 8), "1.+8");
  EXPECT_EQ(nastran_number(-2e-7 / 3.0, 8), "-6.667-8");
}

TEST(NastranReal, SixteenColumnsLoseNoMoreThanTheyMust) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  double worst = 0.0, worst_of_coordinates = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const int exponent = i % 80 - 40;
    const double value = mantissa(random) * std::pow(10.0, exponent);
    const std::string text = nastran_number(value, 16);
    ASSERT_LE(text.size(), 16u);
    const auto back = to_number(text);
    ASSERT_TRUE(back.has_value()) << text;
    const double loss = std::abs(*back - value) / std::abs(value);
    worst = std::max(worst, loss);
    if (std::abs(value) > 1e-3 && std::abs(value) < 1e6) {
      worst_of_coordinates = std::max(worst_of_coordinates, loss);
    }
  }
  // Half a unit of the eleventh digit after the first: -1.2345678901-40.
  EXPECT_LE(worst, 0.5e-10);
  // Half a unit of the twelfth: -.00123456789012.
  EXPECT_LE(worst_of_coordinates, 0.5e-11);
}

// The content of a mesh in a fixed order: blocks by region and type.
void expect_same(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.nodes.rows(), b.nodes.rows());
  EXPECT_EQ((a.nodes.array() == b.nodes.array()).all(), true);  // the same bits
  EXPECT_EQ(a.regions, b.regions);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (size_t i = 0; i < a.cells.size(); ++i) {
    EXPECT_EQ(a.cells[i].type, b.cells[i].type);
    EXPECT_EQ(a.cells[i].region, b.cells[i].region);
    EXPECT_EQ(a.cells[i].nodes, b.cells[i].nodes);
    if (!a.cells[i].ids.empty()) {
      EXPECT_EQ(a.cells[i].ids, b.cells[i].ids);
    }
  }
  EXPECT_EQ(a.node_sets, b.node_sets);
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  for (const auto& [name, surface] : a.surfaces) {
    const auto& other = b.surface(name);
    ASSERT_EQ(surface.faces.size(), other.faces.size()) << name;
    for (size_t i = 0; i < surface.faces.size(); ++i) {
      EXPECT_EQ(surface.faces[i].type, other.faces[i].type);
      EXPECT_EQ(surface.faces[i].nodes, other.faces[i].nodes) << name;
    }
  }
}

Mesh written_and_read(const Mesh& mesh) {
  std::ostringstream out;
  mesh::deck::write_nastran(mesh, out);
  return read_deck(out.str()).mesh;
}

class NastranRoundTrip : public testing::TestWithParam<CellType> {};

TEST_P(NastranRoundTrip, GivesTheSameMesh) {
  // Coordinates with all digits: thirds, rotated.
  const auto map = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x[0] / 3 - 0.1 * x[1], x[1] * 1e-3 + 0.7 * x[2], x[2] / 7 - 100.0);
  };
  assembly::testing::BlockOptions options;
  options.type = GetParam();
  Mesh mesh = assembly::testing::block_mesh({3, 2, 2}, map, options);
  mesh.node_sets["one corner, spaces in its name"] = {0};
  const Mesh back = written_and_read(mesh);
  expect_same(mesh, back);
  for (Eigen::Index n = 0; n < back.nodes.rows(); ++n) {
    EXPECT_EQ(back.node_ids[n], n + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(All, NastranRoundTrip,
                         testing::Values(CellType::kTet4, CellType::kTet10, CellType::kHex8,
                                         CellType::kHex20, CellType::kWedge6, CellType::kWedge15,
                                         CellType::kPyramid5, CellType::kPyramid13),
                         [](const auto& info) {
                           return std::string(mesh::traits(info.param).name);
                         });

TEST(NastranWriter, KeepsNumbersHoweverLarge) {
  for (const int32_t step : {7, 2000000}) {  // the second needs large fields
    Mesh mesh = assembly::testing::block_mesh({2, 2, 2}, assembly::testing::brick({1, 2, 3}));
    for (Eigen::Index n = mesh.nodes.rows(); n > 0; --n) {
      mesh.node_ids.push_back(static_cast<int32_t>(n) * step + 3);
    }
    for (auto& block : mesh.cells) {
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        block.ids.push_back(static_cast<int32_t>(c) * 31 + 2);
      }
    }
    const Mesh back = written_and_read(mesh);
    expect_same(mesh, back);
    EXPECT_EQ(mesh.node_ids, back.node_ids);
  }
}

TEST(NastranWriter, ShellsComeBackWithTheirThicknessOffsetAndSurfaces) {
  const Mesh mesh = mesh::testing::cube_and_sheet();
  std::ostringstream out;
  mesh::deck::write_nastran(mesh, out);
  EXPECT_THAT(out.str(), HasSubstr("\n$ clatter region 2 sheet\n"
                                   "PSHELL  2       1               1               1\n"));
  EXPECT_THAT(out.str(), HasSubstr("\nCTRIA3  71      2       73      64      70      \n"));
  const mesh::deck::Deck deck = read_deck(out.str());
  EXPECT_EQ(deck.mesh.node_ids.back(), 58);
  expect_same(mesh, deck.mesh);
  mesh::testing::expect_same_shells(mesh, deck.mesh);
  EXPECT_TRUE(deck.materials.empty());
  EXPECT_EQ(deck.regions.at(2).material, "");
}

TEST(NastranWriter, ShellsOfOneNumberGetNumbersOfTheirOwn) {
  Mesh mesh = mesh::testing::cube_and_sheet();
  mesh.shells[0].ids = {70};
  mesh.shells[2].ids = {9};  // as the cube
  const Mesh back = written_and_read(mesh);
  EXPECT_EQ(back.cells.at(0).ids.at(0), 9);
  EXPECT_EQ(back.shells.at(0).ids.at(0), 70);
  EXPECT_EQ(back.shells.at(1).ids.at(0), 71);
  EXPECT_EQ(back.shells.at(2).ids.at(0), 72);
}

TEST(NastranWriter, MaterialsThatTheUserAddsAreThoseOfTheShells) {
  std::ostringstream out;
  mesh::deck::write_nastran(mesh::testing::cube_and_sheet(), out);
  std::string deck = out.str();
  deck.insert(deck.find("ENDDATA"), "MAT1,1,210.,,.3\n");
  EXPECT_THAT(refusal(deck), HasSubstr("CTRIA3 71: found a thickness of 0, expected more than 0"));
  deck.replace(deck.find("PSHELL  2"), 32, "PSHELL  2       1       .002    ");
  const mesh::deck::Deck read = read_deck(deck);
  EXPECT_EQ(read.shells.at(0).section.thickness, 0.002);
  EXPECT_EQ(read.regions.at(1).material, "mat_1");
}

TEST(NastranWriter, OtherProgramsReadPlainCards) {
  Mesh mesh = read_deck(kTet).mesh;
  mesh.nodes(3, 2) = 1.0 / 3.0;
  std::ostringstream out;
  mesh::deck::write_nastran(mesh, out);
  EXPECT_THAT(
      out.str(),
      HasSubstr("\n$ clatter at 4 0 0 0.3333333333333333\n"
                "GRID*   4                               0.              0.              *\n"
                "*       .333333333333333\n"));
  EXPECT_THAT(out.str(), HasSubstr("\nCTETRA  1       1       1       2       3       4       \n"));
}

TEST(NastranWriter, ACardThatWasChangedCountsMoreThanItsComment) {
  const std::string card = "$ clatter at 1 0.1 0 0\nGRID,1,,";
  std::string deck = kTet;
  deck.replace(deck.find("GRID,1,,0."), 10, card + ".1");
  EXPECT_EQ(read_deck(deck).mesh.nodes(0, 0), 0.1);
  deck.replace(deck.find("0.1 0 0"), 7, "0.10000000000000003 0 0");
  EXPECT_EQ(read_deck(deck).mesh.nodes(0, 0), 0.10000000000000003);
  deck.replace(deck.find(",.1,"), 4, ",.2,");
  EXPECT_EQ(read_deck(deck).mesh.nodes(0, 0), 0.2);
}

TEST(NastranWriter, IsTheExportToBdf) {
  const auto file = test::scratch_path("export.bdf");
  const Mesh mesh = read_deck(kTet).mesh;
  mesh::export_mesh(mesh, file);
  expect_same(mesh, mesh::deck::read_nastran(file).mesh);
  std::filesystem::remove(file);
}

TEST(NastranWriter, WritesCompleteFilesOrNone) {
  const auto folder = test::scratch_path("nastran_writer");
  std::filesystem::create_directories(folder);
  const Mesh mesh = read_deck(kTet).mesh;
  mesh::deck::write_nastran(mesh, folder / "a.bdf");
  expect_same(mesh, mesh::deck::read_nastran(folder / "a.bdf").mesh);
  test::expect_parts(test::refusal_of<FileError>(
                         [&] { mesh::deck::write_nastran(mesh, folder / "absent" / "a.bdf"); }),
                     {"absent/a.bdf: cannot be written (folder missing or disk full?)"});
  Mesh wrong = mesh;
  wrong.node_ids[0] = 0;
  test::expect_parts(test::refusal_of([&] { mesh::deck::write_nastran(wrong, folder / "b.bdf"); }),
                     {"found the number 0, Nastran expects 1 or more"});
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

TEST(NastranWriter, HangingMidSideNodesKeepTheirNumbersWithoutTheGridsThatNoCellUses) {
  const Mesh mesh = read_deck(
                        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
                        "GRID,5,,.5,0.,0.\nGRID,80,,9.,0.,0.\nCTETRA,7,1,1,2,3,4,5\n")
                        .mesh;
  ASSERT_THAT(mesh.node_ids, testing::ElementsAre(1, 2, 3, 4, 5, 81, 82, 83, 84, 85));
  std::ostringstream out;
  mesh::deck::write_nastran(mesh, out);
  const Mesh again = read_deck(out.str()).mesh;
  EXPECT_EQ(again.node_ids, mesh.node_ids);
  EXPECT_EQ(again.nodes, mesh.nodes);
  EXPECT_EQ(again.node_sets, mesh.node_sets);
}

TEST(NastranWriter, OmitsHangingMidSideNodes) {
  const Mesh mesh = read_deck(
                        "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
                        "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\nGRID,8,,0.,0.,.5\n"
                        "CTETRA,7,1,1,2,3,4,5,6,+\n+,7,8\n")
                        .mesh;
  ASSERT_EQ(mesh.node_sets.at(mesh::kHangingMidSideNodes).size(), 2U);
  std::ostringstream out;
  mesh::deck::write_nastran(mesh, out);
  EXPECT_THAT(out.str(), HasSubstr("$ clatter hanging 9\n"));
  const Mesh again = read_deck(out.str()).mesh;
  EXPECT_EQ(again.nodes, mesh.nodes);
  EXPECT_EQ(again.node_ids, mesh.node_ids);
  EXPECT_EQ(again.cells.at(0).nodes, mesh.cells.at(0).nodes);
  EXPECT_EQ(again.node_sets, mesh.node_sets);

  // In other formats they are ordinary nodes, with a warning.
  const auto deck = std::filesystem::path(testing::TempDir()) / "clatter_hanging.inp";
  testing::internal::CaptureStderr();
  mesh::export_mesh(mesh, deck);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("the 2 mid-side nodes of the set"));
  std::filesystem::remove(deck);
}

}  // namespace
}  // namespace clatter::test
