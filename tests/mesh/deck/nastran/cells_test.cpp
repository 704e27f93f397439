// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "core/mesh/validity.hpp"
#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::CellType;
using mesh::deck::Deck;
using mesh::deck::Formulation;
using mesh::deck::Material;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// Grids first ... last with arbitrary coordinates.
std::string grids(int first, int last) {
  std::string text;
  for (int i = first; i <= last; ++i) text += fmt::format("GRID,{},,{}.,{}.,0.\n", i, i, i * i);
  return text;
}

struct CellCase {
  const char* card;
  int nodes;
  CellType type;
};

class NastranCells : public testing::TestWithParam<CellCase> {};

// The corner and mid-side nodes are in the order of cell.hpp: a_other[i] = a_gmsh[p[i]].
TEST_P(NastranCells, NodesAreInOurOrder) {
  const auto& [card, nodes, type] = GetParam();
  std::string text = fmt::format("{},7,1", card);
  for (int i = 0; i < nodes; ++i) {
    if (i == 6 || i == 14) text += ",+\n+";
    text += fmt::format(",{}", i + 1);
  }
  const Deck deck = read_deck(grids(1, nodes) + text + "\n");
  ASSERT_EQ(deck.mesh.cells.size(), 1u);
  const auto& block = deck.mesh.cells[0];
  EXPECT_EQ(block.type, type);
  const auto p = mesh::traits(type).to_nastran;
  for (size_t i = 0; i < p.size(); ++i) EXPECT_EQ(block.nodes(0, p[i]), static_cast<int>(i));
}

INSTANTIATE_TEST_SUITE_P(All, NastranCells,
                         testing::Values(CellCase{"CTETRA", 4, CellType::kTet4},
                                         CellCase{"CTETRA", 10, CellType::kTet10},
                                         CellCase{"CPYRAM", 5, CellType::kPyramid5},
                                         CellCase{"CPYRAM", 13, CellType::kPyramid13},
                                         CellCase{"CPENTA", 6, CellType::kWedge6},
                                         CellCase{"CPENTA", 15, CellType::kWedge15},
                                         CellCase{"CHEXA", 8, CellType::kHex8},
                                         CellCase{"CHEXA", 20, CellType::kHex20}));

// Hex20 with straight edges: our mid-side node = mean of its edge's corners.
TEST(NastranCell, MidSideNodesOfAHexLieBetweenTheirCorners) {
  const double corner[8][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},
                               {0, 0, 2}, {2, 0, 2}, {2, 2, 2}, {0, 2, 2}};
  const int edge[12][2] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5},
                           {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};  // Nastran G9 to G20
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += fmt::format("GRID,{},,{}.,{}.,{}.\n", i + 1, corner[i][0], corner[i][1], corner[i][2]);
  }
  for (int e = 0; e < 12; ++e) {
    const double *a = corner[edge[e][0]], *b = corner[edge[e][1]];
    text += fmt::format("GRID,{},,{}.,{}.,{}.\n", e + 9, (a[0] + b[0]) / 2, (a[1] + b[1]) / 2,
                        (a[2] + b[2]) / 2);
  }
  const Deck deck =
      read_deck(text +
                "CHEXA          7       1       1       2       3       4       5       6\n"
                "               7       8       9      10      11      12      13      14\n"
                "              15      16      17      18      19      20\n");
  const auto& block = deck.mesh.cells.at(0);
  const auto edges = mesh::traits(CellType::kHex20).edges;
  for (int e = 0; e < 12; ++e) {
    const auto at = [&](int i) { return deck.mesh.nodes.row(block.nodes(0, i)); };
    const auto& [a, b] = edges[e];
    EXPECT_EQ((at(8 + e) - (at(a) + at(b)) / 2).norm(), 0.0) << e;
  }
}

TEST(NastranCell, MidSideNodesThatACardOmitsAreAddedOnceAndHang) {
  // Two tetrahedra share edge 2-3, whose mid-side node both omit: G6 of one, G5 of the other.
  const Deck deck = read_deck(grids(1, 14) +
                              "CTETRA,7,1,1,2,3,4,5,,+\n+,7,8,9,10\n"
                              "CTETRA,8,1,2,3,11,4,,12,+\n+,13,9,10,14\n");
  ASSERT_EQ(deck.mesh.cells.size(), 1U);
  const auto& block = deck.mesh.cells[0];
  EXPECT_EQ(block.type, CellType::kTet10);
  EXPECT_EQ(deck.mesh.nodes.rows(), 14);  // 1 to 5, 7 to 14 and the new one
  EXPECT_EQ(deck.mesh.node_ids.back(), 15);
  EXPECT_THAT(deck.mesh.node_sets.at(mesh::kHangingMidSideNodes), ElementsAre(13));
  EXPECT_EQ(block.nodes(0, 5), 13);
  EXPECT_EQ(block.nodes(1, 4), 13);
  EXPECT_EQ(deck.mesh.nodes.row(13), Eigen::RowVector3d(2.5, 6.5, 0.0));
}

TEST(NastranCell, WrongNodesAreRefused) {
  EXPECT_THAT(refusal(kTet + "CTETRA,2,1,1,2,3,30\n"),
              HasSubstr("t.bdf:8: cell 2: found no GRID 30"));
  EXPECT_THAT(refusal(kTet + "CTETRA,2,1,1,2,3,1\n"),
              HasSubstr("cell 2: found a tet4 with repeated nodes that is no wedge"));
  EXPECT_THAT(refusal(kTet + "CTETRA,2,1,1,2,3\n"), HasSubstr("G: found nothing, expected"));
  EXPECT_THAT(refusal(kTet + "CTETRA,1,1,1,2,3,4\n"),
              StartsWith("t.bdf:8: cell 1: found another one with this number at t.bdf:7"));
  EXPECT_THAT(refusal(grids(1, 12) + "CTETRA,7,1,1,2,3,4,5,6,+\n+,7,8,9,10,11\n"),
              HasSubstr("found '11' after the last field"));
}

TEST(NastranCell, NumbersAndOrderAreThoseOfTheDeck) {
  const Deck deck = read_deck(
      "GRID,70,,0.,0.,0.\nGRID,5,,1.,0.,0.\nGRID,300,,0.,1.,0.\nGRID,99999999,,0.,0.,1.\n"
      "GRID,6,,1.,1.,1.\nCTETRA,12,3,70,5,300,99999999\n");
  EXPECT_THAT(deck.mesh.node_ids, ElementsAre(70, 5, 300, 99999999));
  EXPECT_THAT(deck.mesh.cells.at(0).ids, ElementsAre(12));
  EXPECT_THAT(deck.mesh.regions, ElementsAre("pid_3"));
  EXPECT_EQ(deck.regions.at(0).material, "");  // a deck without properties is a mesh
  EXPECT_EQ(deck.ignored.at("GRID (of no solid and no coupling)"), 1);
}

TEST(NastranCell, GridsThatComeTwiceMustAgree) {
  EXPECT_EQ(read_deck(kTet + "GRID,4,,0.,0.,1.\n").mesh.nodes.rows(), 4);
  EXPECT_THAT(refusal(kTet + "GRID,4,,0.,0.,2.\n"),
              StartsWith("t.bdf:8: GRID 4: found another one with this number at t.bdf:6"));
  // Numbers too far apart for a table.
  EXPECT_THAT(refusal(kTet + "GRID,2000000000,,0.,0.,2.\nGRID,2000000000,,0.,0.,3.\n"),
              HasSubstr("GRID 2000000000: found another one"));
}

TEST(NastranRegions, OneForEachPropertyWithItsMaterial) {
  const Deck deck =
      read_deck(kTet + "CTETRA,2,8,1,2,3,4\nPSOLID,8,2\nMAT1,2,70.,30.,,2.7,2.3-5,20.,.02\n");
  EXPECT_THAT(deck.mesh.regions, ElementsAre("pid_1", "pid_8"));
  EXPECT_EQ(deck.regions[1].material, "mat_2");
  EXPECT_EQ(deck.regions[1].where, "t.bdf:9");
  const Material& material = deck.materials.at("mat_2");
  EXPECT_EQ(material.constants[0], 70.0);
  EXPECT_NEAR(material.constants[1], 70.0 / 60.0 - 1.0, 1e-15);  // E / 2 G - 1
  EXPECT_EQ(material.density, 2.7);
  EXPECT_THAT(material.expansion, ElementsAre(2.3e-5));
  EXPECT_EQ(material.reference_temperature, 20.0);
  EXPECT_EQ(material.loss_factor, 0.02);
}

TEST(NastranRegions, MissingOnesAreNamed) {
  EXPECT_THAT(refusal(kTet + "CTETRA,2,8,1,2,3,4\n"),
              HasSubstr("t.bdf:8: cell 2: found no PSOLID 8"));
  EXPECT_THAT(refusal(kTet + "CTETRA,2,8,1,2,3,4\nPSOLID,8,2\n"),
              HasSubstr("t.bdf:9: PSOLID: found no material 2"));
}

TEST(NastranRegions, ElasticConstantsMustMakeSense) {
  const auto with = [](const std::string& mat) {
    return refusal(kTet.substr(0, kTet.find("MAT1")) + mat + kTet.substr(kTet.find("GRID,1")));
  };
  EXPECT_EQ(with("MAT1,1,210.,80.77,.3\n"), "");  // G rounded to two digits
  EXPECT_THAT(with("MAT1,1,210.,70.,.3\n"),
              HasSubstr("found G = 70, expected E / (2 (1 + NU)) = 80.7"));
  EXPECT_THAT(with("MAT1,1,210.\n"), HasSubstr("expected two of E, G and NU"));
  EXPECT_THAT(with("MAT1,1,21.2,5.3\n"), HasSubstr("found NU = 1"));
  EXPECT_THAT(with("MAT1,1,-1.,,.3\n"), HasSubstr("found E = -1"));
  EXPECT_THAT(with("MAT1,1,210.,,.3,-7.8\n"), HasSubstr("RHO is negative"));
}

TEST(NastranRegions, Mat9IsAnisotropicInThePropertysSystem) {
  std::string mat = "MAT9,1";
  for (int i = 1; i <= 21; ++i)
    mat += (i == 8 || i == 16 ? ",+\n+," : ",") + std::to_string(i) + ".";
  mat += ",7.8,1.-5,+\n+,2.-5,3.-5,,,,20.\n";
  const std::string cord = "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
  const std::string tet = kTet.substr(kTet.find("GRID,1"));
  const Deck deck = read_deck("PSOLID,1,1,5\n" + mat + cord + tet);
  const Material& material = deck.materials.at("mat_1");
  EXPECT_EQ(material.kind, Material::Kind::kAnisotropic);
  ASSERT_EQ(material.constants.size(), 21u);
  for (int i = 0; i < 21; ++i) EXPECT_EQ(material.constants[i], i + 1.0);
  EXPECT_THAT(material.expansion, ElementsAre(1e-5, 2e-5, 3e-5));
  EXPECT_EQ(material.density, 7.8);
  EXPECT_EQ(material.reference_temperature, 20.0);
  EXPECT_EQ(deck.regions[0].system, "cord_5");
  EXPECT_THAT(refusal("PSOLID,1,1,-1\n" + mat + tet), HasSubstr("axes of the cells"));
}

TEST(NastranRegions, IntegrationOfHexesIsAsThePropertySays) {
  const auto formulation = [](const std::string& psolid, int nodes) {
    std::string cell = "CHEXA,7,1";
    for (int i = 1; i <= nodes; ++i)
      cell += (i == 7 || i == 15 ? ",+\n+," : ",") + std::to_string(i);
    const Deck deck = read_deck(grids(1, nodes) + cell + "\nMAT1,1,1.,,.3\n" + psolid);
    const auto& all = deck.regions.at(0).formulation;
    return all.empty() ? Formulation::kDefault : all.begin()->second;
  };
  const auto k = [&](const std::string& in, const std::string& isop, int nodes) {
    return formulation("PSOLID,1,1,," + in + ",," + isop + "\n", nodes);
  };
  // All pairs of the manual: IN blank, BUBBLE, TWO, THREE; ISOP blank or REDUCED, FULL.
  for (const char* reduced : {"", "0", "REDUCED"}) {
    for (const char* in : {"", "0", "BUBBLE", "TWO", "2", "THREE", "3"})
      EXPECT_EQ(k(in, reduced, 8), Formulation::kDefault) << in;
    for (const char* in : {"", "0", "THREE", "3"})
      EXPECT_EQ(k(in, reduced, 20), Formulation::kFull) << in;
    for (const char* in : {"TWO", "2"}) EXPECT_EQ(k(in, reduced, 20), Formulation::kReduced) << in;
  }
  for (const char* full : {"FULL", "1"}) {
    for (const char* in : {"TWO", "2"}) EXPECT_EQ(k(in, full, 8), Formulation::kFull) << in;
    for (const char* in : {"THREE", "3"}) EXPECT_EQ(k(in, full, 8), Formulation::kFine) << in;
    EXPECT_EQ(k("BUBBLE", full, 8), Formulation::kDefault);  // has no standard points
    EXPECT_EQ(k("TWO", full, 20), Formulation::kReduced);
    EXPECT_EQ(k("THREE", full, 20), Formulation::kFull);
  }
  EXPECT_THAT(refusal(kTet + "PSOLID,2,1,,,,,FOO\n"),
              HasSubstr("FCTN: found 'FOO', expected SMECH, PFLUID or FFLUID"));
}

TEST(NastranRegions, ChoicesOfIntegrationAreSaidOnceForEachKind) {
  const auto notes = [](const std::string& psolid, int nodes, const char* card = "CHEXA") {
    std::string cell = fmt::format("{},7,1", card), other = fmt::format("{},8,2", card);
    for (int i = 1; i <= nodes; ++i) {
      const std::string next = (i == 7 || i == 15 ? ",+\n+," : ",") + std::to_string(i);
      cell += next;
      other += next;
    }
    return read_deck(grids(1, nodes) + cell + "\n" + other + "\nMAT1,1,1.,,.3\nPSOLID,1,1" +
                     psolid + "\nPSOLID,2,1" + psolid + "\nENDDATA\n")
        .notes;
  };
  EXPECT_THAT(notes("", 8), ElementsAre(HasSubstr(
                                "PSOLID 1 and 1 more, IN blank, ISOP blank: CHEXA of 8 grids has "
                                "no counterpart for the bubble functions of Nastran; the nearest "
                                "is incompatible modes")));
  EXPECT_THAT(notes(",,THREE", 8), ElementsAre(HasSubstr("has no counterpart for the reduced shear "
                                                         "strains of Nastran; the nearest is "
                                                         "incompatible modes")));
  EXPECT_THAT(notes(",,THREE,,FULL", 8), testing::IsEmpty());  // the same
  EXPECT_THAT(notes(",,TWO,,FULL", 8), testing::IsEmpty());    // the same
  EXPECT_THAT(notes(",,TWO", 6, "CPENTA"), ElementsAre(HasSubstr("full integration")));
  EXPECT_THAT(notes("", 10, "CTETRA"), testing::IsEmpty());
  EXPECT_THAT(notes("", 5, "CPYRAM"),
              ElementsAre(HasSubstr("CPYRAM of 5 grids has no counterpart")));
}

TEST(NastranRegions, PropertiesAndMaterialsThatAreNotOfSolidsAreNamed) {
  EXPECT_THAT(refusal(kTet + "CTETRA,2,8,1,2,3,4\nPLSOLID,8,1\n"),
              HasSubstr("cell 2: property 8 is a PLSOLID, expected a PSOLID"));
  EXPECT_THAT(refusal(kTet + "CTETRA,2,8,1,2,3,4\nPSOLID,8,3\nMAT8,3,70.,30.,.3\n"),
              HasSubstr("material 3 is a MAT8, expected a MAT1 or MAT9"));
  EXPECT_EQ(refusal(kTet + "MAT8,3,70.,30.,.3\nMAT10,4,1.,1.\nPCOMP,9,,,,,,,,+\n+,3,.1\nENDDATA\n"),
            "");
}

// A writer lists the mid-side nodes of pyramids as 1-2, 4-1, 3-4, 2-3, 2-5, 1-5, 3-5, 4-5.
TEST(NastranCells, MidSideNodesOfAnotherOrderAreSortedAndCounted) {
  const double at[13][3] = {{0, 0, 0},   {2, 0, 0},     {2, 2, 0},   {0, 2, 0}, {1, 1, 2},
                            {1, 0, 0},   {0, 1, 0},     {1, 2, 0},   {2, 1, 0}, {1.5, .5, 1},
                            {.5, .5, 1}, {1.5, 1.5, 1}, {.5, 1.5, 1}};
  std::string text = "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\n";
  for (int i = 0; i < 13; ++i)
    text += fmt::format("GRID,{},,{:.1f},{:.1f},{:.1f}\n", i + 1, at[i][0], at[i][1], at[i][2]);
  const Deck deck = read_deck(text + "CPYRAM,1,1,1,2,3,4,5,6,+\n+,7,8,9,10,11,12,13\nENDDATA\n");
  ASSERT_EQ(deck.renumbered.size(), 1u);
  EXPECT_EQ(deck.renumbered[0].cells, 1);
  EXPECT_TRUE(mesh::check_validity(deck.mesh).invalid.empty());
  EXPECT_NEAR(
      mesh::volume_of(CellType::kPyramid13, mesh::cell_nodes(deck.mesh, deck.mesh.cells[0], 0)),
      8.0 / 3.0, 1e-14);
}

}  // namespace
}  // namespace clatter::test
