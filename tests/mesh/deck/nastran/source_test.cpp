// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// A temporary folder for each test.
class NastranInclude : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("include");
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "sub" / "deep");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  mesh::deck::Deck read(const std::string& name) const {
    return mesh::deck::read_nastran(folder_ / name);
  }
  std::string refusal_of(const std::string& name) const {
    try {
      read(name);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder_.string().size() + 1);
    }
    return {};
  }
  void write_parts(const std::string& include) const {
    write("top.bdf", kTet.substr(0, kTet.find("GRID,3")) + include + "CTETRA,1,1,1,2,3,4\n");
    write("sub/nodes.blk", "GRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.");
  }

  std::filesystem::path folder_;
};

TEST_F(NastranInclude, NamesWithOrWithoutQuotesInAnyCase) {
  for (const char* line : {"INCLUDE 'sub/nodes.blk'\n", "include \"sub/nodes.blk\" $ comment\n",
                           "INCLUDE sub/nodes.blk\n", "Include   'sub\\nodes.blk'\r\n",
                           "INCLUDE 'sub/\nnodes.blk'\n", "INCLUDE 'sub/\n  no\n  des.blk'\n"}) {
    write_parts(line);
    const auto deck = read("top.bdf");
    EXPECT_EQ(deck.mesh.nodes.rows(), 4) << line;
    ASSERT_EQ(deck.files.size(), 2u);
    EXPECT_EQ(deck.files[1], (folder_ / "sub/nodes.blk").string());
  }
}

TEST_F(NastranInclude, IsRelativeToTheIncludingFileThenToThoseAboveIt) {
  write("top.bdf",
        kTet.substr(0, kTet.find("GRID,3")) + "INCLUDE 'sub/a.blk'\nCTETRA,1,1,1,2,3,4\n");
  write("sub/a.blk", "INCLUDE 'deep/b.blk'\nINCLUDE 'beside_top.blk'\n");
  write("sub/deep/b.blk", "GRID,3,,0.,1.,0.\n");
  write("beside_top.blk", "GRID,4,,0.,0.,1.\n");
  EXPECT_EQ(read("top.bdf").files.size(), 4u);
}

TEST_F(NastranInclude, LinesAreThoseOfTheFileTheyAreIn) {
  write_parts("INCLUDE 'sub/nodes.blk'\n");
  write("sub/nodes.blk", "$\nGRID,3,,0.,1.,0.\nCBEND,1\nGRID,4,,0.,0.,1.\n");
  EXPECT_THAT(refusal_of("top.bdf"), StartsWith("sub/nodes.blk:3: card CBEND is not supported"));
  write("sub/nodes.blk", "GRID,3,,0.,1.,0.\n");
  EXPECT_THAT(refusal_of("top.bdf"), StartsWith("top.bdf:6: cell 1: found no GRID 4"));
}

TEST_F(NastranInclude, AMissingFileIsNamed) {
  write_parts("INCLUDE 'sub/node.blk'\n");
  EXPECT_THAT(refusal_of("top.bdf"),
              StartsWith("top.bdf:5: INCLUDE 'sub/node.blk': found no such file"));
  write_parts("INCLUDE 'sub\n");
  EXPECT_THAT(refusal_of("top.bdf"), HasSubstr("top.bdf:5: INCLUDE: found no quote at the end"));
  test::expect_parts(test::refusal_of<FileError>([&] { read("absent.bdf"); }),
                     {"absent.bdf: no such file"});
  test::expect_parts(test::refusal_of<FileError>([&] { read("sub"); }), {"sub: no such file"});
}

TEST_F(NastranInclude, CyclesAreRefused) {
  write_parts("INCLUDE 'sub/nodes.blk'\n");
  write("sub/nodes.blk", "INCLUDE '../top.bdf'\n");
  EXPECT_THAT(refusal_of("top.bdf"), HasSubstr("this file includes itself"));
  std::filesystem::create_symlink(folder_ / "sub/nodes.blk", folder_ / "sub/link.blk");
  write("sub/nodes.blk", "INCLUDE 'link.blk'\n");
  EXPECT_THAT(refusal_of("top.bdf"), HasSubstr("this file includes itself"));
}

TEST_F(NastranInclude, DepthAndNumberAreLimited) {
  for (int i = 0; i < 70; ++i) {
    write(fmt::format("f{}", i), fmt::format("INCLUDE f{}\n", i + 1));
  }
  EXPECT_THAT(refusal_of("f0"), HasSubstr("more than 64 files deep"));
  // Each file includes the next one twice: 2^40 lines without a limit.
  for (int i = 0; i < 40; ++i) {
    write(fmt::format("f{}", i), fmt::format("INCLUDE f{0}\nINCLUDE f{0}\n", i + 1));
  }
  write("f40", "$\n");
  EXPECT_THAT(refusal_of("f0"), HasSubstr("more than 10000 INCLUDE"));
}

TEST_F(NastranInclude, ControlSectionsMayIncludeToo) {
  write("top.bdf", "SOL 101\nCEND\nINCLUDE 'sub/case'\nBEGIN BULK\n" + kTet);
  write("sub/case", "SUBCASE 7\n");
  EXPECT_EQ(read("top.bdf").steps.at(0).name, "subcase_7");
}

TEST(NastranIncludeInMemory, IsRefused) {
  EXPECT_THAT(refusal("INCLUDE 'a'\n"), HasSubstr("t.bdf:1: INCLUDE is not possible here"));
}

}  // namespace
}  // namespace clatter::test
