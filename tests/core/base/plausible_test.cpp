// SPDX-License-Identifier: GPL-3.0-or-later
// Values in a wrong unit are reported with a guess; plausible values give no warning.
#include <gtest/gtest.h>

#include "core/base/plausible.hpp"

namespace clatter {
namespace {

TEST(Plausible, EngineMaterialsGiveNoWarning) {
  struct {
    const char* name;
    double E, rho;
  } const known[] = {
      {"steel", 210e9, 7850},    {"cast iron", 110e9, 7200}, {"aluminium", 70e9, 2700},
      {"magnesium", 45e9, 1740}, {"lead", 16e9, 11340},      {"tungsten", 411e9, 19300},
      {"rubber", 1e6, 1100},     {"PA66-GF30", 9e9, 1360},   {"damping foam", 4e5, 30},
      {"ceramic", 380e9, 3900},  {"diamond", 1.2e12, 3500}};
  for (const auto& material : known) {
    EXPECT_EQ(density_warning(material.rho), "") << material.name;
    EXPECT_EQ(modulus_warning(material.E, material.rho), "") << material.name;
  }
  EXPECT_EQ(poisson_warning(0.4999), "");
  for (const double length : {0.003, 0.02, 1.2, 25.0}) EXPECT_EQ(length_warning(length), "");
}

TEST(Plausible, DensitiesInOtherUnitsAreGuessed) {
  EXPECT_EQ(density_warning(7.85e-9),
            "density 7.85e-09 kg/m3: did you mean 7850 (7.85e-09 t/mm3)?");
  EXPECT_EQ(density_warning(7.85e-6),
            "density 7.85e-06 kg/m3: did you mean 7850 (7.85e-06 kg/mm3)?");
  EXPECT_EQ(density_warning(7.85), "density 7.85 kg/m3: did you mean 7850 (7.85 g/cm3)?");
  EXPECT_NE(density_warning(0.284).find("lb/in3"), std::string::npos);
  EXPECT_NE(density_warning(7.35e-4).find("lbf s2/in4"), std::string::npos);
  EXPECT_EQ(density_warning(1e5), "density 100000 kg/m3");  // no unit makes it plausible
}

TEST(Plausible, ModuliInOtherUnitsAreGuessed) {
  EXPECT_EQ(modulus_warning(210000, 7850),
            "Young's modulus 210000 Pa: did you mean 2.1e+11 (210000 MPa)?");
  EXPECT_EQ(modulus_warning(210, 7850), "Young's modulus 210 Pa: did you mean 2.1e+11 (210 GPa)?");
  EXPECT_NE(modulus_warning(2.1e14, 7850).find("2.1e+11 (MPa, not GPa)"), std::string::npos);
  // 3e7 Pa is plausible for rubber, but not for steel: probably psi.
  EXPECT_EQ(modulus_warning(3e7, 1100), "");
  EXPECT_EQ(
      modulus_warning(3e7, 7850),
      "Young's modulus 3e+07 Pa with density 7850 kg/m3: did you mean 2.06843e+11 (3e+07 psi)?");
}

TEST(Plausible, LengthsAndFrequencies) {
  EXPECT_EQ(length_warning(60.0), "the part is 60 m long: did you mean 0.06 (60 mm)?");
  EXPECT_EQ(length_warning(60e-6), "the part is 6e-05 m long: did you mean 0.06 (m, not mm)?");
  EXPECT_EQ(first_frequency_warning(800.0, 0.6), "");
  EXPECT_EQ(first_frequency_warning(0.08, 3.0), "");  // a strip of 1 mm
  // Steel with E in MPa and rho in kg/m3, lengths in mm read as metres.
  EXPECT_NE(first_frequency_warning(1e-5, 300.0), "");
  EXPECT_NE(first_frequency_warning(5e7, 0.01).find("one system of units"), std::string::npos);
}

}  // namespace
}  // namespace clatter
