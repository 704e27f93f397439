// SPDX-License-Identifier: GPL-3.0-or-later
// Flipped bits in a finished file: no reader accepts a wrong number or string, and nothing crashes.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numeric>
#include <random>

#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDamaged = "checksum does not match: the file was damaged";

/// The complete content of the test file.
struct Content {
  std::vector<double> doubles;
  RowMatrix rows, middle_rows;
  std::vector<int32_t> ints;
  std::vector<int64_t> longs, attributes;
  std::vector<std::string> texts, names;
  double number = 0.0;
  std::vector<std::string> attribute_texts;

  bool operator==(const Content&) const = default;
};

Content read_all(const fs::path& path) {
  const H5File file = H5File::open(path);
  Content found;
  found.names = file.list("group");
  for (const std::string& name : file.attributes("group")) found.names.push_back(name);
  found.doubles = file.read_doubles("group/doubles");
  found.rows = file.read_rows("group/rows");
  found.middle_rows = file.read_rows("group/rows", 3, 2);
  found.ints = file.read_ints("ints");
  found.longs = file.read_longs("longs");
  found.texts = file.read_strings("texts");
  found.number = file.get_double("group", "number");
  found.attributes = file.get_ints("group", "shape");
  for (const std::string& name : file.attributes("/"))
    found.attribute_texts.push_back(name + " = " + file.get_string("/", name));
  found.attribute_texts.push_back(file.get_string("group", "unit"));
  return found;
}

class Integrity : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_path("integrity");
    fs::create_directories(folder_);
    path_ = folder_ / "a.h5";
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(int64_t doubles) {
    H5File out = H5File::create(path_);
    std::vector<double> values(static_cast<size_t>(doubles));
    for (size_t i = 0; i < values.size(); ++i) values[i] = 1.0 / static_cast<double>(i + 1);
    out.write("group/doubles", values);
    out.write("group/rows", RowMatrix(RowMatrix::Constant(8, 3, 0.1)));
    out.write("ints", std::vector<int32_t>{1, -2, 3});
    out.write("longs", std::vector<int64_t>{1, int64_t{1} << 40});
    out.write("texts", std::vector<std::string>{"bore", "", "crown of the piston"});
    out.set("group", "number", 0.3);
    out.set("group", "shape", std::vector<int64_t>{4, 5});
    out.set("group", "unit", "m");
    // Many attributes, a long one among them: HDF5 would move them to a heap.
    for (const char c : std::string("abcdefghij")) out.set("/", std::string(1, c), "text");
    out.set("/", "config", configuration(5000));
    out.commit();
  }

  static std::string configuration(size_t bytes) {
    std::string text;
    for (int line = 0; text.size() < bytes; ++line) text += "key = " + std::to_string(line) + "\n";
    return text;
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// For each of these positions, flips one bit of the file and reads it.
  template <class Positions>
  void flip(const Positions& positions) {
    const Content expected = read_all(path_);
    const std::string good = bytes();
    int refused = 0;
    for (const size_t at : positions) {
      std::string bad = good;
      bad[at] = static_cast<char>(bad[at] ^ (1 << (at * 5 % 8)));
      std::ofstream(path_, std::ios::binary) << bad;
      try {
        EXPECT_TRUE(read_all(path_) == expected) << "byte " << at;
      } catch (const InputError& error) {
        ++refused;
        EXPECT_NE(std::string(error.what()).find(path_.string()), std::string::npos);
      }
    }
    std::ofstream(path_, std::ios::binary) << good;
    EXPECT_GT(refused, 0);
    RecordProperty("refused", refused);
  }

  fs::path folder_, path_;
};

TEST_F(Integrity, NoByteOfAFileCanChangeANumberOrAText) {
  write(100);
  std::vector<size_t> positions(bytes().size());
  std::iota(positions.begin(), positions.end(), size_t{0});
  ASSERT_GT(positions.size(), 9000u);
  flip(positions);
}

TEST_F(Integrity, NorInDataOfSeveralChunks) {
  write(40000);  // 320 kB: three chunks
  const size_t size = bytes().size();
  std::mt19937 draw(3);
  std::vector<size_t> positions;
  for (int i = 0; i < 300; ++i) positions.push_back(draw() % size);
  flip(positions);
}

TEST_F(Integrity, TheLineNamesFileAndDataset) {
  write(1000);
  std::string text = bytes();
  const double value = 1.0 / 500.0;
  const size_t at = text.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  ASSERT_NE(at, std::string::npos);
  text[at] = static_cast<char>(text[at] ^ 1);
  std::ofstream(path_, std::ios::binary) << text;
  test::expect_parts(test::refusal_of([&] { read_all(path_); }),
                     {path_.string(), "group/doubles", kDamaged});
}

TEST_F(Integrity, RowsOfADamagedPieceAreRefusedAndOthersAreRead) {
  H5File out = H5File::create(path_);
  out.write("rows", RowMatrix(RowMatrix::Constant(40000, 1, 0.25)));
  out.commit();
  std::string text = bytes();
  const double value = 0.25;
  const size_t at = text.find(std::string(reinterpret_cast<const char*>(&value), sizeof value));
  text[at] = static_cast<char>(text[at] ^ 1);
  std::ofstream(path_, std::ios::binary) << text;
  const H5File in = H5File::open(path_);
  test::expect_parts(test::refusal_of([&] { in.read_rows("rows", 0, 10); }), {"rows", kDamaged});
  EXPECT_EQ(in.read_rows("rows", 39990, 10), RowMatrix(RowMatrix::Constant(10, 1, 0.25)));
}

TEST_F(Integrity, ATextThatIsTooLongForAnAttributeIsADataset) {
  const std::string text = configuration(70000);
  H5File out = H5File::create(path_);
  out.set("/", "config", text);
  out.set("group", "unit", "");
  out.commit();
  const H5File in = H5File::open(path_);
  EXPECT_EQ(in.get_string("/", "config"), text);
  EXPECT_EQ(in.read_strings("config"), std::vector<std::string>{text});
  EXPECT_EQ(in.get_string("group", "unit"), "");
  test::expect_parts(test::refusal_of([&] { in.get_string("group", "name"); }),
                     {path_.string(), "group", "found no attribute name"});
}

}  // namespace
}  // namespace clatter
