// SPDX-License-Identifier: GPL-3.0-or-later
// CFAST and CWELD: springs between patches of two sheets.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/observed.hpp"

namespace clatter::test {
namespace {

using Eigen::Vector3d;
using mesh::deck::Deck;
using mesh::deck::Spring;
using ::testing::HasSubstr;

constexpr double kE = 210.0, kNu = 0.3;

/// Two sheets of 3 x 3 cells of 10, of different meshes, at z = 0 (property 1, 2 thick) and z = 4
/// (property 2, 3 thick, its upper half moved by 3 along x, so that cells are no parallelograms).
std::string two_sheets() {
  std::string text = "MAT1,1,210.,,.3,7.8\nPSHELL,1,1,2.,1,,1\nPSHELL,2,1,3.,1,,1\n";
  for (int sheet = 0; sheet < 2; ++sheet)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const double shift = sheet == 1 && j > 1 ? 3.0 : 0.0;
        text += fmt::format("GRID,{},,{:.1f},{:.1f},{:.1f}\n", 100 * sheet + 4 * j + i + 1,
                            10.0 * i + shift, 10.0 * j, 4.0 * sheet);
        if (i == 3 || j == 3) continue;
        const int first = 100 * sheet + 4 * j + i + 1;
        text += fmt::format("CQUAD4,{},{},{},{},{},{}\n", 100 * sheet + 3 * j + i + 1, sheet + 1,
                            first, first + 1, first + 5, first + 4);
      }
  return text;
}

/// How much a spring is longer where each node of the sheet at z = 4 moves by u + theta x (x - c).
double elongation(const Deck& deck, const Spring& spring, const Vector3d& u, const Vector3d& theta,
                  bool both = false, const Vector3d& c = Vector3d(15.0, 15.0, 4.0)) {
  double sum = 0.0;
  for (const auto& term : spring.terms) {
    const Vector3d x = deck.mesh.nodes.row(term.node_index);
    if (!both && x.z() < 1.0) continue;
    EXPECT_LT(term.direction, 3);  // patches move by displacements alone
    sum += term.coefficient * (u + theta.cross(x - c))(term.direction);
  }
  return sum;
}

const std::string kFast = "PFAST,7,6.,,,1.,2.,3.,4.,+\n+,5.,6.,.8,.02\n";

TEST(NastranFasteners, SixSpringsFollowPatchesOfBothSheets) {
  const Deck deck = read_deck(two_sheets() + kFast + "CFAST,50,7,PROP,1,2,,,,+\n+,15.,15.,1.\n");
  ASSERT_EQ(deck.springs.size(), 6u);
  // Axes: along z; across it first along x, the least of the basic axes along z.
  const std::array<Vector3d, 3> axes = {Vector3d::UnitZ(), Vector3d::UnitX(), Vector3d::UnitY()};
  double rigid = 0.0, relative = 0.0;
  for (int k = 0; k < 6; ++k) {
    const Spring& spring = deck.springs[static_cast<size_t>(k)];
    EXPECT_EQ(spring.stiffness, k + 1.0);
    EXPECT_EQ(spring.loss_factor, 0.02);
    const Vector3d u(0.3, -0.7, 0.5), theta(0.2, 0.4, -0.1);
    rigid = std::max(rigid, std::abs(elongation(deck, spring, u, theta, true)));
    const Vector3d t = axes[static_cast<size_t>(k % 3)];
    // At the middle of both sheets, 2 below the upper one.
    const Vector3d there = u + theta.cross(Vector3d(0.0, 0.0, -2.0));
    const double expected = k < 3 ? t.dot(there) : t.dot(theta);
    relative = std::max(relative, std::abs(elongation(deck, spring, u, theta) - expected));
  }
  expect_at_most("elongation by rigid motions of both sheets", rigid, 1e-14);
  expect_at_most("error of elongations by one sheet's", relative, 1e-13);
  double mass = 0.0;
  for (const auto& one : deck.masses) mass += one.mass;
  EXPECT_NEAR(mass, 0.8, 1e-15);
}

TEST(NastranFasteners, ShellsGridsAndPiercingPointsAreEndsToo) {
  const std::string sheets =
      two_sheets() + "GRID,900,,15.,15.,2.\nGRID,901,,16.,15.,0.\n" + kFast + "PWELD,8,1,6.\n";
  for (const char* card :
       {"CFAST,50,7,ELEM,5,105,900\n", "CWELD,50,8,900,ELPAT,,,,,+\n+,5,105\n",
        "CWELD,50,8,900,ELEMID,,,,,+\n+,5,105\n", "CWELD,50,8,900,PARTPAT,,,,,+\n+,1,2\n",
        "CWELD,50,8,900,GRIDID,,,QQ,,+\n+,6,7,11,10,,,,,+\n+,106,107,111,110\n",
        "CFAST,50,7,PROP,1,2,,901\n"}) {
    const Deck deck = read_deck(sheets + card);
    ASSERT_EQ(deck.springs.size(), 6u) << card;
    for (const Spring& spring : deck.springs)
      EXPECT_NEAR(elongation(deck, spring, {1, 2, 3}, {0.1, 0.2, 0.3}, true), 0.0, 1e-13) << card;
  }
  // To a grid of the other sheet with its own rotations.
  const Deck deck = read_deck(sheets + "CWELD,50,8,,ALIGN,6,106\n");
  ASSERT_EQ(deck.springs.size(), 6u);
  EXPECT_EQ(deck.springs[3].terms.size(), 2u);
}

// Flanges of one property, of which GS lies nearer to the lower one.
TEST(NastranFasteners, SheetsOfOnePropertyAreJoinedByTheirShells) {
  std::string text = two_sheets();
  for (size_t at = 0; (at = text.find("CQUAD4,10", at)) != std::string::npos; ++at)
    text[text.find(',', at + 7) + 1] = '1';
  const Deck deck = read_deck(text + kFast + "CFAST,50,7,ELEM,5,105,,,,+\n+,15.,15.,1.\n");
  ASSERT_EQ(deck.springs.size(), 6u);
  const Vector3d u(2.0, 3.0, 1.0), still(0.0, 0.0, 0.0);
  for (int k = 0; k < 3; ++k) {  // along z, x, y
    const Spring& spring = deck.springs[static_cast<size_t>(k)];
    EXPECT_NEAR(elongation(deck, spring, u, still), u((k + 2) % 3), 1e-13);
  }
}

TEST(NastranFasteners, AWeldIsARoundBarWithShear) {
  const double D = 6.0, area = std::numbers::pi * 9.0, I = area * D * D / 16.0,
               G = kE / (2.0 * (1.0 + kNu));
  const auto stiffness = [&](const std::string& property) {
    const Deck deck = read_deck(two_sheets() + property +
                                "CWELD,50,8,,PARTPAT,,,,,+\n+,1,2,,,,,,,+\n+,15.,15.,1.\n");
    std::array<double, 6> k{};
    for (size_t i = 0; i < 6; ++i) k[i] = deck.springs.at(i).stiffness;
    return k;
  };
  // Timoshenko's bar of the length 4 between the sheets, about its middle: 12 E I / (L^3 (1 +
  // phi)).
  const double L = 4.0, phi = 12.0 * kE * I / (0.9 * G * area * L * L);
  const std::array<double, 6> bar = stiffness("PWELD,8,1,6.\n");
  EXPECT_NEAR(bar[0], kE * area / L, 1e-10);
  EXPECT_NEAR(bar[1], 12.0 * kE * I / (L * L * L * (1.0 + phi)), 1e-10);
  EXPECT_NEAR(bar[2], bar[1], 1e-10);
  EXPECT_NEAR(bar[3], 2.0 * G * I / L, 1e-10);
  EXPECT_NEAR(bar[4], kE * I / L, 1e-10);
  // A spot weld is as long as half of both sheets are thick.
  EXPECT_NEAR(stiffness("PWELD,8,1,6.,,,,,SPOT\n")[0], kE * area / 2.5, 1e-10);
  // LDMIN.
  EXPECT_NEAR(stiffness("PWELD,8,1,6.,,,,,,+\n+,1.5\n")[0], kE * area / 9.0, 1e-10);
}

TEST(NastranFasteners, WhatIsMissingIsNamed) {
  const std::string sheets = two_sheets() + kFast;
  const auto of = [&](const std::string& card) { return refusal(sheets + card); };
  EXPECT_THAT(of("CFAST,50,9,PROP,1,2,,,,+\n+,15.,15.,1.\n"),
              HasSubstr("CFAST 50: found no PFAST 9"));
  EXPECT_THAT(of("CFAST,50,7,PROP,1,3,,,,+\n+,15.,15.,1.\n"),
              HasSubstr("CFAST 50: found no shell of property 3 within"));
  EXPECT_THAT(of("CFAST,50,7,ELEM,5,77,,,,+\n+,15.,15.,1.\n"), HasSubstr("found no shell 77"));
  EXPECT_THAT(of("CFAST,50,7,PROP,1,2\n"), HasSubstr("expected a grid, GA, or XS, YS and ZS"));
  EXPECT_THAT(of("CFAST,50,7,NODE,1,2,6\n"), HasSubstr("expected PROP or ELEM"));
  EXPECT_THAT(of("CFAST,50,7,PROP,1,2,,,,+\n+,15.,15.,400.\n"),
              HasSubstr("found no shell of property 1 within"));
  EXPECT_THAT(of("PFAST,8,0.\n"), HasSubstr("expected a diameter above 0"));
  EXPECT_THAT(of("PWELD,8,3,6.\nCWELD,50,8,,ALIGN,6,106\n"), HasSubstr("found no material 3"));
}

}  // namespace
}  // namespace clatter::test
