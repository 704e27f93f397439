// SPDX-License-Identifier: GPL-3.0-or-later
// Materials and the systems of their axes.
#include <cmath>

#include "mesh/deck/system_axes.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck {
namespace {

using testing::kCube;
using testing::kModel;
using testing::read;
using testing::refusal;

Material material(const std::string& cards) {
  return read(kCube + "*MATERIAL, NAME=M\n" + cards + "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n")
      .materials.at("M");
}

std::string bad_material(const std::string& cards) {
  return refusal(kCube + "*MATERIAL, NAME=M\n" + cards +
                 "*SOLID SECTION, ELSET=EALL, MATERIAL=M\n");
}

TEST(AbaqusMaterials, AnIsotropicOneHasModulusAndRatio) {
  const Material m = material(
      "*DENSITY\n7.8E-9,\n*ELASTIC\n2.1E5, .3, 20.\n*EXPANSION, ZERO=20.\n1.2E-5\n"
      "*CONDUCTIVITY\n50.\n*SPECIFIC HEAT\n4.\n");
  EXPECT_EQ(m.kind, Material::Kind::kIsotropic);
  EXPECT_EQ(m.constants, (std::vector<double>{2.1e5, 0.3}));
  EXPECT_EQ(m.density, 7.8e-9);
  EXPECT_EQ(m.expansion, std::vector<double>{1.2e-5});
  EXPECT_EQ(m.reference_temperature, 0.0);
}

TEST(AbaqusMaterials, EngineeringConstantsKeepTheirOrder) {
  const Material m = material(
      "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1,2,3,.4,.5,.6,7,8\n9\n"
      "*EXPANSION, TYPE=ORTHO\n1,2,3\n");
  EXPECT_EQ(m.kind, Material::Kind::kOrthotropic);
  EXPECT_EQ(m.constants, (std::vector<double>{1, 2, 3, .4, .5, .6, 7, 8, 9}));
  EXPECT_EQ(m.expansion, (std::vector<double>{1, 2, 3}));
}

// C by stresses 11 22 33 12 23 31, rows of the upper triangle.
double entry(const Material& m, size_t i, size_t j) {
  size_t at = 0;
  for (size_t row = 0; row < i; ++row) at += 6 - row;
  return m.constants[at + j - i];
}

TEST(AbaqusMaterials, AnOrthotropicStiffnessHasEachConstantAtItsIndex) {
  // D1111 D1122 D2222 D1133 D2233 D3333 D1212 D1313 D2323
  const Material m =
      material("*ELASTIC, TYPE=ORTHO\n1111,1122,2222,1133,2233,3333,1212,1313\n2323\n");
  EXPECT_EQ(m.kind, Material::Kind::kAnisotropic);
  EXPECT_EQ(entry(m, 0, 0), 1111);
  EXPECT_EQ(entry(m, 0, 1), 1122);
  EXPECT_EQ(entry(m, 0, 2), 1133);
  EXPECT_EQ(entry(m, 1, 1), 2222);
  EXPECT_EQ(entry(m, 1, 2), 2233);
  EXPECT_EQ(entry(m, 2, 2), 3333);
  EXPECT_EQ(entry(m, 3, 3), 1212);
  EXPECT_EQ(entry(m, 4, 4), 2323);
  EXPECT_EQ(entry(m, 5, 5), 1313);
  EXPECT_EQ(entry(m, 0, 3), 0);
  EXPECT_EQ(entry(m, 3, 4), 0);
}

TEST(AbaqusMaterials, AnAnisotropicStiffnessHasEachConstantAtItsIndex) {
  const Material m = material(
      "*ELASTIC, TYPE=ANISOTROPIC\n"
      "1111,1122,2222,1133,2233,3333,1112,2212\n"
      "3312,1212,1113,2213,3313,1213,1313,1123\n"
      "2223,3323,1223,1323,2323\n");
  // Our components are 11 22 33 12 23 31: C_ij must be the number "ij" of Abaqus.
  const std::array<int, 6> names = {11, 22, 33, 12, 23, 13};
  const std::array<int, 6> rank = {0, 1, 2, 3, 5, 4};  // Abaqus writes 12 before 13 before 23
  for (size_t i = 0; i < 6; ++i) {
    for (size_t j = i; j < 6; ++j) {
      const bool in_order = rank[i] <= rank[j];
      EXPECT_EQ(entry(m, i, j), in_order ? 100 * names[i] + names[j] : 100 * names[j] + names[i]);
    }
  }
}

TEST(AbaqusMaterials, UnsupportedInputIsRefused) {
  EXPECT_NE(bad_material("*ELASTIC\n1,.3,0\n2,.3,100\n").find("depend on the temperature"),
            std::string::npos);
  EXPECT_EQ(material("*ELASTIC\n1,.3,0\n1,.3,100\n").constants.size(), 2u);
  EXPECT_NE(bad_material("*ELASTIC, TYPE=COUPLED\n1,2,3\n").find("TYPE=COUPLED"),
            std::string::npos);
  EXPECT_NE(bad_material("*ELASTIC, TYPE=LAMINA\n5,4,.3,1,1,1\n").find("is a LAMINA, of shells"),
            std::string::npos);
  EXPECT_NE(bad_material("*ELASTIC\n1\n").find("found '' in field 2"), std::string::npos);
  EXPECT_NE(bad_material("*ELASTIC\n").find("found 0 data lines"), std::string::npos);
  EXPECT_NE(bad_material("*DENSITY\n1\n").find("has no *ELASTIC"), std::string::npos);
  EXPECT_NE(bad_material("*ELASTIC\n1,.3\n*HYPERELASTIC\n1,0\n").find("keyword *HYPERELASTIC"),
            std::string::npos);
  EXPECT_EQ(refusal("*ELASTIC\n1,.3\n"), "deck.inp:1: found *ELASTIC, expected it after *MATERIAL");
  EXPECT_NE(refusal(kModel + "*MATERIAL, NAME=steel\n").find("a second material steel"),
            std::string::npos);
}

System orientation(const std::string& parameters, const std::string& lines) {
  return read(kModel + "*ORIENTATION, NAME=O" + parameters + "\n" + lines).systems.at("O");
}

TEST(AbaqusSystems, ARectangularOneHasItsFirstAxisThroughA) {
  const System s = orientation("", "0, 2, 0, -1, 5, 0\n");
  Eigen::Matrix3d wanted;
  wanted << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  EXPECT_EQ(s.axes, wanted);
  const System shifted = orientation(", SYSTEM=RECTANGULAR", "1, 2, 0, 0, 1, 0, 1, 1, 0\n");
  EXPECT_EQ(shifted.axes, wanted);
  EXPECT_EQ(shifted.origin, Eigen::Vector3d(1, 1, 0));
}

TEST(AbaqusSystems, TheSecondLineTurnsAboutALocalAxis) {
  // Axes y, -x, z of the basic frame; 90 degrees about the third: -x, -y, z.
  const System s = orientation("", "0, 1, 0, -1, 0, 0\n3, 90.\n");
  EXPECT_LT((s.axes.col(0) - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-15);  // cos(pi / 2) rounds
  EXPECT_LT((s.axes.col(1) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-15);
}

TEST(AbaqusSystems, ACylindricalOneRotatesWithThePosition) {
  const System s = orientation(", SYSTEM=CYLINDRICAL", "1, 0, 0, 1, 0, 5\n");
  EXPECT_EQ(s.kind, System::Kind::kCylindrical);
  EXPECT_EQ(s.origin, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(s.axes.col(2), Eigen::Vector3d(0, 0, 1));
  EXPECT_NEAR(s.axes.determinant(), 1.0, 1e-15);
  const Eigen::Matrix3d axes = axes_at(s, {1, 3, 7});
  EXPECT_EQ(axes.col(0), Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(axes.col(1), Eigen::Vector3d(-1, 0, 0));
}

TEST(AbaqusSystems, InvalidAxesAreRefused) {
  const auto bad = [](const std::string& rest) {
    return refusal(kModel + "*ORIENTATION, NAME=O" + rest);
  };
  EXPECT_NE(bad("\n1,0,0,2,0,0\n").find("not on a line"), std::string::npos);
  EXPECT_NE(bad(", SYSTEM=CYLINDRICAL\n1,0,0,1,0,0\n").find("two different points"),
            std::string::npos);
  EXPECT_NE(bad(", SYSTEM=CYLINDRICAL\n0,0,0,0,0,1\n1, 30.\n").find("additional rotation"),
            std::string::npos);
  EXPECT_NE(bad(", SYSTEM=SPHERICAL\n0,0,0,0,0,1\n").find("SYSTEM=SPHERICAL"), std::string::npos);
  EXPECT_NE(bad(", DEFINITION=NODES\n1,2,3\n").find("DEFINITION=COORDINATES"), std::string::npos);
}

TEST(AbaqusDamping, OfMaterialsAndStepsIsOffered) {
  const std::string elastic = "*ELASTIC\n2.1E5, .3\n";
  const Material m = material(elastic + "*DAMPING, ALPHA=2., BETA=1.E-5\n");
  EXPECT_EQ(m.mass_damping, 2.0);
  EXPECT_EQ(m.stiffness_damping, 1e-5);
  EXPECT_EQ(material(elastic + "*DAMPING, ALPHA=TABULAR\n1., 20.\n").mass_damping, 0.0);
  EXPECT_EQ(material(elastic + "*DAMPING, STRUCTURAL=.03\n").loss_factor, 0.03);
  EXPECT_EQ(m.loss_factor, 0.0);
  EXPECT_THAT(bad_material(elastic + "*DAMPING, ALPHA=x\n"),
              ::testing::HasSubstr("expected a number (ALPHA)"));

  // Of a step that is read, of one that is left out, and Rayleigh damping of modes.
  const Deck deck =
      read(kModel +
           "*STEP\n*FREQUENCY\n5\n*END STEP\n"
           "*STEP\n*GLOBAL DAMPING, ALPHA=3., BETA=2.E-5\n*STEADY STATE DYNAMICS, "
           "DIRECT\n1., 2.\n*END STEP\n"
           "*STEP\n*MODAL DYNAMIC\n1., 2.\n*MODAL DAMPING, RAYLEIGH\n1, 5, 4., 3.E-5\n"
           "*GLOBAL DAMPING, FIELD=ACOUSTIC, ALPHA=9.\n*MODAL DAMPING\n1, 2, .02\n"
           "*END STEP\n");
  ASSERT_EQ(deck.damping.size(), 2u);
  EXPECT_EQ(deck.damping[0].of, "*GLOBAL DAMPING");
  EXPECT_EQ(deck.damping[0].mass, 3.0);
  EXPECT_EQ(deck.damping[0].stiffness, 2e-5);
  EXPECT_EQ(deck.damping[1].of, "*MODAL DAMPING");
  EXPECT_EQ(deck.damping[1].mass, 4.0);
  EXPECT_EQ(deck.damping[1].stiffness, 3e-5);
  EXPECT_THAT(deck.passed, ::testing::HasSubstr("damping, offered to the recipe: *GLOBAL DAMPING"));
}

}  // namespace
}  // namespace clatter::mesh::deck
