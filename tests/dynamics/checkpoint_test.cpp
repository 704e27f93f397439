// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged checkpoints.
#include "dynamics/run/checkpoint.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

class Checkpoints : public ::testing::Test {
 protected:
  void SetUp() override {
    testing::write_slap_scene(folder_);
    scene_ = testing::changed_scene(folder_, "");
    control_.output = folder_ / "slap.run.h5";
    point_ = checkpoint_path(control_.output);
    simulate(scene_, load_bodies(scene_), control_);
  }
  std::string refusal() const {
    return test::refusal_of([&] {
      RunControl control = control_;
      control.resume_from = read_checkpoint(point_, fingerprint(scene_));
      simulate(scene_, load_bodies(scene_), control);
    });
  }
  /// Another checkpoint with the right fingerprint and so many samples.
  void rewrite(const Checkpoint& point, int64_t samples) const {
    CheckpointFile file(point_);
    SampleBlock block;
    block.count = samples;
    block.eta = block.v = RowMatrix::Zero(samples, 9);
    file.add(block);
    file.commit(point, fingerprint(scene_));
  }
  void expect_advice() const {
    test::expect_parts(refusal(), {point_.string() + ": ", "; delete " + point_.string(),
                                   "or run without --resume"});
  }

  fs::path folder_ = testing::test_folder(), point_;
  Scene scene_;
  RunControl control_;
};

// Before: "cannot be opened, expected a complete HDF5 file", and no word about what to do; a wrong
// number of elements was read beyond the end of the vector.
TEST_F(Checkpoints, HardN11_ADamagedCheckpointSaysWhatToDelete) {
  const auto bytes = fs::file_size(point_);
  fs::resize_file(point_, bytes / 2);
  expect_advice();
  std::ofstream(point_) << "not HDF5";
  expect_advice();
}

TEST_F(Checkpoints, HardN11_ACheckpointOfAnotherSizeSaysWhatToDelete) {
  const Checkpoint whole = read_checkpoint(point_, fingerprint(scene_)).value();
  Checkpoint fewer = whole;
  fewer.elements.pop_back();
  rewrite(fewer, 1201);
  EXPECT_NE(refusal().find("elements: found 3 numbers, expected 4"), std::string::npos);
  expect_advice();
  rewrite(whole, 7);
  EXPECT_NE(refusal().find("cycle/eta: expected 1201 samples of 9 modes"), std::string::npos);
  expect_advice();
}

}  // namespace
}  // namespace clatter::dynamics
