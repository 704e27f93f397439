// SPDX-License-Identifier: GPL-3.0-or-later
// Keys as data: rows of every kind, what they read, refuse and write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/keys/describe.hpp"
#include "core/keys/keys.hpp"
#include "core/keys/member.hpp"

namespace clatter::keys {
namespace {

using testing::HasSubstr;

struct Quantities {
  bool force = true, moment = false;
};

struct Seat {
  std::string name;
  double height = 0.0;  // 0: not given
};

struct Everything {
  double metre = 1.0;
  std::optional<Eigen::Vector3d> at;
  double reach = 0.02;
  double from = -10.0;  // [deg], or [s]
  bool in_seconds = false;
  std::vector<double> moduli;
  std::optional<std::pair<double, double>> range;
  std::map<std::string, double> factors;
  std::map<std::string, Seat> seats;
  std::vector<Seat> rows{{"first", 0.0}};
  Quantities quantities;
  Kind kind = Kind::kNone;
  std::string method = "fast";
  std::optional<int> count;
  UnitSystem units;
  double doubled = 0.0;
};

const Keys<Seat>& seat_keys() {
  static const Keys<Seat> keys("seat", "a seat", [](auto& key, Seat& seat) {
    key.name("name", seat.name, "its name").distinct();
    key.number("height", seat.height, Range::positive(), "its height").in_length_unit();
  });
  return keys;
}

const Keys<Everything>& everything_keys() {
  static const Keys<Everything> keys("all.toml", "all rows", [](auto& key, Everything& all) {
    key.length_unit("length_unit", all.metre, {{"m", 1.0}, {"mm", 1e-3}}, "of lengths");
    key.vector("at", all.at, {}, "a point").in_length_unit();
    key.number("reach", all.reach, Range::positive(), "how far").in_length_unit();
    key.number("from_deg", all.from, {}, "begin").unconverted();
    key.number("from_s", all.from, {}, "begin");
    key.in_either("from_deg", "from_s", all.in_seconds);
    key.one_or_more("modulus_gpa", all.moduli, Range::positive(), "one or three");
    key.interval("range", all.range, "ends").in_length_unit();
    key.by_name("factors", all.factors, {}, "of loads");
    key.then([](const Config&, Everything& e) { e.doubled = 2.0 * e.reach; });
    key.named("seats", all.seats, seat_keys());
    key.tables("row", all.rows, seat_keys());
    key.flags("quantities", all.quantities,
              {{"force", &Quantities::force}, {"moment", &Quantities::moment}}, "what is written");
    key.choice("kind", all.kind, {{"steel", Kind::kSteel}, {"oil", Kind::kOil}}, "of it");
    key.choice("method", all.method, {"fast", "exact"}, "of solution");
    key.integer("count", all.count, {1, 9}, "how many").needs("kind", {"steel", "oil"});
    key.units("units", all.units, "of the deck");
  });
  return keys;
}

Everything read_all(const std::string& text) {
  return everything_keys().read(Config::parse(text, "a.toml"));
}

std::string refusal_of_all(const std::string& text) {
  try {
    read_all(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Keys, LengthsWithoutAUnitAreInThatOfTheFile) {
  const Everything all = read_all(
      "at = [1, 2, 3]\nrange = [4, 5]\nlength_unit = 'mm'\n[seats.low]\nheight = 7\n[[row]]\n"
      "height = 8");
  EXPECT_NEAR((*all.at - Eigen::Vector3d(1e-3, 2e-3, 3e-3)).norm(), 0.0, 1e-18);
  EXPECT_DOUBLE_EQ(all.reach, 0.02);  // a default is SI
  EXPECT_DOUBLE_EQ(all.doubled, 0.04);
  EXPECT_DOUBLE_EQ(all.range->second, 5e-3);
  EXPECT_DOUBLE_EQ(all.seats.at("low").height, 7e-3);
  ASSERT_EQ(all.rows.size(), 1U);  // instead of the default's
  EXPECT_DOUBLE_EQ(all.rows[0].height, 8e-3);
  EXPECT_DOUBLE_EQ(read_all("at = [1, 2, 3]").at->x(), 1.0);
}

TEST(Keys, RowsOfEveryKindAreRead) {
  const Everything all = read_all(
      "from_s = 0.5\nmodulus_gpa = 210\nfactors = {a = 2, b = -1}\nquantities = ['moment']\n"
      "kind = 'oil'\nmethod = 'exact'\ncount = 3\nunits = 'mm-t-s'");
  EXPECT_DOUBLE_EQ(all.from, 0.5);
  EXPECT_TRUE(all.in_seconds);
  EXPECT_EQ(all.moduli, std::vector<double>{210e9});
  EXPECT_EQ(all.factors.at("b"), -1.0);
  EXPECT_FALSE(all.quantities.force);
  EXPECT_TRUE(all.quantities.moment);
  EXPECT_EQ(all.kind, Kind::kOil);
  EXPECT_EQ(all.method, "exact");
  EXPECT_EQ(all.count, 3);
  EXPECT_EQ(all.units.length, 1e-3);
  EXPECT_EQ(read_all("modulus_gpa = [1, 2, 3]").moduli, (std::vector<double>{1e9, 2e9, 3e9}));
  EXPECT_EQ(read_all("from_deg = 3").from, 3.0);
  EXPECT_EQ(read_all("").kind, Kind::kNone);
  EXPECT_EQ(read_all("[[row]]\nname = 'a'").rows[0].height, 0.0);
}

TEST(Keys, RowsOfEveryKindRefuse) {
  EXPECT_EQ(refusal_of_all("from_deg = 1\nfrom_s = 2"),
            "a.toml:2: from_s: from_s and from_deg exclude each other");
  EXPECT_EQ(refusal_of_all("modulus_gpa = [1, 0]"),
            "a.toml:1: modulus_gpa: found 0, expected a number above 0");
  EXPECT_THAT(refusal_of_all("range = [2, 1]"), HasSubstr("a.toml:1: range: found an end"));
  EXPECT_EQ(refusal_of_all("quantities = ['power']"),
            "a.toml:1: quantities: found \"power\", expected some of: force, moment");
  EXPECT_EQ(refusal_of_all("quantities = []"),
            "a.toml:1: quantities: found none, expected at least one");
  EXPECT_EQ(refusal_of_all("kind = 'wood'"),
            "a.toml:1: kind: found \"wood\", expected one of: steel, oil");
  EXPECT_EQ(refusal_of_all("method = 'slow'"),
            "a.toml:1: method: found \"slow\", expected one of: fast, exact");
  EXPECT_EQ(refusal_of_all("count = 2"), "a.toml:1: count: needs kind = \"steel\" or \"oil\"");
  EXPECT_EQ(refusal_of_all("[[row]]\nname = 'a'\n[[row]]\nname = 'a'"),
            "a.toml:4: row[1].name: found \"a\" twice, expected different names");
  EXPECT_EQ(refusal_of_all("[seats.low]\nname = 'a/b'"),
            "a.toml:2: seats.low.name: found \"a/b\", expected a name without '/'");
  EXPECT_EQ(refusal_of_all("[seats.low]\nheight = 0"),
            "a.toml:2: seats.low.height: found 0, expected a number above 0");
  EXPECT_THAT(refusal_of_all("units = 'feet'"), HasSubstr("a.toml:1: units: found units 'feet'"));
}

TEST(Keys, TextsAreQuotedWhereTomlWouldMisreadThem) {
  EXPECT_EQ(toml_text("a \"b\" \\c\td"), "\"a \\\"b\\\" \\\\c\\u0009d\"");
  EXPECT_EQ(toml_key("steel_1"), "steel_1");
  EXPECT_EQ(toml_key("St 37.2"), "\"St 37.2\"");
  EXPECT_EQ(toml_key(""), "\"\"");
}

TEST(Keys, WhatIsWrittenIsReadBack) {
  for (const char* text :
       {"", "from_s = 0.5\nquantities = ['moment']\nkind = 'oil'\ncount = 3", "row = []",
        "at = [1, 2, 3]\nfactors = {a = 2}\n[seats.low]\nheight = 2\n[[row]]\nname = 'b'"}) {
    const std::string written = everything_keys().toml_of(read_all(text));
    EXPECT_EQ(everything_keys().toml_of(read_all(written)), written) << text;
  }
  const std::string written = everything_keys().toml_of(read_all("from_s = 0.5\nrow = []"));
  EXPECT_THAT(written, HasSubstr("from_s = 0.5\n"));
  EXPECT_THAT(written, testing::Not(HasSubstr("from_deg")));
  EXPECT_THAT(written, HasSubstr("row = []\n"));
}

enum class Film { kNone, kMoes, kTable };

struct Bearing {
  std::string where;
  Film film = Film::kNone;
  std::optional<Film> start;
  double scale = 0.0;  // 0: that of the run
  std::optional<double> width;
  std::array<double, 2> range{0.0, 1.0};
  Eigen::Vector2d end = {1e-3, 2e-3};
  std::vector<double> height, value;
  std::vector<double> temperature;
  std::optional<int> cells;
  std::optional<bool> exact;
  Oil oil;
};

const Keys<Bearing>& bearing_keys() {
  static const Keys<Bearing> keys("bearing", "a bearing", [](auto& key, Bearing& bearing) {
    key.where(bearing.where);
    key.choice("film", bearing.film,
               {{"none", Film::kNone}, {"moes", Film::kMoes}, {"table", Film::kTable}},
               "its model");
    key.choice("start", bearing.start, {{"none", Film::kNone}, {"moes", Film::kMoes}}, "first");
    key.number("displacement_um", bearing.scale, Range::between(1e-9, 1e6), "error scale");
    key.number("width_mm", bearing.width, Range::positive(), "along the axis")
        .needs("film", {"moes", "table"})
        .required_with("film", "moes");
    key.vector("range_deg", bearing.range, Range::between(-360.0, 360.0), "angles").ascending();
    key.vector("end_mm", bearing.end, Range::between(-1e3, 1e3), "of the line");
    key.numbers("height_mm", bearing.height, Range::between(-1e3, 1e3), "heights").ascending();
    key.numbers("relief_um", bearing.value, Range::between(0.0, 1e3), "there")
        .as_many_as("height_mm");
    key.one_or_more("temperature_c", bearing.temperature, Range::between(-60.0, 400.0), "there");
    key.all_need("film", "table", "it has a grid", [&] {
      key.integer("cells", bearing.cells, Range::between(2.0, 9.0), "around");
      key.flag("exact", bearing.exact, "modes");
    });
    key.table("oil", bearing.oil, oil_keys()).required();
  });
  return keys;
}

std::string bearing_refusal(const std::string& text) {
  try {
    bearing_keys().read(Config::parse(text, "a.toml"));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Keys, ListsOptionsAndDefaultsThatNoFileGives) {
  const Bearing absent = bearing_keys().read(Config::parse("oil = {}", "a.toml"));
  EXPECT_EQ(absent.where, "a.toml:1");
  EXPECT_EQ(absent.scale, 0.0);
  EXPECT_EQ(absent.end, Eigen::Vector2d(1e-3, 2e-3));
  EXPECT_FALSE(absent.start || absent.cells || absent.exact);
  const Bearing given = bearing_keys().read(Config::parse(
      "film = \"table\"\nstart = \"moes\"\ndisplacement_um = 3\nrange_deg = [0, 180]\nend_mm = [3, "
      "4]\n"
      "height_mm = [1, 2]\nrelief_um = [5, 6]\ntemperature_c = 80\ncells = 3\nexact = "
      "false\noil = {}",
      "a.toml"));
  EXPECT_EQ(given.start, Film::kMoes);
  EXPECT_DOUBLE_EQ(given.scale, 3e-6);
  EXPECT_NEAR(given.range[1], 3.141592653589793, 1e-15);
  EXPECT_EQ(given.end, Eigen::Vector2d(3e-3, 4e-3));
  EXPECT_THAT(given.value, testing::ElementsAre(testing::DoubleEq(5e-6), testing::DoubleEq(6e-6)));
  EXPECT_THAT(given.temperature, testing::ElementsAre(353.15));
  EXPECT_EQ(given.cells, 3);
  EXPECT_EQ(given.exact, false);
  const Config config = Config::parse("oil = {}\nfilm = \"table\"", "a.toml");
  bearing_keys().read(config);
  EXPECT_THAT(config.resolved(), HasSubstr("film = \"table\""));
  EXPECT_THAT(config.resolved(), testing::Not(HasSubstr("vogel_b_k")));
  Bearing preset;
  preset.start = Film::kMoes;
  preset.cells = 4;
  bearing_keys().read(config, preset);
  EXPECT_THAT(config.resolved(), HasSubstr("start = \"moes\"\n"));
  EXPECT_THAT(config.resolved(), HasSubstr("cells = 4\n"));
  EXPECT_EQ(bearing_keys().table().find("displacement_um")->standard, "");
  EXPECT_EQ(bearing_keys().table().find("end_mm")->standard, "[1, 2]");
}

TEST(Keys, RulesNameSeveralValuesAndLengths) {
  EXPECT_EQ(bearing_refusal("width_mm = 3\noil = {}"),
            "a.toml:1: width_mm: needs film = \"moes\" or \"table\"");
  EXPECT_THAT(bearing_refusal("film = \"moes\"\noil = {}"),
              HasSubstr("width_mm: is missing, film = \"moes\" needs it"));
  EXPECT_EQ(bearing_refusal("film = \"table\"\nwidth_mm = 3\noil = {}"), "");
  EXPECT_EQ(bearing_refusal("height_mm = [1, 2]\nrelief_um = [5]\noil = {}"),
            "a.toml:2: relief_um: found 1 values, expected as many as height_mm, 2");
  EXPECT_EQ(bearing_refusal("height_mm = [2, 1]\noil = {}"),
            "a.toml:1: height_mm: found 1 after 2, expected ascending values");
  EXPECT_EQ(bearing_refusal("range_deg = [90, 0]\noil = {}"),
            "a.toml:1: range_deg: found 0 after 90, expected ascending values");
  EXPECT_EQ(bearing_refusal("temperature_c = [80, 500]\noil = {}"),
            "a.toml:1: temperature_c: found 500, expected a number at least -60 and at most 400");
  EXPECT_EQ(bearing_refusal("start = \"table\"\noil = {}"),
            "a.toml:1: start: found \"table\", expected one of: none, moes");
  EXPECT_EQ(bearing_refusal("cells = 3\noil = {}"),
            "a.toml:1: cells: needs film = \"table\": it has a grid");
  EXPECT_THAT(bearing_refusal("film = \"table\"\ncells = 3"),
              HasSubstr("oil: found nothing, expected a table [oil]"));
}

TEST(Keys, ATableOfAnotherOwnerIsListed) {
  Table file("run.toml", "a scene");
  file.add("bearing", Type::kTables, bearing_keys().table());
  EXPECT_THAT(text_of(file, "bearing.width_mm"),
              HasSubstr("only with film = \"moes\" or \"table\""));
  EXPECT_THROW(file.read(Config::parse("bearings = 1", "a.toml"), nullptr), InputError);
}

}  // namespace
}  // namespace clatter::keys
