// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "core/base/error.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRounding = 1e-14;  // a few products

struct Case {
  const char* name;
  double force, pressure, density;  // of one unit [N], [Pa], [kg/m3]
};

class Units : public ::testing::TestWithParam<Case> {};

TEST_P(Units, HaveTheForceAndPressureOfTheirName) {
  const auto& [name, force, pressure, density] = GetParam();
  const UnitSystem units = unit_system_named(name, "deck.inp");
  EXPECT_NEAR(units.force(), force, kRounding * force);
  EXPECT_NEAR(units.pressure(), pressure, kRounding * pressure);
  Deck deck;
  deck.mesh.nodes.resize(0, 3);
  deck.materials["m"].density = 1.0;
  convert_units(deck, units);
  EXPECT_NEAR(deck.materials["m"].density, density, kRounding * density);
}

// psi and lbf s2 / in4: NIST SP 811, appendix B (6.894 757 e3 Pa, 1.068 690 e7 kg/m3).
INSTANTIATE_TEST_SUITE_P(
    All, Units,
    ::testing::Values(Case{"m-kg-s", 1.0, 1.0, 1.0}, Case{"mm-t-s", 1.0, 1e6, 1e12},
                      Case{"mm-kg-ms", 1e3, 1e9, 1e9}, Case{"mm-kg-s", 1e-3, 1e3, 1e9},
                      Case{"cm-g-s", 1e-5, 0.1, 1e3},
                      Case{"in-lbfs2/in-s", 4.4482216152605, 4.4482216152605 / 6.4516e-4,
                           4.4482216152605 / (6.4516e-4 * 6.4516e-4)}),
    [](const auto& info) { return "system" + std::to_string(info.index); });

TEST(UnitsByName, UnknownOnesAreRefusedWithTheKnownOnes) {
  EXPECT_THAT([] { unit_system_named("mm-g-s", "deck.inp"); },
              ThrowsMessage<InputError>(
                  HasSubstr("deck.inp: found units 'mm-g-s', expected one of: m-kg-s, mm-t-s, ")));
}

/// A deck with one item of each kind with a unit, all values 1.
Deck of_ones() {
  Deck deck;
  deck.mesh.nodes = RowMatrix::Ones(2, 3);
  deck.points.push_back({3, Eigen::Vector3d::Ones()});
  deck.systems["s"].origin = Eigen::Vector3d::Ones();
  deck.materials["iso"].constants = {1.0, 1.0};
  deck.materials["ortho"].kind = Material::Kind::kOrthotropic;
  deck.materials["ortho"].constants.assign(9, 1.0);
  deck.materials["aniso"].kind = Material::Kind::kAnisotropic;
  deck.materials["aniso"].constants.assign(21, 1.0);
  deck.materials["iso"].expansion = {1.0};
  deck.ties.resize(2);
  deck.ties[0].distance = 1.0;
  Equation equation;
  equation.terms = {{0, 0, 1.0}, {2, 4, 1.0}};
  deck.equations = {equation};
  deck.springs = {{"", 1.0, equation.terms}};
  for (const bool is_mass : {false, true})
    deck.matrices.push_back({"", "", is_mass, equation.terms, Eigen::MatrixXd::Ones(2, 2)});
  Mass mass;
  mass.mass = 1.0;
  mass.inertia.setOnes();
  mass.offset.setOnes();
  deck.masses = {mass};
  Support shift, turn;
  shift.value = turn.value = 1.0;
  turn.dofs = 0b010000;
  Step step;
  step.supports = {shift, turn};
  step.forces = {{0, 0, 1.0, ""}, {2, 3, 1.0, ""}};
  step.pressures = {{"top", 1.0}};
  step.acceleration.setOnes();
  deck.steps = {step};
  return deck;
}

TEST(Deck, InMillimetresTonnesAndSecondsBecomesSi) {
  Deck deck = of_ones();
  convert_units(deck, unit_system_named("mm-t-s", "deck"));
  EXPECT_EQ(deck.mesh.nodes, RowMatrix::Constant(2, 3, 1e-3));
  EXPECT_EQ(deck.points[0].at, Eigen::Vector3d::Constant(1e-3));
  EXPECT_EQ(deck.systems["s"].origin, Eigen::Vector3d::Constant(1e-3));
  EXPECT_DOUBLE_EQ(deck.materials["iso"].constants[0], 1e6);
  EXPECT_EQ(deck.materials["iso"].constants[1], 1.0);  // nu
  EXPECT_EQ(deck.materials["iso"].expansion[0], 1.0);  // per kelvin
  for (size_t i = 0; i < 9; ++i)                       // E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
    EXPECT_DOUBLE_EQ(deck.materials["ortho"].constants[i], i / 3 == 1 ? 1.0 : 1e6) << i;
  for (const double c : deck.materials["aniso"].constants) EXPECT_DOUBLE_EQ(c, 1e6);
  EXPECT_DOUBLE_EQ(deck.ties[0].distance, 1e-3);
  EXPECT_EQ(deck.ties[1].distance, -1.0);  // left to the assembler
  // x [mm] + theta = 0 is x [m] + 1e-3 theta = 0.
  EXPECT_EQ(deck.equations[0].terms[0].coefficient, 1.0);
  EXPECT_DOUBLE_EQ(deck.equations[0].terms[1].coefficient, 1e-3);
  EXPECT_DOUBLE_EQ(deck.springs[0].stiffness, 1e3);  // N/mm
  EXPECT_EQ(deck.springs[0].terms[0].coefficient, 1.0);
  EXPECT_DOUBLE_EQ(deck.springs[0].terms[1].coefficient, 1e-3);  // a lever arm
  Eigen::Matrix2d stiffness, mass;
  stiffness << 1e3, 1.0, 1.0, 1e-3;  // N/mm, N, N mm
  mass << 1e3, 1.0, 1.0, 1e-3;       // t, t mm, t mm2
  EXPECT_LT((deck.matrices[0].values - stiffness).norm(), 1e3 * kRounding);
  EXPECT_LT((deck.matrices[1].values - mass).norm(), 1e3 * kRounding);
  EXPECT_DOUBLE_EQ(deck.masses[0].mass, 1e3);
  EXPECT_NEAR(deck.masses[0].inertia(0, 1), 1e-3, kRounding);  // t mm2
  EXPECT_DOUBLE_EQ(deck.masses[0].offset(2), 1e-3);
  const Step& step = deck.steps[0];
  EXPECT_DOUBLE_EQ(step.supports[0].value, 1e-3);
  EXPECT_EQ(step.supports[1].value, 1.0);  // rad
  EXPECT_DOUBLE_EQ(step.forces[0].value, 1.0);
  EXPECT_DOUBLE_EQ(step.forces[1].value, 1e-3);  // N mm
  EXPECT_DOUBLE_EQ(step.pressures[0].value, 1e6);
  EXPECT_EQ(step.acceleration, Eigen::Vector3d::Constant(1e-3));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
