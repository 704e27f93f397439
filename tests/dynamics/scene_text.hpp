// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scenes that tests write as text.
#include <fstream>
#include <string>
#include <utility>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics::testing {

/// Tests of scenes in a folder of their own, <stem>.run.toml.
class SceneText : public ::testing::Test {
 protected:
  explicit SceneText(std::string stem) : stem_(std::move(stem)) {}

  Scene scene(const std::string& text) {
    const std::filesystem::path path = folder_ / (stem_ + ".run.toml");
    std::ofstream(path) << text;
    return read_scene(path);
  }
  /// The file of the run to its end; its result is in result_.
  H5File recorded(const std::string& text) {
    return complete_file(scene(text), folder_ / (stem_ + ".run.h5"), result_);
  }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { build_model(scene(text), {}); });
  }

  std::string stem_;
  std::filesystem::path folder_ = test_folder();
  RunResult result_;
};

}  // namespace clatter::dynamics::testing
