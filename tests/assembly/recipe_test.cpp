// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/recipe.hpp"

#include <gtest/gtest.h>

#include "block_mesh.hpp"
#include "core/base/error.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr const char* kSteelToml =
    "[material.steel]\nregions = [\"body\"]\nE_gpa = 210.0\nnu = 0.3\nrho = 7800.0\n";

Recipe read(const std::string& toml) {
  mesh::Mesh mesh = block_mesh({1, 1, 1}, brick({1, 1, 1}));
  return read_recipe(Config::parse(toml, "part.fe.toml"), mesh);
}

using test::expect_parts;

/// The message of the InputError that the text must raise.
std::string recipe_refusal(const std::string& toml) {
  return test::refusal_of([&] { read(toml); });
}

TEST(Recipe, ReadsUnitsByName) {
  const Recipe recipe = read(std::string("length_unit = \"mm\"\n") + kSteelToml + R"(
[[sensor]]
name = "s"
surface = "z1"
near = [100.0, 200.0, 1000.0]
)");
  EXPECT_DOUBLE_EQ(recipe.materials[0].youngs, 2.1e11);
  EXPECT_LT((*recipe.nodes[0].near - Eigen::Vector3d(0.1, 0.2, 1.0)).norm(), 1e-15);
}

TEST(Recipe, UnknownNamesListWhatThereIs) {
  expect_parts(recipe_refusal("[material.a]\nregions = [\"bdoy\"]\nE = 1.0\nnu = 0.3\nrho = 1.0\n"),
               {"part.fe.toml:", "bdoy", "expected one of: body"});
  expect_parts(recipe_refusal(std::string(kSteelToml) + "[[support]]\nsurface = \"z9\"\n"),
               {"part.fe.toml:", "z9", "skin, x0, x1, y0, y1, z0, z1"});
  expect_parts(recipe_refusal(std::string(kSteelToml) + "[[support]]\nnode_set = \"al\"\n"),
               {"al", "expected one of: all"});
  expect_parts(
      recipe_refusal(std::string(kSteelToml) + "[[point_mass]]\non = \"pin\"\nmass = 1.0\n"),
      {"pin", "expected one of"});
  expect_parts(recipe_refusal(std::string(kSteelToml) + "[[suport]]\nsurface = \"z0\"\n"),
               {"suport"});
}

TEST(Recipe, KeysThatDoNotGoTogetherAreRefusedWithTheReason) {
  const auto refused = [](const std::string& table, const std::string& said) {
    expect_parts(recipe_refusal(kSteelToml + table), {said});
  };
  const std::string load = "[[load]]\nname = \"a\"\n";
  refused(load + "kind = \"gravity\"\ndirection = [0, 0, 1]\nsurface = \"z0\"\n",
          "part.fe.toml:10: load[0].surface: needs kind = \"pressure\" or \"resultant\" or "
          "\"displacement\"");
  refused(load + "kind = \"acceleration\"\n",
          "part.fe.toml:6: load[0].direction: is missing, an acceleration needs it, or field");
  refused("[[support]]\nsurface = \"z0\"\nnode_set = \"all\"\n",
          "part.fe.toml:8: support[0].node_set: surface and node_set exclude each other");
  refused("[[support]]\ndirections = \"x\"\n",
          "part.fe.toml:6: support[0].surface: give surface or node_set or point");
  refused("[[support]]\nsurface = \"z0\"\ndirections = \"xrx\"\n",
          "found \"x r x\", expected each");
  refused("[[support]]\nsurface = \"z0\"\ndirections = [\"rx\"]\n",
          "part.fe.toml:8: support[0].directions: found \"rx\", expected x, y or z");
  refused("[[support]]\nsurface = \"z0\"\nsystem = \"axle\"\n",
          "part.fe.toml:8: support[0].system: found \"axle\", expected one of: ");
  refused("[[coupling]]\nsurface = \"z0\"\n", "part.fe.toml:6: coupling[0].name: is missing");
  refused("[[coupling]]\nname = \"a\"\ntype = \"rigid\"\nsurface = \"z0\"\ndofs = 6\n",
          "part.fe.toml:10: coupling[0].dofs: needs type = \"distributing\"");
  refused("[damping]\nratio = 0.1\nalpha = 1.0\nat_hz = 10\n",
          "part.fe.toml:8: damping.alpha: alpha and ratio exclude each other");
  refused("[damping]\nratio = 0.1\n", "part.fe.toml:6: damping.at_hz: is missing, ratio needs it");
  refused("[[point]]\nname = \"p\"\nnode_set = \"all\"\nnumber = 3\n",
          "part.fe.toml:9: point[0].number: needs at");
}

TEST(Recipe, TemperatureNeedsAMaterialThatExpands) {
  expect_parts(recipe_refusal(std::string(kSteelToml) +
                              "[[load]]\nname = \"hot\"\nkind = \"temperature\"\nvalue = 20.0\n"),
               {"part.fe.toml:", "temperature", "no material has an expansion"});
}

TEST(Recipe, EachRegionNeedsOneMaterial) {
  expect_parts(recipe_refusal("[material]\n"), {"body"});
  expect_parts(
      recipe_refusal(std::string(kSteelToml) +
                     "[material.other]\nregions = [\"body\"]\nE = 1.0\nnu = 0.3\nrho = 1.0\n"),
      {"body", "two materials"});
}

TEST(Recipe, RefusesMaterialsThatDoNotExist) {
  const auto material = [](const std::string& values) {
    return recipe_refusal("[material.a]\nregions = [\"body\"]\n" + values);
  };
  expect_parts(material("E = 2e11\nnu = 0.3\nrho = -7800.0\n"), {"rho", "-7800"});
  expect_parts(material("E = 0.0\nnu = 0.3\nrho = 7800.0\n"), {"E", "0"});
  expect_parts(material("E = 2e11\nnu = 0.5\nrho = 7800.0\n"), {"nu", "0.5"});
  expect_parts(material("E = 2e11\nE_gpa = 200.0\nnu = 0.3\nrho = 7800.0\n"), {"E_gpa"});
  expect_parts(material("E = 2e11\nnu = 0.3\nrho = 7800.0\nsystem = \"wood\"\n"),
               {"system", "wood"});
  expect_parts(material("E = nan\nnu = 0.3\nrho = 7800.0\n"), {"E"});
}

TEST(Recipe, RefusesWhatCannotBe) {
  const std::string contact = std::string(kSteelToml) +
                              "[[contact]]\nname = \"c\"\nsurface = \"y0\"\naxis_point = [0.0, "
                              "0.0, 0.0]\naxis = [0.0, 0.0, 1.0]\nzero_angle = [0.0, 1.0, 0.0]\n";
  const std::string sector =
      "[[contact.sector]]\ncentre_deg = 0.0\nhalf_width_deg = 40.0\nstrips = 3\n";
  expect_parts(recipe_refusal(contact + "axial = [1.0, 0.0]\nrows = 3\n" + sector),
               {"axial", "ascending"});
  expect_parts(recipe_refusal(contact + "axial = [0.0, 1.0]\nrows = 0\n" + sector), {"rows"});
  expect_parts(recipe_refusal(contact + "axial = [0.0, 1.0]\nrows = 3\n"), {"sector"});
  expect_parts(recipe_refusal(contact + "axial = [0.0, 1.0]\nrows = 3\n" + sector + sector),
               {"overlap"});
  expect_parts(recipe_refusal(std::string(kSteelToml) +
                              "[[coupling]]\nname = \"a\"\nsurface = \"z0\"\ndofs = 5\n"),
               {"dofs", "5", "6 or 3"});
  expect_parts(
      recipe_refusal(std::string(kSteelToml) + "[[coupling]]\nname = \"a\"\nsurface = \"z0\"\n"
                                               "[[coupling]]\nname = \"a\"\nsurface = \"z1\"\n"),
      {"\"a\" twice"});
  expect_parts(recipe_refusal(std::string(kSteelToml) +
                              "[[coupling]]\nname = \"a\"\nsurface = \"z0\"\n[[point_"
                              "mass]]\non = \"a\"\nmass = 1.0\ninertia = [1.0, 1.0, "
                              "3.0]\n"),
               {"inertia"});
  expect_parts(
      recipe_refusal(std::string(kSteelToml) + "[[load]]\nname = \"g\"\nkind = \"presure\"\n"),
      {"presure", "pressure"});
  expect_parts(recipe_refusal(std::string(kSteelToml) + "[damping]\nratio = 0.01\nat_hz = 0.0\n"),
               {"at_hz"});
}

}  // namespace
}  // namespace clatter::assembly::testing
