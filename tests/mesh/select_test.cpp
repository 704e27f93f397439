// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces found by where faces lie.
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "mesh/face/select.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh {
namespace {

// A cylinder of radius 2 about z through (5, 0, 0), z from 0 to 3.
FaceFacts cylinder_face() {
  FaceFacts face;
  face.tag = 4;
  face.kind = "Cylinder";
  face.radius = 2.0;
  face.centre = {5, 0, 1.5};
  std::vector<Eigen::Vector3d> normals;
  for (int i = 0; i < 16; ++i) {
    const double a = i * M_PI / 8;
    for (double z : {0.0, 3.0})
      face.edge_points.push_back({5 + 2 * std::cos(a), 2 * std::sin(a), z});
    face.surface_points.push_back({5 + 2 * std::cos(a), 2 * std::sin(a), 1.0 + 0.1 * i});
    normals.push_back({std::cos(a), std::sin(a), 0.0});
  }
  face.shape = find_shape(face.kind, face.surface_points, normals);
  return face;
}

std::vector<NamedSurface> surfaces(const std::string& text) {
  const Config config = Config::parse(text, "part.toml");
  const Config tables = config.table("surface");
  std::map<std::string, SurfaceTable> read;
  for (const std::string& name : tables.keys())
    read[name] = surface_keys().read(tables.table(name));
  return named_surfaces(config, read);
}

TEST(Select, FiltersCombine) {
  const std::vector<FaceFacts> faces = {cylinder_face()};
  const auto selected = [&](const std::string& keys) {
    const auto named = surfaces("[surface.s]\n" + keys);
    return matches(faces[0], named[0].filters[0], 1e-9);
  };
  const std::string bore = "cylinder = { radius = 2.0, point = [5, 0, 9], axis = [0, 0, -4] }\n";
  EXPECT_TRUE(selected(bore));
  EXPECT_FALSE(selected("cylinder = { radius = 2.1, point = [5, 0, 0], axis = [0, 0, 1] }"));
  EXPECT_FALSE(selected("cylinder = { radius = 2.0, point = [5, 0, 0], axis = [0, 1, 0] }"));
  EXPECT_TRUE(selected(bore + "box = { min = [0, -2, 0], max = [7, 2, 3] }"));
  EXPECT_FALSE(selected(bore + "box = { min = [0, -2, 0], max = [7, 2, 2] }"));
  EXPECT_FALSE(selected(bore + "outside = { min = [0, -2, 0], max = [7, 2, 3] }"));
  EXPECT_FALSE(selected("plane = { normal = [0, 0, 1], height = 3.0 }"));
}

// A part of 100 mm: exact is 0.1 um, near 10 um.
const SelectionScale kScale{100.0, "mm"};

std::string selection_refusal(const std::string& keys) {
  try {
    select_faces({cylinder_face()}, surfaces("[surface.bore]\n" + keys)[0], kScale, "part.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "selected";
}

TEST(Select, NothingSelectedNamesTheNearestFacesAndHowFarOffEachIs) {
  const std::string faces = "; the part has 0 planes, cylinders of radius 2 (1), 0 other faces";
  const std::string begin =
      "part.toml: surface 'bore' selects no face; nearest: face 4, cylinder of radius 2 mm, ";
  EXPECT_EQ(selection_refusal("plane = { normal = [1, 0, 0], height = 3.0 }"),
            begin + "up to 4 mm off" + faces);
  EXPECT_EQ(selection_refusal("cylinder = { radius = 2, point = [5.3, 0, 0], axis = [0, 0, 1] }"),
            begin + "axis 0.3 mm away" + faces);
  EXPECT_EQ(selection_refusal("cylinder = { radius = 1.5, point = [5, 0, 0], axis = [0, 0, 1] }"),
            begin + "radius 0.5 mm more" + faces);
  EXPECT_EQ(selection_refusal("cylinder = { radius = 2, point = [5, 0, 1.5], axis = [0, 1, 0] }"),
            begin + "axis turned by 90 deg" + faces);
  EXPECT_EQ(selection_refusal("cylinder = { radius = 2, point = [5, 0, 0], axis = [0, 0, 1] }\n"
                              "box = { min = [0, -2, 0], max = [7, 2, 2] }"),
            begin + "extends 1 mm out of the box" + faces);
}

// The bore's centre was read off a drawing, 5 um beside where it is.
TEST(Select, AFaceFiveMicrometresOffIsTakenAndTold) {
  const auto named = surfaces(
      "[surface.bore]\ncylinder = { radius = 2, point = [5.005, 0, 0], axis = [0, 0, 1] }");
  const Selection selection = select_faces({cylinder_face()}, named[0], kScale, "part.toml");
  EXPECT_EQ(selection.tags, std::vector<int>{4});
  ASSERT_EQ(selection.warnings.size(), 1u);
  EXPECT_EQ(selection.warnings[0],
            "part.toml: surface 'bore': face 4, cylinder of radius 2 mm, axis 0.005 mm away, is "
            "taken as none is closer: tolerance = 0.0055 in [surface.bore] confirms it");
}

TEST(Select, ATrueFaceKeepsANearOneOutAndTheUsersToleranceTakesBoth) {
  FaceFacts beside = cylinder_face();
  beside.tag = 7;
  for (auto* points : {&beside.edge_points, &beside.surface_points})
    for (Eigen::Vector3d& x : *points) x.x() += 0.005;
  beside.shape.point.x() += 0.005;
  const std::string bore =
      "[surface.s]\ncylinder = { radius = 2, point = [5, 0, 0], axis = [0, 0, 1] }\n";
  const Selection exact = select_faces({cylinder_face(), beside}, surfaces(bore)[0], kScale, "t");
  EXPECT_EQ(exact.tags, std::vector<int>{4});
  EXPECT_TRUE(exact.warnings.empty());
  ASSERT_EQ(exact.remarks.size(), 1u);
  EXPECT_NE(exact.remarks[0].find("face 7"), std::string::npos) << exact.remarks[0];
  const Selection wide =
      select_faces({cylinder_face(), beside}, surfaces(bore + "tolerance = 0.01")[0], kScale, "t");
  EXPECT_EQ(wide.tags, (std::vector<int>{4, 7}));
  EXPECT_TRUE(wide.warnings.empty() && wide.remarks.empty());
  const auto narrow = surfaces(
      "[surface.s]\ntolerance = 1e-4\ncylinder = { radius = 2, point = "
      "[5.005, 0, 0], axis = [0, 0, 1] }");
  test::expect_parts(
      test::refusal_of([&] { select_faces({cylinder_face()}, narrow[0], kScale, "t"); }),
      {"t: surface 's' selects no face; nearest: face 4, cylinder of radius 2 mm, axis 0.005 mm "
       "away; "});
}

TEST(Select, WrongTablesAreRefused) {
  test::expect_parts(
      test::refusal_of([&] { surfaces("[surface.s]\n"); }),
      {"part.toml:1: surface.s.cylinder: give cylinder, plane, box, outside or named"});
  test::expect_parts(test::refusal_of([&] {
                       surfaces("[surface.s]\nplane = { normal = [0, 0, 0], height = 1 }");
                     }),
                     {"part.toml:2: surface.s.plane.normal: found length 0, expected a direction"});
  test::expect_parts(test::refusal_of([&] {
                       surfaces("[surface.s]\nplain = { normal = [0, 0, 1], height = 1 }");
                     }),
                     {"part.toml:2: surface.s.plain: unknown key, did you mean plane?"});
  test::expect_parts(
      test::refusal_of(
          [&] { surfaces("[surface.skin]\nplane = { normal = [0, 0, 1], height = 1 }"); }),
      {"part.toml:1: surface.skin: the name 'skin' is reserved for the entire boundary"});
}

}  // namespace
}  // namespace clatter::mesh
