// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case H3: files that another program has open.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <filesystem>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

class HardH3_OpenElsewhere : public ::testing::Test {
 protected:
  void SetUp() override {
    H5File file = H5File::create(path_);
    file.write("x", std::vector<double>{1.0});
    file.commit();
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC);
  }
  void TearDown() override {
    ::close(descriptor_);
    std::filesystem::remove(path_);
  }
  const std::filesystem::path path_ = test::scratch_path("core_open_elsewhere.h5");
  int descriptor_ = -1;
};

// As HDF5 locks a file that h5py opens by "r+". Before: "truncated, or not HDF5".
TEST_F(HardH3_OpenElsewhere, ForChangesIsSaid) {
  ASSERT_EQ(::flock(descriptor_, LOCK_EX), 0);
  const std::string said = test::refusal_of<FileError>([&] { H5File::open(path_); });
  test::observed("refused: " + said.substr(said.find("core_open_elsewhere")));
  test::expect_parts(said, {path_.string(), "another program has it open for changes", "h5py"});
  ASSERT_EQ(::flock(descriptor_, LOCK_UN), 0);
  EXPECT_EQ(H5File::open(path_).read_doubles("x").at(0), 1.0);
}

TEST_F(HardH3_OpenElsewhere, ForReadingIsNoHindrance) {
  ASSERT_EQ(::flock(descriptor_, LOCK_SH), 0);
  const H5File one = H5File::open(path_), other = H5File::open(path_);
  EXPECT_EQ(one.read_doubles("x"), other.read_doubles("x"));
  EXPECT_NE(::flock(descriptor_, LOCK_EX | LOCK_NB), 0);  // nobody changes what is being read
}

}  // namespace
}  // namespace clatter
