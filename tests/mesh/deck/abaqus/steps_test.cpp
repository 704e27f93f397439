// SPDX-License-Identifier: GPL-3.0-or-later
// Supports, loads and steps.
#include <numeric>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck {
namespace {

using testing::ids_of;
using testing::kModel;
using testing::node;
using testing::point;
using testing::read;
using testing::refusal;

std::string step(const std::string& cards) { return "*STEP\n*STATIC\n" + cards + "*END STEP\n"; }

// Sum of the forces of a step by direction.
double force(const Step& step, int direction) {
  double sum = 0.0;
  for (const auto& f : step.forces) sum += f.direction == direction ? f.value : 0.0;
  return sum;
}

TEST(AbaqusBoundary, RangesNamesAndValues) {
  const Deck deck =
      read(kModel + "*BOUNDARY\nBOT, 1, 3\n5, XSYMM\n6, 2\n7, 1, 1, 0.5\n8, ENCASTRE\n");
  std::map<int32_t, DofMask> held;
  for (const Support& support : deck.supports) {
    for (const NodeIndex node_index : support.node_indices)
      held[ids_of(deck, {node_index})[0]] |= support.dofs;
    EXPECT_EQ(support.value, support.node_indices[0] == node(deck, 7) ? 0.5 : 0.0);
    EXPECT_EQ(support.where, "deck.inp:24");
  }
  // Nodes of solids have no rotations to fix.
  EXPECT_EQ(held, (std::map<int32_t, DofMask>{
                      {1, 7}, {2, 7}, {3, 7}, {4, 7}, {5, 1}, {6, 2}, {7, 1}, {8, 7}}));
}

TEST(AbaqusBoundary, NamesOfSupportsFixTheDofsOfAbaqus) {
  const std::map<std::string, DofMask> wanted = {
      {"XSYMM", 0b110001},  {"YSYMM", 0b101010},  {"ZSYMM", 0b011100},  {"XASYMM", 0b001110},
      {"YASYMM", 0b010101}, {"ZASYMM", 0b100011}, {"PINNED", 0b000111}, {"ENCASTRE", 0b111111}};
  for (const auto& [name, mask] : wanted) {
    const Deck deck =
        read(kModel + "*RIGID BODY, NSET=TOP, REF NODE=9\n*BOUNDARY\n9, " + name + "\n");
    EXPECT_EQ(deck.supports.at(0).dofs, mask) << name;
  }
}

TEST(AbaqusBoundary, ContradictionsAndStrangeDofsAreRefused) {
  EXPECT_NE(refusal(kModel + "*BOUNDARY\n1, 1, 1, 0.\n1, 1, 1, 2.\n")
                .find("deck.inp:26: node 1 is fixed at 0 and at 2 in direction 1"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*BOUNDARY\n1, 11, 11, 20.\n").find("found '11' in field 2"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*BOUNDARY\n1, 3, 2\n").find("from 3 to 6"), std::string::npos);
  EXPECT_NE(refusal(kModel + "*BOUNDARY, TYPE=VELOCITY\n1, 1\n").find("TYPE=DISPLACEMENT"),
            std::string::npos);
}

TEST(AbaqusBoundary, TransformedNodesAreHeldAndPushedInTheirAxes) {
  const Deck deck =
      read(kModel + "*TRANSFORM, NSET=TOP, TYPE=C\n0,0,0,0,0,1\n*BOUNDARY\nNALL, 2\n" +
           step("*CLOAD\n7, 1, 3.\n"));
  ASSERT_EQ(deck.supports.size(), 2u);
  EXPECT_EQ(deck.supports[0].system, "");
  EXPECT_EQ(ids_of(deck, deck.supports[1].node_indices), (std::vector<int32_t>{5, 6, 7, 8}));
  EXPECT_EQ(deck.supports[1].system, "transform_1");
  EXPECT_EQ(deck.systems.at("transform_1").kind, System::Kind::kCylindrical);
  EXPECT_EQ(deck.steps.at(0).forces.at(0).system, "transform_1");
}

TEST(AbaqusSteps, LoadsOfOneStepAddUpAndThoseOfTheNextReplaceThem) {
  const Deck deck =
      read(kModel + step("*CLOAD\n5, 3, 1.\n5, 3, 2.\n6, 1, 4.\n*CLOAD\nTOP, 3, 10.\n") +
           step("*CLOAD\n5, 3, 7.\n") + step("*CLOAD, OP=NEW\n8, 2, 1.\n"));
  ASSERT_EQ(deck.steps.size(), 3u);
  EXPECT_EQ(force(deck.steps[0], 2), 43.0);
  EXPECT_EQ(force(deck.steps[0], 0), 4.0);
  EXPECT_EQ(force(deck.steps[1], 2), 37.0);
  EXPECT_EQ(force(deck.steps[1], 0), 4.0);
  EXPECT_EQ(force(deck.steps[2], 1), 1.0);
  EXPECT_EQ(force(deck.steps[2], 2), 0.0);
}

TEST(AbaqusSteps, SupportsPersistUntilTheyAreReplaced) {
  const Deck mod = read(kModel + "*BOUNDARY\nBOT, 1, 3\n" + step("*BOUNDARY\n5, 3, 3, .1\n") +
                        step("*BOUNDARY\n1, 1, 1, .2\n"));
  EXPECT_EQ(mod.supports.size(), 1u);
  ASSERT_EQ(mod.steps[1].supports.size(), 2u);
  EXPECT_EQ(mod.steps[1].supports[0].value, 0.1);
  EXPECT_EQ(mod.steps[1].supports[1].value, 0.2);
  const Deck replaced =
      read(kModel + "*BOUNDARY\nBOT, 1, 3\n" + step("") + step("*BOUNDARY, OP=NEW\n5, 1\n"));
  EXPECT_TRUE(replaced.supports.empty());  // no longer of the entire model
  EXPECT_EQ(replaced.steps[0].supports.at(0).node_indices.size(), 4u);
  ASSERT_EQ(replaced.steps[1].supports.size(), 1u);
  EXPECT_EQ(ids_of(replaced, replaced.steps[1].supports[0].node_indices), std::vector<int32_t>{5});
}

TEST(AbaqusSteps, PressuresPushOnFacesGravityOnAll) {
  const Deck deck = read(kModel + "*SURFACE, NAME=LID\nEALL, S2\n" +
                         step("*DLOAD\nEALL, P1, 3.\n1, P1, 1.\n1, P3, 4.\n"
                              "EALL, GRAV, 9810., 0., 0., -2.\n*DSLOAD\nLID, P, 5.\n"));
  const Step& s = deck.steps.at(0);
  ASSERT_EQ(s.pressures.size(), 2u);  // 3 + 1 on S1 and 4 on S3 are one surface
  EXPECT_EQ(s.pressures[0].value, 4.0);
  EXPECT_EQ(deck.mesh.surface(s.pressures[0].surface).face_count(), 2);
  EXPECT_EQ(s.pressures[1].surface, "LID");
  EXPECT_EQ(s.acceleration, Eigen::Vector3d(0, 0, -9810));
}

TEST(AbaqusSteps, TheSameGravityTwiceActsTwice) {
  const std::string line = "EALL, GRAV, 9810., 0., 0., -1.\n";
  EXPECT_EQ(read(kModel + step("*DLOAD\n" + line + line)).steps.at(0).acceleration,
            Eigen::Vector3d(0, 0, -19620));
}

// A mass that is not in the set would be loaded with it.
TEST(AbaqusSteps, LoadsOfABodyBesideAMassAreThoseOfTheBodyOrRefused) {
  const std::string model =
      kModel + "*ELEMENT, TYPE=MASS, ELSET=LUMP\n90, 5\n*MASS, ELSET=LUMP\n1.\n";
  const auto bad = [&](const std::string& lines) {
    return refusal(model + step("*DLOAD\n" + lines));
  };
  EXPECT_NE(bad("EALL, GRAV, 9810., 0., 0., -1.\n").find("also those of *MASS and beams"),
            std::string::npos);
  EXPECT_NE(bad("LUMP, CENTRIF, 4., 0,0,0, 0,0,1\n").find("CENTRIF acts on *MASS or beams"),
            std::string::npos);
  EXPECT_EQ(read(model + step("*DLOAD\n, GRAV, 9810., 0., 0., -1.\n")).steps.at(0).acceleration,
            Eigen::Vector3d(0, 0, -9810));
  const std::string body = "EALL, CENTRIF, 4., 0,0,0, 0,0,1\n",
                    lump = "LUMP, CENTRIF, 4., 0,0,0, 0,0,1\n";
  const Deck alone = read(model + step("*DLOAD\n" + body));
  ASSERT_EQ(alone.steps.at(0).rotations.size(), 1u);
  EXPECT_FALSE(alone.steps[0].rotations[0].regions.empty());  // without masses
  const Deck both = read(model + step("*DLOAD\n" + body + lump));
  ASSERT_EQ(both.steps.at(0).rotations.size(), 1u);
  EXPECT_TRUE(both.steps[0].rotations[0].regions.empty());  // everything
}

TEST(AbaqusSteps, UnsupportedLoadsAreRefused) {
  const auto bad = [](const std::string& cards) { return refusal(kModel + step(cards)); };
  EXPECT_NE(bad("*DLOAD\nEALL, CORIO, 1., 0,0,0, 0,0,1\n").find("load CORIO"), std::string::npos);
  EXPECT_NE(bad("*DLOAD\nEALL, P7, 1.\n").find("load P7"), std::string::npos);
  EXPECT_NE(bad("*CLOAD\n9, 1, 1.\n").find("node 9, which belongs to no element"),
            std::string::npos);
  EXPECT_NE(bad("*CLOAD\n5, 4, 1.\n").find("a moment on node 5"), std::string::npos);
  EXPECT_NE(refusal(kModel + "*CLOAD\n5, 1, 1.\n").find("expected it inside a step"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*STEP, NLGEOM\n*STATIC\n*END STEP\n").find("ignore = [\"NLGEOM\"]"),
            std::string::npos);
  EXPECT_EQ(read(kModel + "*STEP, NLGEOM=NO\n*STATIC\n*END STEP\n").steps.size(), 1u);
  EXPECT_EQ(read(kModel + "*STEP, NLGEOM\n*STATIC\n*END STEP\n", {"nlgeom"}).ignored.at("NLGEOM"),
            1);
  EXPECT_NE(refusal(kModel + "*STEP\n*STATIC\n").find("*STEP without *END STEP"),
            std::string::npos);
}

TEST(AbaqusSteps, GravityOnSomeElementsIsRefused) {
  EXPECT_NE(refusal("*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n"
                    "*ELEMENT, TYPE=C3D4, ELSET=A\n1,1,2,3,4\n2,2,3,4,5\n"
                    "*STEP\n*STATIC\n*DLOAD\n1, GRAV, 1., 0,0,1\n*END STEP\n")
                .find("GRAV, BX, BY or BZ acts on some elements only"),
            std::string::npos);
}

// A force of 3 with an amplitude, in a static step whose line is `times`.
double scaled(const std::string& amplitude, const std::string& times) {
  const Deck deck = read(kModel + "*AMPLITUDE, NAME=A" + amplitude + "*STEP\n*STATIC\n" + times +
                         "*CLOAD, AMPLITUDE=a\n5, 1, 3.\n*END STEP\n");
  return force(deck.steps.at(0), 0);
}

TEST(AbaqusSteps, AmplitudesAreTakenAtTheEndOfAStaticStep) {
  EXPECT_EQ(scaled("\n0., 2., 1., 2.\n", ""), 6.0);
  EXPECT_EQ(scaled("\n0., 0., 1., 1.\n", ""), 3.0);
  EXPECT_EQ(scaled("\n0., 0., 1., 1.\n", ".1, .5\n"), 1.5);
  EXPECT_EQ(scaled("\n0., 0., 1., 1.\n2., .5\n", ".1, 1.5\n"), 2.25);
  EXPECT_EQ(scaled("\n.7, .2, 1., 1.\n", ".1, .5\n"), 3.0 * 0.2);
  EXPECT_EQ(scaled(", DEFINITION=SMOOTH STEP\n0., 0., 1., 1.\n", ".1, .5\n"), 1.5);
  // (1/4)^3 (10 - 15/4 + 6/16)
  EXPECT_DOUBLE_EQ(scaled(", DEFINITION=SMOOTH STEP\n0., 0., 1., 1.\n", ".1, .25\n"),
                   3.0 * 0.103515625);
}

TEST(AbaqusSteps, AmplitudesOfTheTotalTimeGoOnOverSteps) {
  const std::string load = "*AMPLITUDE, NAME=A, TIME=TOTAL TIME\n0., 0., 4., 1.\n";
  const std::string one = "*STEP\n*STATIC\n.1, 1.\n*CLOAD, AMPLITUDE=A\n5, 1, 8.\n*END STEP\n";
  const Deck deck = read(kModel + load + one + one + one);
  EXPECT_EQ(force(deck.steps.at(0), 0), 2.0);
  EXPECT_EQ(force(deck.steps.at(2), 0), 6.0);
}

TEST(AbaqusSteps, AmplitudesWithoutAnEndOfTheStepAreRefused) {
  const std::string load = "*CLOAD, AMPLITUDE=A\n5, 1, 3.\n";
  const std::string table = kModel + "*AMPLITUDE, NAME=A\n0., 0., 1., 1.\n";
  const std::string later = "*STEP, PERTURBATION\n*STATIC\n" + load + "*END STEP\n";
  EXPECT_NE(refusal(table + later)
                .find("amplitude A changes with time, expected a table that a general *STATIC"),
            std::string::npos);
  EXPECT_EQ(force(read(table + later, {"AMPLITUDE"}).steps[0], 0), 3.0);
  EXPECT_NE(refusal(kModel + "*AMPLITUDE, NAME=A, DEFINITION=PERIODIC\n1, 50., 0., 0.\n1., 0.\n" +
                    step(load))
                .find("amplitude A changes with time"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*AMPLITUDE, NAME=A, VALUE=ABSOLUTE\n0., 0., 1., 1.\n" + step(load))
                .find("expected VALUE=RELATIVE"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*AMPLITUDE, NAME=A\n1., 0., 0., 1.\n" + step(load))
                .find("found time 0 after 1, expected ascending times"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + step("*CLOAD, AMPLITUDE=X\n5, 1, 3.\n")).find("no amplitude 'X'"),
            std::string::npos);
}

TEST(AbaqusSteps, ForcesPerVolumeAreAccelerationsWhereThereIsOneDensity) {
  const std::string force = "*DLOAD\nEALL, BY, 1.56E-8\n";
  EXPECT_EQ(read(kModel + step(force)).steps.at(0).acceleration, Eigen::Vector3d(0, 2, 0));
  std::string light = kModel;
  light.erase(light.find("*DENSITY"), std::string("*DENSITY\n7.8E-9\n").size());
  EXPECT_NE(refusal(light + step(force)).find("BY acts on a material without density"),
            std::string::npos);
  const std::string second =
      "*NODE\n11, 0, 0, 2\n12, 1, 0, 2\n13, 1, 1, 2\n14, 0, 1, 2\n*ELEMENT, TYPE=C3D8, ELSET=B\n"
      "2, 5, 6, 7, 8, 11, 12, 13, 14\n";
  EXPECT_NE(
      refusal(kModel + second +
              "*MATERIAL, NAME=M\n*ELASTIC\n7E4, .3\n*DENSITY\n1E-9\n*SOLID SECTION, ELSET=B, "
              "MATERIAL=M\n" +
              step("*DLOAD\n, BX, 1.\n"))
          .find("BX acts on materials of several densities"),
      std::string::npos);
  EXPECT_NE(refusal(kModel + second + "*SOLID SECTION, ELSET=B, MATERIAL=STEEL\n" + step(force))
                .find("acts on some elements only"),
            std::string::npos);
}

TEST(AbaqusSteps, TemperaturesCountFromTheInitialOnes) {
  const std::string uniform = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n";
  const Deck deck = read(kModel + uniform + step("*TEMPERATURE\nTOP, 120.\n") + step(""));
  EXPECT_EQ(deck.materials.at("Steel").reference_temperature, 20.0);
  ASSERT_EQ(deck.steps[0].temperature, "temperature_1");
  const RowMatrix& field = deck.mesh.fields.at("temperature_1");
  EXPECT_EQ(field(node(deck, 1), 0), 20.0);
  EXPECT_EQ(field(node(deck, 7), 0), 120.0);
  EXPECT_EQ(deck.mesh.fields.at(deck.steps[1].temperature), field);
  const Deck two = read(kModel + uniform + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n7, 50.\n" +
                        step("*TEMPERATURE\nTOP, 120.\n"));
  EXPECT_EQ(two.materials.at("Steel").reference_temperature, 0.0);
  EXPECT_EQ(two.mesh.fields.at("temperature_1")(node(two, 7), 0), 70.0);
  EXPECT_EQ(two.mesh.fields.at("temperature_1")(node(two, 1), 0), 0.0);
  EXPECT_TRUE(read(kModel + uniform + step("")).steps[0].temperature.empty());
}

TEST(AbaqusSteps, FrequenciesAfterALoadedStepAreReadWithoutItsStressesOnRequest) {
  const std::string frequency =
      "*STEP, PERTURBATION\n*FREQUENCY, SOLVER=ARPACK\n7, 0., 100.\n*END STEP\n";
  EXPECT_EQ(read(kModel + frequency).steps.at(0).modes, 7);
  EXPECT_EQ(read(kModel + frequency).steps.at(0).kind, Step::Kind::kFrequency);
  EXPECT_EQ(read(kModel + step("*CLOAD\n5, 1, 1.\n") + frequency).steps.size(), 1u);
  EXPECT_EQ(read(kModel + step("*CLOAD\n5, 1, 1.\n") + frequency, {"PERTURBATION"}).steps.size(),
            2u);
}

TEST(AbaqusSteps, OutputRequestsAreSkippedWithTheirLines) {
  const Deck deck =
      read(kModel + "*PREPRINT, ECHO=NO\n*RESTART, WRITE\n" +
           step("*NODE FILE, NSET=NOWHERE\nU, RF\n*NODEPRINT\nU\n*EL PRINT, ELSET=X\nS\n"
                "*OUTPUT, FIELD\n*NODE OUTPUT\nU\n*SECTION PRINT\nA\n*CONTROLS\n1,2\n"));
  EXPECT_EQ(deck.steps.size(), 1u);
  EXPECT_TRUE(deck.ignored.empty());
}

TEST(AbaqusSteps, RetainedDofsAreKept) {
  const Deck deck =
      read(kModel +
           "*STEP\n*SUBSTRUCTURE GENERATE\n*RETAINED NODAL DOFS, SORTED=NO\nTOP, 1, 3\n"
           "*SUBSTRUCTURE MATRIX OUTPUT, STIFFNESS=YES\n*END STEP\n");
  ASSERT_EQ(deck.retained.size(), 1u);
  EXPECT_EQ(ids_of(deck, deck.retained[0].node_indices), (std::vector<int32_t>{5, 6, 7, 8}));
  EXPECT_EQ(deck.retained[0].dofs, kTranslations);
}

}  // namespace
}  // namespace clatter::mesh::deck
