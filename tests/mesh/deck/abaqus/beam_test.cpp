// SPDX-License-Identifier: GPL-3.0-or-later
// A clamped beam of tetrahedra as pre-processors write it: a part, its instance, shells on its
// skin.
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"
#include "tests/mesh/deck/deck_text.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh::deck {
namespace {

Mesh slender_block(CellType type) {
  assembly::testing::BlockOptions options;
  options.type = type;
  return assembly::testing::block_mesh({1, 1, 6}, assembly::testing::brick({20.0, 20.0, 500.0}),
                                       options);
}

TEST(AbaqusBeam, OfAPartHasItsNodesCellsAndSupports) {
  const Mesh mesh = slender_block(CellType::kTet10);
  const Deck deck = testing::read(test::abaqus_beam(mesh));
  EXPECT_EQ(deck.mesh.nodes, mesh.nodes);  // 17 digits
  EXPECT_EQ(deck.mesh.node_ids[0], 1);
  ASSERT_EQ(deck.mesh.cells.size(), 1u);
  EXPECT_EQ(deck.mesh.cells[0].type, CellType::kTet10);
  EXPECT_EQ(deck.mesh.cells[0].nodes, mesh.cells[0].nodes);
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"solid"});
  EXPECT_EQ(deck.materials.at("steel").density, 7.85e-09);
  EXPECT_EQ(deck.mesh.node_set("fixed").size(), 9u);
  for (const int32_t node : deck.mesh.node_set("fixed")) EXPECT_EQ(mesh.nodes(node, 2), 0.0);
  ASSERT_EQ(deck.steps.size(), 1u);
  EXPECT_EQ(deck.steps[0].modes, 10);
  ASSERT_EQ(deck.steps[0].supports.size(), 1u);
  EXPECT_EQ(deck.steps[0].supports[0].node_indices, deck.mesh.node_set("fixed"));
  EXPECT_EQ(deck.steps[0].supports[0].dofs, kTranslations);
}

TEST(AbaqusBeam, ShellsOnItsSkinAreASurfaceOrIgnored) {
  const Mesh mesh = slender_block(CellType::kTet4);
  std::string shells = "*ELEMENT, TYPE=S3, ELSET=coat\n";
  int number = 1000;
  const IndexMatrix& faces = mesh.surface("skin").faces.at(0).nodes;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    shells += fmt::format("{}, {}, {}, {}\n", ++number, faces(f, 0) + 1, faces(f, 1) + 1,
                          faces(f, 2) + 1);
  const std::string text = test::abaqus_beam(mesh, shells);
  const Deck coated = testing::read(text);
  EXPECT_EQ(coated.mesh.surface("coat").face_count(), faces.rows());
  EXPECT_EQ(nodes_of(coated.mesh.surface("coat")), nodes_of(mesh.surface("skin")));
  ASSERT_EQ(coated.notes.size(), 1u);
  test::expect_parts(coated.notes[0], {"52 S3: faces of solids, now the surface coat"});
  const Deck deck = testing::read(text, {"S3"});
  EXPECT_EQ(deck.mesh.nodes, mesh.nodes);
  EXPECT_EQ(deck.mesh.cell_count(), 36);
  EXPECT_EQ(deck.ignored.at("S3"), 2 * (2 + 4 * 6));  // two triangles on each square
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"solid"});
}

}  // namespace
}  // namespace clatter::mesh::deck
