// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with the film around the entire skirt, grooves and windows.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dynamics/film/piston_liner.hpp"
#include "dynamics/run/run_file.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic_engine.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char* kRecesses = R"(
[time]
cycles = 1
film_every_deg = 90
[accuracy]
tolerance = 1e-2
[contact]
span = "whole"
cells_around = 16
[contact.liner_oil]
splash_um_s = 400
splash_thickness_um = 8
[[contact.recess]]
kind = "window"
height_mm = [-45, -5]
angle_deg = [60, 120]
[[contact.recess]]
kind = "window"
height_mm = [-45, -5]
angle_deg = [240, 300]
[[contact.recess]]
height_mm = [0, 12]
angle_deg = [-40, 40]
pressure_bar = 0.5
[[contact.recess]]
on = "liner"
height_mm = [200, 213]
fill = 0.1
)";

class ContactRecess : public testing::SlapScenes {};

TEST_F(ContactRecess, IsReadInSiUnitsAndListedAmongTheEffects) {
  const auto on = [&](const std::string& changes) {
    const Scene described = scene(changes);
    const auto model = build_model(described, load_bodies(described));
    std::string names;
    for (const auto& effect : model->effects.effects())
      if (effect.on && (effect.name.starts_with("gap around") || effect.name.starts_with("groove")))
        names += effect.name + "; ";
    return names;
  };
  EXPECT_EQ(on(""), "");
  EXPECT_EQ(on("[contact]\nspan = \"whole\"\ncells_around = 8\n"), "gap around the entire skirt; ");
  EXPECT_EQ(on(kRecesses), "gap around the entire skirt; grooves and windows; ");
  const Scene described = scene(kRecesses);
  const auto model = build_model(described, load_bodies(described));
  const film::PistonLinerOptions& options = testing::cylinder_of(*model).contact()->options();
  ASSERT_EQ(options.recesses.size(), 4U);
  EXPECT_EQ(options.recesses[0].kind, film::Recess::Kind::kWindow);
  EXPECT_NEAR(options.recesses[0].bottom, -0.045, 1e-15);
  EXPECT_NEAR(options.recesses[1].angle_begin, 4.0 / 3.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(options.recesses[1].angle_span, std::numbers::pi / 3.0, 1e-12);
  EXPECT_NEAR(options.recesses[2].pressure, 5e4, 1e-9);
  EXPECT_EQ(options.recesses[2].fill, 1.0);
  EXPECT_TRUE(options.recesses[3].on_liner);
  EXPECT_NEAR(options.recesses[3].angle_span, 2.0 * std::numbers::pi, 1e-15);
  EXPECT_EQ(options.recesses[3].fill, 0.1);
}

TEST_F(ContactRecess, ARunAccountsForItsOilAndItsEnergy) {
  RunResult result;
  const H5File file = testing::complete_file(scene(kRecesses), folder_ / "recess.run.h5", result);
  const RunCertificate proved = run_certificate(result);
  std::printf("    oil missing %.1e, energy %.1e\n", proved.oil_residue.value(),
              proved.energy_residue);
  EXPECT_LT(proved.oil_residue.value(), 1e-10);
  EXPECT_LT(proved.energy_residue, 1e-3);  // the tolerance of the steps, 1e-2
  const auto grooves = file.read_doubles("history/oil_into_grooves");
  EXPECT_NE(grooves.back(), grooves.front());
  const std::vector<std::string> groups = file.list("film");
  EXPECT_EQ(std::count(groups.begin(), groups.end(), "thrust"), 0);
  const std::vector<std::string> fields = file.list("film/skirt");
  for (const char* name : {"pressure", "fill", "gap", "angle_deg", "axial", "liner_oil"})
    EXPECT_EQ(std::count(fields.begin(), fields.end(), name), 1) << name;
  const auto friction = file.read_doubles("history/friction_force");
  EXPECT_TRUE(
      std::all_of(friction.begin(), friction.end(), [](double f) { return std::isfinite(f); }));
}

}  // namespace
}  // namespace clatter::dynamics
