// SPDX-License-Identifier: GPL-3.0-or-later
// The recipe of a deck, given to clatter-assembly's reader as data and as its text.
#include "mesh/deck/recipe/recipe.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "assembly/recipe/recipe.hpp"
#include "core/base/config.hpp"
#include "core/mesh/boundary.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/nastran/reader.hpp"
#include "mesh/deck/recipe/names.hpp"
#include "mesh/deck/units.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using assembly::LoadSpec;
using assembly::Recipe;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

struct Parsed {
  std::string text;
  Recipe recipe;
};

Parsed parse(Deck deck) {
  deck.mesh.surfaces["skin"] = skin_of(boundary_faces(deck.mesh));
  const deck::Recipe recipe = recipe_of(deck);
  const std::string text = recipe.text();
  // From its text it is the same.
  const Config config = Config::parse(text, "deck.fe.toml");
  EXPECT_EQ(recipe::file_keys().text_of(recipe::file_keys().read(config)),
            std::regex_replace(text, std::regex("  #[^\n]*|# [^\n]*\n"), ""));
  assembly::read_recipe(config, deck.mesh);
  return {text, assembly::read_recipe(recipe.file, deck.mesh)};
}

TEST(RecipeText, WritesMaterialSupportForceAndStep) {
  const Parsed parsed = parse(read(kModel + "*BOUNDARY\nBOT, 1, 3\n"
                                            "*STEP\n*STATIC\n*CLOAD\nTOP, 3, -2.5\n*END STEP\n"));
  ASSERT_THAT(parsed.recipe.materials, SizeIs(1));
  EXPECT_EQ(parsed.recipe.materials[0].youngs, 2.1e5);
  EXPECT_EQ(parsed.recipe.materials[0].poisson, 0.3);
  EXPECT_EQ(parsed.recipe.materials[0].density, 7.8e-9);
  EXPECT_EQ(parsed.recipe.materials[0].integration.hex8, fe::Integration::kFull);
  ASSERT_THAT(parsed.recipe.supports, SizeIs(1));
  EXPECT_EQ(parsed.recipe.supports[0].selection.node_set, "BOT");
  EXPECT_THAT(parsed.recipe.supports[0].directions, ElementsAre(0, 1, 2));
  ASSERT_THAT(parsed.recipe.loads, SizeIs(1));
  EXPECT_EQ(parsed.recipe.loads[0].kind, LoadSpec::Kind::kNodal);
  ASSERT_THAT(parsed.recipe.cases, SizeIs(1));
  EXPECT_EQ(parsed.recipe.cases.begin()->second.begin()->second, 1.0);
}

TEST(RecipeText, GivesEveryNumberBackToTheLastBit) {
  const double value = 0.1 + 0.2;
  Deck deck = read(kModel);
  deck.materials.begin()->second.constants = {1.0 / 3.0, value};
  EXPECT_EQ(parse(std::move(deck)).recipe.materials[0].youngs, 1.0 / 3.0);
}

TEST(RecipeText, QuotesNamesThatTomlWouldMisread) {
  Deck deck = read(kModel);
  auto material = deck.materials.extract(deck.materials.begin());
  material.key() = "St \"37.2\"";
  deck.regions[0].material = material.key();
  deck.materials.insert(std::move(material));
  EXPECT_EQ(parse(std::move(deck)).recipe.materials[0].youngs, 2.1e5);
}

TEST(RecipeText, NotesWhatIsMissingInsteadOfInventingIt) {
  const std::string no_density = kCube +
                                 "*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E5, 0.3\n"
                                 "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n";
  EXPECT_THAT(parse(read(no_density)).text, HasSubstr("rho = 1  # the deck has none"));
  Deck bare = read(kCube);
  EXPECT_THAT(recipe_of(bare).text(), HasSubstr("# region \"EALL\" has no material in the deck"));
}

TEST(RecipeText, NamesTheLaterStepWhoseSupportsDiffer) {
  const Parsed parsed =
      parse(read(kModel + "*STEP\n*STATIC\n*BOUNDARY\nBOT, 1, 3\n*CLOAD\nTOP, 3, 1.\n*END STEP\n"
                          "*STEP\n*STATIC\n*BOUNDARY, OP=NEW\nTOP, 1, 3\n*END STEP\n"));
  EXPECT_THAT(parsed.recipe.cases, SizeIs(1));
  EXPECT_THAT(parsed.text, HasSubstr("it needs a separate model"));
}

TEST(RecipeText, KeepsARigidBodyOnItsPointAndItsMass) {
  const Parsed parsed =
      parse(read(kModel + "*RIGID BODY, NSET=TOP, REF NODE=9\n"
                          "*ELEMENT, TYPE=MASS, ELSET=M\n20, 9\n*MASS, ELSET=M\n2.5\n"));
  ASSERT_THAT(parsed.recipe.points, SizeIs(1));
  EXPECT_EQ(parsed.recipe.points[0].point.position, Eigen::Vector3d(0.5, 0.5, 2.0));
  ASSERT_THAT(parsed.recipe.couplings, SizeIs(1));
  EXPECT_TRUE(parsed.recipe.couplings[0].rigid);
  EXPECT_EQ(parsed.recipe.couplings[0].on_point, parsed.recipe.points[0].point.name);
  ASSERT_THAT(parsed.recipe.point_masses, SizeIs(1));
  EXPECT_EQ(parsed.recipe.point_masses[0].mass, 2.5);
}

TEST(RecipeText, SharesANodeSetAndMakesNoSecondOne) {
  Deck deck = read(kModel + "*BOUNDARY\n5, 1\n6, 1\n7, 1\n8, 1\n");
  EXPECT_THAT(recipe_of(deck).text(), HasSubstr("node_set = \"TOP\""));
  EXPECT_THAT(deck.mesh.node_sets, SizeIs(3));  // BOT, NALL, TOP
}

const std::string kNastran =
    "PSOLID,1,1,,THREE,,FULL\nMAT1,1,210.,,.3,7.8\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,"
    "1.,"
    "0.\nGRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
    "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\nGRID,9,,0.,0.,3.\nGRID,10,,0.,0.,5.\n";

Parsed parse_nastran(const std::string& text) { return parse(read_nastran_text("t.bdf", text)); }

TEST(RecipeText, RetainsReferenceGridsAndComponents) {
  const Recipe recipe =
      parse_nastran(kNastran + "RBE2,11,9,123456,5,6\nASET1,123456,9\nASET1,3,1,2\n").recipe;
  ASSERT_THAT(recipe.nodes, SizeIs(1));
  EXPECT_EQ(recipe.nodes[0].name, "retained");
  ASSERT_THAT(recipe.nodes[0].terms, SizeIs(2));
  EXPECT_THAT(recipe.nodes[0].terms[0].directions, ElementsAre(2));
  EXPECT_EQ(recipe.nodes[0].terms[1].selection.point, "point_9");
  EXPECT_THAT(recipe.nodes[0].terms[1].directions, ElementsAre(0, 1, 2, 3, 4, 5));
}

TEST(RecipeText, RetainsComponentsAlongTheAxesOfTheGrid) {
  std::string deck = kNastran;
  deck.replace(deck.find("GRID,2,,1.,0.,0."), 16, "GRID,2,,1.,0.,0.,6");
  const Recipe recipe =
      parse_nastran(deck +
                    "CORD2R,6,0,0.,0.,0.,1.,0.,0.,+\n+,0.,1.,0.\nASET1,3,1,2\nCONM2,1,2,,2.\n")
          .recipe;
  ASSERT_THAT(recipe.nodes, SizeIs(1));
  ASSERT_THAT(recipe.nodes[0].terms, SizeIs(2));
  EXPECT_TRUE(recipe.nodes[0].terms[0].axes.frame.isIdentity());
  EXPECT_THAT(recipe.nodes[0].terms[1].directions, ElementsAre(2));
  EXPECT_EQ(recipe.nodes[0].terms[1].axes.frame.col(2), Eigen::Vector3d::UnitX());
  EXPECT_EQ(recipe.point_masses.at(0).on, "on_node_2");  // no [[nodes]] of x y z beside it
}

TEST(RecipeText, WritesAccelerationsOfNodesAndMovedSupports) {
  Deck deck = read_nastran_text(
      "t.bdf", kNastran + "SPC1,1,123,1,THRU,4\nSPCD,3,2,2,.5\nACCEL1,3,,4.,1.,0.,0.,,,+\n+,5,6\n");
  convert_units(deck, unit_system_named("mm-t-s", ""));
  const Parsed parsed = parse(std::move(deck));
  ASSERT_THAT(parsed.recipe.loads, SizeIs(2));
  EXPECT_EQ(parsed.recipe.loads[0].kind, LoadSpec::Kind::kAcceleration);
  EXPECT_EQ(parsed.recipe.loads[0].field, "load_3_accelerations");
  EXPECT_EQ(parsed.recipe.loads[1].kind, LoadSpec::Kind::kDisplacement);
  EXPECT_THAT(parsed.recipe.loads[1].directions, ElementsAre(1));
  EXPECT_DOUBLE_EQ(parsed.recipe.loads[1].amount, 0.5e-3);
}

TEST(RecipeText, OffersTheDampingOfTheDeck) {
  EXPECT_THAT(parse_nastran(kNastran + "PARAM,ALPHA1,3.\nPARAM,ALPHA2,1.-5\n").text,
              HasSubstr("# the deck's damping of PARAM, ALPHA1 and ALPHA2 (t.bdf), not used unless "
                        "these lines are:\n# [damping]\n# alpha = 1e-05\n# beta = 3\n"));
}

TEST(RecipeText, HasTheMassAndIntegrationOfNastran) {
  const Recipe lumped = parse_nastran(kNastran).recipe;
  EXPECT_EQ(lumped.mass, fe::MassForm::kHrz);
  EXPECT_EQ(lumped.materials.at(0).integration.hex8, fe::Integration::kFine);
  EXPECT_EQ(parse_nastran(kNastran + "PARAM,COUPMASS,1\n").recipe.mass, fe::MassForm::kConsistent);
}

TEST(RecipeText, WritesMatricesAndSpringsWithLevers) {
  const Recipe recipe = parse_nastran("CEND\nM2GG = MB\nBEGIN BULK\n" + kNastran +
                                      "CBUSH,7,8,9,10,1.,0.,0.\nPBUSH,8,K,10.,20.\n"
                                      "DMIG,MB,0,6,1,0\nDMIG,MB,9,1,,9,1,5.,,+\n+,10,2,-4.\n")
                            .recipe;
  ASSERT_THAT(recipe.springs, SizeIs(2));
  EXPECT_THAT(recipe.springs[1].terms, SizeIs(4));
  ASSERT_THAT(recipe.matrices, SizeIs(1));
  EXPECT_TRUE(recipe.matrices[0].is_mass);
  EXPECT_EQ(recipe.matrices[0].values(0, 0), 5.0);
  EXPECT_EQ(recipe.matrices[0].values(0, 1), -4.0);
}

// [[nodes]] would keep a node that the coupling moves.
TEST(RecipeText, AMassOnADependentNodeIsOnAPoint) {
  const Recipe recipe =
      parse_nastran(kNastran + "RBE2,11,9,123456,5,6\nCONM2,1,5,,2.\nCONM2,2,1,,3.\n").recipe;
  ASSERT_THAT(recipe.point_masses, SizeIs(2));
  EXPECT_EQ(recipe.point_masses[0].on, "on_node_5");
  EXPECT_EQ(recipe.point_masses[1].on, "mass_node_1");
}

class DeckFile : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              (std::string("clatter_deck_file_") +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::filesystem::path folder_;
};

TEST_F(DeckFile, IsKnownByItsExtensionInAnyCase) {
  for (const char* name : {"a.inp", "a.INP", "a.bdf", "a.nas", "a.DAT", "a.fem"})
    EXPECT_TRUE(is_deck(name));
  for (const char* name : {"a.toml", "a", "a.step"}) EXPECT_FALSE(is_deck(name));
}

TEST_F(DeckFile, IsReadToSiWithItsSkin) {
  const Deck deck = read_deck(write("cube.inp", kModel), unit_system_named("mm-t-s", ""), {});
  EXPECT_EQ(deck.mesh.nodes.maxCoeff(), 1e-3);
  EXPECT_EQ(deck.mesh.surface("skin").face_count(), 6);
  EXPECT_NEAR(deck.materials.begin()->second.constants[0], 2.1e11, 1e-3);
}

TEST_F(DeckFile, WithLeftHandedCellsIsReadAndSaysSo) {
  const std::string turned =
      kCubeNodes + "*ELEMENT, TYPE=C3D8, ELSET=EALL\n17, 5, 6, 7, 8, 1, 2, 3, 4\n";
  const Deck deck = read_deck(write("turned.inp", turned), {}, {});
  EXPECT_THAT(
      deck.renumbered,
      ::testing::Contains(::testing::Field(
          &Repair::text, HasSubstr("1 of 1 cells are left-handed: their nodes are renumbered"))));
}

TEST_F(DeckFile, WithAFoldedCellIsRefusedByItsNumber) {
  const std::string folded =
      kCubeNodes + "*ELEMENT, TYPE=C3D8, ELSET=EALL\n17, 1, 2, 4, 3, 5, 6, 8, 7\n";
  const auto path = write("folded.inp", folded);
  EXPECT_THAT([&] { read_deck(path, {}, {}); },
              ThrowsMessage<InputError>(HasSubstr("1 of 1 cells are inverted or folded")));
  EXPECT_THAT([&] { read_deck(path, {}, {}); }, ThrowsMessage<InputError>(HasSubstr("cell 17")));
}

TEST_F(DeckFile, OfAnotherKindOrAbsentIsRefusedByName) {
  EXPECT_THAT([&] { read_deck(folder_ / "a.unv", {}, {}); },
              ThrowsMessage<InputError>(HasSubstr("found extension '.unv'")));
  test::expect_parts(
      test::refusal_of<FileError>([&] { read_deck(folder_ / "absent.inp", {}, {}); }),
      {"absent.inp: no such file"});
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
