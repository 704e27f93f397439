// SPDX-License-Identifier: GPL-3.0-or-later
// Keys of a base that a file over it makes meaningless: left out with a line, not refused.
#include <gtest/gtest.h>

#include <fstream>

#include "core/base/log.hpp"
#include "core/keys/keys.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::keys {
namespace {

struct OilLayer {
  double splash = 0.0, thickness = 0.0;
};

struct OilGap {
  bool oil = true;
  double gap = 0.0, warm_gap = 0.0;
  double load = 0.0;
  bool as_force = false;
  std::string table, column;
  double scale = 1.0;
  std::optional<OilLayer> layer;
};

const Keys<OilLayer>& oil_layer_keys() {
  static const Keys<OilLayer> keys("layer", "a layer", [](auto& key, OilLayer& layer) {
    key.number("splash_um", layer.splash, Range::not_negative(), "splash");
    key.number("thickness_um", layer.thickness, Range::between(1e-3, 1e5), "thickness");
    key.check([](const Config& table, OilLayer& found) {
      if (found.splash > 0.0 && found.thickness == 0.0) table.fail("thickness_um", "is missing");
    });
  });
  return keys;
}

const Keys<OilGap>& oil_gap_keys() {
  static const Keys<OilGap> keys("film", "a film", [](auto& key, OilGap& film) {
    key.choice("oil", film.oil, {{"film", true}, {"none", false}}, "oil");
    key.number("gap_um", film.gap, Range::positive(), "gap");
    key.number("warm_gap_um", film.warm_gap, Range::positive(), "warm gap");
    key.one_of({"gap_um", "warm_gap_um"});
    key.number("load_n_m", film.load, Range::positive(), "load");
    key.number("force_n", film.load, Range::positive(), "force");
    key.in_either("load_n_m", "force_n", film.as_force);
    key.number("scale", film.scale, {}, "factor").excludes("table");
    key.text("table", film.table, "table");
    key.text("column", film.column, "column").needs("table");
    key.table("layer", film.layer, oil_layer_keys()).needs("oil", "film");
  });
  return keys;
}

class Overruled : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The film of top.toml over base.toml; warnings are kept.
  OilGap read(const std::string& base, const std::string& top) {
    std::ofstream(folder_ / "base.toml") << "[film]\n" << base;
    std::ofstream(folder_ / "top.toml") << "base = \"base.toml\"\n[film]\n" << top;
    said_.clear();
    set_log_sink([&](bool, const std::string& line) { said_ += line + "\n"; });
    const Config config = Config::load_with_base(folder_ / "top.toml");
    const OilGap film = oil_gap_keys().read(config.table("film"));
    config.finish();
    set_log_sink({});
    return film;
  }
  std::string place(const char* file, int line, const char* key) const {
    return fmt::format("{}:{}: film.{}", (folder_ / file).string(), line, key);
  }
  const std::filesystem::path folder_ = test::scratch_path("overruled");
  std::string said_;
};

const std::string kGap = "gap_um = 5\n", kLayer = "[film.layer]\nsplash_um = 4\nthickness_um = 2\n";

TEST_F(Overruled, ATableOfTheBaseIsLeftOutWhereTheUpperFileTurnsOffWhatItNeeds) {
  const OilGap film = read(kGap + kLayer, "oil = \"none\"\n");
  EXPECT_FALSE(film.oil);
  EXPECT_FALSE(film.layer.has_value());
  EXPECT_EQ(said_, place("base.toml", 3, "layer") + ": left out, it does not go with " +
                       place("top.toml", 3, "oil") + "\n");
}

TEST_F(Overruled, AKeyThatIsSetToZeroLeavesItsPartnersOfTheBaseInForce) {
  const OilGap film = read(kGap + kLayer, "layer.splash_um = 0\n");
  ASSERT_TRUE(film.layer.has_value());
  EXPECT_EQ(film.layer->splash, 0.0);
  EXPECT_DOUBLE_EQ(film.layer->thickness, 2e-6);
  EXPECT_EQ(said_, "");
}

TEST_F(Overruled, TheUpperOneOfKeysThatExcludeEachOtherHolds) {
  const OilGap warm = read(kGap, "warm_gap_um = 7\n");
  EXPECT_EQ(warm.gap, 0.0);
  EXPECT_DOUBLE_EQ(warm.warm_gap, 7e-6);
  const OilGap force = read(kGap + "load_n_m = 3\n", "force_n = 2\n");
  EXPECT_TRUE(force.as_force);
  EXPECT_EQ(force.load, 2.0);
  const OilGap load = read(kGap + "force_n = 3\n", "load_n_m = 2\n");
  EXPECT_FALSE(load.as_force);
  EXPECT_EQ(load.load, 2.0);
  const OilGap table = read(kGap + "scale = 3\n", "table = \"a.csv\"\n");
  EXPECT_EQ(table.table, "a.csv");
  EXPECT_EQ(table.scale, 1.0);
}

TEST_F(Overruled, WhatNeedsAnOverruledKeyGoesWithIt) {
  const OilGap film = read(kGap + "table = \"a.csv\"\ncolumn = \"b\"\n", "scale = 3\n");
  EXPECT_EQ(film.scale, 3.0);
  EXPECT_EQ(film.table + film.column, "");
  EXPECT_NE(said_.find("film.column: left out, it does not go with"), std::string::npos) << said_;
}

TEST_F(Overruled, KeysOfOneFileAndOfTheUpperOneAreRefusedAsEver) {
  const auto refused = [&](const std::string& base, const std::string& top,
                           const std::string& message) {
    const std::string found = test::refusal_of([&] { read(base, top); });
    set_log_sink({});
    EXPECT_NE(found.find(message), std::string::npos) << found;
  };
  refused(kGap + "oil = \"none\"\n", kLayer, "film.layer: needs oil = \"film\"");
  refused(kGap, "oil = \"none\"\n" + kLayer, "film.layer: needs oil = \"film\"");
  refused(kGap + "oil = \"none\"\n" + kLayer, "", "film.layer: needs oil = \"film\"");
  refused("", kGap + "warm_gap_um = 7\n", "gap_um and warm_gap_um exclude each other");
  refused(kGap + "scale = 3\n", "column = \"b\"\n", "film.column: needs table");
}

}  // namespace
}  // namespace clatter::keys
