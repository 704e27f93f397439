// Surfaces found by where faces lie.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "mesh/select.hpp"

namespace clatter::mesh {
namespace {

// A cylinder of radius 2 about z through (5, 0, 0), z from 0 to 3.
FaceFacts cylinder_face() {
  FaceFacts face;
  face.tag = 4;
  face.kind = "Cylinder";
  face.radius = 2.0;
  face.centre = {5, 0, 1.5};
  for (int i = 0; i < 16; ++i) {
    const double a = i * M_PI / 8;
    for (double z : {0.0, 3.0})
      face.edge_points.push_back({5 + 2 * std::cos(a), 2 * std::sin(a), z});
    face.surface_points.push_back({5 + 2 * std::cos(a), 2 * std::sin(a), 1.0});
  }
  return face;
}

std::vector<NamedSurface> surfaces(const std::string& text) {
  const Config config = Config::parse(text, "part.toml");
  auto result = read_named_surfaces(config);
  config.finish();
  return result;
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

TEST(Select, NothingSelectedIsAnErrorThatListsTheFaces) {
  const auto named = surfaces("[surface.bore]\nplane = { normal = [1, 0, 0], height = 3.0 }");
  try {
    select_faces({cylinder_face()}, named[0], 1e-9, "part.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "part.toml: surface 'bore' selects no face; the part has 0 planes, cylinders of "
                 "radius 2 (1), 0 other faces");
  }
}

TEST(Select, WrongTablesAreRefused) {
  EXPECT_THROW(surfaces("[surface.s]\n"), InputError);
  EXPECT_THROW(surfaces("[surface.s]\nplane = { normal = [0, 0, 0], height = 1 }"), InputError);
  EXPECT_THROW(surfaces("[surface.s]\nplain = { normal = [0, 0, 1], height = 1 }"), InputError);
  EXPECT_THROW(surfaces("[surface.skin]\nplane = { normal = [0, 0, 1], height = 1 }"), InputError);
}

}  // namespace
}  // namespace clatter::mesh
