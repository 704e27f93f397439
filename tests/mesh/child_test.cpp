// SPDX-License-Identifier: GPL-3.0-or-later
// Gmsh in a child process: identical results, errors of the same kind, crashes reported.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/error.hpp"
#include "mesh/part/gmsh_in_child.hpp"
#include "mesh/part/part_in_child.hpp"
#include "mesh_toml.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;
using testing::mesh_toml;

const std::string kChildTube =
    "name = 'tube'\nkind = 'cylinder'\n[cylinder]\nradius = 20\ninner_radius = 16\nlength = 60\n"
    "[mesh]\nelement_size_mm = 9\nelements_per_turn = 12\n";

MadePart make(const std::string& toml, const std::string& cad_extension = "") {
  const PartFile part = part_keys().read(Config::parse(toml, "part.toml"));
  return make_part_in_child({&part, "part.toml", cad_extension}, {});
}

TEST(HardN17_GmshInAChild, TheSameBitsAsInThisProcess) {
  const MadePart there = make(kChildTube, ".brep");
  PartMesh here = mesh_toml(kChildTube).part;
  note_poor_cells(find_poor_cells(here.mesh, here.quality), here.certificate);
  EXPECT_EQ(there.part.mesh.name, here.mesh.name);
  EXPECT_EQ(there.part.mesh.nodes, here.mesh.nodes);
  EXPECT_EQ(there.part.mesh.regions, here.mesh.regions);
  EXPECT_EQ(there.part.mesh.node_sets, here.mesh.node_sets);
  ASSERT_EQ(there.part.mesh.cells.size(), here.mesh.cells.size());
  EXPECT_EQ(there.part.mesh.cells[0].nodes, here.mesh.cells[0].nodes);
  for (const auto& [name, surface] : here.mesh.surfaces)
    EXPECT_EQ(there.part.mesh.surface(name).faces[0].nodes, surface.faces[0].nodes) << name;
  EXPECT_EQ(there.part.quality.min_dihedral_deg.histogram, here.quality.min_dihedral_deg.histogram);
  EXPECT_EQ(there.part.quality.scaled_jacobian.worst_cells.size(), kWorstCells);
  EXPECT_EQ(there.part.certificate.simpler_setting, 0.0);
  MeshCertificate certificate = there.part.certificate;
  certificate.simpler_setting.reset();  // only of a part made in a child
  EXPECT_EQ(certificate, here.certificate);
  EXPECT_EQ(there.steps.size(), 2u);
  EXPECT_TRUE(there.cad.starts_with("DBRep_DrawableShape") ||
              there.cad.find("CASCADE Topology") < 100)
      << there.cad.substr(0, 100);
}

TEST(HardN17_GmshInAChild, ErrorsKeepTheirKindAndMessage) {
  test::expect_parts(
      test::refusal_of([&] { make("name = 'x'\nkind = 'cad'\n[cad]\nsource = 'none.step'\n"); }),
      {"none.step: file not found"});
  try {
    make(kChildTube + "elements_per_trun = 3\n");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("elements_per_turn"), std::string::npos);
  }
}

TEST(HardN17_GmshInAChild, TheLastMessageNamesTheStepThatCrashed) {
  ChildEnd end;
  end.kind = ChildEnd::Kind::kCrashed;
  end.signal = 11;
  EXPECT_EQ(last_step(end), "its start");
  end.step = "gmsh: meshing";
  EXPECT_EQ(last_step(end), "gmsh: meshing");
  end.chatter =
      "Info    : Meshing 2D...\nInfo    : [ 20%] Meshing surface 7 (Cylinder, Frontal-Delaunay)\n"
      "free(): invalid pointer\n";
  EXPECT_EQ(describe_end(end, {}),
            "gmsh crashed (signal 11, Segmentation fault) at: Meshing surface 7 (Cylinder, "
            "Frontal-Delaunay) (last output: free(): invalid pointer)");
}

}  // namespace
}  // namespace clatter::mesh
