// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/config.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"

namespace clatter {
namespace {

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Config, ReadsNumbersTextsAndLists) {
  const Config config = Config::parse("a = 1\nb = 2.5\nc = \"x\"\n[t]\nd = [1, 2.0]\n", "file");
  EXPECT_EQ(config.integer("a"), 1);
  EXPECT_EQ(config.number("a"), 1.0);
  EXPECT_EQ(config.number("b"), 2.5);
  EXPECT_EQ(config.text("c"), "x");
  EXPECT_EQ(config.table("t").numbers("d", 2), (std::vector<double>{1.0, 2.0}));
  EXPECT_NO_THROW(config.finish());
}

TEST(Config, AnUnknownKeyNamesTheNearestKnownOne) {
  const Config config = Config::parse("[oil]\nviscosty = 1\n", "scene.toml");
  config.table("oil").number_or("viscosity", 0.01);
  EXPECT_EQ(message_of([&] { config.finish(); }),
            "scene.toml:2: oil.viscosty: unknown key, did you mean viscosity?");
}

TEST(Config, ATableRefusesItsOwnUnknownKeysAlone) {
  const Config config = Config::parse("other = 1\n[oil]\nviscosty = 1\n[water]\n", "scene.toml");
  const Config oil = config.table("oil");
  oil.number_or("viscosity", 0.01);
  EXPECT_EQ(message_of([&] { oil.finish_table(); }),
            "scene.toml:3: oil.viscosty: unknown key, did you mean viscosity?");
  EXPECT_NO_THROW(config.table("water").finish_table());
}

TEST(Config, AnUnknownTableIsAnUnknownKey) {
  const Config config = Config::parse("[[load]]\nset = \"tip\"\nforse = 3\n", "s");
  for (const auto& load : config.tables("load")) {
    load.text("set");
    load.number_or("force", 0.0);
  }
  EXPECT_EQ(message_of([&] { config.finish(); }),
            "s:3: load[0].forse: unknown key, did you mean force?");
}

TEST(Config, AValueOutOfRangeSaysWhatWasFoundAndExpected) {
  const Config config = Config::parse("clearance_um = -3\n", "s.toml");
  EXPECT_EQ(message_of([&] { config.number("clearance_um", Range::not_negative()); }),
            "s.toml:1: clearance_um: found -3, expected a number at least 0");
}

TEST(Config, NotANumberIsRefused) {
  const Config config = Config::parse("a = nan\nb = true\nc = \"1\"\n", "s");
  const auto message = [&](const char* key) { return message_of([&] { config.number(key); }); };
  EXPECT_EQ(message("a"), "s:1: a: found nan, expected a finite number");
  EXPECT_EQ(message("b"), "s:2: b: found true, expected a finite number");
  EXPECT_EQ(message("c"), "s:3: c: found '1', expected a finite number");
  EXPECT_EQ(message("missing"), "s:1: missing: found nothing, expected a finite number");
}

TEST(Config, BrokenTomlNamesLineAndColumn) {
  const std::string text = message_of([] { Config::parse("a = \n", "s.toml"); });
  EXPECT_EQ(text.rfind("s.toml:1:", 0), 0U) << text;
}

TEST(Config, DefaultsAreInTheResolvedConfiguration) {
  const Config config = Config::parse("a = 1\n", "s");
  config.number("a");
  config.number_or("b", 4.5);
  config.choice("c", {"one", "two"});
  EXPECT_EQ(config.resolved(), "a = 1\nb = 4.5\nc = \"one\"\n");
}

TEST(Config, AChoiceListsWhatIsAllowed) {
  const Config config = Config::parse("mode = \"oily\"\n", "s");
  EXPECT_EQ(message_of([&] {
              config.choice("mode", {"film", "none"});
            }),
            "s:1: mode: found \"oily\", expected one of: film, none");
}

TEST(Config, ATableWithAFallbackLacksNoKeyOfIt) {
  const Config root = Config::parse(
      "[oil]\nviscosity = 1\nfill = 2\n[oil.cold]\nstart = 5\n[air]\np = 3\n"
      "[[part]]\n[part.oil]\nfill = 4\nname = 7\n",
      "s");
  const Config part = root.tables("part").at(0).with_fallback(root);
  const Config oil = part.table("oil");
  EXPECT_EQ(oil.number("viscosity"), 1.0);
  EXPECT_EQ(oil.number("fill"), 4.0);
  EXPECT_EQ(oil.table("cold").number("start"), 5.0);
  EXPECT_EQ(oil.number_or("absent", 9.0), 9.0);
  EXPECT_EQ(part.table("air").number("p"), 3.0);
  EXPECT_FALSE(part.find_table("gas").has_value());
  // Messages name the table that has the key.
  EXPECT_EQ(oil.where("viscosity"), "s:2: oil.viscosity");
  EXPECT_EQ(oil.where("fill"), "s:10: part[0].oil.fill");
  EXPECT_EQ(message_of([&] { oil.number("viscosity", Range::between(2.0, 3.0)); }),
            "s:2: oil.viscosity: found 1, expected a number at least 2 and at most 3");
  EXPECT_EQ(message_of([&] { oil.text("name"); }),
            "s:11: part[0].oil.name: found 7, expected a string in quotes");
  EXPECT_EQ(root.resolved(),
            "oil.viscosity = 1\npart[0].oil.fill = 4\noil.cold.start = 5\n"
            "part[0].oil.absent = 9\nair.p = 3\n");
  // The shared fill is known, although the part has its own.
  static_cast<void>(oil.has("name"));
  EXPECT_NO_THROW(root.finish());
}

TEST(Config, MissingKeysAreTakenFromTheBase) {
  const std::filesystem::path folder = ::testing::TempDir() + "clatter_config_base";
  std::filesystem::create_directories(folder / "below");
  std::ofstream(folder / "below/base.toml") << "table = \"gas.csv\"\n[oil]\nmu = 0.01\nkeep = 1\n";
  std::ofstream(folder / "top.toml") << "base = \"below/base.toml\"\n[oil]\nmu = -2\n";
  const Config config = Config::load_with_base(folder / "top.toml");
  EXPECT_EQ(config.table("oil").number("mu"), -2.0);
  EXPECT_EQ(config.table("oil").number("keep"), 1.0);
  EXPECT_EQ(config.path("table"), folder / "below/gas.csv");
  EXPECT_EQ(config.files().size(), 2U);
  EXPECT_NO_THROW(config.finish());
  const auto message = [&](const char* key) {
    return message_of([&] { config.table("oil").number(key, Range{5.0, 9.0, false}); });
  };
  EXPECT_NE(message("mu").find("top.toml:3: oil.mu"), std::string::npos) << message("mu");
  EXPECT_NE(message("keep").find("base.toml:4: oil.keep"), std::string::npos) << message("keep");
  std::ofstream(folder / "loop.toml") << "base = \"loop.toml\"\n";
  EXPECT_EQ(message_of([&] { Config::load_with_base(folder / "loop.toml"); }),
            (folder / "loop.toml").string() + ": base: the file is its own base");
}

TEST(Config, EntriesOfTheBaseAreChangedByName) {
  const std::filesystem::path folder = ::testing::TempDir() + "clatter_config_entries";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "base.toml")
      << "[[drive]]\nname = \"crank\"\nspeed = 3400\nkeep = 1\n"
         "over = [{ r = 1 }, { r = 2 }]\n[[drive]]\nname = \"pump\"\nspeed = 2\n"
         "[[load]]\nname = \"gas\"\n";
  const auto with = [&](const char* text) {
    std::ofstream(folder / "top.toml") << "base = \"base.toml\"\n" << text;
    return Config::load_with_base(folder / "top.toml");
  };
  const Config config =
      with("load = []\n[drive.crank]\nspeed = 1000\nnew = 4\nover.1.r = 3\n[[new]]\na = 1\n");
  const auto drives = config.tables("drive");
  ASSERT_EQ(drives.size(), 2U);
  EXPECT_EQ(drives[0].number("speed"), 1000.0);
  EXPECT_EQ(drives[0].number("keep"), 1.0);
  EXPECT_EQ(drives[0].number("new"), 4.0);
  EXPECT_EQ(drives[0].tables("over").at(0).number("r"), 1.0);
  EXPECT_EQ(drives[0].tables("over").at(1).number("r"), 3.0);
  EXPECT_EQ(drives[1].number("speed"), 2.0);
  EXPECT_EQ(config.tables("load").size(), 0U);
  EXPECT_EQ(config.tables("new").size(), 1U);
  const std::string top = (folder / "top.toml").string();
  EXPECT_EQ(message_of([&] { with("[drive.cranc]\nspeed = 1\n"); }),
            top + ":2: drive.cranc: the base has no entry of this name");
  EXPECT_EQ(message_of([&] { with("drive.crank.over.2.r = 1\n"); }),
            top + ":2: drive.crank.over.2: the base has no entry of this name");
  EXPECT_EQ(message_of([&] { with("drive.crank = 1\n"); }),
            top +
                ":2: drive.crank: found a value, expected the keys to change of the entry of this "
                "name, or [[tables]] instead of those of the base");
  EXPECT_NE(message_of([&] {
              with("[drive.pump]\nspeed = -1\n").tables("drive")[1].number("speed", Range{0, 1});
            }).find("top.toml:3: drive[1].speed"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter
