// SPDX-License-Identifier: GPL-3.0-or-later
// A written deck is read back as the same mesh.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/number.hpp"
#include "mesh/deck/abaqus/writer.hpp"
#include "mesh/deck/field_text.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"
#include "tests/mesh/deck/sheet_mesh.hpp"
#include "tests/mesh/support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh::deck {
namespace {

Mesh again(const Mesh& mesh) {
  const mesh::testing::Folder folder;
  write_abaqus(mesh, folder / "out.inp");
  Mesh read = read_abaqus(folder / "out.inp", {}).mesh;
  read.name = mesh.name;
  return read;
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.regions, b.regions);
  EXPECT_EQ(a.node_sets, b.node_sets);
  ASSERT_EQ(a.cells.size(), b.cells.size());
  for (size_t i = 0; i < a.cells.size(); ++i) {
    EXPECT_EQ(a.cells[i].type, b.cells[i].type);
    EXPECT_EQ(a.cells[i].region, b.cells[i].region);
    EXPECT_EQ(a.cells[i].nodes, b.cells[i].nodes);
    EXPECT_EQ(a.cells[i].ids, b.cells[i].ids);
  }
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  for (const auto& [name, surface] : a.surfaces) {
    const Surface& other = b.surface(name);
    ASSERT_EQ(surface.faces.size(), other.faces.size()) << name;
    for (size_t f = 0; f < surface.faces.size(); ++f) {
      EXPECT_EQ(surface.faces[f].type, other.faces[f].type);
      EXPECT_EQ(surface.faces[f].nodes, other.faces[f].nodes) << name;
    }
  }
}

// A cell of each of the types, the linear ones apart from the quadratic ones, in two regions, with
// numbers that do not ascend, sets, and a surface of all faces of every cell.
std::string all_types() {
  std::string text = "*NODE\n";
  int32_t id = 900;
  std::string elements;
  for (const char* name : {"C3D20", "C3D4", "C3D15", "C3D8", "C3D5", "C3D6", "C3D10"}) {
    const int nodes = traits(abaqus::solid_type(name)->type).nodes;
    elements +=
        fmt::format("*ELEMENT, TYPE={}, ELSET={}\n{}", name, nodes > 8 ? "Upper part" : "low", id);
    for (int i = 0; i < nodes; ++i, --id) {
      text += fmt::format("{}, {}, {}, {}\n", id, std::sin(id), std::cos(3.0 * id), id / 3.0);
      elements += fmt::format("{}{}", i % 10 == 9 ? ",\n" : ",", id);
    }
    elements += "\n";
  }
  return text + elements +
         "*NSET, NSET=ends\n900, 850\n*SURFACE, NAME=all\nUpper part, S1\nlow, S4\nlow, S1\n";
}

TEST(AbaqusWriter, EveryCellTypeComesBackWithNumbersSetsAndSurfaces) {
  const Mesh mesh = testing::read(all_types()).mesh;
  ASSERT_EQ(mesh.cells.size(), 7u);
  const Mesh read = again(mesh);
  expect_same(mesh, read);
  EXPECT_EQ(mesh.node_ids, read.node_ids);
}

TEST(AbaqusWriter, AMeshWithoutNumbersIsNumberedFromOne) {
  Mesh mesh = mesh::testing::one_cell();
  const Mesh read = again(mesh);
  EXPECT_EQ(read.cells[0].ids, std::vector<int32_t>{1});
  EXPECT_EQ(read.node_ids.front(), 1);
  mesh.cells[0].ids = {1};
  expect_same(mesh, read);
  EXPECT_EQ(read.surface("skin").face_count(), 4);
}

TEST(AbaqusWriter, ShellsComeBackWithBothSidesOfTheirSurfaces) {
  const mesh::testing::Folder folder;
  Mesh mesh = mesh::testing::cube_and_sheet();
  write_abaqus(mesh, folder / "out.inp");
  std::ifstream file(folder / "out.inp");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_NE(text.find("*ELEMENT, TYPE=S3, ELSET=sheet\n71, 73, 64, 70\n"), std::string::npos);
  EXPECT_NE(text.find("*SURFACE, NAME=wet, TYPE=ELEMENT\n71, SPOS\n9, S2\n70, SNEG\n"),
            std::string::npos);
  const Deck deck = read_abaqus(folder / "out.inp", {});
  EXPECT_EQ(deck.regions.at(2).material, "");
  EXPECT_TRUE(deck.notes.empty());
  expect_same(mesh, deck.mesh);
  mesh.shells[2].thickness.resize(0, 0);
  mesh.shells[2].offset.resize(0);
  mesh::testing::expect_same_shells(mesh, deck.mesh);
}

TEST(AbaqusWriter, SectionsThatTheUserAddsAreThoseOfTheShells) {
  const mesh::testing::Folder folder;
  write_abaqus(mesh::testing::cube_and_sheet(), folder / "out.inp");
  std::ofstream(folder / "all.inp")
      << "*INCLUDE, INPUT=out.inp\n*MATERIAL, NAME=steel\n*ELASTIC\n2e11, .3\n"
         "*SOLID SECTION, ELSET=block, MATERIAL=steel\n"
         "*SHELL SECTION, ELSET=rib, MATERIAL=steel\n.004\n"
         "*SHELL SECTION, ELSET=sheet, MATERIAL=steel\n.002\n";
  const Deck deck = read_abaqus(folder / "all.inp", {});
  EXPECT_EQ(deck.mesh.regions, (std::vector<std::string>{"block", "rib", "sheet"}));
  ASSERT_EQ(deck.shells.size(), 2u);
  EXPECT_EQ(deck.shells[1].section.thickness, 0.002);
}

TEST(AbaqusWriter, NumbersFitCalculixAndLoseNothingAboveAHundredth) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), power(-2.0, 6.0);
  for (int i = 0; i < 100000; ++i) {
    const double m = mantissa(random);
    const double x = std::copysign(std::pow(10.0, power(random)) * (1.0 + std::abs(m)), m);
    const std::string text = abaqus_number(x);
    ASSERT_LE(text.size(), 20u) << text;
    ASSERT_EQ(to_number(text), x) << text;
  }
}

TEST(AbaqusWriter, SmallNumbersLoseAtMostTheDigitsThatDoNotFit) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), power(-80.0, -2.0);
  double worst = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double m = mantissa(random);
    const double x = std::copysign(std::pow(10.0, power(random)) * (1.0 + std::abs(m)), m);
    const std::string text = abaqus_number(x);
    ASSERT_LE(text.size(), 20u) << text;
    worst = std::max(worst, std::abs(*to_number(text) / x - 1.0));
  }
  EXPECT_LE(worst, 5.3e-15);  // half of the fifteenth digit, and the roundings to double
  EXPECT_EQ(abaqus_number(0.0), "0.");
  EXPECT_EQ(abaqus_number(-5.0), "-5.");
  EXPECT_EQ(abaqus_number(0.25), ".25");
  EXPECT_EQ(abaqus_number(1e100), "1e100");
}

TEST(AbaqusWriter, WhatADeckCannotHoldIsRefused) {
  const mesh::testing::Folder folder;
  Mesh mesh = mesh::testing::one_cell();
  mesh.node_sets["TIP"] = {0};
  const auto refusal = [&] {
    return test::refusal_of([&] { write_abaqus(mesh, folder / "x.inp"); });
  };
  EXPECT_EQ(refusal(), "mesh 'one': the names 'TIP' and 'tip' are the same to Abaqus");
  mesh = mesh::testing::one_cell();
  mesh.cells[0].type = CellType::kPyramid13;
  EXPECT_EQ(refusal(), "mesh 'one': Abaqus has no element for pyramid13");
  mesh = mesh::testing::one_cell();
  std::swap(mesh.surfaces["skin"].faces[0].nodes(0, 0), mesh.surfaces["skin"].faces[0].nodes(0, 1));
  test::expect_parts(refusal(), {"mesh 'one': surface skin: the face of nodes ",
                                 "is not an outward face of a cell"});
  EXPECT_FALSE(std::filesystem::exists(folder / "x.inp"));
  EXPECT_FALSE(std::filesystem::exists(folder / "x.inp.part"));
  test::expect_parts(test::refusal_of<FileError>(
                         [&] { write_abaqus(mesh::testing::one_cell(), folder / "none/x.inp"); }),
                     {"none/x.inp: cannot be written (folder missing or disk full?)"});
}

}  // namespace
}  // namespace clatter::mesh::deck
