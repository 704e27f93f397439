// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Runs and refusals of scenes with valves.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics::testing {

class Valves : public ::testing::Test {
 protected:
  Scene scene(const std::string& text) {
    std::ofstream(folder_ / "valve.run.toml") << text;
    return read_scene(folder_ / "valve.run.toml");
  }
  H5File recorded(const std::string& text) {
    return complete_file(scene(text), folder_ / "valve.run.h5", result_);
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { build_model(scene(text), {}); });
  }
  std::filesystem::path folder_ = test_folder();
  RunResult result_;
};

/// A history.
inline std::vector<double> of(const H5File& file, const std::string& name) {
  return file.read_doubles("history/" + name);
}

}  // namespace clatter::dynamics::testing
