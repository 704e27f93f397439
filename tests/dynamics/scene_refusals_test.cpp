// SPDX-License-Identifier: GPL-3.0-or-later
// Values that contradict one another, and scenes that describe no machine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

class SceneRefusals : public ::testing::Test {
 protected:
  void SetUp() override { testing::write_slap_scene(folder_); }
  std::string refusal(const std::string& changes) const {
    return testing::scene_refusal(folder_, changes);
  }
  std::filesystem::path folder_ = testing::test_folder();
};

TEST_F(SceneRefusals, NameSpanStepAndBodyOfASceneWithoutEngine) {
  const auto scene = [](const std::string& time, const std::string& name) {
    return "[time]\n" + time + "[[body]]\nname = " + name + "\nrom = \"bar.rom.h5\"\n";
  };
  const auto refused = [&](const std::string& text) {
    std::ofstream(folder_ / "bar.run.toml") << text;
    return test::refusal_of([&] { read_scene(folder_ / "bar.run.toml"); });
  };
  for (const char* end : {"0", "-1", "nan", "inf", "1e30", "1e-30", "\"1\""})
    test::expect_parts(refused(scene(fmt::format("end_s = {}\n", end), "\"bar\"")),
                       {"bar.run.toml:2: time.end_s: found ", "expected "});
  for (const char* step : {"0", "-1", "nan", "inf", "1e30", "1e-30", "1e-6", "2e6"})
    test::expect_parts(
        refused(scene(fmt::format("end_s = 1.0\noutput_step_us = {}\n", step), "\"bar\"")),
        {"bar.run.toml:3: time.output_step_us: found ", "expected "});
  test::expect_parts(refused(scene("end_s = 1e6\n", "\"bar\"")),
                     {"time.output_step_us: found 20 (default), expected at least 1e+03"});
  for (const char* name : {"\"\"", "\"a/b\"", "\".\"", "1"})
    test::expect_parts(refused(scene("end_s = 1.0\n", name)), {"body[0].name: found "});
  EXPECT_EQ(refused(scene("end_s = 1.0\noutput_step_us = 1.0\n", "\"bar\"")), "accepted");
}

TEST_F(SceneRefusals, NameTheKeyOfAContradiction) {
  const auto expect = [&](const std::string& changes, const std::string& said) {
    EXPECT_NE(refusal(changes).find(said), std::string::npos) << changes << refusal(changes);
  };
  expect(
      "[contact]\nskirt_top_mm = -50\n",
      "changed.run.toml:3: contact.skirt_top_mm: found -50, expected above skirt_bottom_mm, -45");
  const std::string recess = "[[contact.recess]]\nheight_mm = [-30, 0]\n";
  expect("[[contact.recess]]\nheight_mm = [1]\n",
         "changed.run.toml:3: contact.recess[0].height_mm");
  expect("[[contact.recess]]\nheight_mm = [1, 0]\n",
         "height_mm: found 0 after 1, expected ascending values");
  expect("[[contact.recess]]\nheight_mm = [0, 2e4]\n",
         "height_mm: found 20000, expected a number at least -10000 and at most 10000");
  expect(recess + "angle_deg = [0, 400]\n", "angle_deg: found a span of 400, expected at most 360");
  expect(recess + "pressure_bar = 1\nfill = 0.5\n", "fill: found 0.5 under pressure, expected 1");
  expect(recess + "pressure_bar = -1\n", "pressure_bar: found -1, expected");
  expect(recess + "kind = \"window\"\nfill = 0.5\n",
         "fill: needs kind = \"groove\": a window is a part of the skirt");
  expect(recess + "kind = \"hole\"\n", "contact.recess[0].kind: ");
  expect(recess + "on = \"rod\"\n", "contact.recess[0].on: ");
  expect("[contact]\nspan = \"half\"\n", "changed.run.toml:3: contact.span: ");
  expect("[contact]\nspan = \"whole\"\ncells_around = 6\n",
         "changed.run.toml:4: contact.cells_around: found 6, expected");
  expect("[contact]\nspan = \"whole\"\ncells_around = 45\n",
         "changed.run.toml:4: contact.cells_around: found 45, expected an even number");
  expect("[contact]\nprofile_height_mm = [0, 2, 1]\nprofile_relief_um = [0, 1, 2]\n",
         "changed.run.toml:3: contact.profile_height_mm: found 1 after 2, expected ascending");
  expect("[contact]\nprofile_height_mm = [0, 2]\nprofile_relief_um = [0]\n",
         "changed.run.toml:4: contact.profile_relief_um: found 1 values, expected as many");
  expect("[contact]\nflow_factors = true\npeklenik = 2\n",
         "changed.run.toml:4: contact.peklenik: peklenik: no pressure flow factor for 2, expected");
  expect(
      "[contact]\nflow_factors = true\npiston_roughness_um = 0\nliner_roughness_um = 0\n",
      "changed.run.toml:3: contact.flow_factors: needs a roughness above 0: both walls are smooth");
  expect("[time]\nlargest_step_us = 1\nsmallest_step_us = 2\n",
         "changed.run.toml:4: time.smallest_step_us: found 2, expected less than largest_step_us");
  expect("[rod]\nlength_mm = 64\ncentre_mm = 0\ninertia_kg_m2 = 0.005\n",
         "changed.run.toml:3: rod.length_mm: slider-crank: ");
  expect("[engine]\npin_offset_mm = 150\n",
         "changed.run.toml:3: engine.pin_offset_mm: slider-crank: ");
  expect("[[mount]]\nsets = []\nstiffness_n_m = [1, 1, 1]\n", "mount[0].sets: found none");
  expect("[[mount]]\nsets = [\"mounts\"]\nstiffness_n_m = [0, 0, 0]\n",
         "stiffness_n_m: found 0 everywhere");
  expect("[time]\nfilm_every_deg = 1e-3\n", "time.film_every_deg: found 0.001, expected 0 (no");
}

TEST_F(SceneRefusals, HardN10_GasBelowVacuumIsRefused) {
  std::ofstream(folder_ / "low.csv") << "crank_angle [deg], pressure [bar]\n-360, 1\n-120, -500\n"
                                        "120, 30\n359, 1\n";
  EXPECT_NE(refusal("[gas]\ntable = \"low.csv\"\n")
                .find("low.csv:3: pressure: found -500 bar, expected an absolute pressure from 0"),
            std::string::npos)
      << refusal("[gas]\ntable = \"low.csv\"\n");
}

TEST_F(SceneRefusals, HardN10_ACentredPistonOnAnOffsetPinIsRefused) {
  // 44.5 bar on 8.992e-3 m2, 0.6 mm beside the pin: a moment of 24 N m about the pin, which was
  // missing before.
  const std::string offset = "[engine]\npin_offset_mm = 0.6\n";
  const std::string said = refusal(offset);
  test::expect_parts(said,
                     {"changed.run.toml:3: engine.pin_offset_mm: found 0.6, but the gas load of ",
                      "piston.rom.h5 is 0 mm from the pin, expected -0.6 mm"});
  // With the gas on the bore's axis: M = y F.
  rom::ReducedModel piston = testing::rigid_piston(1.9, 4e-3, 8.992e-3);
  piston.loads["gas"](3) = 0.6e-3 * 8.992e-3;
  testing::write_rom(folder_ / "piston.rom.h5", piston);
  EXPECT_EQ(refusal(offset), "accepted");
  EXPECT_NE(
      refusal("[engine]\npin_offset_mm = -0.6\n").find("is -0.6 mm from the pin, expected 0.6"),
      std::string::npos);
  // The skirt decides where the model has one, also of a piston that is simulated as rigid.
  testing::write_rom(folder_ / "piston.rom.h5", testing::elastic_piston(0.0535, 4, 6));
  EXPECT_NE(refusal(offset).find("but the skirt's axis of "), std::string::npos);
  EXPECT_EQ(refusal(""), "accepted");
}

TEST_F(SceneRefusals, ASetOfSeveralNodesIsNoPointButEachOfItsNodesIsMounted) {
  const std::string block = R"(
[block]
model = "elastic"
liner = "liner_4"
bearings = ["main_4", "main_5"]
[[mount]]
sets = ["mounts"]
stiffness_n_m = [1e5, 1e5, 2e5]
)";
  test::expect_parts(
      refusal(block +
              "[[load]]\nbody = \"block\"\nset = \"mounts\"\ncomponent = \"z\"\nvalue = 1.0\n"),
      {"changed.run.toml:", "load.set: ",
       "set \"mounts\" has 4 displacements along z, expected one"});
  const Scene scene = testing::changed_scene(folder_, block);
  const auto model = build_model(scene, load_bodies(scene));
  int mounted = 0;
  for (int e = 0; e < model->system.elements(); ++e)
    if (model->system.element(e).name() == "mount 1")
      mounted = static_cast<int>(model->system.element(e).coordinates().size());
  EXPECT_EQ(mounted, 12);
}

}  // namespace
}  // namespace clatter::dynamics
