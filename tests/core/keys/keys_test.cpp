// SPDX-License-Identifier: GPL-3.0-or-later
// Keys as data: what is read, what is refused and how it is said, what the reference says.
#include "core/keys/keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

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

TEST(Keys, AMistakeInATableIsSeenWhenItIsMade) {
  struct Listed {
    std::vector<Ring> rings{1};
    double size = 0.0;
  };
  const auto row_of_an_entry = [] {
    Keys<Listed>("list", "a member that is not in the struct", [](auto& key, Listed& list) {
      key.number("height_mm", list.rings[0].height, Range::positive(), "of the first ring");
    });
  };
  const auto twice = [] {
    Keys<Whole>("whole", "two rows of one name", [](auto& key, Whole& whole) {
      key.number("viscosity_mpa_s", whole.length, Range::positive(), "of another member");
      key.part(whole.oil, oil_keys());
    });
  };
  EXPECT_THROW(row_of_an_entry(), std::logic_error);
  EXPECT_THROW(twice(), std::logic_error);
}

}  // namespace
}  // namespace clatter::keys
