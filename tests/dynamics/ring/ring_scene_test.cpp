// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with piston rings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>

#include "dynamics/film/piston_liner.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char* kShort =
    "[time]\ncycles = 1\n[accuracy]\ntolerance = 1e-3\n[contact]\ncavitation = false\n";

/// A compression and an oil ring; `boundary` and `groove` are their coefficients.
std::string rings(double boundary, double groove) {
  return fmt::format(R"(
[[contact.ring]]
height_mm = 50
face_radius_mm = 20
tangential_force_n = 20
width_mm = 2.5
thickness_mm = 4
gas_share = 1
mass_g = 20
friction_coefficient = {0}
groove_coefficient = {1}
[[contact.ring]]
height_mm = 40
face_radius_mm = 10
load_n_mm = 0.6
width_mm = 3
thickness_mm = 3
friction_coefficient = {0}
groove_coefficient = {1}
)",
                     boundary, groove);
}

class Rings : public testing::SlapScenes {
 protected:
  std::vector<double> column(const H5File& file, const std::string& name) {
    return file.read_doubles("history/" + name);
  }
};

TEST_F(Rings, WithoutCoefficientsAreOffToTheBit) {
  const H5File plain = recorded(scene(kShort), "plain");
  const H5File off = recorded(scene(kShort + rings(0.0, 0.0)), "off");
  for (const char* what : {"bodies/piston/q", "bodies/piston/a"})
    EXPECT_EQ(plain.read_rows(what), off.read_rows(what)) << what;
}

TEST_F(Rings, LoseWhatTheyTakeFromTheStroke) {
  const H5File file = recorded(scene(kShort + rings(0.1, 0.08)), "rings");
  std::printf("energy residue %.1e\n", result_.energy_residue);
  EXPECT_LT(result_.energy_residue, 1e-4);
  const auto total = column(file, "ring_friction_force"),
             power = column(file, "ring_friction_power"), top = column(file, "ring_1_friction"),
             oil = column(file, "ring_2_friction"), groove = column(file, "ring_groove_power"),
             time = column(file, "time");
  double work = 0.0;
  for (size_t k = 1; k < time.size(); ++k) {
    EXPECT_NEAR(total[k], top[k] + oil[k], 1e-12 * std::abs(top[k]) + 1e-12);
    EXPECT_GE(power[k], 0.0);
    EXPECT_GE(groove[k], 0.0);
    work += 0.5 * (power[k] + power[k - 1]) * (time[k] - time[k - 1]);
  }
  const double displaced = std::numbers::pi / 4.0 * 0.107 * 0.107 * 0.130;
  std::printf("friction mean effective pressure of the rings %.3f bar\n", work / displaced * 1e-5);
  EXPECT_GT(work / displaced, 0.05e5);
  EXPECT_LT(work / displaced, 0.8e5);
}

TEST_F(Rings, GroovesHoldThePistonWhileGasPressesTheRings) {
  // From 0 to 30 deg after firing TDC the dry piston changes sides; with this coefficient the sides
  // of the top ring carry more than the side force, and the groove stays where it was.
  const std::string dry =
      "[time]\ncycles = 1\n[accuracy]\ntolerance = 1e-3\n[contact]\nlubrication = \"none\"\n";
  const auto range = [&](double coefficient, const char* name) {
    const H5File file = recorded(scene(dry + rings(0.1, coefficient)), name);
    const auto lateral = column(file, "piston_lateral"), tilt = column(file, "piston_tilt"),
               time = column(file, "time");
    double low = 1.0, high = -1.0;
    for (size_t k = 0; k < time.size(); ++k) {
      const double angle = 2000.0 * 6.0 * time[k];  // firing TDC is at 0
      if (angle < 0.0 || angle > 30.0) continue;
      const double at_ring = lateral[k] - 50e-3 * tilt[k];
      low = std::min(low, at_ring);
      high = std::max(high, at_ring);
    }
    return high - low;
  };
  const double free = range(0.0, "free"), held = range(1.0, "held");
  std::printf("lateral motion of the groove: free %.2e, held %.2e m\n", free, held);
  EXPECT_GT(free, 5e-6);
  EXPECT_LT(held, 0.2 * free);
}

TEST_F(Rings, GivenOnceServeFrictionAndTheLayerOnTheLiner) {
  const Scene described = scene("[contact.liner_oil]\n" + rings(0.1, 0.0));
  const auto model = build_model(described, load_bodies(described));
  const CylinderComponent& cylinder = testing::cylinder_of(*model);
  const film::LinerLayerOptions& layer = *cylinder.contact()->options().liner_layer;
  ASSERT_EQ(layer.rings.size(), 2U);
  EXPECT_DOUBLE_EQ(layer.rings[0].load, 20.0 / 53.5e-3);
  EXPECT_DOUBLE_EQ(layer.rings[1].load, 600.0);
  EXPECT_FALSE(layer.rings[1].gas_load);
  const double gas = layer.rings[0].gas_load(0.0) / 2.5e-3;  // at firing TDC
  EXPECT_GT(gas, 20e5);
  EXPECT_LT(gas, 80e5);
  EXPECT_DOUBLE_EQ(film::ring_layer(layer.rings[1], 0.01, 4.0, 1400.0),
                   1.5 * 0.01 * 4.0 * 10e-3 / 2000.0);
}

TEST_F(Rings, AreRefusedByWhatIsWrong) {
  const std::string ring = "[[contact.ring]]\nheight_mm = 50\nface_radius_mm = 20\n";
  test::expect_parts(refusal(ring), {"contact.ring[0].load_n_mm"});
  test::expect_parts(refusal(ring + "load_n_mm = 1\ntangential_force_n = 20\n"),
                     {"tangential_force_n: load_n_mm and tangential_force_n exclude each other"});
  test::expect_parts(refusal(ring + "load_n_mm = 1\ngas_share = 0.5\n"), {"width_mm"});
  test::expect_parts(refusal(ring + "load_n_mm = 1\ngas_share = 1.5\n"),
                     {"gas_share: found 1.5, expected"});
  test::expect_parts(refusal(ring + "load_n_mm = 1\n" + ring + "load_n_mm = 1\n"),
                     {"ring[1].height_mm: found 50 after 50, expected the rings from the highest"});
  const std::string lower = "[[contact.ring]]\nheight_mm = 40\nface_radius_mm = 20\n";
  test::expect_parts(
      refusal(ring + "load_n_mm = 1\n" + lower + "load_n_mm = 1\nwidth_mm = 2\ngas_share = 0.2\n"),
      {"ring[1].gas_share: found 0.2 below a ring with 0"});
  test::expect_parts(refusal(lower + "load_n_mm = 1\nthickness_mm = 60\n"),
                     {"thickness_mm: found 60, expected below the bore's radius, 53.5"});
  test::expect_parts(
      refusal("[[contact.ring]]\nheight_mm = 20\nface_radius_mm = 20\nload_n_mm = 1\n"),
      {"height_mm: found 20, expected above skirt_top_mm, 25"});
  test::expect_parts(refusal("[contact.liner_oil]\n[[contact.liner_oil.ring]]\nheight_mm = 50\n"),
                     {"contact.liner_oil.ring: unknown key"});
}

struct NumberKey {
  const char* key;
  bool zero;  // is allowed
};
TEST_F(Rings, TheirNumbersAreRefusedOutsideTheirRanges) {
  const NumberKey keys[] = {{"face_radius_mm", false}, {"load_n_mm", false},
                            {"least_um", true},        {"width_mm", false},
                            {"thickness_mm", false},   {"mass_g", true},
                            {"gas_share", true},       {"friction_coefficient", true},
                            {"roughness_um", false},   {"groove_coefficient", true}};
  for (const NumberKey& one : keys) {
    std::string ring = "[[contact.ring]]\nheight_mm = 50\n";
    for (const char* needed : {"face_radius_mm", "load_n_mm", "width_mm"})
      if (one.key != std::string(needed)) ring += fmt::format("{} = 1\n", needed);
    for (const double value : {-1.0, 1e9, 0.0}) {
      const std::string found = refusal(ring + fmt::format("{} = {:g}\n", one.key, value));
      if (value == 0.0 && one.zero) {
        EXPECT_EQ(found, "accepted") << one.key;
      } else {
        test::expect_parts(found, {fmt::format("contact.ring[0].{}: found", one.key)});
      }
    }
  }
}

}  // namespace
}  // namespace clatter::dynamics
