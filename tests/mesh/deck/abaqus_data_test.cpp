// SPDX-License-Identifier: GPL-3.0-or-later
// Public decks (shared/data).
#include <fstream>
#include <sstream>

#include "tests/mesh/deck/abaqus_support.hpp"
#include "tests/shared_data.hpp"

namespace clatter::mesh::deck {
namespace {

#define READ_OR_SKIP(variable, name, ...)                                                   \
  const auto path_of_##variable = test::shared_data(name);                                  \
  if (!std::filesystem::exists(path_of_##variable)) GTEST_SKIP() << "no shared/data/" name; \
  const Deck variable = read_abaqus(path_of_##variable, {__VA_ARGS__})

TEST(AbaqusData, TheBeamOfAPartHasItsFiveHundredNodes) {
  READ_OR_SKIP(deck, "abaqus_beam/abq_beam.inp", {});
  EXPECT_EQ(deck.mesh.nodes.rows(), 518);
  ASSERT_EQ(deck.mesh.cells.size(), 1u);
  EXPECT_EQ(deck.mesh.cells[0].type, CellType::kTet10);
  EXPECT_EQ(deck.mesh.cells[0].nodes.rows(), 233);
  EXPECT_EQ(deck.mesh.node_ids[0], 1);
  EXPECT_EQ(deck.mesh.nodes(0, 2), 500.0);
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"solid"});
  EXPECT_EQ(deck.materials.at("steel").density, 7.85e-09);
  // fe.md: the nodes that carry 1e36 in Abaqus' matrix.
  EXPECT_EQ(testing::ids_of(deck, deck.mesh.node_set("fixed")),
            (std::vector<int32_t>{3, 4, 6, 7, 293, 395, 511, 512, 514}));
  ASSERT_EQ(deck.steps.size(), 1u);
  ASSERT_EQ(deck.steps[0].supports.size(), 1u);
  EXPECT_EQ(deck.steps[0].supports[0].node_indices, deck.mesh.node_set("fixed"));
  EXPECT_EQ(deck.steps[0].supports[0].dofs, kTranslations);
}

TEST(AbaqusData, ThePistonsShellsAreRefusedByNameOrIgnored) {
  const auto path = test::shared_data("piston/piston_8789_P1.inp");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared/data/piston";
  EXPECT_THROW(read_abaqus(path, {}), InputError);
  const Deck deck = read_abaqus(path, {{"S3"}});
  EXPECT_EQ(deck.mesh.nodes.rows(), 8789);
  EXPECT_EQ(deck.mesh.cell_count(), 31437);
  EXPECT_EQ(deck.ignored.at("S3"), 5894);  // as its comments count them
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"PISTON"});
}

}  // namespace
}  // namespace clatter::mesh::deck
