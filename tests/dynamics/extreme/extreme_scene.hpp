// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scenes of general components at their limits, written by each test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics::testing {

class ExtremeScenes : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  Scene scene(const std::string& text) {
    write("extreme.run.toml", text);
    return read_scene(folder_ / "extreme.run.toml");
  }
  /// Runs the scene to its end.
  H5File recorded(const std::string& text) {
    return complete_file(scene(text), folder_ / "extreme.run.h5", result_);
  }
  /// The message with which the scene is refused, which is a line of the page; "accepted".
  std::string refusal(const std::string& text) {
    const std::string said = test::refusal_of([&] { build_model(scene(text), {}); });
    const size_t start = said.find(folder_.string());
    test::observed("refused: " + (start == std::string::npos
                                      ? said
                                      : said.substr(start + folder_.string().size() + 1)));
    return said;
  }
  static double last(const H5File& file, const std::string& history) {
    return file.read_doubles("history/" + history).back();
  }

  std::filesystem::path folder_ = test_folder();
  RunResult result_;
};

/// [time] and [accuracy], as the first lines of a scene.
inline std::string span(double end, double tolerance = 1e-3, const std::string& keys = "") {
  return fmt::format("[time]\nend_s = {}\n{}[accuracy]\ntolerance = {}\n", end, keys, tolerance);
}

/// A body on a slide along z.
inline std::string slider(const std::string& name, double mass, double speed = 0.0) {
  return fmt::format(
      "[[rigid_body]]\nname = \"{}\"\nmotion = \"slide\"\naxis = [0, 0, 1]\nmass_kg = {}\n"
      "start_velocity_m_s = [0, 0, {}]\n",
      name, mass, speed);
}

/// A bushing between the centres of two bodies, `b` empty: the ground.
inline std::string joint(const std::string& a, const std::string& b, double stiffness,
                         double damping = 0.0) {
  return fmt::format(
      "[[bushing]]\na = {{ body = \"{}\", at_mm = [0, 0, 0] }}\nb = {{ {} }}\n"
      "stiffness_n_m = {}\ndamping_n_s_m = {}\n",
      a, b.empty() ? "at_mm = [0, 0, 0]" : fmt::format("body = \"{}\", at_mm = [0, 0, 0]", b),
      stiffness, damping);
}

/// A body of 1 kg in the plane y, z.
inline std::string block(const std::string& velocity = "[0, 0, 0]") {
  return "[[rigid_body]]\nname = \"b\"\nmotion = \"yz\"\nmass_kg = 1\ninertia_kg_m2 = 1\n"
         "start_velocity_m_s = " +
         velocity + "\n";
}

/// A stop below the centre of that body at `height` [mm].
inline std::string floor_at(double height, const std::string& law, const std::string& name = "s") {
  return fmt::format(
      "[[stop]]\nname = \"{}\"\na = {{ body = \"b\", at_mm = [0, 0, 0] }}\n"
      "b = {{ at_mm = [0, 0, {}] }}\nnormal = [0, 0, 1]\n{}\n",
      name, height, law);
}

}  // namespace clatter::dynamics::testing
