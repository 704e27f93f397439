// SPDX-License-Identifier: GPL-3.0-or-later
// Universal files as Gmsh's own reader understands them.
#include <gmsh.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/exports/unv_writer.hpp"
#include "support.hpp"
#include "tests/assembly/block_mesh.hpp"
#include "tests/mesh/deck/sheet_mesh.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;

Mesh unv_brick(CellType type) {
  assembly::testing::BlockOptions options;
  options.type = type;
  return assembly::testing::block_mesh({2, 1, 1}, assembly::testing::brick({0.3, 0.2, 0.1}),
                                       options);
}

/// Elements of that Gmsh type, in file order: node numbers.
std::vector<size_t> elements_of(int type) {
  std::vector<size_t> tags, nodes;
  gmsh::model::mesh::getElementsByType(type, tags, nodes);
  return nodes;
}

/// Elements of a physical group.
size_t members(int dim, int group) {
  std::vector<int> entities;
  gmsh::model::getEntitiesForPhysicalGroup(dim, group, entities);
  size_t count = 0;
  for (const int entity : entities) {
    std::vector<int> types;
    std::vector<std::vector<size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
    for (const auto& list : tags) count += list.size();
  }
  return count;
}

class UnvOfEachKind : public ::testing::TestWithParam<CellType> {};

// Gmsh's order of nodes is ours, so that what it reads must be what we have, node by node.
TEST_P(UnvOfEachKind, GmshReadsTheSameCellsFacesAndGroups) {
  const Mesh mesh = unv_brick(GetParam());
  const Folder folder;
  std::string text = unv_text(mesh);
  text.replace(text.find("\n  2467\n"), 8, "\n  2477\n");
  std::ofstream(folder / "part.unv") << text;
  const GmshSession session("unv");
  gmsh::option::setNumber("Mesh.ReadGroupsOfElements", 1);
  gmsh::merge((folder / "part.unv").string());
  size_t cells = 0;
  for (const CellBlock& block : mesh.cells) {
    const std::vector<size_t> found = elements_of(traits(block.type).gmsh_type);
    ASSERT_EQ(found.size(), static_cast<size_t>(block.nodes.size()));
    for (Eigen::Index i = 0; i < block.nodes.size(); ++i)
      ASSERT_EQ(found[i], static_cast<size_t>(block.nodes.data()[i]) + 1);
    cells += static_cast<size_t>(block.nodes.rows());
  }
  EXPECT_GT(cells, 0u);
  std::vector<size_t> tags;
  std::vector<double> xyz, parameters;
  gmsh::model::mesh::getNodes(tags, xyz, parameters);
  ASSERT_EQ(tags.size(), static_cast<size_t>(mesh.nodes.rows()));
  for (size_t i = 0; i < tags.size(); ++i)
    for (size_t d = 0; d < 3; ++d)
      ASSERT_EQ(xyz[3 * i + d],
                mesh.nodes(static_cast<Eigen::Index>(tags[i]) - 1, static_cast<Eigen::Index>(d)));
  // Gmsh 4.8.4 reads the groups' layout under the number 2477 only, and not all their names.
  for (size_t r = 0; r < mesh.regions.size(); ++r)
    EXPECT_EQ(members(3, static_cast<int>(r) + 1), cells) << mesh.regions[r];
  auto group = static_cast<int>(mesh.regions.size());
  for (const auto& [name, surface] : mesh.surfaces)
    EXPECT_EQ(members(2, ++group), static_cast<size_t>(surface.face_count())) << name;
}

INSTANTIATE_TEST_SUITE_P(Kinds, UnvOfEachKind,
                         ::testing::Values(CellType::kTet4, CellType::kTet10, CellType::kHex8,
                                           CellType::kHex20, CellType::kWedge6,
                                           CellType::kWedge15));

// Gmsh mixes up groups that share elements: they are checked as text.
TEST(Unv, ShellsAreThinShellsOfTheirRegionAndSurfaces) {
  const Mesh mesh = testing::cube_and_sheet();
  const Folder folder;
  const std::string text = unv_text(mesh);
  std::ofstream(folder / "part.unv") << text;
  const GmshSession session("unv");
  gmsh::merge((folder / "part.unv").string());
  // Six faces of the cube, two shells and one triangle, each once.
  EXPECT_EQ(elements_of(traits(FaceType::kQuad4).gmsh_type).size(), 4u * 8);
  EXPECT_EQ(elements_of(traits(FaceType::kTri3).gmsh_type), (std::vector<size_t>{73, 64, 70}));
  for (const char* group :
       {"         2\nsheet\n         8        71         0         0         8        70",
        "         1\nrib\n         8         5         0         0\n", "         9\nskin\n",
        "         3\nwet\n         8        71"})
    EXPECT_NE(text.find(group), std::string::npos) << group << text;
}

TEST(Unv, ARegionOfShellsNamedAsASurfaceGetsAnotherName) {
  Mesh mesh = testing::cube_and_sheet();
  mesh.regions[2] = "wet";
  EXPECT_NE(unv_text(mesh).find("\nwet_shells\n"), std::string::npos);
}

TEST(Unv, NodeSetsAndFacesInTwoSurfacesAreWritten) {
  Mesh mesh = testing::one_cell();
  mesh.surfaces["again"] = mesh.surfaces["skin"];
  const std::string text = unv_text(mesh);
  // Four faces, once: one solid (118) and four triangles (92).
  size_t triangles = 0;
  for (size_t at = text.find("        92"); at != std::string::npos;
       at = text.find("        92", at + 1))
    ++triangles;
  EXPECT_EQ(triangles, 4u);
  EXPECT_NE(text.find("\ntip\n         7         4"), std::string::npos) << text;
}

TEST(Unv, PyramidsAndLongNamesAreRefused) {
  Mesh mesh = unv_brick(CellType::kPyramid5);
  test::expect_parts(test::refusal_of([&] { unv_text(mesh); }),
                     {": universal files have no element for pyramid5"});
  mesh = testing::one_cell();
  mesh.node_sets[std::string(41, 'x')] = {0};
  test::expect_parts(test::refusal_of([&] { unv_text(mesh); }),
                     {"mesh 'one': the name 'xxx",
                      "is not one line of 1 to 40 characters, the limit of universal files"});
}

}  // namespace
}  // namespace clatter::mesh
