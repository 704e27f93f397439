// SPDX-License-Identifier: GPL-3.0-or-later
// Gmsh files: all cells, both versions, text and binary; what a physical group may say (hard case
// G4) and what is refused.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/base/error.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/deck/msh/reader.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "mesh/repair/quality.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using assembly::testing::block_mesh;
using assembly::testing::brick;
using testing::Folder;

const UnitSystem kSi;

deck::Deck read(const std::filesystem::path& path, const std::vector<std::string>& ignore = {}) {
  return read_mesh_file(path, kSi, {ignore});
}

deck::Deck read_text(const std::string& text, const std::vector<std::string>& ignore = {}) {
  const Folder folder;
  std::ofstream(folder / "part.msh") << text;
  return read(folder / "part.msh", ignore);
}

void expect_refused(const std::string& text, const std::string& part,
                    const std::vector<std::string>& ignore = {}) {
  try {
    read_text(text, ignore);
    ADD_FAILURE() << "expected: " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

// A brick with two regions, numbers with holes, surfaces and node sets that share nodes.
Mesh numbered_mesh(CellType type) {
  assembly::testing::BlockOptions options;
  options.type = type;
  Mesh mesh = block_mesh({3, 2, 2}, brick({0.3, 0.2, 0.1}), options);
  const Eigen::Index half = mesh.cells[0].nodes.rows() / 2;
  CellBlock second{type, 1, mesh.cells[0].nodes.bottomRows(half), {}};
  mesh.cells[0].nodes.conservativeResize(mesh.cells[0].nodes.rows() - half, Eigen::NoChange);
  mesh.cells.push_back(second);
  mesh.regions = {"liner, grey iron", "block"};
  int32_t id = 10;
  for (CellBlock& block : mesh.cells)
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) block.ids.push_back(id += 3);
  for (Eigen::Index n = 0; n < mesh.nodes.rows(); ++n)
    mesh.node_ids.push_back(100 + 7 * static_cast<int32_t>(n));
  mesh.node_sets = {{"corner", {0}}, {"x0", nodes_of(mesh.surface("x0"))}};
  return mesh;
}

void expect_same(const Mesh& found, const Mesh& expected) {
  // Ours are written with all digits, Gmsh's with 16.
  EXPECT_LT((found.nodes - expected.nodes).lpNorm<Eigen::Infinity>(), 1e-16);
  EXPECT_EQ(found.node_ids, expected.node_ids);
  EXPECT_EQ(found.regions, expected.regions);
  ASSERT_EQ(found.cells.size(), expected.cells.size());
  for (size_t b = 0; b < found.cells.size(); ++b) {
    EXPECT_EQ(found.cells[b].type, expected.cells[b].type);
    EXPECT_EQ(found.cells[b].region, expected.cells[b].region);
    EXPECT_EQ(found.cells[b].ids, expected.cells[b].ids);
    EXPECT_EQ(found.cells[b].nodes, expected.cells[b].nodes);
  }
  EXPECT_EQ(found.node_sets, expected.node_sets);
  ASSERT_EQ(found.surfaces.size(), expected.surfaces.size());
  for (const auto& [name, surface] : expected.surfaces) {
    const SurfaceIntegrals a = integrate(found, found.surface(name)),
                           b = integrate(expected, surface);
    EXPECT_EQ(nodes_of(found.surface(name)), nodes_of(surface)) << name;
    EXPECT_EQ(found.surface(name).face_count(), surface.face_count()) << name;
    EXPECT_LT((a.normal - b.normal).norm(), 1e-15) << name;  // sums in another order
  }
}

TEST(Quality, EachCellTypeHasAHistogramAndTheWorstCellsComeFirst) {
  for (int t = 0; t < kCellTypes; ++t) {
    const auto type = static_cast<CellType>(t);
    Mesh mesh = numbered_mesh(type);
    const QualityReport report = measure_quality(mesh);
    ASSERT_EQ(report.scaled_jacobian.by_type.size(), 1u);
    EXPECT_EQ(report.scaled_jacobian.by_type.at(type), report.scaled_jacobian.histogram);
    EXPECT_EQ(report.scaled_jacobian.histogram.back(), mesh.cell_count()) << traits(type).name;
  }
  Mesh mesh = numbered_mesh(CellType::kHex8);
  const int32_t node = mesh.cells[1].nodes(5, 6);  // a corner of the last cell, pushed inward
  mesh.nodes.row(node) += 0.4 * (mesh.nodes.row(mesh.cells[1].nodes(5, 0)) - mesh.nodes.row(node));
  const Measure found = measure_quality(mesh).scaled_jacobian;
  ASSERT_EQ(found.worst_cells.size(), kWorstCells);
  EXPECT_EQ(found.worst_cells[0].label, mesh.cells[1].ids[5]);
  EXPECT_EQ(found.worst_cells[0].value, found.worst);
  EXPECT_LT(found.worst, 0.7);
  for (size_t i = 1; i < kWorstCells; ++i)
    EXPECT_GE(found.worst_cells[i].value, found.worst_cells[i - 1].value);
}

class MshOfAll : public ::testing::TestWithParam<int> {};

// Gmsh renumbers when it writes only groups: its nodes in our order, by position.
void take_numbers(Mesh& found, const Mesh& expected) {
  std::vector<int32_t> row(static_cast<size_t>(found.nodes.rows()), -1);
  for (Eigen::Index n = 0; n < found.nodes.rows(); ++n)
    for (Eigen::Index k = 0; k < expected.nodes.rows(); ++k)
      if ((found.nodes.row(n) - expected.nodes.row(k)).norm() < 1e-12)
        row[n] = static_cast<int32_t>(k);
  const auto renumber = [&](IndexMatrix& table) {
    for (Eigen::Index i = 0; i < table.size(); ++i) table.data()[i] = row[table.data()[i]];
  };
  for (size_t b = 0; b < found.cells.size(); ++b) {
    renumber(found.cells[b].nodes);
    found.cells[b].ids = expected.cells[b].ids;
  }
  for (auto& [name, surface] : found.surfaces)
    for (FaceBlock& block : surface.faces) renumber(block.nodes);
  for (auto& [name, set] : found.node_sets) {
    for (int32_t& n : set) n = row[n];
    std::sort(set.begin(), set.end());
  }
  found.nodes = expected.nodes;
  found.node_ids = expected.node_ids;
}

TEST_P(MshOfAll, OurExportReadsBackWithoutLoss) {
  const Folder folder;
  const Mesh mesh = numbered_mesh(static_cast<CellType>(GetParam()));
  export_mesh(mesh, folder / "part.msh");
  expect_same(read(folder / "part.msh").mesh, mesh);
}

void write_again(const std::filesystem::path& from, const std::filesystem::path& to, double version,
                 bool binary) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::merge(from.string());
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary);
  gmsh::write(to.string());
  gmsh::finalize();
}

TEST(Msh, NumbersOfVersion4AreKept) {
  const Mesh mesh =
      read_text(
          "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 5 \"iron\"\n"
          "$EndPhysicalNames\n$Entities\n0 0 0 1\n9 0 0 0 1 1 1 1 5 0\n$EndEntities\n"
          "$Nodes\n1 4 20 50\n3 9 0 4\n50\n20\n30\n40\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
          "$Elements\n1 1 77 77\n3 9 4 1\n77 50 20 30 40\n$EndElements\n")
          .mesh;
  EXPECT_EQ(mesh.node_ids, (std::vector<int32_t>{20, 30, 40, 50}));
  EXPECT_EQ(mesh.cells[0].ids, std::vector<int32_t>{77});
  EXPECT_EQ(mesh.cells[0].nodes.row(0), Eigen::RowVector4i(3, 0, 1, 2));
}

TEST_P(MshOfAll, GmshsOwnVersion2And4TextAndBinaryAreTheSameMesh) {
  const Folder folder;
  const Mesh mesh = numbered_mesh(static_cast<CellType>(GetParam()));
  Mesh plain = mesh;  // Gmsh writes quadratic cells wrong where numbers have holes
  plain.node_ids.clear();
  for (CellBlock& block : plain.cells) block.ids.clear();
  export_mesh(plain, folder / "ours.msh");
  for (const double version : {2.2, 4.0, 4.1}) {
    for (const bool binary : {false, true}) {
      if (version == 4.0 && binary) continue;  // which Gmsh does not write
      SCOPED_TRACE(std::to_string(version) + (binary ? " binary" : " text"));
      write_again(folder / "ours.msh", folder / "gmsh.msh", version, binary);
      Mesh found = read(folder / "gmsh.msh").mesh;
      take_numbers(found, mesh);
      expect_same(found, mesh);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, MshOfAll, ::testing::Range(0, kCellTypes), [](const auto& info) {
  return std::string(traits(static_cast<CellType>(info.param)).name);
});

// Two tetrahedra on the triangle 2 3 4; node 6 belongs to no cell.
std::string two_tets(const std::string& names, const std::string& elements, int count) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + names +
         "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n6 9 9 9\n"
         "$EndNodes\n$Elements\n" +
         std::to_string(count) + "\n" + elements + "$EndElements\n";
}

TEST(MshGroups, HardG4_CellsInNoGroupAreRefusedAndTheGroupsListed) {
  const std::string text =
      two_tets("1\n3 7 \"iron\"\n", "11 4 2 7 1 1 2 3 4\n12 4 2 0 2 2 3 4 5\n", 2);
  expect_refused(text,
                 "element 12 (Tetrahedron 4) is in no group of solids, expected one of: iron");
  const deck::Deck ignored = read_text(text, {"no group"});
  EXPECT_EQ(ignored.mesh.cell_count(), 1);
  EXPECT_EQ(ignored.ignored.at("NO GROUP"), 1);
}

TEST(MshGroups, HardG4_WithoutGroupsOfSolidsAllCellsAreOneRegion) {
  const deck::Deck deck =
      read_text(two_tets("0\n", "1 4 2 0 1 1 2 3 4\n2 4 2 0 2 2 3 4 5\n3 2 2 0 1 1 3 2\n", 3));
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"solid"});
  EXPECT_EQ(deck.mesh.cell_count(), 2);
  EXPECT_EQ(deck.ignored.at("Triangle 3 in no group"), 1);
  EXPECT_EQ(deck.ignored.at("nodes that nothing uses"), 1);
}

// Gmsh gives both cells both groups here, as they share the elementary entity 1.
TEST(MshGroups, HardG4_CellsOfOneEntityKeepTheirOwnGroups) {
  const deck::Deck deck = read_text(
      two_tets("2\n3 7 \"iron\"\n3 8 \"steel\"\n", "1 4 2 7 1 1 2 3 4\n2 4 2 8 1 2 3 4 5\n", 2));
  ASSERT_EQ(deck.mesh.regions, (std::vector<std::string>{"iron", "steel"}));
  EXPECT_EQ(deck.mesh.cells[0].ids, std::vector<int32_t>{1});
  EXPECT_EQ(deck.mesh.cells[1].ids, std::vector<int32_t>{2});
}

TEST(MshGroups, HardG4_ANamedGroupOfAnotherDimensionThanItsElementsIsRefused) {
  expect_refused(two_tets("2\n3 7 \"iron\"\n2 9 \"clamp\"\n",
                          "1 4 2 7 1 1 2 3 4\n2 4 2 7 1 2 3 4 5\n3 1 2 9 1 1 2\n", 3),
                 "group 'clamp' (dimension 2, number 9) has no element");
}

TEST(MshGroups, HardG4_ACellInTwoGroupsIsRefusedUntilOneIsIgnored) {
  const Folder folder;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  const int box = gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
  gmsh::model::occ::synchronize();
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {box}), "iron");
  gmsh::model::setPhysicalName(3, gmsh::model::addPhysicalGroup(3, {box}), "everything");
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1}), "left");
  gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, {1, 2}), "sides");
  gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, {1}), "edge");
  gmsh::model::mesh::generate(3);
  gmsh::write((folder / "two.msh").string());
  gmsh::finalize();
  test::expect_parts(test::refusal_of([&] { read(folder / "two.msh"); }),
                     {"two.msh: element ",
                      "is in the groups 'iron' and 'everything', expected one: a region has one "
                      "material; --ignore one of them"});
  const Mesh mesh = read(folder / "two.msh", {"Everything"}).mesh;
  EXPECT_EQ(mesh.regions, std::vector<std::string>{"iron"});
  EXPECT_NEAR(integrate(mesh, mesh.surface("left")).area, 1.0, 1e-14);  // flat: rounding only
  EXPECT_NEAR(integrate(mesh, mesh.surface("sides")).area, 2.0, 1e-14);
  EXPECT_NEAR(integrate(mesh, mesh.surface("left")).normal.x(), -1.0, 1e-14);
  EXPECT_GE(mesh.node_set("edge").size(), 2u);
}

TEST(MshGroups, NodesOfGroupsWithoutCellsBecomePoints) {
  const deck::Deck deck =
      read_text(two_tets("2\n3 7 \"iron\"\n0 1 \"mount\"\n",
                         "1 4 2 7 1 1 2 3 4\n2 4 2 7 1 2 3 4 5\n3 15 2 1 1 6\n", 3));
  ASSERT_EQ(deck.points.size(), 1u);
  EXPECT_EQ(deck.points[0].id, 6);
  EXPECT_EQ(deck.points[0].at, Eigen::Vector3d(9, 9, 9));
  EXPECT_EQ(deck.sets.at("mount"), std::vector<int32_t>{5});
}

TEST(MshGroups, AFaceBetweenTwoRegionsKeepsItsSide) {
  const std::string head = "3\n3 7 \"iron\"\n3 8 \"steel\"\n2 9 \"joint\"\n";
  const std::string cells = "1 4 2 7 1 1 2 3 4\n2 4 2 8 2 2 3 4 5\n";
  const Mesh up = read_text(two_tets(head, cells + "3 2 2 9 1 2 3 4\n", 3)).mesh;
  const Mesh down = read_text(two_tets(head, cells + "3 2 2 9 1 2 4 3\n", 3)).mesh;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
  constexpr double kRounding = 1e-14;  // of sums of a few terms of order one
  EXPECT_LT((integrate(up, up.surface("joint")).normal - half).norm(), kRounding);
  EXPECT_LT((integrate(down, down.surface("joint")).normal + half).norm(), kRounding);
}

TEST(MshRefusals, EachNamesWhatItFound) {
  const std::string iron = "1\n3 7 \"iron\"\n", cells = "1 4 2 7 1 1 2 3 4\n2 4 2 7 1 2 3 4 5\n";
  const std::string both = "2\n3 7 \"iron\"\n2 9 \"plate\"\n";
  expect_refused(two_tets(both, cells + "3 2 2 9 1 2 3 4\n", 3), "lies within region 'iron'");
  expect_refused(two_tets(both, cells + "3 2 2 9 1 1 2 5\n", 3), "is not a face of a cell");
  expect_refused(two_tets(both, cells + "3 9 2 9 1 1 2 3 4 5 6\n", 3), "other nodes than the tri3");
  expect_refused(two_tets(iron, cells + "3 14 2 7 1 1 2 3 4 5 6 1 2 3 4 5 6 1 2\n", 3),
                 "is a Pyramid 14");
  EXPECT_EQ(read_text(two_tets(iron, cells + "3 14 2 7 1 1 2 3 4 5 6 1 2 3 4 5 6 1 2\n", 3),
                      {"pyramid 14"})
                .ignored.at("Pyramid 14"),
            1);
  expect_refused(
      two_tets("2\n3 7 \"iron\"\n3 8 \"iron\"\n", "1 4 2 7 1 1 2 3 4\n2 4 2 8 2 2 3 4 5\n", 2),
      "two groups of dimension 3");
  expect_refused(two_tets("2\n3 7 \"iron\"\n2 9 \"skin\"\n", cells + "3 2 2 9 1 1 3 2\n", 3),
                 "not the entire boundary");
  expect_refused(two_tets(iron, "1 4 2 7 1 1 2 3 4\n1 4 2 7 1 2 3 4 5\n", 2),
                 "two elements with the number 1");
  EXPECT_EQ(
      read_text(two_tets(iron, "1 4 2 7 1 1 2 4 3\n2 4 2 7 1 2 3 4 5\n", 2)).renumbered.size(),
      1u);  // left-handed
  expect_refused("SystemCall \"touch hacked\";\n", "expected a Gmsh MSH file");
  expect_refused("$MeshFormat\n1 0 8\n$EndMeshFormat\n", "MSH version 1");
}

TEST(MshRefusals, DamagedFilesNeverCrash) {
  const Folder folder;
  export_mesh(numbered_mesh(CellType::kTet4), folder / "ours.msh");
  std::mt19937 random(11);
  for (const bool binary : {false, true}) {
    for (const double version : {2.2, 4.1}) {
      write_again(folder / "ours.msh", folder / "whole.msh", version, binary);
      std::ifstream file(folder / "whole.msh", std::ios::binary);
      const std::string whole((std::istreambuf_iterator<char>(file)), {});
      for (int trial = 0; trial < 25; ++trial) {
        std::string text = whole;
        if (trial % 2 == 0) text.resize(random() % text.size());
        for (int i = 0; i < 3 && !text.empty(); ++i)
          text[random() % text.size()] = static_cast<char>(random() % 256);
        std::ofstream(folder / "bad.msh", std::ios::binary) << text;
        try {
          read(folder / "bad.msh", {"NO GROUP"});
        } catch (const Error&) {  // one line, exit code 2 or 3
        }
      }
    }
  }
}

}  // namespace
}  // namespace clatter::mesh
