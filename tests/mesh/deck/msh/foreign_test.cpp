// SPDX-License-Identifier: GPL-3.0-or-later
// Universal files, MED files and ANSYS archives.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "mesh/deck/msh/cdb_reader.hpp"
#include "mesh/deck/msh/reader.hpp"
#include "mesh/deck/msh/unv_reader.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using assembly::testing::block_mesh;
using assembly::testing::brick;
using testing::Folder;

const UnitSystem kMetres;

Mesh brick_of(CellType type) {
  assembly::testing::BlockOptions options;
  options.type = type;
  Mesh mesh = block_mesh({2, 1, 1}, brick({0.3, 0.2, 0.1}), options);
  mesh.node_sets = {{"corner", {0}}, {"x0", nodes_of(mesh.surface("x0"))}};
  mesh.surfaces.erase("skin");
  return mesh;
}

deck::Deck written_and_read(const Mesh& mesh, const std::string& name) {
  const Folder folder;
  export_mesh(mesh, folder / name);
  return read_mesh_file(folder / name, kMetres, {});
}

class BackFromOtherFormats : public ::testing::TestWithParam<CellType> {};

TEST_P(BackFromOtherFormats, UniversalFilesKeepAllOfTheMesh) {
  const Mesh mesh = brick_of(GetParam());
  const deck::Deck deck = written_and_read(mesh, "part.unv");
  ASSERT_EQ(deck.mesh.cells.size(), 1u);
  EXPECT_EQ(deck.mesh.cells[0].nodes, mesh.cells[0].nodes);
  EXPECT_LT((deck.mesh.nodes - mesh.nodes).lpNorm<Eigen::Infinity>(), 1e-15);
  EXPECT_EQ(deck.mesh.regions, mesh.regions);
  EXPECT_EQ(deck.mesh.node_sets, mesh.node_sets);
  for (const auto& [name, surface] : mesh.surfaces)
    EXPECT_EQ(nodes_of(deck.mesh.surface(name)), nodes_of(surface)) << name;
}

TEST_P(BackFromOtherFormats, MedFilesKeepAllOfTheMesh) {
  const Mesh mesh = brick_of(GetParam());
  const deck::Deck deck = written_and_read(mesh, "part.med");
  ASSERT_EQ(deck.mesh.cells.size(), 1u);
  EXPECT_EQ(deck.mesh.cells[0].nodes, mesh.cells[0].nodes);
  EXPECT_EQ(deck.mesh.regions, mesh.regions);
  EXPECT_EQ(deck.mesh.node_sets, mesh.node_sets);
  for (const auto& [name, surface] : mesh.surfaces)
    EXPECT_EQ(nodes_of(deck.mesh.surface(name)), nodes_of(surface)) << name;
}

INSTANTIATE_TEST_SUITE_P(Cells, BackFromOtherFormats,
                         ::testing::Values(CellType::kTet4, CellType::kTet10, CellType::kWedge6,
                                           CellType::kWedge15, CellType::kHex8, CellType::kHex20));

ForeignMesh unv(const std::string& text, const std::vector<std::string>& ignore = {}) {
  std::istringstream file(text);
  return read_unv(file, "part.unv", ignore);
}

const std::string kUnvNodes =
    "    -1\n  2411\n         1         1         1        11\n"
    "   0.0000000000000000D+00   0.0000000000000000D+00   1.0000000000000000D+00\n    -1\n";

TEST(Unv, WhatItCannotReadIsNamedWithItsLine) {
  test::expect_parts(test::refusal_of([] { unv(kUnvNodes); }),
                     {"found no elements (dataset 2412)"});
  test::expect_parts(test::refusal_of([] { unv("    -1\n   781\n    -1\n"); }),
                     {"part.unv:2: found dataset 781, an old form of nodes"});
  const std::string mass =
      "    -1\n  2412\n        5       161         1         1         7         1\n"
      "         1\n    -1\n";
  test::expect_parts(test::refusal_of([&] { unv(kUnvNodes + mass); }),
                     {"element 5 has the descriptor 161", "--ignore 161", "[[point_mass]]"});
  EXPECT_EQ(unv(kUnvNodes + mass, {"161"}).ignored.at("elements of descriptor 161"), 1);
  test::expect_parts(test::refusal_of([] { unv("    -1\n  2411\n         x\n"); }),
                     {"part.unv:3: found 'x' in columns 1 to 10, expected the number of a node"});
  test::expect_parts(test::refusal_of([] { unv("    -1\n  2411\n         1\n"); }),
                     {"part.unv:3: found the end of the file, expected coordinates"});
}

ForeignMesh cdb(const std::string& text, const std::vector<std::string>& ignore = {}) {
  std::istringstream file(text);
  return read_cdb(file, "part.cdb", ignore);
}

/// Nodes 1 to 8 of the unit cube.
const std::string kCdbNodes =
    "ET,1,185\nKEYOPT,1,2,3\nET,2,186\nET,3,154\nNBLOCK,3\n(3i8,6e20.13)\n"
    "       1       0       0\n       2       0       0 1.0\n"
    "       3       0       0 1.0                 1.0\n"
    "       4       0       0 0.0                 1.0\n"
    "       5       0       0 0.0                 0.0                 1.0\n"
    "       6       0       0 1.0                 0.0                 1.0\n"
    "       7       0       0 1.0                 1.0                 1.0\n"
    "       8       0       0 0.0                 1.0                 1.0\n"
    "N,R5.3,LOC,       -1,\n";

std::string cdb_cells(int type, const std::string& nodes, int count = 8) {
  const auto field = [](int value) {
    const std::string text = std::to_string(value);
    return std::string(8 - text.size(), ' ') + text;
  };
  std::string out = "EBLOCK,19,SOLID,1,1\n(19i8)\n" + field(7) + field(type);
  for (int i = 0; i < 6; ++i) out += field(0);
  return out + field(count) + field(0) + field(1) + nodes + "\n      -1\n";
}

TEST(Cdb, RepeatedNodesMakeWedgesPyramidsAndTetrahedra) {
  struct Case {
    std::string nodes;
    CellType type;
  };
  for (const Case& one :
       {Case{"       1       2       3       4       5       6       7       8", CellType::kHex8},
        Case{"       1       2       3       3       5       6       7       7", CellType::kWedge6},
        Case{"       1       2       3       4       5       5       5       5",
             CellType::kPyramid5},
        Case{"       1       2       3       3       5       5       5       5",
             CellType::kTet4}}) {
    const Folder folder;
    std::ofstream(folder / "part.cdb") << kCdbNodes + cdb_cells(1, one.nodes);
    const deck::Deck found = read_mesh_file(folder / "part.cdb", kMetres, {});
    ASSERT_EQ(found.mesh.cells.size(), 1u);
    EXPECT_EQ(found.mesh.cells[0].type, one.type);
    EXPECT_EQ(found.renumbered.size(), one.type == CellType::kHex8 ? 0u : 1u);
  }
  const ForeignMesh hex = cdb(kCdbNodes + cdb_cells(1,
                                                    "       1       2       3       4       5"
                                                    "       6       7       8"));
  EXPECT_EQ(hex.regions.at("mat_7").formulation.at(CellType::kHex8),
            deck::Formulation::kIncompatible);  // KEYOPT(2) = 3
}

TEST(Cdb, MaterialsByMpAndMpdata) {
  const std::string cube = kCdbNodes + cdb_cells(1,
                                                 "       1       2       3       4       5"
                                                 "       6       7       8");
  const ForeignMesh found =
      cdb(cube +
          "MPTEMP,R5.0, 1, 1,  0.0,\nMPDATA,R5.0, 1,EX  ,       7, 1,  200. ,\n"
          "MP,PRXY,7,.25\nMP,DENS,7,7.8\nMP,ALPD,7,3.\nMP,BETD,7,1E-6\n");
  const deck::Material& steel = found.materials.at("mat_7");
  EXPECT_EQ(steel.constants, (std::vector<double>{200.0, 0.25}));
  EXPECT_EQ(steel.density, 7.8);
  EXPECT_EQ(steel.mass_damping, 3.0);
  EXPECT_EQ(steel.stiffness_damping, 1e-6);
  EXPECT_EQ(found.regions.at("mat_7").material, "mat_7");
  test::expect_parts(test::refusal_of([&] { cdb(cube + "MPDATA,R5.0, 2,EX,7, 1, 200., 190.,\n"); }),
                     {"EX of material 7 depends on the temperature"});
  test::expect_parts(test::refusal_of([&] { cdb(cube + "MP,DENS,7,7.8\n"); }),
                     {"material 7 has no EX"});
}

TEST(Cdb, OtherElementsAreRefusedWithTheWayOut) {
  const std::string cube =
      cdb_cells(1, "       1       2       3       4       5       6       7       8");
  const std::string skin = cdb_cells(3, "       1       2       3       4", 4);
  test::expect_parts(test::refusal_of([&] { cdb(kCdbNodes + cube + skin); }),
                     {"part.cdb:22: element 1 has the type 154", "--ignore 154", "[[spring]]"});
  EXPECT_EQ(cdb(kCdbNodes + cube + skin, {"SURF154"}).ignored.at("elements of type 154"), 1);
  test::expect_parts(test::refusal_of([&] { cdb(kCdbNodes + "EBLOCK,10\n(15i9)\n"); }),
                     {"found EBLOCK without SOLID"});
  test::expect_parts(test::refusal_of([&] { cdb("EBLOCK,19,SOLID\n(what)\n"); }),
                     {"part.cdb:2: expected a format, as (3i9,6e21.13e3)"});
}

}  // namespace
}  // namespace clatter::mesh
