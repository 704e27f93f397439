// SPDX-License-Identifier: GPL-3.0-or-later
// CQUAD4, CTRIA3 and the like beside solids.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "mesh/deck/recipe/recipe.hpp"
#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::FaceType;
using mesh::deck::Deck;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two squares along x, of grids 1 to 6; grid 7 belongs to nothing.
const std::string kSheetGrids =
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,2.,0.,0.\n"
    "GRID,4,,0.,1.,0.\nGRID,5,,1.,1.,0.\nGRID,6,,2.,1.,0.\nGRID,7,,9.,0.,0.\n";
const std::string kSheetSection = "MAT1,1,210.,,.3,7.8\nPSHELL,2,1,.1,1,,1\n";
const std::string kTwoShells =
    kSheetSection + kSheetGrids + "CQUAD4,11,2,1,2,5,4\nCQUAD4,12,2,2,3,6,5\n";

std::string notes_of(const Deck& deck) {
  std::string all;
  for (const std::string& note : deck.notes) all += note + "\n";
  return all;
}

TEST(NastranShells, AreCellsOfARegionWithItsSection) {
  const auto deck = read_deck(kTwoShells);
  EXPECT_EQ(deck.mesh.nodes.rows(), 6);
  EXPECT_TRUE(deck.points.empty());
  EXPECT_THAT(deck.mesh.regions, ElementsAre("pid_2"));
  EXPECT_EQ(deck.regions.at(0).material, "mat_1");
  const mesh::ShellBlock& block = deck.mesh.shells.at(0);
  EXPECT_EQ(block.type, FaceType::kQuad4);
  EXPECT_EQ(block.region, 0);
  EXPECT_THAT(block.ids, ElementsAre(11, 12));
  EXPECT_EQ(block.nodes.row(1), (Eigen::RowVector<int32_t, 4>(1, 2, 5, 4)));
  EXPECT_EQ(block.thickness.size(), 0);
  EXPECT_EQ(block.offset.size(), 0);
  const recipe::Shell& shell = deck.shells.at(0);
  EXPECT_THAT(shell.regions, ElementsAre("pid_2"));
  EXPECT_EQ(shell.section.thickness, 0.1);
  EXPECT_EQ(shell.section.bending, 1.0);
  EXPECT_EQ(shell.section.shear, 5.0 / 6.0);
  EXPECT_TRUE(deck.mass == mesh::deck::MassForm::kLumped);
  EXPECT_EQ(deck.notes.size(), 1u);  // it has no ENDDATA
}

TEST(NastranShells, ThicknessAndOffsetOfACellAreItsOwn) {
  const auto deck = read_deck(kSheetSection + kSheetGrids +
                              "CQUAD4,11,2,1,2,5,4,,.05,+\n+,,,.1,.2,.3,.4\n"
                              "CTRIA3,12,2,2,3,6,,,+\n+,,1,.5,2.\nCTRIA3,13,2,2,6,5\n");
  const mesh::ShellBlock &quad = deck.mesh.shells.at(1), &triangles = deck.mesh.shells.at(0);
  EXPECT_EQ(quad.thickness.row(0), Eigen::RowVector4d(0.1, 0.2, 0.3, 0.4));
  EXPECT_EQ(quad.offset(0), 0.05);
  EXPECT_TRUE(triangles.thickness.row(0).isApprox(Eigen::RowVector3d(0.05, 0.2, 0.1), 1e-15));
  EXPECT_EQ(triangles.thickness.row(1), Eigen::RowVector3d(0.1, 0.1, 0.1));
  EXPECT_EQ(triangles.offset.size(), 0);
}

TEST(NastranShells, NeighboursAreTurnedToOneSideWithTheirOffset) {
  const auto deck = read_deck(kSheetSection + kSheetGrids +
                              "CQUAD4,11,2,1,2,5,4,,.05\nCQUAD4,12,2,2,5,6,3,,.05\n"
                              "PLOAD2,1,3.,12\n");
  const mesh::ShellBlock& block = deck.mesh.shells.at(0);
  EXPECT_EQ(block.nodes.row(1), (Eigen::RowVector<int32_t, 4>(1, 2, 5, 4)));
  EXPECT_EQ(block.offset, Eigen::Vector2d(0.05, -0.05));
  EXPECT_THAT(notes_of(deck), HasSubstr("1 shells are turned to the side of their neighbours"));
  // Its pressure acts along the normal of the deck's order: down.
  const mesh::Surface& surface = deck.mesh.surface("pload4_1");
  EXPECT_EQ(surface.faces.at(0).nodes.row(0), (Eigen::RowVector<int32_t, 4>(1, 4, 5, 2)));
  EXPECT_EQ(deck.steps.at(0).pressures.at(0).value, -3.0);
}

TEST(NastranShells, SectionsCountTheStiffnessOfTheirMaterials) {
  const std::string materials = "MAT1,1,200.,,.25\nMAT1,3,100.,,.25\nMAT1,4,50.,,.25\n";
  const std::string cells = kSheetGrids + "CQUAD4,11,2,1,2,5,4\n";
  const auto deck = read_deck(materials + cells + "PSHELL,2,1,.1,3,2.,4,.5,7.\nPARAM,WTMASS,.1\n");
  const fe::ShellSection& section = deck.shells.at(0).section;
  EXPECT_DOUBLE_EQ(section.bending, 1.0);
  EXPECT_DOUBLE_EQ(section.shear, 0.125);
  EXPECT_DOUBLE_EQ(section.area_mass, 0.7);
  const auto plain = read_deck(materials + cells + "PSHELL,2,1,.1,3\n");
  EXPECT_DOUBLE_EQ(plain.shells.at(0).section.bending, 0.5);
  EXPECT_DOUBLE_EQ(plain.shells.at(0).section.shear, 5.0 / 12.0);
  EXPECT_THAT(notes_of(plain), HasSubstr("MID3 of 1 PSHELL is blank, rigid in shear"));
}

TEST(NastranShells, HardU12_AMembraneIsSaidAndThicknessInOtherUnitsIsGuessed) {
  const std::string cells = kSheetGrids + "MAT1,1,200.,,.25\nCQUAD4,11,2,1,2,5,4\n";
  const auto membrane = read_deck(cells + "PSHELL,2,1,.1\n");
  EXPECT_EQ(membrane.shells.at(0).section.bending, 1e-6);
  EXPECT_THAT(notes_of(membrane), HasSubstr("MID2 of 1 PSHELL is blank, a membrane"));
  EXPECT_THAT(notes_of(read_deck(cells + "PSHELL,2,1,1-5,1,,1\n")),
              HasSubstr("1 shells are very thin, this one 1e-05 of its longest side: is the "
                        "thickness given in m instead of mm by mistake?"));
  EXPECT_THAT(notes_of(read_deck(cells + "PSHELL,2,1,30.,1,,1\n")),
              HasSubstr("1 shells are very thick, this one 30 of its longest side: is the "
                        "thickness given in mm instead of m by mistake?"));
}

TEST(NastranShells, WhatASectionCannotBeIsRefusedByName) {
  const std::string cells = kSheetGrids +
                            "MAT1,1,200.,,.25\nMAT1,3,100.,,.3\nMAT8,8,1.,1.,.3,1.\n" +
                            "CQUAD4,11,2,1,2,5,4\n";
  const auto of = [&](const std::string& property) { return refusal(cells + property); };
  EXPECT_THAT(of("PSHELL,2,,.1,1\n"), HasSubstr("PSHELL 2: MID1 is blank"));
  EXPECT_THAT(of("PSHELL,2,1,.1,-1\n"), HasSubstr("MID2 is -1: plane strain"));
  EXPECT_THAT(of("PSHELL,2,1,.1,1,,1,,,+\n+,,,3\n"), HasSubstr("MID4 joins stretching to bending"));
  EXPECT_THAT(of("PSHELL,2,7,.1,7\nMAT9,7\n"),
              HasSubstr("material 7 is a MAT9, expected a MAT1, MAT2 or MAT8"));
  EXPECT_THAT(of("PSHELL,2,9,.1,9\n"), HasSubstr("PSHELL 2: found no material 9"));
  EXPECT_THAT(of("PSHELL,2,1,,1\n"), HasSubstr("CQUAD4 11: found a thickness of 0"));
  EXPECT_THAT(of("PSHELL,7,1,.1,1\n"), HasSubstr("CQUAD4 11: found no PSHELL 2"));
  EXPECT_THAT(of("PCOMP,2,,,,,,,MEM,+\n+,1,.1,0.,YES\n"),
              HasSubstr("PCOMP 2: LAM is MEM: a laminate without part of its stiffness"));
  EXPECT_THAT(of("PCOMP,2\n"), HasSubstr("PCOMP: found no ply, expected MID, T and THETA"));
  EXPECT_THAT(of("PCOMP,2,,,,,,,,+\n+,1,0.\n"), HasSubstr("expected more than 0"));
  EXPECT_THAT(of("PCOMP,2,,,,,,,,+\n+,9,.1\n"), HasSubstr("PCOMP 2: found no material 9"));
  const std::string fibres = "PSHELL,2,5,.1,5\n";
  EXPECT_THAT(of(fibres + "MAT8,5,1.,2.,.8,1.\n"),
              HasSubstr("MAT8 5: found NU12 = 0.8, expected NU12**2 < E1 / E2"));
  EXPECT_THAT(of(fibres + "MAT8,5,1.,2.,.3\n"),
              HasSubstr("MAT8 5: found a modulus of 0, expected E1, E2, G12, G1Z and G2Z"));
}

TEST(NastranShells, OtherMaterialsOfBendingAndShearAreNamed) {
  const std::string cells = kSheetGrids + "CQUAD4,11,2,1,2,5,4\n";
  const auto other = read_deck(cells + "MAT1,1,200.,,.25\nMAT1,3,100.,,.3\nPSHELL,2,1,.1,3,2.\n");
  EXPECT_EQ(other.shells.at(0).bending_material, "mat_3");
  EXPECT_EQ(other.shells.at(0).shear_material, "mat_3");
  EXPECT_EQ(other.shells.at(0).section.bending, 2.0);
  // Faces of fibres on a core: of the core only the shear counts.
  auto sandwich = read_deck(cells +
                            "MAT8,6,17.,16.,.3,4.,3.,2.,5.,+\n+,1.-6,2.-6,20.\n"
                            "MAT8,7,.1,.1,.1,.1,.45,.22\nPSHELL,2,6,.036,6,1416.,7,22.2,3.\n");
  const recipe::Shell& shell = sandwich.shells.at(0);
  EXPECT_EQ(shell.bending_material, "");
  EXPECT_EQ(shell.shear_material, "mat_7");
  EXPECT_EQ(shell.section.shear, 22.2);
  EXPECT_EQ(shell.section.bending, 1416.0);
  const mesh::deck::Material& face = sandwich.materials.at("mat_6");
  EXPECT_EQ(face.kind, mesh::deck::Material::Kind::kOrthotropic);
  EXPECT_THAT(face.constants, ElementsAre(17.0, 16.0, 16.0, 0.3, 0.0, 0.0, 4.0, 3.0, 2.0));
  EXPECT_THAT(face.expansion, ElementsAre(1e-6, 2e-6, 0.0));
  EXPECT_EQ(face.reference_temperature, 20.0);
  EXPECT_EQ(sandwich.mesh.shells.at(0).axis.row(0), Eigen::RowVector3d(1.0, 0.0, 0.0));
  // The core has no density, and no part in the mass.
  const recipe::File file = mesh::deck::recipe_of(sandwich).file;
  EXPECT_THAT(file.shells.at(0).shear_material, "mat_7");
  EXPECT_TRUE(file.materials.at("mat_7").regions.empty());
  EXPECT_THAT(mesh::deck::recipe_of(sandwich).text(),
              HasSubstr("the material has no part in the mass"));
  const auto any = read_deck(cells + "MAT2,1,5.,1.,2.,6.,3.,4.\nPSHELL,2,1,.1,1,,1\n");
  EXPECT_THAT(any.materials.at("mat_1").constants,
              ElementsAre(5, 1, 0, 2, 0, 0, 6, 0, 3, 0, 0, 6, 0, 0, 0, 4, 0, 0, 4, 0, 4));
}

TEST(NastranShells, LayersAreThoseOfPcomp) {
  const std::string cells = kSheetGrids +
                            "MAT8,8,140.,10.,.3,5.\nMAT1,1,200.,,.25\n"
                            "CQUAD4,11,2,1,2,5,4,30.,.02\nCTRIA3,12,2,2,3,5,9\n"
                            "CORD2R,9,,0.,0.,0.,0.,0.,1.,+\n+,0.,1.,0.\n";
  auto deck = read_deck(cells + "PCOMP,2,-.3,7.,,,50.,,SYM,+\n+,8,.1,45.,YES,,,-45.,,+\n+,1,.2\n");
  const recipe::Shell& shell = deck.shells.at(0);
  ASSERT_EQ(shell.layers.size(), 6u);
  EXPECT_EQ(shell.layers[1].material, "mat_8_of_2");
  EXPECT_EQ(shell.layers[1].thickness, 0.1);
  EXPECT_DOUBLE_EQ(shell.layers[1].angle, -std::numbers::pi / 4.0);
  EXPECT_EQ(shell.layers[3].material, "mat_1_of_2");
  EXPECT_DOUBLE_EQ(shell.layers[5].angle, std::numbers::pi / 4.0);
  EXPECT_DOUBLE_EQ(shell.thickness(), 0.8);
  EXPECT_EQ(shell.section.area_mass, 7.0);
  EXPECT_EQ(deck.materials.at("mat_8_of_2").reference_temperature, 50.0);
  EXPECT_EQ(deck.materials.size(), 2u);
  EXPECT_THAT(notes_of(deck), HasSubstr("G1Z or G2Z of MAT8 8 is blank"));
  // Triangles first. Z0 + t/2, and ZOFFS beside it.
  const mesh::ShellBlock &triangle = deck.mesh.shells.at(0), &quad = deck.mesh.shells.at(1);
  EXPECT_NEAR(triangle.offset(0), 0.1, 1e-15);
  EXPECT_NEAR(quad.offset(0), 0.12, 1e-15);
  EXPECT_TRUE(triangle.axis.row(0).isApprox(Eigen::RowVector3d(0.0, 1.0, 0.0), 1e-15));
  EXPECT_TRUE(quad.axis.row(0).isApprox(Eigen::RowVector3d(std::sqrt(0.75), 0.5, 0.0), 1e-15));
  EXPECT_EQ(quad.thickness.size(), 0);
  const recipe::File file = mesh::deck::recipe_of(deck).file;
  EXPECT_THAT(file.shells.at(0).layers.at(2).material, "mat_1_of_2");
  EXPECT_TRUE(file.materials.at("mat_1_of_2").regions.empty());
  const auto global = read_deck(cells + "PCOMPG,2,,,,,,,,+\n+,101,8,.1,45.,YES,,,,+\n+,102,1,.3\n");
  EXPECT_EQ(global.shells.at(0).layers.size(), 2u);
  EXPECT_EQ(global.shells.at(0).layers[1].thickness, 0.3);
  EXPECT_EQ(global.shells.at(0).layers[1].angle, 0.0);
  EXPECT_EQ(global.mesh.shells.at(0).offset.size(), 0);
}

TEST(NastranShells, TemperatureAndLossOfALaminateAreItsOwn) {
  const std::string cells = kSheetGrids +
                            "MAT1,1,200.,,.25,,,20.,.1\nCQUAD4,11,2,1,2,5,4\n"
                            "CQUAD4,12,3,2,5,6,3\nPCOMP,2,,,,,20.,,,+\n+,1,.1\n";
  const auto deck = read_deck(cells + "PCOMP,3,,,,,50.,.3,,+\n+,1,.1\n");
  const mesh::deck::Material &plain = deck.materials.at("mat_1"),
                             &own = deck.materials.at("mat_1_of_3");
  EXPECT_EQ(deck.shells.at(0).layers.at(0).material, "mat_1");
  EXPECT_EQ(plain.reference_temperature, 20.0);
  EXPECT_EQ(plain.loss_factor, 0.1);
  EXPECT_EQ(own.reference_temperature, 50.0);
  EXPECT_EQ(own.loss_factor, 0.3);
  EXPECT_THAT(notes_of(deck), HasSubstr("PCOMP 2: GE of its materials counts"));
  EXPECT_THAT(refusal(cells + "PCOMP,3,,,,,,-.3,,+\n+,1,.1\n"), HasSubstr("a loss factor of 0"));
}

TEST(NastranShells, AWallBetweenTwoSolidsIsNoSkin) {
  // Two cubes with a gap; grids 1 to 8 and 11 to 18.
  std::string grids;
  for (int cube = 0; cube < 2; ++cube)
    for (int k = 0; k < 8; ++k)
      grids +=
          fmt::format("GRID,{},,{}.,{}.,{}.\n", 10 * cube + k + 1,
                      2 * cube + (k % 4 == 1 || k % 4 == 2 ? 1 : 0), k % 4 >= 2 ? 1 : 0, k / 4);
  const std::string deck = kSheetSection + grids +
                           "PSOLID,9,1\nCHEXA,1,9,1,2,3,4,5,6,+\n+,7,8\n"
                           "CHEXA,2,9,11,12,13,14,15,16,+\n+,17,18\n"
                           "CQUAD4,21,2,2,11,14,3\nCQUAD4,22,2,5,6,7,8\n";
  EXPECT_THAT(refusal(deck), HasSubstr("found edge 2-11 of shell CQUAD4 21 on nodes of solids"));
  const auto held = read_deck(deck + "SPC1,1,456,2,3,11,14\n");
  EXPECT_THAT(held.mesh.shells.at(0).ids, ElementsAre(21));
  EXPECT_EQ(held.mesh.shells.size(), 1u);
  EXPECT_EQ(held.mesh.surface("pid_2").face_count(), 1);
  // Half of a face is neither.
  EXPECT_THAT(refusal(deck + "SPC1,1,456,2,3,11,14\nCTRIA3,23,2,15,16,17\n"),
              HasSubstr("found 1 CTRIA3 whose corners all belong to solids"));
}

TEST(NastranShells, LayersKeepTheSideOfTheDeck) {
  const std::string cells =
      kSheetGrids + "MAT1,1,200.,,.25\nMAT1,3,100.,,.25\nPCOMP,2,,,,,,,,+\n+,1,.1,,,3,.1\n";
  const auto deck = read_deck(cells + "CQUAD4,11,2,1,2,5,4\nCQUAD4,12,2,2,5,6,3\n");
  EXPECT_EQ(deck.mesh.shells.at(0).nodes.row(1), (Eigen::RowVector<int32_t, 4>(1, 4, 5, 2)));
  // So does a material whose shear stretches it.
  const auto leaning = read_deck(kSheetGrids +
                                 "MAT2,1,5.,1.,2.,6.,3.,4.\nPSHELL,2,1,.1,1,,1\n"
                                 "CQUAD4,11,2,1,2,5,4\nCQUAD4,12,2,2,5,6,3\n");
  EXPECT_EQ(leaning.mesh.shells.at(0).nodes.row(1), (Eigen::RowVector<int32_t, 4>(1, 4, 5, 2)));
  EXPECT_THAT(refusal(cells + "CQUAD4,11,2,1,2,5,4,,,+\n+,,,.3,.3,.3,.3\n"),
              HasSubstr("found T1 = 0.3, expected blank fields: its PCOMP has the thickness"));
  EXPECT_THAT(
      refusal(kSheetGrids + "MAT8,8,140.,10.,.3,5.\nPSHELL,2,8,.1,8\nCQUAD4,11,2,1,2,5,4,9\n"
                            "CORD2C,9,,0.,0.,0.,0.,0.,1.,+\n+,0.,1.,0.\n"),
      HasSubstr("CQUAD4 11: MCID 9 is a curved system, expected a rectangular one"));
}

TEST(NastranShells, QuadraticOnesKeepTheirNodes) {
  const std::string middle =
      "GRID,21,,.5,0.,0.\nGRID,22,,1.,.5,0.\nGRID,23,,.5,1.,0.\nGRID,24,,0.,.5,0.\n"
      "GRID,25,,1.5,.0,0.\nGRID,26,,1.5,.5,0.\n";
  const auto deck = read_deck(kSheetSection + kSheetGrids + middle +
                              "CQUAD8,11,2,1,2,5,4,21,22,+\n+,23,24\n"
                              "CTRIA6,12,2,2,3,5,25,26,22\n");
  const mesh::ShellBlock &triangles = deck.mesh.shells.at(0), &quads = deck.mesh.shells.at(1);
  EXPECT_EQ(quads.type, mesh::FaceType::kQuad8);
  EXPECT_EQ(triangles.type, mesh::FaceType::kTri6);
  EXPECT_THAT(quads.ids, ElementsAre(11));
  EXPECT_THAT(triangles.ids, ElementsAre(12));
  EXPECT_EQ(deck.mesh.nodes.rows(), 11);
  EXPECT_EQ(read_deck(kSheetSection + kSheetGrids + "CQUAD8,11,2,1,2,5,4\n")
                .mesh.shells.at(0)
                .nodes.rows(),
            1);
  EXPECT_THAT(refusal(kSheetSection + kSheetGrids + middle + "CQUAD8,11,2,1,2,5,4,21,22\n"),
              HasSubstr("CQUAD8 11: found 2 of its mid-side grids blank, expected all or none"));
  // G5 lies between equal corners: a triangle does not have it.
  const auto collapsed =
      read_deck(kSheetSection + kSheetGrids + middle + "CQUAD8,11,2,1,1,5,4,21,22,+\n+,23,24\n");
  EXPECT_EQ(collapsed.mesh.nodes.rows(), 6);
  EXPECT_THAT(collapsed.mesh.node_ids, ElementsAre(1, 4, 5, 22, 23, 24));
}

TEST(NastranShells, FacesThatAreNoneAreRefusedWithNumberAndPosition) {
  const auto of = [&](const std::string& cell) {
    return refusal(kSheetSection + kSheetGrids + cell);
  };
  EXPECT_THAT(of("CQUAD4,11,2,1,5,2,4\n"),
              HasSubstr("t.bdf:10: CQUAD4 11 at node 1 (0, 0, 0) has no area"));
  EXPECT_THAT(of("CTRIA3,11,2,1,2,3\n"), HasSubstr("CTRIA3 11 at node 1 (0, 0, 0) has no area"));
  EXPECT_THAT(of("GRID,8,,.2,.2,0.\nCQUAD4,11,2,1,2,8,4\n"), HasSubstr("is concave or folded"));
  EXPECT_THAT(of("GRID,21,,0.,0.,.3\nGRID,22,,1.,0.,-.3\nGRID,23,,1.,1.,.3\n"
                 "GRID,24,,0.,1.,-.3\nCQUAD4,11,2,21,22,23,24\n"),
              HasSubstr("CQUAD4 11 at node 21 (0, 0, 0.3) is warped by 0.6 of its size"));
  const auto warped =
      read_deck(kSheetSection + kSheetGrids + "GRID,8,,0.,1.,.4\nCQUAD4,11,2,1,2,5,8\n");
  EXPECT_THAT(notes_of(warped), HasSubstr("1 shells are warped by more than 0.1 of their size"));
  const auto triangle = read_deck(kSheetSection + kSheetGrids + "CQUAD4,11,2,1,2,5,5\n");
  EXPECT_EQ(triangle.mesh.shells.at(0).type, FaceType::kTri3);
}

TEST(NastranShells, TheirNodesTurnInSupportsCouplingsSpringsAndLoads) {
  auto deck = read_deck(kTwoShells +
                        "SPC1,1,123456,1,4\nRBE2,20,3,123456,7\nCELAS2,30,5.,2,5\n"
                        "CONM2,40,6,,2.,.1,0.,0.\nMOMENT,1,5,,3.,0.,0.,1.\n"
                        "MPC,1,2,4,1.,5,4,-1.\n");
  EXPECT_EQ(deck.supports.at(0).dofs, mesh::deck::kAllDofs);
  EXPECT_EQ(deck.rigid.at(0).reference, 2);
  EXPECT_EQ(deck.points.size(), 1u);
  EXPECT_EQ(deck.springs.at(0).terms.at(0).direction, 4);
  EXPECT_TRUE(deck.distributing.empty());
  EXPECT_EQ(deck.masses.at(0).node_index, 5);
  EXPECT_EQ(deck.steps.at(0).forces.at(0).direction, 5);
  const recipe::File file = mesh::deck::recipe_of(deck).file;
  EXPECT_EQ(file.shells.size(), 1u);
  EXPECT_THAT(file.supports.at(0).directions, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(file.supports.at(0).selection.node_set, "spc_1");
  EXPECT_EQ(file.springs.at(0).terms.at(0).selection.node_set, "node_2");
  EXPECT_EQ(file.equations.at(0).terms.at(0).selection.node_set, "node_2");
  EXPECT_EQ(file.couplings.at(0).on_point, "on_node_3");
  EXPECT_EQ(file.point_masses.at(0).on, "on_node_6");
  EXPECT_EQ(file.loads.at(0).set, "on_node_5");
}

TEST(NastranShells, PressuresActAlongTheirNormals) {
  const auto deck = read_deck(kTwoShells + "PLOAD4,1,11,2.,,,,THRU,12\n");
  EXPECT_EQ(deck.mesh.surface("pload4_1").face_count(), 2);
  EXPECT_EQ(deck.steps.at(0).pressures.at(0).value, -2.0);
  const auto total = [](const Deck& one) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& force : one.steps.at(0).forces) sum[force.direction] += force.value;
    return sum;
  };
  const auto varied = read_deck(kTwoShells + "PLOAD4,1,11,1.,1.,3.,3.\n");
  EXPECT_TRUE(total(varied).isApprox(Eigen::Vector3d(0, 0, 2), 1e-14));
  const auto along = read_deck(kTwoShells + "PLOAD4,1,11,2.,,,,,,+\n+,,1.,0.,0.\n");
  EXPECT_TRUE(total(along).isApprox(Eigen::Vector3d(2, 0, 0), 1e-14));
  EXPECT_THAT(refusal(kTwoShells + "PLOAD2,1,2.,99\n"), HasSubstr("found no shell 99"));
}

// Unit cube; grid 9 stands on the middle of nothing.
const std::string kSolid =
    "PSOLID,1,1\nGRID,11,,0.,0.,0.\nGRID,12,,1.,0.,0.\nGRID,13,,1.,1.,0.\nGRID,14,,0.,1.,0.\n"
    "GRID,15,,0.,0.,1.\nGRID,16,,1.,0.,1.\nGRID,17,,1.,1.,1.\nGRID,18,,0.,1.,1.\n"
    "GRID,21,,0.,0.,2.\nGRID,22,,1.,0.,2.\n"
    "CHEXA,1,1,11,12,13,14,15,16,+\n+,17,18\n";

TEST(NastranShells, OnesOnNodesOfSolidsAreHingesUnlessSomethingTurnsThese) {
  const std::string wall = kSheetSection + kSolid + "CQUAD4,50,2,15,16,22,21\n";
  EXPECT_THAT(refusal(wall),
              HasSubstr("t.bdf:16: found edge 15-16 of shell CQUAD4 50 on nodes of solids, which "
                        "do not turn: a hinge; nodes of its own"));
  const std::string one_end = wall + "RBE3,60,,15,123456,1.,123,12,13\n";
  EXPECT_THAT(refusal(one_end), HasSubstr("a hinge"));
  const auto deck = read_deck(one_end + "RBE3,61,,16,123456,1.,123,12,13\n");
  EXPECT_EQ(deck.mesh.shells.at(0).region, 1);
  EXPECT_THAT(deck.mesh.regions, ElementsAre("pid_1", "pid_2"));
  EXPECT_THAT(refusal(kSheetSection + kSolid + "CQUAD4,50,2,15,16,13,14\n"),
              HasSubstr("found edge 15-16 of shell CQUAD4 50 on nodes of solids"));
}

TEST(NastranShells, AMeshWithoutPropertiesHasRegionsWithoutASection) {
  const auto deck = read_deck(kSheetGrids + "CQUAD4,11,2,1,2,5,4\n");
  EXPECT_EQ(deck.mesh.shells.at(0).nodes.rows(), 1);
  EXPECT_TRUE(deck.shells.empty());
  EXPECT_TRUE(deck.regions.at(0).material.empty());
}

TEST(NastranShells, BarsEndOnThemWithoutAHinge) {
  const auto deck = read_deck(kTwoShells + "PBAR,3,1,1.,1.,1.,1.\nCBAR,70,3,1,2,0.,0.,1.\n");
  EXPECT_EQ(deck.beams.at(0).ends, (std::array<int32_t, 2>{0, 1}));
  EXPECT_EQ(deck.beams.at(0).sections.at(0).J, 1.0);
}

}  // namespace
}  // namespace clatter::test
