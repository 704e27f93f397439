// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case P2: an artefact and the list of inputs that make reads with it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/write_artefact.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

class HardP2_Dependencies : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("dependencies");
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    artefact_ = folder_ / "part.mesh.h5";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(
      const fs::path& depfile, const std::function<void()>& companions = [] {}) const {
    CommonOptions common;
    common.depfile = depfile;
    write_artefact(
        artefact_, {"clatter/mesh/1", "", {}}, StepClock(), common, [](H5File&) {}, companions);
  }

  fs::path folder_, artefact_;
};

// A process may be killed after each file: no artefact is there without its list.
TEST_F(HardP2_Dependencies, AreListedBeforeTheArtefactIsThere) {
  const fs::path depfile = folder_ / "part.mesh.h5.d";
  fs::create_directories(artefact_ / "taken");  // so that the artefact cannot get its name
  test::expect_parts(test::refusal_of<FileError>([&] { write(depfile); }), {"part.mesh.h5"});
  EXPECT_TRUE(fs::exists(depfile));
}

TEST_F(HardP2_Dependencies, ThatCannotBeListedDoNotCostTheArtefact) {
  const fs::path depfile = folder_ / "missing" / "part.mesh.h5.d";
  test::expect_parts(test::refusal_of<FileError>([&] { write(depfile); }), {depfile.string()});
  EXPECT_TRUE(fs::is_regular_file(artefact_));
}

// Make takes the artefact's name for the files that are written with it.
TEST_F(HardP2_Dependencies, CompanionsAreThereBeforeTheArtefact) {
  bool early = false;
  write({}, [&] {
    early = fs::exists(artefact_.string() + ".part") && !fs::exists(artefact_);
    write_whole_file(folder_ / "part.vtu", "cells");
  });
  EXPECT_TRUE(early);
  EXPECT_TRUE(fs::is_regular_file(artefact_));
  EXPECT_EQ(read_whole_file(folder_ / "part.vtu"), "cells");
}

TEST_F(HardP2_Dependencies, CompanionsThatFailDoNotCostTheArtefact) {
  const fs::path companion = folder_ / "missing" / "part.vtu";
  test::expect_parts(test::refusal_of<FileError>(
                         [&] { write({}, [&] { write_whole_file(companion, "cells"); }); }),
                     {companion.string()});
  EXPECT_TRUE(fs::is_regular_file(artefact_));
}

// The same of files in formats of other programs, which are written one by one.
TEST_F(HardP2_Dependencies, OfExportsAreListedBeforeTheFirstFile) {
  CommonOptions common;
  common.depfile = folder_ / "part.inp.d";
  const ExportedFiles exported{folder_ / "part.inp", {folder_ / "part.inp"}, {"part.rom.h5"}};
  bool listed = false;
  write_exports(exported, common, [&] {
    listed = fs::exists(common.depfile);
    return "part";
  });
  EXPECT_TRUE(listed);
  common.depfile = folder_ / "missing" / "part.inp.d";
  bool written = false;
  test::expect_parts(test::refusal_of<FileError>([&] {
                       write_exports(exported, common, [&] {
                         written = true;
                         return "part";
                       });
                     }),
                     {common.depfile.string()});
  EXPECT_TRUE(written);
}

}  // namespace
}  // namespace clatter
