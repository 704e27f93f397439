// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with the oil's laws, the layer on the liner and data of the asperities.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "dynamics/film/piston_liner.hpp"
#include "dynamics/run/run_file.hpp"
#include "dynamics/run/run_size.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic_engine.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLayer = R"(
[accuracy]
tolerance = 1e-2
[contact.liner_oil]
splash_um_s = 400
splash_thickness_um = 8
most_um = 30
[[contact.ring]]
height_mm = 40
face_radius_mm = 20
load_n_mm = 1.5
least_um = 0.3
)";
constexpr const char* kWalther =
    "[contact.oil]\nlaw = \"walther\"\nwalther_temperature_c = [40, 100]\n"
    "walther_mm2_s = [105, 14.2]\ndensity_kg_m3 = 860\ntemperature_c = 120\n";

class ContactOil : public testing::SlapScenes {
 protected:
  film::PistonLinerOptions options_of(const std::string& changes) {
    const Scene described = scene(changes);
    const auto model = build_model(described, load_bodies(described));
    return testing::cylinder_of(*model).contact()->options();
  }
  std::string on(const std::string& changes) {
    const Scene described = scene(changes);
    const auto model = build_model(described, load_bodies(described));
    std::string names;
    for (const auto& effect : model->effects.effects())
      if (effect.on && (effect.name.starts_with("viscosity") || effect.name.starts_with("oil l") ||
                        effect.name.starts_with("friction f")))
        names += effect.name + "; ";
    return names;
  }
};

TEST_F(ContactOil, IsAnEffectOnlyWhereItIsRequested) {
  EXPECT_EQ(on(""), "");
  EXPECT_EQ(on(kLayer), "oil layer on the liner; ");
  EXPECT_EQ(on(std::string("[contact]\nlubrication = \"none\"\n") + kWalther), "");
  EXPECT_EQ(on(std::string("[contact]\nflow_factors = true\nfriction_factors = true\n") + kWalther +
               "pressure_coefficient_1_gpa = 20\nshear_rate_1_s = 1e6\nshear_ratio = 0.5\n"),
            "viscosity over temperature; viscosity over pressure; viscosity over shear rate; "
            "friction factors; ");
  const film::PistonLinerOptions plain = options_of("");
  EXPECT_FALSE(plain.liner_layer.has_value());
  EXPECT_FALSE(plain.oil.by_temperature());
}

TEST_F(ContactOil, IsReadInSiUnits) {
  const film::PistonLinerOptions warm = options_of(kWalther);
  // 120 degrees by hand: nu + 0.7 = 10^(10^0.02035), 9.27 mm2/s.
  EXPECT_NEAR(warm.viscosity, 860.0 * 9.27e-6, 860.0 * 0.15e-6);
  const film::PistonLinerOptions layer = options_of(kLayer);
  ASSERT_TRUE(layer.liner_layer.has_value());
  EXPECT_DOUBLE_EQ(layer.liner_layer->splash, 4e-4);
  EXPECT_DOUBLE_EQ(layer.liner_layer->rings.at(0).load, 1500.0);
  // Below the skirt at bottom dead centre (145 mm) and above the ring at top dead centre (275 mm).
  EXPECT_NEAR(layer.liner_layer->bottom, 0.145 - 0.045 - 0.010, 1e-12);
  EXPECT_NEAR(layer.liner_layer->top, 0.275 + 0.040 + 0.010, 1e-12);
  const auto asperity = [&](const std::string& text) {
    return options_of("[contact]\n" + text).asperity;
  };
  const auto summits =
      asperity("summit_roughness_um = 0.5\nsummit_density_1_mm2 = 8000\nsummit_radius_um = 50\n");
  EXPECT_NEAR(summits.factor, 4.7390751 * 0.04 * 0.1, 1e-9);  // eq. (11)
  EXPECT_EQ(summits.law, film::AsperityOptions::Law::kExact);
  EXPECT_EQ(asperity("summit_roughness_um = 0.5\nsummit_density_1_mm2 = 8000\n"
                     "summit_radius_um = 50\nasperity_factor = 1e-3\n")
                .factor,
            summits.factor);  // as in a scene whose base has K
  EXPECT_EQ(asperity("").law, film::AsperityOptions::Law::kFit);
}

// Eq. (11) with data of summits and eq. (12) with the K that follows from them are one contact.
TEST_F(ContactOil, BothEquationsOfTheAsperitiesAgreeWhenKMatches) {
  const std::string dry = "[contact]\nlubrication = \"none\"\nclearance_um = 5\n";
  const RowMatrix eleven =
      recorded(scene(dry + "summit_roughness_um = 0.5\nsummit_density_1_mm2 = 8000\n"
                           "summit_radius_um = 50\n[time]\ncycles = 1\n"),
               "eleven")
          .read_rows("bodies/piston/q");
  const double k = film::contact_factor(8e9, 50e-6, 0.5e-6);
  const RowMatrix twelve =
      recorded(scene(fmt::format("{}summit_roughness_um = 0.5\nasperity_law = \"exact\"\n"
                                 "asperity_factor = {:.17g}\n[time]\ncycles = 1\n",
                                 dry, k)),
               "twelve")
          .read_rows("bodies/piston/q");
  ASSERT_EQ(eleven.rows(), twelve.rows());
  EXPECT_LT((eleven - twelve).norm(), 1e-9 * eleven.norm());
}

TEST_F(ContactOil, ARunAccountsForItsOilAndResumesBitByBit) {
  const Scene described = scene(std::string("[time]\ncycles = 2\n") + kLayer);
  const LoadedBodies bodies = load_bodies(described);
  RunControl control;
  control.output = folder_ / "1.run.h5";
  RunResult entire = simulate(described, bodies, control);
  ASSERT_TRUE(entire.complete) << entire.failure;
  const RunCertificate proved = run_certificate(entire);
  std::printf("    oil missing %.1e of %.3g mm3 moved\n", proved.oil_residue.value(),
              1e9 * proved.oil_moved.value());
  EXPECT_LT(proved.oil_residue.value(), 1e-10);
  EXPECT_GT(proved.oil_moved.value(), 1e-8);
  const fs::path point = checkpoint_path(control.output);
  control.output = folder_ / "2.run.h5";
  fs::copy_file(point, checkpoint_path(control.output));
  control.resume_from = read_checkpoint(point, fingerprint(described));
  ASSERT_TRUE(control.resume_from.has_value());
  RunResult again = simulate(described, bodies, control);
  EXPECT_EQ(proved, run_certificate(again));
  const H5File a = testing::finished_file(described, bodies, entire);
  const H5File b = testing::finished_file(described, bodies, again);
  for (const std::string& name : a.list("history"))
    EXPECT_EQ(a.read_doubles("history/" + name), b.read_doubles("history/" + name)) << name;
  const auto number = [&](const char* name) {
    return a.read_doubles(std::string("history/oil_") + name);
  };
  // What the columns say balances as well: from the first to the last row of the reported cycle.
  const auto change = [&](const char* name) { return number(name).back() - number(name).front(); };
  EXPECT_NEAR(change("in_gap") + change("on_liner"),
              change("supplied") - change("scraped") - change("dripped") - change("over_sides") -
                  change("over_ends"),
              1e-10 * proved.oil_moved.value());
  EXPECT_GT(change("supplied"), 0.0);
  EXPECT_GT(change("scraped"), 0.0);
  const std::vector<std::string> fields = a.list("film/thrust");
  for (const char* name : {"liner_height", "liner_oil"})
    EXPECT_EQ(std::count(fields.begin(), fields.end(), name), 1) << name;
}

TEST_F(ContactOil, AStartFromAnotherRunTakesItsLayer) {
  const H5File two =
      recorded(scene(std::string("[time]\nsettle_to = 1e-9\ncycles = 2\n") + kLayer), "two");
  const H5File one = recorded(scene(std::string("[time]\ncycles = 1\n") + kLayer), "one");
  const H5File on = recorded(
      scene(std::string("[time]\ncycles = 1\nstart_from = \"one.run.h5\"\n") + kLayer), "on");
  for (const char* name : {"history/oil_on_liner", "history/oil_in_gap", "history/oil_scraped"})
    EXPECT_EQ(on.read_doubles(name), two.read_doubles(name)) << name;
  EXPECT_NE(one.read_doubles("history/oil_on_liner"), two.read_doubles("history/oil_on_liner"));
  test::expect_parts(
      test::refusal_of(
          [&] { recorded(scene("[time]\ncycles = 1\nstart_from = \"one.run.h5\"\n"), "without"); }),
      {"one.run.h5: piston_liner: the saved film state has"});
}

// Thin oil on the liner is what the supply makes it: without splash the rings take it.
TEST_F(ContactOil, TheFillIsTheOutcomeOfTheSupply) {
  const auto fill = [&](const char* name, const std::string& splash) {
    const auto values =
        recorded(
            scene(std::string(
                      "[time]\ncycles = 1\n[accuracy]\ntolerance = 1e-2\n[contact.liner_oil]\n") +
                  splash +
                  "[[contact.ring]]\nheight_mm = 40\nface_radius_mm = 20\n"
                  "load_n_mm = 10\nleast_um = 0.2\n"),
            name)
            .read_doubles("history/oil_on_liner");
    return values.back();
  };
  const double much = fill("much", "splash_um_s = 2000\nsplash_thickness_um = 20\n"),
               none = fill("none", "");
  EXPECT_GT(much, 2.0 * none);
}

TEST_F(ContactOil, HardN10_ItsNumbersAreRefusedOutsideTheirRanges) {
  const std::string ring = "[[contact.ring]]\n",
                    rest = "height_mm = 40\nface_radius_mm = 20\nload_n_mm = 1\n",
                    vogel = "[contact.oil]\nlaw = \"vogel\"\n";
  struct Key {
    std::string key, text;
    bool zero = false;
  };
  const std::vector<Key> keys{
      {"contact.liner_oil.cell_mm", "[contact.liner_oil]\ncell_mm = {}\n", true},
      {"contact.liner_oil.splash_um_s",
       "[contact.liner_oil]\nsplash_thickness_um = 5\nsplash_um_s = {}\n", true},
      {"contact.liner_oil.splash_thickness_um",
       "[contact.liner_oil]\nsplash_um_s = 5\nsplash_thickness_um = {}\n"},
      {"contact.liner_oil.most_um", "[contact.liner_oil]\nmost_um = {}\n"},
      {"contact.ring[0].height_mm", ring + "face_radius_mm = 20\nload_n_mm = 1\nheight_mm = {}\n"},
      {"contact.ring[0].face_radius_mm",
       ring + "height_mm = 40\nload_n_mm = 1\nface_radius_mm = {}\n"},
      {"contact.ring[0].load_n_mm", ring + "height_mm = 40\nface_radius_mm = 20\nload_n_mm = {}\n"},
      {"contact.ring[0].least_um", ring + rest + "least_um = {}\n", true},
      {"contact.oil.vogel_a_pa_s",
       vogel + "vogel_b_k = 1000\nvogel_c_c = -90\ntemperature_c = 90\nvogel_a_pa_s = {}\n"},
      {"contact.oil.vogel_b_k",
       vogel + "vogel_a_pa_s = 5e-5\nvogel_c_c = -90\ntemperature_c = 90\nvogel_b_k = {}\n", true},
      {"contact.oil.vogel_c_c",
       vogel + "vogel_a_pa_s = 5e-5\nvogel_b_k = 1000\ntemperature_c = 90\nvogel_c_c = {}\n", true},
      {"contact.oil.temperature_c",
       vogel + "vogel_a_pa_s = 5e-5\nvogel_b_k = 1000\nvogel_c_c = -90\ntemperature_c = {}\n",
       true},
      {"contact.oil.pressure_coefficient_1_gpa", "[contact.oil]\npressure_coefficient_1_gpa = {}\n",
       true},
      {"contact.oil.shear_rate_1_s", "[contact.oil]\nshear_ratio = 0.5\nshear_rate_1_s = {}\n"},
      {"contact.oil.shear_ratio", "[contact.oil]\nshear_rate_1_s = 1e6\nshear_ratio = {}\n", true},
      {"contact.oil.shear_exponent",
       "[contact.oil]\nshear_rate_1_s = 1e6\nshear_ratio = 0.5\nshear_exponent = {}\n"},
      {"contact.summit_density_1_mm2",
       "[contact]\nsummit_radius_um = 20\nsummit_density_1_mm2 = {}\n"},
      {"contact.summit_radius_um",
       "[contact]\nsummit_density_1_mm2 = 1000\nsummit_radius_um = {}\n"}};
  for (const Key& key : keys) {
    std::vector<std::string> values{"nan", "inf", "1e30", "-1e30", "\"1\"", "true", "[]"};
    if (!key.zero) values.emplace_back("0");
    if (key.key == "contact.oil.temperature_c") std::erase(values, std::string("[]"));  // a list
    for (const std::string& value : values)
      test::expect_parts(refusal(fmt::format(fmt::runtime(key.text), value)),
                         {"changed.run.toml:", ": " + key.key + ": found ", "expected "});
  }
}

TEST_F(ContactOil, ThePredictedSizeHasTheLayer) {
  const auto cells = [&](const std::string& changes) {
    const Scene described = scene(changes);
    const auto bodies = load_bodies(described);
    return predict_size(described, bodies).film_bytes;
  };
  // 36 cells of each pad have four fields; rows of 70 mm / 6 from 90 to 325 mm are 21, of one
  // field.
  EXPECT_NEAR(cells(kLayer) / cells(""), 1.0 + 0.25 * 21.0 / 6.0, 0.01);
}

TEST_F(ContactOil, AFileOverTheLayerTurnsItOffOrItsSplash) {
  std::filesystem::copy_file(folder_ / "slap.run.toml", folder_ / "engine.run.toml");
  std::ofstream(folder_ / "slap.run.toml") << "base = \"engine.run.toml\"\n" << kLayer;
  EXPECT_EQ(on("[contact.liner_oil]\nsplash_um_s = 0\n"), "oil layer on the liner; ");
  EXPECT_EQ(on("[contact]\nlubrication = \"none\"\n"), "");
  EXPECT_EQ(on("[contact]\ncavitation = false\n"), "");
}

TEST_F(ContactOil, ContradictionsNameTheirKey) {
  const auto expect = [&](const std::string& changes, const std::string& said) {
    EXPECT_NE(refusal(changes).find(said), std::string::npos) << changes << refusal(changes);
  };
  expect("[contact]\nfriction_factors = true\n",
         "contact.friction_factors: needs flow_factors = true");
  expect("[contact]\nsupply_pressure_bar = 1\n[contact.liner_oil]\n",
         "contact.supply_pressure_bar: supply_pressure_bar and liner_oil exclude each other");
  expect("[contact]\nsupply_fill = 0.5\n[contact.liner_oil]\n",
         "contact.supply_fill: supply_fill and liner_oil exclude each other");
  expect("[contact]\nlubrication = \"none\"\n[contact.liner_oil]\n",
         "contact.liner_oil: needs lubrication = \"film\"");
  expect("[contact.liner_oil]\ncell_mm = 1e-9\n",
         "contact.liner_oil.cell_mm: found 1e-09, expected 0 (a row of the pad) or at least 0.01");
  expect("[contact.liner_oil]\nwiper = 1\n", "contact.liner_oil.wiper");
  expect(std::string(kWalther) + "height_mm = [1, 2]\n",
         "contact.oil.height_mm: found 2 heights for 1 temperatures");
  expect(
      "[contact.oil]\nlaw = \"walther\"\nwalther_temperature_c = [100, 40]\n"
      "walther_mm2_s = [105, 14.2]\ndensity_kg_m3 = 860\ntemperature_c = 120\n",
      "contact.oil.walther_temperature_c: found 40 after 100, expected ascending");
}

}  // namespace
}  // namespace clatter::dynamics
