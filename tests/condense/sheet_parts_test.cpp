// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced sheets in an assembly.
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/mesh/boundary.hpp"
#include "core/modes/analysis.hpp"
#include "sheet.hpp"
#include "tests/condense/part_files.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using namespace testing;

/// A sheet whose left half lies on a block, and the block.
class SheetOnABlock : public ::testing::Test {
 protected:
  static constexpr const char* kWithoutNormal =
      "directions = [\"x\", \"y\", \"z\", \"rx\", \"ry\"]\n";
  static constexpr double kHigh = 0.021;  // half a thickness above the block

  static mesh::Mesh the_block() { return block_mesh({4, 2, 1}, brick({0.4, 0.05, 0.02})); }
  static mesh::Mesh the_sheet() {
    mesh::Mesh mesh = assembly::testing::sheet(0.5, 0.05, 10, 2);
    mesh.nodes.col(2).setConstant(kHigh);
    for (int32_t a = 0; a < mesh.nodes.rows(); ++a)
      if (mesh.nodes(a, 0) < 0.26) mesh.node_sets["foot"].push_back(a);
    return mesh;
  }

  static std::string tie(const std::string& slave, const std::string& master) {
    return "[[tie]]\nslave = \"" + slave + "\"\nmaster = \"" + master + "\"\ndistance = 0.002\n";
  }

  static const std::string& iron() {
    static const std::string toml = material("body", kIron);
    return toml;
  }

  /// Both in one mesh.
  static VectorXd of_one_mesh() {
    mesh::Mesh mesh = the_block();
    const mesh::Mesh above = the_sheet();
    const auto first = static_cast<int32_t>(mesh.nodes.rows());
    mesh.nodes.conservativeResize(first + above.nodes.rows(), 3);
    mesh.nodes.bottomRows(above.nodes.rows()) = above.nodes;
    mesh.regions.push_back("sheet");
    mesh::ShellBlock shells = above.shells[0];
    shells.region = 1;
    shells.nodes.array() += first;
    mesh.shells = {shells};
    mesh.node_sets.clear();
    mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh), mesh.shells);
    mesh::FaceBlock foot{mesh::FaceType::kQuad4, IndexMatrix(10, 4)};
    for (int j = 0; j < 2; ++j)
      foot.nodes.middleRows(5 * j, 5) = shells.nodes.middleRows(10 * j, 5);
    mesh.surfaces["foot"].faces = {foot};
    return elastic_hz(
        build_all(mesh, assembly::testing::kSheetSteel + iron() + tie("foot", "z1")).model);
  }

  static VectorXd elastic_hz(const fe::FeModel& model) {
    modes::ModesOptions options;
    options.count = 16;
    const modes::PartModes found = modes::analyse(model, options);
    return found.modes.frequencies_hz();
  }

  static std::filesystem::path sheet_file(const std::string& directions = kWithoutNormal) {
    const fe::FeModel model =
        build_all(the_sheet(),
                  assembly::testing::kSheetSteel +
                      "[[nodes]]\nname = \"joint\"\n[[nodes.term]]\nnode_set = \"foot\"\n" +
                      directions)
            .model;
    return reduced_file("sheet", model, below(5e4));
  }

  static std::filesystem::path block_file() {
    const fe::FeModel model = build_all(the_block(), iron() + kept("z1")).model;
    return reduced_file("base", model, complete(model));
  }
};

TEST_F(SheetOnABlock, IsTheSameAsOneMeshAsAMeshWithAPartAndAsTwoParts) {
  const VectorXd expected = of_one_mesh();
  const std::string sheet = part("sheet", sheet_file());
  const std::string base = part("block", block_file());
  // Against one mesh by what the modes of the sheet above 50 kHz would add.
  const VectorXd parts = elastic_hz(joined(sheet + base + tie("sheet_joint", "block_joint")).model);
  expect_same_elastic(parts, expected, 1e-5);
  expect_same_elastic(
      elastic_hz(build_all(the_block(), iron() + sheet + tie("sheet_joint", "z1")).model), parts,
      1e-8);
  // Without rotations the sheet's face turns as the block's, which is stiffer on large cells.
  const VectorXd plain = elastic_hz(joined(part("sheet", sheet_file("directions = \"xyz\"\n")) +
                                           base + tie("sheet_joint", "block_joint"))
                                        .model);
  expect_same_elastic(plain, expected, 0.03);
  mesh::Mesh mesh = the_sheet();
  const fe::FeModel onto = build_all(mesh, assembly::testing::kSheetSteel + base +
                                               "[[nodes]]\nname = \"end\"\nnode_set = \"tip\"\n")
                               .model;
  // Not joined: each has its own rigid motions.
  EXPECT_LT(elastic_hz(onto)(11), 1e-2);
  EXPECT_GT(elastic_hz(onto)(12), 1.0);
}

TEST_F(SheetOnABlock, HardB16_RotationsAboutItsNormalMoveNoMassAndAreNamed) {
  test::expect_parts(
      test::refusal_of<NumericsError>([] { (void)sheet_file(""); }),
      {"M_rr is not positive definite", ".rz moves no mass", "rotation about its normal"});
}

TEST_F(SheetOnABlock, HardB15_ItsSkinStaysASheetInTheAssembly) {
  const fe::FeModel engine = joined(part("sheet", sheet_file()) + part("block", block_file()) +
                                    tie("sheet_joint", "block_joint") +
                                    "[[nodes]]\nname = \"held\"\nnode_set = \"block_joint\"\n")
                                 .model;
  CondenseOptions options = below(5e3);
  const rom::ReducedModel again = reduced_again(engine, "held", options);
  EXPECT_EQ(again.skin.sheet.size(), 40U);  // 20 quadrilaterals of two triangles
  EXPECT_EQ(again.skin.sheet, again.skin.faces.at("sheet_skin"));
  options.skin = {"block_skin"};
  EXPECT_TRUE(reduced_again(engine, "held", options).skin.sheet.empty());
}

}  // namespace
}  // namespace clatter::condense
