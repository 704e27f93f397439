// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/valve_model.hpp"

#include <fmt/format.h>

namespace clatter::dynamics::testing {
namespace {

ValveSpec valve_of(const std::string& text) {
  const Config root = Config::parse(text, "valve.toml");
  ValveSpec spec = valve_keys().read(root.tables("valve").front());
  root.finish();
  return spec;
}

}  // namespace

ValveModelOf::ValveModelOf(const std::string& shafts, const std::string& valve)
    : shaft(shafts), valves(valve_of(valve)) {
  valves.add_bodies(shaft.builder);
  valves.add_elements(shaft.builder);
}

std::unique_ptr<ValveModelOf> valves_on_a_shaft(const std::string& model, double rpm, int count) {
  std::string shaft = fmt::format(
      "[[shaft]]\nname = \"cam\"\nmodel = \"{}\"\nspeed_rpm = {}\n"
      "[[shaft.section]]\nfrom_mm = 0\nto_mm = 300\ndiameter_mm = 24\n",
      model, rpm);
  for (int k = 0; k < 2; ++k)
    shaft += fmt::format(
        "[[shaft.bearing]]\nname = \"b{}\"\nat_mm = {}\nmodel = \"linear\"\n"
        "stiffness_n_m = 1e8\ndamping_n_s_m = 1e3\nthrust_stiffness_n_m = 1e6\n",
        k, 300 * k);
  std::string valve = "[[valve]]\nname = \"valve\"\nlift_mm = 7.5\nhalf_angle_deg = 70\nlobe = [\n";
  for (int k = 0; k < count; ++k) {
    const double at = 300.0 * (k + 0.5) / count;
    shaft += fmt::format(
        "[[shaft.disc]]\nname = \"lobe_{}\"\nat_mm = {}\nmass_kg = 0.05\npolar_kg_m2 = 1e-2\n", k,
        at);
    valve += fmt::format("{{ body = \"cam.lobe_{}\", at_mm = [0, 0, {}], deg = {} }},\n", k, at,
                         20.0 + 360.0 * k / count);
  }
  return std::make_unique<ValveModelOf>(shaft, valve + "]\n");
}

}  // namespace clatter::dynamics::testing
