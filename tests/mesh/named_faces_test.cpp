// SPDX-License-Identifier: GPL-3.0-or-later
// Faces by the names that they have in a STEP file.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "mesh/face/face_list.hpp"
#include "mesh_toml.hpp"
#include "support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

using testing::Folder;
using testing::mesh_toml;

/// A copy of boxes.step whose faces have the names side 1, side 2, ...; their number.
int name_faces(const Folder& folder) {
  std::ifstream file(folder / "boxes.step");
  std::stringstream stream;
  stream << file.rdbuf();
  std::string text = stream.str();
  const std::string unnamed = "ADVANCED_FACE(''";
  int number = 0;
  for (size_t at = text.find(unnamed); at != std::string::npos; at = text.find(unnamed, at + 1))
    text.replace(at, unnamed.size(), fmt::format("ADVANCED_FACE('side {}'", ++number));
  std::ofstream(folder / "named.step") << text;
  return number;
}

/// A box of 10 x 20 x 30 mm whose faces have the names side 1 to 6, of x0 x1 y0 y1 z0 z1 in the
/// order of OpenCASCADE, and beside x1 one of 10 x 20 x 10 mm, 7 to 12.
std::string write_boxes(const Folder& folder) {
  {
    GmshSession session("boxes");
    session.box({0, 0, 0}, {10, 20, 30});
    session.box({10, 0, 0}, {20, 20, 10});
    session.write_cad(folder / "boxes.step", "mm");
  }
  EXPECT_EQ(name_faces(folder), 12);
  return (folder / "named.step").string();
}

double area(const Mesh& mesh, const std::string& surface) {
  return 1e6 * integrate(mesh, mesh.surface(surface)).area;
}

// The number of a face that is gone becomes that of another one.
TEST(NamedFaces, AreSurfacesAndThoseThatAnotherSolidSplitsHaveNoNameAnyMore) {
  const Folder folder;
  const std::string path = write_boxes(folder);
  const Mesh mesh = mesh_toml(fmt::format("name = 'a'\nkind = 'cad'\n[cad]\nsource = '{}'\n"
                                          "[surface.end]\nnamed = 'side 1'\n"
                                          "[surface.low]\nnamed = 'side 11'\n"
                                          "[surface.side]\nnamed = 'side 3'\n"
                                          "[mesh]\nelement_size_mm = 8\n",
                                          path))
                        .part.mesh;
  EXPECT_NEAR(area(mesh, "end"), 600.0, 1e-9);
  EXPECT_NEAR(area(mesh, "side"), 300.0, 1e-9);
  EXPECT_NEAR(area(mesh, "low"), 200.0, 1e-9);
  EXPECT_NEAR(integrate(mesh, mesh.surface("end")).normal.x(), -600e-6, 1e-15);
  EXPECT_NEAR(integrate(mesh, mesh.surface("side")).normal.y(), -300e-6, 1e-15);
  test::expect_parts(test::refusal_of([&] {
                       mesh_toml(fmt::format(
                           "name = 'a'\nkind = 'cad'\n[cad]\nsource = '{}'\n"
                           "[surface.split]\nnamed = 'side 2'\n[mesh]\nelement_size_mm = 8\n",
                           path));
                     }),
                     {"found no face named 'side 2'"});
  EXPECT_NEAR(integrate(mesh, mesh.surface("low")).normal.z(), -200e-6, 1e-15);
}

TEST(NamedFaces, MakeASheetAndPositionsChooseAmongThem) {
  const Folder folder;
  const std::string path = write_boxes(folder);
  const auto sheet = [&](const std::string& faces) {
    return mesh_toml(fmt::format("name = 'a'\nkind = 'sheet'\n[sheet]\nsource = '{}'\n"
                                 "thickness = 1\nfaces = {{ {} }}\n[mesh]\nelement_size_mm = 5\n",
                                 path, faces))
        .part.mesh;
  };
  EXPECT_NEAR(area(sheet("named = 'side 6'"), "skin"), 200.0, 1e-9);
  test::expect_parts(test::refusal_of([&] {
                       sheet("named = 'side 6', plane = { normal = [0, 0, 1], height = 10 }");
                     }),
                     {"selects no face", "nearest: face 6"});
}

// The outside of a ring and of a shaft in it: 1 200 pi mm2 and one centre.
TEST(NamedFaces, OfEqualAreaAndCentreAreToldApart) {
  const Folder folder;
  {
    GmshSession session("rings");
    const Solid wide = session.cylinder({0, 0, -10}, {0, 0, 20}, 30);
    const Solids ring = session.cut({wide}, {session.cylinder({0, 0, -11}, {0, 0, 22}, 25)});
    ASSERT_EQ(ring.size(), 1u);
    session.cylinder({0, 0, -15}, {0, 0, 30}, 20);
    session.write_cad(folder / "boxes.step", "mm");
  }
  const int number = name_faces(folder);
  GmshSession session("read");
  session.import_cad(folder / "named.step", "mm");
  std::map<std::string, double> radii;
  for (const FaceFacts& face : session.boundary_faces()) {
    EXPECT_FALSE(face.name.empty());
    EXPECT_TRUE(radii.emplace(face.name, face.radius).second) << face.name << " twice";
  }
  EXPECT_EQ(radii.size(), static_cast<size_t>(number));
}

TEST(NamedFaces, ANameThatNoFaceHasIsRefusedWithThoseThatThereAre) {
  const Folder folder;
  const auto cad = [&](const std::string& file) {
    mesh_toml(
        fmt::format("name = 'a'\nkind = 'cad'\n[cad]\nsource = '{}'\n[surface.b]\n"
                    "named = 'bottom'\n[mesh]\nelement_size_mm = 8\n",
                    file));
  };
  const std::string named = write_boxes(folder);
  test::expect_parts(test::refusal_of([&] { cad(named); }),
                     {"surface 'b': found no face named 'bottom'",
                      "its faces have the names side 1, side 10", "side 9"});
  test::expect_parts(test::refusal_of([&] { cad((folder / "boxes.step").string()); }),
                     {"found no face named 'bottom'; no face has a name: STEP files alone"});
}

TEST(NamedFaces, AreListedWhereThereAreAny) {
  FaceList list;
  list.faces.resize(1);
  EXPECT_THAT(table_of(list)[0], ::testing::Not(::testing::HasSubstr("name")));
  list.faces[0].name = "flange";
  EXPECT_THAT(table_of(list)[0], ::testing::HasSubstr("name"));
  EXPECT_THAT(table_of(list)[1], ::testing::HasSubstr("flange"));
}

}  // namespace
}  // namespace clatter::mesh
