// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of cylinders and of the crankshaft that are off are the limit of the effect going to
// zero.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "tests/dynamics/effects/limit_case.hpp"
#include "tests/dynamics/effects/limit_list.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/dynamics/synthetic.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using testing::LimitCase;
using testing::ShortSteps;

constexpr ShortSteps kAfterTdc{1e-3, 2e-6, 40};  // 12 deg after firing TDC: side force of the gas

/// Keys of a dry skirt that touches the liner.
constexpr const char* kTouching =
    "[time]\nmethod = \"sdirk2\"\n[contact]\nlubrication = \"none\"\nclearance_um = "
    "0.5\nbarrel_top_um = 5\n"
    "barrel_bottom_um = 5\novality_um = 10\nasperity_loss_factor = 0\nsummit_roughness_um = 1\n";
/// Those of one that meets the film of the scene, thinner than the gap.
constexpr const char* kThin = "[contact]\nclearance_um = 12\nasperity_loss_factor = 0\n";
/// Those of one that a full film alone carries.
constexpr const char* kFloating =
    "[contact]\nclearance_um = 12\noil_thickness_um = 1e4\n"
    "asperity_loss_factor = 0\n";

class CylinderLimits : public testing::SlapScenes,
                       public ::testing::WithParamInterface<std::string> {
 protected:
  LimitCase named(const std::string& effect) { return case_of(cases(), effect); }

 private:
  std::function<Scene()> off(const std::string& text) {
    return [this, text] { return scene(text); };
  }
  std::function<Scene(double)> on(std::function<std::string(double)> text) {
    return [this, text = std::move(text)](double strength) { return scene(text(strength)); };
  }
  std::vector<LimitCase> cases();
  Scene with_gas(double strength);
  Scene without_gas();
  Scene with_piston(const std::string& model, double softness);
  std::string base();
};

/// slap.run.toml without its [gas].
std::string CylinderLimits::base() {
  std::ifstream file(folder_ / "slap.run.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::string gas = "[gas]\ntable = \"motored.csv\"\n";
  text.erase(text.find(gas), gas.size());
  return text;
}

Scene CylinderLimits::without_gas() { return testing::scene_of(folder_, base()); }

/// The gas pressure of a wave of `strength` times 40 bar over that of the ambient.
Scene CylinderLimits::with_gas(double strength) {
  std::ofstream table(folder_ / "weak.csv");
  table << "crank_angle [deg], pressure [bar]\n";
  for (int k = -360; k < 360; k += 5)
    table << k << ", "
          << fmt::format("{:.17g}",
                         1.0 + 20.0 * strength * (1.0 + std::cos(k * std::numbers::pi / 180.0)))
          << "\n";
  table.close();
  return testing::scene_of(folder_, base() + "[gas]\ntable = \"weak.csv\"\n");
}

/// A piston whose modes are as many times softer than stiff ones.
Scene CylinderLimits::with_piston(const std::string& model, double softness) {
  rom::ReducedModel piston = testing::elastic_piston(0.0535, 4, 4);
  piston.K_rr /= softness;
  testing::write_rom(folder_ / "elastic.rom.h5", piston);
  return scene("[piston]\nrom = \"elastic.rom.h5\"\nmodel = \"" + model + "\"\n" + kThin);
}

std::vector<LimitCase> CylinderLimits::cases() {
  const auto contact = [](const std::string& keys) { return std::string(kFloating) + keys; };
  const auto ring = [](double load, double face, double groove) {
    return fmt::format(
        "[[contact.ring]]\nheight_mm = 50\nface_radius_mm = 20\nload_n_mm = {}\nthickness_mm = 4\n"
        "mass_g = 20\nfriction_coefficient = {}\ngroove_coefficient = {}\n",
        load, face, groove);
  };
  const auto shape = [](double um, const std::string& scale) {
    return fmt::format(
        "[[contact.bore_shape]]\norder = 0\nheight_mm = [-40, 300]\namplitude_um = [{}, {}]\n{}",
        2.0 * um, 6.0 * um, scale);
  };
  const std::string oil = "viscosity_pa_s = 0.02\n";
  const auto crank = [](const std::string& keys, double stiffness) {
    std::string text = "[crank]\nmass_kg = 40\ndiametral_kg_m2 = 1.5\ncentre_mm = 10\n" + keys;
    for (const int x : {-60, 60})
      text += fmt::format(
          "[[crank.bearing]]\nname = \"b{}\"\nat_mm = {}\nmodel = \"linear\"\nstiffness_n_m = {}\n"
          "damping_n_s_m = {}\n",
          x > 0 ? 2 : 1, x, stiffness, 1e-5 * stiffness);
    return text;
  };
  std::vector<LimitCase> list{
      {"gas pressure", [this] { return without_gas(); }, [this](double s) { return with_gas(s); }},
      {"inertia of the rod", off(std::string("[rod]\nmodel = \"massless\"\n") + kThin),
       on([=](double s) {
         return fmt::format("[rod]\nmass_kg = {}\ninertia_kg_m2 = {}\n", 2.2 * s, 0.02 * s) + kThin;
       })},
      {"friction of the rod joint", off("[small_end]\ndiameter_mm = 40\n"), on([](double s) {
         return fmt::format("[small_end]\ndiameter_mm = 40\nfriction_coefficient = {}\n", s);
       })},
      {"cavitation", off(contact("supply_pressure_bar = 2000\ncavitation = false\n")),
       on([=](double s) {
         // Nothing ruptures under a high pressure all around.
         return contact(fmt::format("supply_pressure_bar = {}\n", s == 1.0 ? 1.0 : 2000.0)) + "";
       }),
       1.0, 0.0, 0.0},
      {"viscosity over temperature", off(contact(oil)), on([=](double s) {
         return contact("") +
                fmt::format(
                    "[contact.oil]\nlaw = \"vogel\"\nvogel_a_pa_s = 0.02\nvogel_b_k = {}\n"
                    "vogel_c_c = -100\ntemperature_c = 100\n",
                    100.0 * s);
       })},
      {"viscosity over pressure", off(contact(oil)), on([=](double s) {
         return contact(oil) +
                fmt::format("[contact.oil]\npressure_coefficient_1_gpa = {}\n", 100.0 * s);
       })},
      {"viscosity over shear rate", off(contact(oil)), on([=](double s) {
         return contact(oil) +
                fmt::format("[contact.oil]\nshear_rate_1_s = {}\nshear_ratio = 0.2\n", 1e6 / s);
       })},
      {"friction factors",
       off(contact("flow_factors = true\npiston_roughness_um = 0.01\nliner_roughness_um = 0.01\n")),
       on([=](double s) {
         return contact(
             fmt::format("flow_factors = true\nfriction_factors = true\n"
                         "piston_roughness_um = {0}\nliner_roughness_um = {0}\n",
                         s));
       }),
       1.0, 0.01, 0.0},
      {"asperity contact", off(contact("asperities = false\n")), on([=](double s) {
         return contact(fmt::format("asperity_factor = {}\nsummit_roughness_um = 5\n", 1e-2 * s));
       })},
      {"damping of the contact", off(kTouching), on([](double s) {
         std::string keys = kTouching;
         const std::string none = "asperity_loss_factor = 0\n";
         return keys.replace(keys.find(none), none.size(),
                             fmt::format("asperity_loss_factor = {}\n", s));
       })},
      {"friction", off(std::string(kTouching) + "friction = false\n"), on([](double s) {
         return std::string(kTouching) + fmt::format("friction_coefficient = {}\n", s);
       })},
      {"shapes of bore and skirt", off(contact("")),
       on([=](double s) { return contact("") + shape(s, ""); })},
      {"shapes scaled over the cycle", off(contact("")),
       on([=](double s) { return contact("") + shape(s, "scale = \"gas\"\nat_bar = 40\n"); })},
      {"ends of the liner", off(contact("")),
       on([=](double s) { return contact(fmt::format("liner_bottom_mm = {}\n", s)); }), 240.0, 1.0,
       0.0},
      {"friction of the rings", off(contact("")),
       on([=](double s) { return contact("") + ring(0.5 * s, 0.1, 0.0); }), 1e-2, 1e-3, 0.5},
      {"friction in the ring grooves", off(contact("") + ring(0.5, 0.0, 0.0)),
       on([=](double s) { return contact("") + ring(0.5, 0.0, s); })},
      {"elastic body", [this] { return with_piston("rigid", 1.0); },
       [this](double s) { return with_piston("elastic", s); }},
      {"main bearings", off(contact("")),
       on([=](double s) { return contact("") + crank("", 1e8 / s); }), 1e-4, 1e-5},
      {"gyroscopic moments of the crank", off(contact("") + crank("", 1e9)), on([=](double s) {
         return contact("") + crank(fmt::format("polar_kg_m2 = {}\n", s), 1e9);
       })},
      {"unbalance of the crank", off(contact("") + crank("", 1e9)), on([=](double s) {
         return contact("") + crank("", 1e9) +
                fmt::format("[[crank.unbalance]]\nat_mm = 20\nmoment_kg_m = {}\n", s);
       })},
      {"free rotation of the crank", off(contact("")), on([=](double s) {
         return contact("") + fmt::format("[crank]\nspeed = \"free\"\npolar_kg_m2 = {}\n", 1.0 / s);
       })},
      {"oil film", off(kTouching), on([](double s) {
         std::string keys = kTouching;
         const std::string dry = "lubrication = \"none\"\n";
         return keys.replace(keys.find(dry), dry.size(),
                             fmt::format("initial_fill = {0}\nsupply_fill = {0}\n", s));
       })}};
  for (LimitCase& one : list) {
    one.steps = kAfterTdc;
    if (one.effect == "free rotation of the crank") one.row_off = "none";
  }
  return list;
}

TEST_P(CylinderLimits, OffIsTheLimitOfNoStrength) { expect_limit(named(GetParam())); }

class HardN12 : public testing::SlapScenes {};

TEST_F(HardN12, AFilmWithoutOilIsNoFilm) {
  const auto run = [&](double fill) {
    std::string keys = kTouching;
    const std::string dry = "lubrication = \"none\"\n";
    keys.replace(keys.find(dry), dry.size(),
                 fmt::format("initial_fill = {0}\nsupply_fill = {0}\n", fill));
    return short_run(scene(keys), kAfterTdc);
  };
  const testing::ShortRun none = short_run(scene(kTouching), kAfterTdc);
  test::expect_at_most("motion with a film of fill 0 from that without film, relative",
                       difference(run(0.0), none), 1e-9);  // sums in another order
  test::expect_at_least("the same with a full film", difference(run(1.0), none), 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Effects, CylinderLimits,
                         ::testing::ValuesIn(testing::effects_of_the_cylinder_limits()),
                         testing::name_of_effect);

}  // namespace
}  // namespace clatter::dynamics
