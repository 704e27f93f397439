// SPDX-License-Identifier: GPL-3.0-or-later
// Keys as data: what is read, what is refused and how it is said, what the reference says.
#include "core/keys/keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/keys/describe.hpp"

namespace clatter::keys {
namespace {

using testing::HasSubstr;

enum class Law { kConstant, kVogel };

struct Oil {
  double viscosity = 0.01;             // [Pa s]
  double temperature = 273.15 + 80.0;  // [K]
  Law law = Law::kConstant;
  std::optional<double> vogel_b;
};

struct Ring {
  double height = 2e-3;
  std::string name;
};

struct Contact {
  double radius = 0.0;
  double clearance = 40e-6;
  int cells = 8;
  bool film = true;
  std::optional<double> restitution, stiffness;
  std::vector<double> heights{0.0, 0.01};
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Oil oil;
  std::vector<Ring> rings;
  double gap = 0.0;  // follows from two keys
};

const Keys<Oil>& oil_keys() {
  static const Keys<Oil> keys("oil", "the oil", [](auto& key, Oil& oil) {
    key.number("viscosity_mpa_s", oil.viscosity, Range::positive(), "dynamic viscosity");
    key.number("temperature_c", oil.temperature, Range::between(-60.0, 400.0), "of the film");
    key.choice("law", oil.law, {{"constant", Law::kConstant}, {"vogel", Law::kVogel}},
               "viscosity over temperature");
    key.number("vogel_b_k", oil.vogel_b, Range::positive(), "of Vogel's law")
        .needs("law", "vogel")
        .required_with("law", "vogel");
  });
  return keys;
}

const Keys<Ring>& ring_keys() {
  static const Keys<Ring> keys("ring", "a piston ring", [](auto& key, Ring& ring) {
    key.text("name", ring.name, "in messages").required();
    key.number("height_mm", ring.height, Range::positive(), "of its face");
  });
  return keys;
}

const Keys<Contact>& contact_keys() {
  static const Keys<Contact> keys("contact", "skirt and liner", [](auto& key, Contact& contact) {
    key.number("bore_mm", contact.radius, Range::between(0.1, 1e4), "diameter of the bore")
        .required()
        .times(0.5);
    key.number("clearance_um", contact.clearance, Range::between(0.0, 1e4), "radial, cold");
    key.integer("cells", contact.cells, Range::between(2.0, 400.0), "along the skirt");
    key.flag("film", contact.film, "oil between the walls");
    key.number("restitution", contact.restitution, Range::between(0.0, 1.0), "of impacts");
    key.number("stiffness_n_m", contact.stiffness, Range::positive(), "of the wall")
        .excludes("restitution", "an impact has no stiffness");
    key.numbers("height_mm", contact.heights, Range::between(-100.0, 100.0), "of the relief");
    key.direction("normal", contact.normal, "out of the wall");
    key.table("oil", contact.oil, oil_keys());
    key.tables("ring", contact.rings, ring_keys());
    key.check([](const Config& table, Contact& c) {
      c.gap = c.radius - c.clearance;
      if (!(c.gap > 0.0)) table.fail("clearance_um", "is larger than the bore");
    });
  });
  return keys;
}

Contact read(const std::string& text) {
  const Config config = Config::parse(text, "a.toml");
  Contact contact = contact_keys().read(config);
  config.finish();
  return contact;
}

std::string refusal_of(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Keys, ValuesAreSiAndDefaultsAreTheStructs) {
  const Contact contact = read(
      "bore_mm = 107\ncells = 12\nheight_mm = [1, 2]\nnormal = [0, 3, 4]\n"
      "[oil]\ntemperature_c = 100\n[[ring]]\nname = \"top\"\n[[ring]]\nname = \"oil\"\nheight_mm = "
      "3");
  EXPECT_DOUBLE_EQ(contact.radius, 0.0535);
  EXPECT_DOUBLE_EQ(contact.clearance, 40e-6);
  EXPECT_EQ(contact.cells, 12);
  EXPECT_THAT(contact.heights, testing::ElementsAre(1e-3, 2e-3));
  EXPECT_NEAR((contact.normal - Eigen::Vector3d(0.0, 0.6, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(contact.oil.viscosity, 0.01);
  EXPECT_DOUBLE_EQ(contact.oil.temperature, 373.15);
  ASSERT_EQ(contact.rings.size(), 2U);
  EXPECT_EQ(contact.rings[0].name, "top");
  EXPECT_DOUBLE_EQ(contact.rings[0].height, 2e-3);
  EXPECT_DOUBLE_EQ(contact.rings[1].height, 3e-3);
  EXPECT_DOUBLE_EQ(contact.gap, 0.0535 - 40e-6);
  EXPECT_FALSE(contact.stiffness);
}

TEST(Rounded, IsTheDecimalNumberInAnyLanguage) {
  EXPECT_EQ(rounded(4e-5 / 1e-6, 15), 40.0);
  EXPECT_EQ(rounded(-0.0123456, 2), -0.012);
  EXPECT_EQ(rounded(0.0, 3), 0.0);
  EXPECT_TRUE(std::isnan(rounded(std::nan(""), 15)));
}

TEST(Keys, ADefaultGivesTheSameBitsWhetherItIsWrittenOrNot) {
  const Contact absent = read("bore_mm = 107"), written = read("bore_mm = 107\nclearance_um = 40");
  EXPECT_EQ(absent.clearance, written.clearance);
}

TEST(Keys, WhatIsWrongIsSaidWithItsLineAndTheWayOut) {
  EXPECT_EQ(refusal_of("bore = 107"), "a.toml:1: bore: unknown key, did you mean bore_mm?");
  EXPECT_THAT(refusal_of("cells = 4"), HasSubstr("bore_mm: found nothing, expected a number"));
  EXPECT_THAT(refusal_of("bore_mm = 107\nclearance_um = -1"),
              HasSubstr("a.toml:2: clearance_um: found -1, expected a number at least 0"));
  EXPECT_EQ(refusal_of("bore_mm = 107\nrestitution = 0.5\nstiffness_n_m = 1e8"),
            "a.toml:3: stiffness_n_m: stiffness_n_m and restitution exclude each other: an impact "
            "has no stiffness");
  EXPECT_EQ(refusal_of("bore_mm = 107\n[oil]\nvogel_b_k = 900"),
            "a.toml:3: oil.vogel_b_k: needs law = \"vogel\"");
  EXPECT_EQ(refusal_of("bore_mm = 107\n[oil]\nlaw = \"vogel\""),
            "a.toml:2: oil.vogel_b_k: is missing, law = \"vogel\" needs it");
  EXPECT_EQ(refusal_of("bore_mm = 107\n[oil]\nlaw = \"walther\""),
            "a.toml:3: oil.law: found \"walther\", expected one of: constant, vogel");
  EXPECT_EQ(refusal_of("bore_mm = 107\nheight_mm = [0, 200]"),
            "a.toml:2: height_mm: found 200, expected a number at least -100 and at most 100");
  EXPECT_EQ(refusal_of("bore_mm = 107\nnormal = [0, 0, 0]"),
            "a.toml:2: normal: found length 0, expected a direction");
  EXPECT_EQ(refusal_of("bore_mm = 0.1\nclearance_um = 100"),
            "a.toml:2: clearance_um: is larger than the bore");
  EXPECT_EQ(refusal_of("bore_mm = 107\n[[ring]]\nname = \"top\"\nheight = 3"),
            "a.toml:4: ring[0].height: unknown key, did you mean height_mm?");
}

struct Stop {
  std::optional<double> restitution, stiffness;
};

TEST(Keys, OfAlternativesExactlyOneIsGiven) {
  const Keys<Stop> keys("stop", "a stop", [](auto& key, Stop& stop) {
    key.number("stiffness_n_m", stop.stiffness, Range::positive(), "of the contact");
    key.number("restitution", stop.restitution, Range::between(0.0, 1.0), "of impacts");
    key.one_of({"stiffness_n_m", "restitution"});
  });
  const auto said = [&](const std::string& text) -> std::string {
    try {
      keys.read(Config::parse(text, "a.toml"));
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(said(""), HasSubstr("give stiffness_n_m or restitution"));
  EXPECT_THAT(said("stiffness_n_m = 1e8\nrestitution = 0.5"),
              HasSubstr("a.toml:2: restitution: stiffness_n_m and restitution exclude each other"));
  EXPECT_EQ(said("restitution = 0.5"), "");
}

TEST(Keys, TheReferenceSaysWhatTheReaderDoes) {
  const std::string text = text_of(contact_keys().table());
  EXPECT_THAT(text, HasSubstr("bore_mm                 diameter of the bore"));
  EXPECT_THAT(text, HasSubstr("number from 0.1 to 10000, required"));
  EXPECT_THAT(text, HasSubstr("number from 0 to 10000, default 40"));
  EXPECT_THAT(text, HasSubstr("not with restitution (an impact has no stiffness)"));
  EXPECT_THAT(text, HasSubstr("[oil]  the oil"));
  EXPECT_THAT(text, HasSubstr("\"constant\" | \"vogel\", default \"constant\""));
  EXPECT_THAT(text, HasSubstr("number from -60 to 400, default 80"));
  EXPECT_THAT(text, HasSubstr("[[ring]]  a piston ring"));
  EXPECT_THAT(text_of(contact_keys().table(), "oil.law"), HasSubstr("viscosity over temperature"));
  EXPECT_THROW(text_of(contact_keys().table(), "oil.flaw"), InputError);
  const std::string json = json_of(contact_keys().table());
  EXPECT_THAT(json, HasSubstr(R"("name": "clearance_um", "type": "number", "unit": "um")"));
  EXPECT_THAT(json, HasSubstr(R"("default": "40")"));
}

struct Gearbox {
  Oil oil, thick{.viscosity = 0.2};
};

TEST(Keys, TheReferenceHasTheDefaultsOfTheMemberWhereItsStructHasOthers) {
  static const Keys<Gearbox> keys("gearbox", "two oils", [](auto& key, Gearbox& box) {
    key.table("oil", box.oil, oil_keys());
    key.table("thick", box.thick, oil_keys());
  });
  const Gearbox box = keys.read(Config::parse("[thick]\ntemperature_c = 90\n", "a.toml"));
  EXPECT_DOUBLE_EQ(box.thick.viscosity, 0.2);
  EXPECT_THAT(text_of(keys.table(), "thick.viscosity_mpa_s"), HasSubstr("default 200\n"));
  EXPECT_THAT(text_of(keys.table(), "oil.viscosity_mpa_s"), HasSubstr("default 10\n"));
  EXPECT_EQ(keys.table().find("oil")->table, &oil_keys().table());  // only others are copied
}

TEST(Keys, TheUnitIsTheLongestEndOfTheName) {
  EXPECT_EQ(unit_of("spring_rate_n_m").shown, "N/m");
  EXPECT_EQ(unit_of("damping_n_s_m").shown, "N s/m");
  EXPECT_EQ(unit_of("spin_rad_s").shown, "rad/s");
  EXPECT_EQ(unit_of("splash_um_s").scale, 1e-6);
  EXPECT_EQ(unit_of("viscosity_mpa_s").scale, 1e-3);
  EXPECT_EQ(unit_of("modulus_mpa").scale, 1e6);
  EXPECT_EQ(unit_of("pressure_coefficient_1_gpa").scale, 1e-9);
  EXPECT_EQ(unit_of("cells_along").shown, "");
  EXPECT_EQ(unit_of("mm").shown, "");
}

struct Whole {
  Oil oil;
  double length = 1.0;
};

TEST(Keys, APartHasItsKeysInTheSameTable) {
  const Keys<Whole> keys("whole", "oil and length", [](auto& key, Whole& whole) {
    key.number("length_m", whole.length, Range::positive(), "of the whole");
    key.part(whole.oil, oil_keys());
  });
  const Whole whole = keys.read(Config::parse("viscosity_mpa_s = 5\nlength_m = 2", "a.toml"));
  EXPECT_DOUBLE_EQ(whole.oil.viscosity, 5e-3);
  EXPECT_DOUBLE_EQ(whole.length, 2.0);
  EXPECT_THROW(keys.read(Config::parse("vogel_b_k = 5", "a.toml")), InputError);
}

enum class Kind { kNone, kSteel, kOil };

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
