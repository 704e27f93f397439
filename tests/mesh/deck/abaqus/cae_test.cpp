// SPDX-License-Identifier: GPL-3.0-or-later
// Decks as Abaqus/CAE writes them, keywords that change nothing, contact, sets in constraints.
#include <gmock/gmock.h>

#include "mesh/deck/recipe/recipe.hpp"
#include "mesh/deck/units.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// Two independent instances of an empty part, each with its own mesh, section and surface.
const std::string kInstances =
    "*Heading\n** Job name: Job-1 Model name: Model-1\n"
    "*Preprint, echo=NO, model=NO, history=NO, contact=NO\n"
    "*Part, name=P\n*End Part\n*Assembly, name=Assembly\n"
    "*Instance, name=P-1, part=P\n" +
    kCubeNodes +
    "*Element, type=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Elset, elset=Set-1\n1\n"
    "*Solid Section, elset=Set-1, material=Steel\n,\n*End Instance\n"
    "*Instance, name=P-2, part=P\n 0., 0., 1.\n 0., 0., 1., 0., 0., 2., 90.\n" +
    kCubeNodes +
    "*Element, type=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Elset, elset=Set-1\n1\n"
    "*Solid Section, elset=Set-1, material=Steel\n,\n*End Instance\n"
    "*Nset, nset=Fixed, instance=P-1, generate\n1, 4, 1\n"
    "*Elset, elset=_Up_S2, internal, instance=P-1\n1\n*Surface, type=ELEMENT, name=Up\n_Up_S2, S2\n"
    "*Elset, elset=_Down_S1, internal, instance=P-2\n1\n"
    "*Surface, type=ELEMENT, name=Down\n_Down_S1, S1\n";
const std::string kSteelCae =
    "*End Assembly\n*Material, name=Steel\n*Damping, alpha=3., beta=1e-06\n*Density\n7.8e-09,\n"
    "*Elastic\n210000., 0.3\n*Plastic\n300., 0.\n400., 0.1\n";
const std::string kFrequency =
    "*Step, name=Step-1, nlgeom=NO, perturbation\n"
    "*Frequency, eigensolver=Lanczos, sim=NO, acoustic coupling=on, normalization=displacement\n"
    "10, , , , ,\n*Boundary\nFixed, ENCASTRE\n*Restart, write, frequency=0\n"
    "*Output, field, variable=PRESELECT\n*End Step\n";

TEST(AbaqusCae, MeshesOnInstancesAreMovedWithThem) {
  const Deck deck = read(kInstances + kSteelCae + kFrequency);
  EXPECT_EQ(deck.mesh.cell_count(), 2);
  EXPECT_THAT(deck.mesh.regions, ElementsAre("P-1.Set-1", "P-2.Set-1"));
  // Node 7 of P-2 is at (1, 1, 1), moved by 1 along z and turned about z by 90 deg.
  const Eigen::RowVector3d moved = deck.mesh.nodes.row(node(deck, 107));
  EXPECT_LT((moved - Eigen::RowVector3d(-1, 1, 2)).norm(), 1e-15);
  EXPECT_EQ(deck.mesh.surface("Down").face_count(), 1);
  EXPECT_EQ(deck.steps.at(0).modes, 10);
  EXPECT_EQ(deck.steps.at(0).supports.at(0).node_indices.size(), 4u);
}

TEST(AbaqusCae, AnInstanceAddsToItsPart) {
  const Deck deck = read("*Part, name=P\n" + kCube +
                         "*End Part\n*Assembly, name=A\n"
                         "*Instance, name=P-1, part=P\n*Nset, nset=Corner\n1\n*End Instance\n"
                         "*End Assembly\n");
  EXPECT_EQ(deck.mesh.node_set("Corner").size(), 1u);
  EXPECT_THAT(refusal("*Instance, name=P-1, part=Q\n*Node\n1, 0, 0, 0\n*End Instance\n"),
              HasSubstr("deck.inp:1: found no part 'Q'"));
}

TEST(AbaqusCae, AnEndOfTheDeckIsPassedOver) {
  EXPECT_THAT(read(kCube + "*End").passed, HasSubstr("end of the deck: *END"));
}

TEST(AbaqusCae, WhatChangesNeitherKNorMIsPassedOverAndListed) {
  Deck deck = read(kInstances + kSteelCae + kFrequency);
  EXPECT_EQ(deck.passed,
            "passed over, since neither stiffness nor mass depends on it: damping, offered to the "
            "recipe: *DAMPING; files of a restart: *RESTART; of a nonlinear analysis: *PLASTIC; "
            "output: *PREPRINT, *OUTPUT; title: *HEADING");
  EXPECT_TRUE(deck.ignored.empty());
  convert_units(deck, unit_system_named("mm-t-s", "units"));
  EXPECT_THAT(recipe_of(deck).text(),
              HasSubstr("# [damping]\n# alpha = 1e-06\n# beta = 3\n"));  // alpha multiplies K here
}

TEST(AbaqusCae, DampingOfASubstructureIsPassedOver) {
  const Deck deck = read(kInstances + kSteelCae + kFrequency +
                         "*Step, name=Sub\n*Substructure Generate, type=Z1\n*Damping Controls, "
                         "structural=NONE\n*Flexible Body, type=ADAMS\n*Retained Nodal Dofs\n"
                         "Fixed, 1, 3\n*End Step\n");
  EXPECT_EQ(deck.retained.at(0).node_indices.size(), 4u);
  EXPECT_THAT(deck.passed, HasSubstr("*DAMPING CONTROLS"));
}

TEST(AbaqusCae, ElementsOfTheAssemblyNameNodesOfInstances) {
  const std::string springs =
      "*Element, type=SpringA, elset=S\n1, P-1.7, P-2.1\n*Spring, elset=S\n\n50.\n"
      "*Element, type=Spring1, elset=T\n2, P-2.7\n*Spring, elset=T\n2\n9.\n";
  const Deck deck = read(kInstances + springs + kSteelCae + kFrequency);
  ASSERT_EQ(deck.springs.size(), 2u);
  // From (1, 1, 1) to (0, 0, 1), nodes 7 and 101.
  EXPECT_EQ(deck.springs[0].terms.size(), 4u);
  EXPECT_EQ(deck.springs[0].terms[0].node_index, node(deck, 101));
  EXPECT_EQ(deck.springs[0].terms[1].node_index, node(deck, 7));
  EXPECT_EQ(deck.springs[1].terms.at(0).node_index, node(deck, 107));
  EXPECT_THAT(refusal(kInstances + "*Element, type=Spring1, elset=S\n1, P-3.7\n" + kSteelCae),
              HasSubstr("found no instance 'P-3'"));
}

TEST(AbaqusCae, QuotedNamesHaveBlanksAndCommas) {
  const Deck deck =
      read(kCubeNodes +
           "*ELEMENT, TYPE=C3D8, ELSET=\"The cube, 1\"\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
           "*NSET, NSET=\"The foot, held\"\n1, 2, 3\n*NSET, NSET=All\n\"The foot, held\", 4\n"
           "*MATERIAL, NAME=\"S355, plate\"\n*ELASTIC\n2.1E5, .3\n"
           "*SOLID SECTION, ELSET=\"The cube, 1\", MATERIAL=\"S355, plate\"\n"
           "*BOUNDARY\n\"The foot, held\", 1, 3\nall, 3\n");
  EXPECT_EQ(deck.mesh.node_set("All").size(), 4u);
  ASSERT_EQ(deck.supports.size(), 2u);
  EXPECT_EQ(deck.supports[1].node_indices.size(), 3u);
}

TEST(AbaqusCae, GravityWithoutASetIsThatOfTheModel) {
  const Deck deck =
      read(kInstances + kSteelCae +
           "*Initial Conditions, type=VELOCITY\nFixed, 1, 0.\n*Step, name=Load\n*Static\n"
           "1., 1., 1e-05, 1.\n*Dload\n, GRAV, 9810., 0., 0., -1.\n*Dsload, follower=NO\n"
           "Up, P, 2.\n*End Step\n");
  EXPECT_EQ(deck.steps.at(0).acceleration, Eigen::Vector3d(0, 0, -9810));
  EXPECT_EQ(deck.steps.at(0).pressures.at(0).surface, "Up");
  EXPECT_THAT(deck.passed, HasSubstr("*INITIAL CONDITIONS, TYPE=VELOCITY"));
}

TEST(AbaqusCae, KeywordsThatDoChangeThemAreRefusedWithWhatReplacesThem) {
  EXPECT_THAT(refusal(kModel + "*CONNECTOR LOCK, COMPONENT=1\n1.\n"),
              HasSubstr("its connections: [[spring]] and [[equation]] of the recipe replace it"));
  EXPECT_THAT(refusal(kModel + "*IMPERFECTION, FILE=a, STEP=1\n1, .1\n"),
              HasSubstr("with its data lines: nodes then stay where they were before it"));
  EXPECT_THAT(refusal(kModel + "*ODD THING\n"),
              HasSubstr("and what it adds to stiffness, mass, supports or couplings: [[spring]]"));
}

const std::string kPair = "*Surface Interaction, name=Glue\n1.,\n";

TEST(AbaqusContact, BondedPairsAreTies) {
  const std::string head = kInstances + kSteelCae + kPair;
  for (const std::string& way :
       {std::string("*Surface Behavior, pressure-overclosure=TIED\n1.e7\n"
                    "*Contact Pair, interaction=Glue, type=SURFACE TO SURFACE, adjust=0.01\n"),
        std::string("*Friction, rough\n*Surface Behavior, no separation\n"
                    "*Contact Pair, interaction=Glue, adjust=0.01\n"),
        std::string("*Friction\n0.1\n*Contact Pair, interaction=Glue, tied, adjust=0.01\n")}) {
    const Deck deck = read(head + way + "Down, Up\n" + kFrequency);
    ASSERT_EQ(deck.ties.size(), 1u) << way;
    EXPECT_EQ(deck.ties[0].name, "bonded_Down_Up");
    EXPECT_EQ(deck.ties[0].slave, "Down");
    EXPECT_EQ(deck.ties[0].master, "Up");
    EXPECT_EQ(deck.ties[0].distance, 0.01);
  }
}

TEST(AbaqusContact, SlidingPairsAreRefusedWithTheWayOut) {
  EXPECT_THAT(refusal(kInstances + kSteelCae + kPair +
                      "*Friction\n0.2,\n*Contact Pair, interaction=Glue\nDown, Up\n" + kFrequency),
              HasSubstr("contact with GLUE opens and slides, which is not linear; expected TIED"));
}

TEST(AbaqusContact, BondedPairsOfGeneralContactAreTies) {
  const std::string head = kInstances + kSteelCae + kPair +
                           "*Cohesive Behavior\n*Surface Interaction, name=Slip\n1.,\n*Contact\n";
  const Deck named = read(head +
                          "*Contact Inclusions\nDown, Up\n*Contact Property Assignment\n"
                          "Down, Up, Glue\n" +
                          kFrequency);
  ASSERT_EQ(named.ties.size(), 1u);
  EXPECT_TRUE(named.notes.empty());
  const Deck all = read(head +
                        "*Contact Inclusions, ALL EXTERIOR\n*Contact Property Assignment\n"
                        " ,  , Slip\nDown, Up, Glue\n" +
                        kFrequency);
  ASSERT_EQ(all.ties.size(), 1u);
  ASSERT_EQ(all.notes.size(), 1u);
  EXPECT_THAT(all.notes[0], HasSubstr("general contact of all other surfaces opens and slides"));
  EXPECT_THAT(refusal(head + "*Contact Inclusions, ALL EXTERIOR\n" + kFrequency),
              HasSubstr("opens and slides"));
  EXPECT_TRUE(
      read(head + "*Contact Inclusions, ALL EXTERIOR\n" + kFrequency, {"*CONTACT"}).ties.empty());
}

TEST(AbaqusSets, InEquationsTheyStandForOneEquationEach) {
  const Deck deck = read(kModel +
                         "*NSET, NSET=REVERSED, UNSORTED\n8, 7, 6, 5\n*EQUATION\n3\n"
                         "BOT, 1, 1.\nREVERSED, 1, -1.\n9, 1, 2.\n");
  ASSERT_EQ(deck.equations.size(), 4u);
  for (int32_t i = 0; i < 4; ++i) {
    const Equation& one = deck.equations[i];
    ASSERT_EQ(one.terms.size(), 3u);
    EXPECT_EQ(one.terms[0].node_index, node(deck, 1 + i));
    EXPECT_EQ(one.terms[1].node_index, node(deck, 8 - i));
    EXPECT_EQ(one.terms[2].coefficient, 2.0);
  }
  EXPECT_THAT(refusal(kModel + "*EQUATION\n2\nBOT, 1, 1.\nNALL, 1, -1.\n"),
              HasSubstr("found sets of 4 and 10 nodes"));
}

TEST(AbaqusSets, InMpcsNodesArePairedOrShareOne) {
  const Deck pin = read(kModel + "*MPC\nPIN, BOT, TOP\n");
  EXPECT_EQ(pin.equations.size(), 12u);
  const Deck beam = read(kModel + "*MPC\nBEAM, TOP, 9\n");
  ASSERT_EQ(beam.rigid.size(), 1u);
  EXPECT_EQ(beam.rigid[0].reference, point(beam, 9));
  EXPECT_EQ(beam.rigid[0].dependents.size(), 4u);
}

TEST(AbaqusRigid, TieAndPinSetsAndKinematicCouplings) {
  const Deck body = read(kModel + "*RIGID BODY, REF NODE=9, TIE NSET=TOP, PIN NSET=BOT\n");
  ASSERT_EQ(body.rigid.size(), 2u);
  EXPECT_EQ(body.rigid[0].dofs, kAllDofs);
  EXPECT_EQ(body.rigid[1].dofs, kTranslations);
  EXPECT_EQ(body.rigid[1].dependents.size(), 4u);
  const Deck kinematic = read(kModel + "*KINEMATIC COUPLING, REF NODE=9\nTOP, 1, 3\nBOT, 3\n");
  ASSERT_EQ(kinematic.rigid.size(), 2u);
  EXPECT_EQ(kinematic.rigid[0].dofs, 0b000100);
  EXPECT_EQ(kinematic.rigid[1].dofs, kTranslations);
  EXPECT_EQ(kinematic.rigid[1].reference, point(kinematic, 9));
}

TEST(AbaqusRigid, BodiesThatTouchNoSolidAreLeftOutWithANote) {
  const Deck deck = read(kModel +
                         "*NODE\n21, 5, 0, 0\n22, 6, 0, 0\n23, 6, 1, 0\n*ELEMENT, TYPE=R3D3, "
                         "ELSET=TOOL\n60, 21, 22, 23\n*RIGID BODY, ELSET=TOOL, REF NODE=9\n");
  EXPECT_TRUE(deck.rigid.empty());
  EXPECT_THAT(deck.notes.back(), HasSubstr("deck.inp:30: the rigid body moves no node"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
