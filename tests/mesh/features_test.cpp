// SPDX-License-Identifier: GPL-3.0-or-later
// Small features of CAD parts: reported, removed on request; a larger size gives fewer cells.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <gmsh.h>

#include "core/base/error.hpp"
#include "mesh/cad/gmsh_defeature.hpp"
#include "mesh/cad/gmsh_small_features.hpp"
#include "mesh/geometry/cad_geometry.hpp"
#include "mesh_toml.hpp"
#include "support.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;
using testing::mesh_toml;

/// A plate with a boss whose upper edges are rounded by `radius` (mm), as STEP.
std::string rounded_part(const Folder& folder, double radius) {
  namespace occ = gmsh::model::occ;
  GmshSession session("rounded");
  const Solids plate = session.fuse({session.box({0, 0, 0}, {60, 40, 10})},
                                    {session.box({20, 10, 10}, {40, 30, 20})});
  occ::synchronize();
  gmsh::vectorpair edges, out;
  gmsh::model::getEntitiesInBoundingBox(-1, -1, 19.9, 70, 50, 20.1, edges, 1);
  std::vector<int> tags;
  for (const auto& [dim, tag] : edges) tags.push_back(tag);
  EXPECT_EQ(tags.size(), 4u);
  occ::fillet(plate, tags, {radius}, out);
  session.write_cad(folder / "rounded.step", "mm");
  return (folder / "rounded.step").string();
}

std::string cad_toml(const std::string& file, double size, const std::string& cad = "") {
  return fmt::format(
      "name = 'part'\nkind = 'cad'\n[cad]\nsource = '{}'\n{}\n[mesh]\n"
      "element_size_mm = {}\n",
      file, cad, size);
}

// 12 mm and 24 mm are above a tenth of the diagonal, 7.5 mm.
TEST(Features, HardN20_CoarserNeverGivesMoreCellsThanFiner) {
  const Folder folder;
  const std::string file = rounded_part(folder, 0.3);
  std::vector<int64_t> cells;
  for (const double size : {4.0, 6.0, 12.0, 24.0})
    cells.push_back(mesh_toml(cad_toml(file, size)).part.mesh.cell_count());
  EXPECT_GE(cells[0], cells[1]);
  EXPECT_GE(cells[1], cells[2]);
  EXPECT_EQ(cells[2], cells[3]);
}

// Three bores of nearly one radius that cross: the local search leaves folded cells, HighOrder
// none.
TEST(Features, HardG2_CrossingBoresAreUnfoldedByHighOrderWhereNoFinerCellsAreAllowed) {
  GmshSession session("gallery");
  const Solids bores = {session.cylinder({-1, 30, 30}, {62, 0, 0}, 10),
                        session.cylinder({30, -1, 30}, {0, 62, 0}, 9.98),
                        session.cylinder({30, 30, -1}, {0, 0, 62}, 10.02),
                        session.cylinder({-1, 39.7, 39.7}, {62, 0, 0}, 4)};
  const PartGeometry part = {
      {{"solid", session.cut({session.box({0, 0, 0}, {60, 60, 60})}, bores)}}, {}};
  MeshSettings settings;
  settings.element_size = 8e-3;
  settings.refine_passes = 0;
  const PartMesh made = mesh_part(session, part, settings, 1e-3, "gallery", "gallery");
  EXPECT_EQ(made.certificate.optimiser_repair.value(), 1.0);
  EXPECT_GT(made.certificate.min_scaled_jacobian, kQualityFloor.scaled_jacobian);
}

TEST(Features, ASizeAboveATenthOfTheDiagonalIsReported) {
  ::testing::internal::CaptureStderr();
  mesh_toml(
      "name = 'b'\nkind = 'box'\n[box]\nsize = [60, 60, 60]\n[mesh]\n"
      "element_size_mm = 26\n");
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("element size 26 is above a tenth of the part's diagonal: 10.39"),
            std::string::npos)
      << said;
}

TEST(Features, ShortEdgesNarrowFacesAndSmallRadiiAreListedWithPositions) {
  const Folder folder;
  const std::string file = rounded_part(folder, 0.3);
  GmshSession session("small");
  session.import_cad(file, "mm");
  const auto faces = session.boundary_faces();
  const SmallFeatures features = find_small_features(session, faces, 1.0);
  ASSERT_FALSE(features.edges.empty());
  ASSERT_FALSE(features.faces.empty());
  ASSERT_FALSE(features.radii.empty());
  EXPECT_NEAR(features.radii.front().size, 0.3, 1e-3);
  EXPECT_GT(features.edges.front().size, 0.1);  // without poles and seams of zero length
  const std::string text = describe_small_features(features);
  EXPECT_NE(text.find("radii from 0.3 ("), std::string::npos) << text;
  EXPECT_EQ(find_small_features(session, faces, 0.1).count(), 0u);
}

TEST(Features, NarrowFacesAreRemovedOnRequestAndTheVolumeIsChecked) {
  const Folder folder;
  const std::string file = rounded_part(folder, 0.3);
  GmshSession session("defeature");
  const Solids solids = session.import_cad(file, "mm");
  const Defeatured d = defeature(session, solids, 1.0);
  EXPECT_GE(d.faces_before, 15);  // four fillets at least
  EXPECT_EQ(d.faces_after, 11);   // plate 6, boss 5
  EXPECT_TRUE(d.kept.empty());
  EXPECT_NEAR(d.volume_after, 60.0 * 40 * 10 + 20.0 * 20 * 10, 1e-3);
  EXPECT_NEAR(d.box_after.x(), 60.0, 1e-6);
  EXPECT_LT(std::abs(d.volume_after / d.volume_before - 1.0), 1e-3);
  SizeSettings sizes;
  sizes.size = 8.0;
  session.generate(sizes);  // and it can be meshed
  EXPECT_GT(session.extract().nodes.rows(), 50);
}

TEST(Features, RemovingMoreThanAPercentIsRefused) {
  const Folder folder;
  const std::string file = rounded_part(folder, 0.3);
  try {
    mesh_toml(cad_toml(file, 8.0, "defeature_below = 11.0"));  // the boss's sides too
    FAIL() << "not refused";
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("defeature_below"), std::string::npos) << error.what();
  }
}

// A step of 0.05 mm between parallel faces: nothing closes the gap, so the face is kept and
// reported.
TEST(Features, AFaceThatCannotBeRemovedIsKeptAndReported) {
  GmshSession session("step");
  const Solids part = session.fuse({session.box({0, 0, 0}, {60, 40, 10})},
                                   {session.box({60, 0, 0}, {80, 40, 9.95})});
  const Defeatured d = defeature(session, part, 0.2);
  EXPECT_EQ(d.narrow_faces, 1);
  ASSERT_EQ(d.kept.size(), 1u);
  EXPECT_NEAR(d.kept[0].width, 0.05, 1e-3);
  EXPECT_NEAR(d.kept[0].position.x(), 60.0, 1e-6);
  EXPECT_NEAR(d.volume_after / d.volume_before, 1.0, 1e-9);
}

}  // namespace
}  // namespace clatter::mesh
