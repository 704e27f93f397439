// SPDX-License-Identifier: GPL-3.0-or-later
// Sections of layers.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "core/fe/shell_section.hpp"

namespace clatter::fe {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Material steel() { return {.youngs = 2e11, .poisson = 0.3, .density = 8000.0}; }

/// Of fibres along direction 1.
Material fibres() {
  MaterialTable table;
  table.E = {140e9, 10e9, 9e9};
  table.nu = {0.3, 0.25, 0.4};
  table.G = {5e9, 4e9, 3e9};
  table.expansion = {-1e-6, 3e-5, 3e-5};
  table.material.density = 1600.0;
  finish(keys::Source("test"), table);
  return table.material;
}

ShellSection layers(std::vector<ShellLayer> all) {
  ShellSection section;
  for (const ShellLayer& layer : all) section.thickness += layer.thickness;
  section.layers = std::move(all);
  return section;
}

ShellStiffness of(const ShellSection& section) {
  return stiffness_of(section, {}, section.thickness);
}

template <class A, class B>
void expect_near(const A& a, const B& b, double relative) {
  EXPECT_LE((a - b).norm(), relative * b.norm()) << a << "\n\n" << b;
}

TEST(SheetLaw, IsThatOfTheSolidWithoutStressAcross) {
  const SheetLaw law = sheet_law(fibres());
  const double nu21 = 0.3 * 10.0 / 140.0, factor = 1.0 / (1.0 - 0.3 * nu21);
  Eigen::Matrix3d plane;
  plane << 140e9, 0.3 * 10e9, 0.0, 0.3 * 10e9, 10e9, 0.0, 0.0, 0.0, 5e9 / factor;
  expect_near(law.plane, Eigen::Matrix3d(factor * plane), 1e-14);
  expect_near(law.shear, Eigen::Matrix2d(Eigen::Vector2d(4e9, 3e9).asDiagonal()), 1e-14);
  const SheetLaw isotropic = sheet_law(steel());
  Material same = steel();
  same.elasticity = steel().elasticity_at({});
  expect_near(sheet_law(same).plane, isotropic.plane, 1e-14);
  expect_near(sheet_law(same).shear, isotropic.shear, 1e-14);
}

TEST(SheetLaw, TurnsAsTheSolidDoes) {
  // The solid is turned by its axes, then its stresses across the sheet are removed.
  const double angle = 25.0 * kDegree;
  Material turned = fibres();
  turned.axes = Axes{};
  turned.axes->frame << std::cos(angle), -std::sin(angle), 0.0, std::sin(angle), std::cos(angle),
      0.0, 0.0, 0.0, 1.0;
  Material solid = fibres();
  solid.elasticity = turned.elasticity_at({});
  solid.expansion = turned.expansion_at({});
  const SheetLaw law = sheet_law(fibres(), angle), want = sheet_law(solid);
  expect_near(law.plane, want.plane, 1e-14);
  expect_near(law.shear, want.shear, 1e-14);
  expect_near(law.expansion, want.expansion, 1e-14);
  EXPECT_GT(std::abs(law.plane(0, 2)), 1e9);
}

TEST(SheetLaw, NeedsShearAcrossApartFromThePlane) {
  EXPECT_TRUE(is_sheet_material(steel()));
  EXPECT_TRUE(is_sheet_material(fibres()));
  Material leaning = fibres();
  (*leaning.elasticity)(0, 5) = (*leaning.elasticity)(5, 0) = 1e9;
  EXPECT_FALSE(is_sheet_material(leaning));
}

TEST(Laminate, OfOneMaterialIsASheet) {
  const ShellSection many =
      layers({{steel(), 0.001, 0.3}, {steel(), 0.0005, -1.0}, {steel(), 0.0025, 2.0}});
  const ShellSection one{.thickness = 0.004};
  const ShellStiffness a = of(many), b = stiffness_of(one, steel(), 0.004);
  expect_near(a.A, b.A, 1e-14);
  expect_near(a.D, b.D, 1e-14);
  expect_near(a.S, b.S, 1e-13);
  EXPECT_LE(a.B.norm(), 1e-15 * 0.004 * a.A.norm());
  EXPECT_NEAR(a.drilling, b.drilling, 1e-14 * b.drilling);
  EXPECT_NEAR(a.mass.total, b.mass.total, 1e-14 * b.mass.total);
  EXPECT_NEAR(a.mass.rotary, b.mass.rotary, 1e-14 * b.mass.rotary);
  EXPECT_NEAR(a.mass.moment, 0.0, 1e-16);
  EXPECT_FALSE(many.has_directions({}));
}

TEST(Laminate, CountsItsLayersFromTheInnerSide) {
  // Steel inside, something lighter and softer outside.
  Material light = steel();
  light.youngs = 7e10;
  light.density = 2700.0;
  const double a = 0.001, b = 0.003, h = a + b;
  const ShellStiffness s = of(layers({{steel(), a}, {light, b}}));
  const double factor = 1.0 / (1.0 - 0.09), middle = -0.5 * h + a;  // of the seam
  const auto between = [](double low, double high, int power) {
    return (std::pow(high, power + 1) - std::pow(low, power + 1)) / (power + 1);
  };
  const auto sum = [&](int power, double inner, double outer) {
    return inner * between(-0.5 * h, middle, power) + outer * between(middle, 0.5 * h, power);
  };
  EXPECT_NEAR(s.A(0, 0), factor * sum(0, 2e11, 7e10), 1e-14 * s.A(0, 0));
  EXPECT_NEAR(s.B(0, 0), factor * sum(1, 2e11, 7e10), 1e-14 * h * s.A(0, 0));
  EXPECT_NEAR(s.D(0, 0), factor * sum(2, 2e11, 7e10), 1e-14 * s.D(0, 0));
  EXPECT_LT(s.B(0, 0), 0.0);
  EXPECT_NEAR(s.mass.total, sum(0, 8000.0, 2700.0), 1e-13);
  EXPECT_NEAR(s.mass.moment, sum(1, 8000.0, 2700.0), 1e-15);
  EXPECT_NEAR(s.mass.rotary, sum(2, 8000.0, 2700.0), 1e-15);
}

TEST(Laminate, ASandwichShearsInItsCore) {
  // Thin faces: the shear stress of the core is V / d, of the faces little: S = G d^2 / c.
  Material core{.youngs = 1e6, .poisson = 0.25, .density = 50.0};
  const double face = 1e-5, c = 0.02, d = c + face;
  const ShellStiffness s = of(layers({{steel(), face}, {core, c}, {steel(), face}}));
  const double want = core.mu() * d * d / c;
  EXPECT_NEAR(s.S(0, 0), want, 1e-4 * want);
  EXPECT_NEAR(s.S(1, 1), want, 1e-4 * want);
  EXPECT_NEAR(s.S(0, 1), 0.0, 1e-12 * want);
}

TEST(Laminate, IsTheSameWhereALayerIsTwo) {
  const auto one = layers({{fibres(), 0.001, 0.0}, {fibres(), 0.002, 0.7}, {steel(), 0.001}});
  const auto two = layers(
      {{fibres(), 0.001, 0.0}, {fibres(), 0.0005, 0.7}, {fibres(), 0.0015, 0.7}, {steel(), 0.001}});
  const ShellStiffness a = of(one), b = of(two);
  expect_near(a.A, b.A, 1e-14);
  expect_near(a.B, b.B, 1e-13);
  expect_near(a.D, b.D, 1e-14);
  expect_near(a.S, b.S, 1e-13);
  expect_near(a.stretch, b.stretch, 1e-12);
  expect_near(a.curl, b.curl, 1e-12);
  // In proportion where it is twice as thick.
  const ShellStiffness thick = stiffness_of(one, {}, 2.0 * one.thickness);
  expect_near(thick.A, Eigen::Matrix3d(2.0 * a.A), 1e-14);
  expect_near(thick.B, Eigen::Matrix3d(4.0 * a.B), 1e-13);
  expect_near(thick.D, Eigen::Matrix3d(8.0 * a.D), 1e-14);
  expect_near(thick.S, Eigen::Matrix2d(2.0 * a.S), 1e-13);
  expect_near(thick.curl, Eigen::Vector3d(0.5 * a.curl), 1e-12);
}

TEST(Laminate, TurnedByAQuarterItsDirectionsAreExchanged) {
  const ShellStiffness along = of(layers({{fibres(), 0.001, 0.0}, {steel(), 0.001}}));
  const ShellStiffness across = of(layers({{fibres(), 0.001, 90.0 * kDegree}, {steel(), 0.001}}));
  EXPECT_NEAR(along.D(0, 0), across.D(1, 1), 1e-13 * along.D(0, 0));
  EXPECT_NEAR(along.S(0, 0), across.S(1, 1), 1e-13 * along.S(0, 0));
  EXPECT_NEAR(along.curl(0), across.curl(1), 1e-13 * std::abs(along.curl(0)));
  EXPECT_NEAR(along.D(0, 1), across.D(0, 1), 1e-13 * along.D(0, 0));
}

TEST(Laminate, OfTwoMetalsCurlsWhenItIsWarm) {
  // Timoshenko 1925, of plates: 6 (a2 - a1) (1 + m)^2 / (h (3 (1 + m)^2 + (1 + m n) (m^2 + 1/(m
  // n))))
  Material brass = steel();
  brass.youngs = 1e11;
  brass.expansion.head<3>().setConstant(1.9e-5);
  Material iron = steel();
  iron.expansion.head<3>().setConstant(1.2e-5);
  const double inner = 0.0006, outer = 0.001, h = inner + outer;
  const ShellStiffness s = of(layers({{iron, inner}, {brass, outer}}));
  const double m = inner / outer, n = 2.0, more = (1.0 + m) * (1.0 + m);
  const double bend =
      6.0 * 0.7e-5 * more / (h * (3.0 * more + (1.0 + m * n) * (m * m + 1.0 / (m * n))));
  EXPECT_NEAR(s.curl(0), bend, 1e-12 * bend);
  EXPECT_NEAR(s.curl(1), bend, 1e-12 * bend);
  EXPECT_NEAR(s.curl(2), 0.0, 1e-12 * bend);
  EXPECT_GT(s.stretch(0), 1.2e-5);
  EXPECT_LT(s.stretch(0), 1.9e-5);
}

TEST(Section, HasItsOtherMaterialsForBendingAndShear) {
  ShellSection section{.thickness = 0.002, .bending = 3.0, .shear = 20.0};
  section.shear_material = fibres();
  Material soft = steel();
  soft.youngs = 1e9;
  section.bending_material = soft;
  const ShellStiffness s = stiffness_of(section, steel(), 0.002);
  expect_near(s.A, Eigen::Matrix3d(0.002 * sheet_law(steel()).plane), 1e-14);
  expect_near(s.D, Eigen::Matrix3d(3.0 * 8e-9 / 12.0 * sheet_law(soft).plane), 1e-14);
  expect_near(s.S, Eigen::Matrix2d(0.04 * sheet_law(fibres()).shear), 1e-14);
  EXPECT_TRUE(section.has_directions(steel()));
}

}  // namespace
}  // namespace clatter::fe
