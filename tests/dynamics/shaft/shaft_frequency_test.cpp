// SPDX-License-Identifier: GPL-3.0-or-later
// Natural frequencies of shafts of rigid slices and massless beams, and their order.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dynamics/shaft_model.hpp"

namespace clatter::dynamics {
namespace {

using testing::frequencies;
using testing::ShaftModelOf;
using testing::steel_shaft;

// Of the reference: continuum, free at both ends.
constexpr double kTorsion = 4815.682, kBending[] = {991.184, 2666.349, 5056.511};

double torsion(const char* model, int slices) {
  ShaftModelOf shaft(steel_shaft(fmt::format("model = \"{}\"\nslices = {}\n", model, slices)));
  if (std::string(model) == "torsion") return frequencies(shaft.system(), 1)(0);
  // Of the full model the frequency nearest to the torsional one, which no bending mode is.
  const Eigen::VectorXd all = frequencies(shaft.system(), 6);
  Eigen::Index nearest = 0;
  (all.array() - kTorsion).abs().minCoeff(&nearest);
  return all(nearest);
}

/// Bending modes are pairs.
double bending(int mode, int slices) {
  ShaftModelOf shaft(steel_shaft(fmt::format("shear_factor = 0.886\nslices = {}\n", slices)));
  const Eigen::VectorXd all = frequencies(shaft.system(), 6);
  double last = 0.0;
  int found = 0;
  for (Eigen::Index i = 0; i + 1 < all.size(); ++i) {
    if (std::abs(all(i + 1) - all(i)) < 1e-6 * all(i) && all(i) > last * 1.001) {
      last = all(i);
      if (++found == mode) return last;
    }
  }
  return 0.0;
}

TEST(ShaftFrequencies, OracleTorsionOfTwelveDiscs) {
  const double twelve = torsion("torsion", 12);
  // A chain of equal discs in closed form: n/(pi l) sqrt(G/rho) sin(pi/(2 n)).
  const double exact = 12.0 / 0.330 * std::sqrt(79.3e9 / 7850.0) / std::numbers::pi *
                       std::sin(std::numbers::pi / 24.0);
  std::printf("torsion, 12 discs: %.3f Hz, reference 4801.942, closed form %.3f\n", twelve, exact);
  EXPECT_NEAR(twelve, 4801.942, 1e-3);  // the reference's digits
  EXPECT_NEAR(twelve, exact, 1e-9 * exact);
  EXPECT_NEAR(torsion("full", 12), twelve, 1e-9 * twelve);
}

TEST(ShaftFrequencies, OracleTorsionConvergesWithTheSquareOfTheSlices) {
  double before = 0.0;
  for (const int n : {12, 24, 48, 96}) {
    const double error = 1.0 - torsion("torsion", n) / kTorsion;
    std::printf("%d slices: 1 - f/f_exact = %.3e\n", n, error);
    // Four times smaller each time; the reference has seven digits.
    if (before != 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.02) << n;
    }
    before = error;
  }
  EXPECT_LT(before, 5e-5);
}

TEST(ShaftFrequencies, OracleBendingOfRigidSlices) {
  const double six = bending(1, 6), twelve = bending(1, 12);
  std::printf("bending, 6 and 12 slices: %.3f %.3f Hz, reference 977.520 987.760\n", six, twelve);
  EXPECT_NEAR(six, 977.520, 1e-3);  // the reference's digits
  EXPECT_NEAR(twelve, 987.760, 1e-3);
}

TEST(ShaftFrequencies, OracleBendingConvergesToTimoshenkosBeam) {
  for (int mode = 1; mode <= 3; ++mode) {
    double before = 0.0, error = 0.0;
    for (const int n : {24, 48, 96}) {
      error = 1.0 - bending(mode, n) / kBending[mode - 1];
      std::printf("mode %d, %d slices: 1 - f/f_exact = %.3e\n", mode, n, error);
      if (before != 0.0) {
        EXPECT_NEAR(before / error, 4.0, 0.1) << mode << " " << n;
      }
      before = error;
    }
    EXPECT_LT(error, 2e-3) << mode;
  }
}

TEST(ShaftFrequencies, CowpersShearFactorIsThatOfTheReference) {
  const ShaftMaterial steel;
  EXPECT_NEAR((ShaftSection{0.0, 1.0, 0.024, 0.0}).shear_factor(steel), 0.886, 5e-4);
  // A thin tube: 2 (1 + nu) / (4 + 3 nu).
  const double nu = 206.0 / (2.0 * 79.3) - 1.0;
  EXPECT_NEAR((ShaftSection{0.0, 1.0, 0.1, 0.0999}).shear_factor(steel),
              2.0 * (1.0 + nu) / (4.0 + 3.0 * nu), 1e-5);
}

TEST(ShaftFrequencies, AreTheSameAlongEveryAxis) {
  const std::string discs = R"(
[[shaft.disc]]
name = "wheel"
at_mm = 20
mass_kg = 0.6
polar_kg_m2 = 1.15e-3
[[shaft.bearing]]
name = "b"
at_mm = 140
model = "linear"
stiffness_n_m = 3e7
)";
  Eigen::VectorXd first;
  for (const char* axis : {"x", "y", "z"}) {
    ShaftModelOf shaft(steel_shaft(fmt::format("axis = \"{}\"\nslices = 5\n", axis)) + discs);
    const Eigen::VectorXd found = frequencies(shaft.system(), 4);
    if (first.size() == 0) first = found;
    EXPECT_LT((found - first).cwiseAbs().maxCoeff(), 1e-6 * first.maxCoeff()) << axis;
  }
}

TEST(ShaftFrequencies, OfASteppedShaftDoNotDependOnWhereItIsCut) {
  // One section, or the same as three: stations lie beside their ends.
  const std::string discs =
      "slices = 7\n[[shaft.disc]]\nname = \"wheel\"\nat_mm = 100\nmass_kg = 1\n"
      "polar_kg_m2 = 1e-3\n";
  ShaftModelOf one(steel_shaft(discs));
  ShaftModelOf three("[[shaft]]\nname = \"shaft\"\n" + discs +
                     "[[shaft.section]]\nfrom_mm = 0\nto_mm = 90\ndiameter_mm = 24\n"
                     "[[shaft.section]]\nfrom_mm = 90\nto_mm = 210.7\ndiameter_mm = 24\n"
                     "[[shaft.section]]\nfrom_mm = 210.7\nto_mm = 330\ndiameter_mm = 24\n");
  const Eigen::VectorXd a = frequencies(one.system(), 6), b = frequencies(three.system(), 6);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-7 * a.maxCoeff());
  // A cantilever of two sections: flexibility by Castigliano's theorem.
  const ShaftMaterial steel;
  const ShaftSections stepped({{0.0, 0.1, 0.03, 0.01}, {0.1, 0.25, 0.02, 0.0}}, steel);
  const ShaftFlexibility found = stepped.flexibility(0.0, 0.25);
  const double EI1 =
                   steel.youngs * std::numbers::pi / 64.0 * (std::pow(0.03, 4) - std::pow(0.01, 4)),
               EI2 = steel.youngs * std::numbers::pi / 64.0 * std::pow(0.02, 4);
  EXPECT_NEAR(found.bending(1, 1), 0.1 / EI1 + 0.15 / EI2, 1e-12 * found.bending(1, 1));
  EXPECT_NEAR(found.bending(0, 1), 0.1 * 0.2 / EI1 + 0.15 * 0.075 / EI2,
              1e-12 * found.bending(0, 1));
}

}  // namespace
}  // namespace clatter::dynamics
