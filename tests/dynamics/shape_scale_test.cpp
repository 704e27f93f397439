// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of bore and skirt that a factor scales over the cycle, as scenes.
#include "dynamics/cylinder/shape_scale.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "dynamics/cylinder/cylinder_loads.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

const std::string kFullFilm =
    "[time]\ncycles = 1\n[accuracy]\ntolerance = 1e-3\n[contact]\ncavitation = false\n";

/// A conical bore or skirt.
std::string shape(const std::string& kind, const std::string& scale) {
  return "[[contact." + kind + "]]\norder = 0\nheight_mm = [-40, 300]\namplitude_um = [2, 6]\n" +
         scale;
}

class ScaledShape : public testing::SlapScenes {
 protected:
  void SetUp() override {
    SlapScenes::SetUp();
    std::ofstream one(folder_ / "one.csv"), wave(folder_ / "wave.csv");
    one << "crank_angle [deg], scale [1]\n";
    wave << "crank_angle [deg], scale [1]\n";
    for (int k = -360; k < 360; k += 5) {
      one << k << ", 1\n";
      wave << k << ", " << std::cos(k * std::numbers::pi / 180.0) << "\n";
    }
  }
};

TEST_F(ScaledShape, OfAConstantTableIsTheShape) {
  for (const char* kind : {"bore_shape", "skirt_shape"}) {
    const RowMatrix plain =
        recorded(scene(kFullFilm + shape(kind, "")), "plain").read_rows("bodies/piston/q");
    const RowMatrix scaled =
        recorded(scene(kFullFilm + shape(kind, "scale_table = \"one.csv\"\n")), "scaled")
            .read_rows("bodies/piston/q");
    EXPECT_LT((scaled - plain).cwiseAbs().maxCoeff(), 1e-9 * plain.cwiseAbs().maxCoeff()) << kind;
  }
}

TEST_F(ScaledShape, WorksOnTheFilmWithinTheBalance) {
  const RowMatrix plain = recorded(scene(kFullFilm), "plain").read_rows("bodies/piston/q");
  for (const char* kind : {"bore_shape", "skirt_shape"}) {
    for (const char* scale : {"scale_table = \"wave.csv\"\n", "scale = \"gas\"\nat_bar = 40\n"}) {
      const H5File file = recorded(scene(kFullFilm + shape(kind, scale)), "scaled");
      std::printf("%s %s: residue %.1e\n", kind, scale, result_.energy_residue);
      EXPECT_LT(result_.energy_residue, 1e-4);
      EXPECT_GT((file.read_rows("bodies/piston/q") - plain).cwiseAbs().maxCoeff(),
                1e-3 * plain.cwiseAbs().maxCoeff());
    }
  }
}

TEST_F(ScaledShape, OfGasIsItsGaugePressureOverThatOfTheShape) {
  const Scene described = scene(shape("bore_shape", "scale = \"gas\"\nat_bar = 20\n"));
  const auto model = build_model(described, load_bodies(described));
  const CylinderComponent& cylinder = testing::cylinder_of(*model);
  const auto& scaled = cylinder.contact()->options().scaled_bore;
  ASSERT_EQ(scaled.size(), 1U);
  const Spline gas = *gas_pressure(cylinder.spec());
  for (const double degrees : {-300.0, -20.0, 0.0, 15.0, 200.0}) {
    const double angle = degrees * std::numbers::pi / 180.0, time = cylinder.crank().time(angle);
    const film::ScaleState at = scaled[0].scale(time);
    EXPECT_NEAR(at.value, (gas(angle) - 1e5) / 20e5, 1e-9 * (1.0 + at.value));
    const double h = 1e-7;
    EXPECT_NEAR(at.rate,
                (scaled[0].scale(time + h).value - scaled[0].scale(time - h).value) / (2 * h),
                1e-3 * std::abs(at.rate) + 1e-3);
  }
}

TEST_F(ScaledShape, IsRefusedByWhatIsWrong) {
  const auto expect = [&](const std::string& changes, const std::vector<std::string>& parts) {
    test::expect_parts(refusal(changes), parts);
  };
  const std::string gas = "scale = \"gas\"\nat_bar = 160\n";
  expect(shape("bore_shape", gas) + testing::kElasticBlock,
         {"contact.bore_shape[0].scale: found \"gas\" on an elastic block", "model = \"rigid\""});
  expect(shape("bore_shape", "scale = \"gas\"\n"), {"contact.bore_shape[0].at_bar"});
  expect(shape("bore_shape", "scale = \"gas\"\nat_bar = 0\n"), {"at_bar: found 0"});
  expect(shape("skirt_shape", gas + "scale_table = \"one.csv\"\n"),
         {"contact.skirt_shape[0].scale_table: scale_table and scale exclude each other"});
  expect(shape("skirt_shape", "scale = \"heat\"\n"), {"scale: found \"heat\""});
  std::ofstream(folder_ / "unit.csv")
      << "crank_angle [deg], scale [bar]\n-360, 1\n-180, 1\n0, 1\n180, 1\n";
  expect(shape("skirt_shape", "scale_table = \"unit.csv\"\n"),
         {"unit.csv:1: scale is in [Pa], expected a unit of [1]"});
}

}  // namespace
}  // namespace clatter::dynamics
