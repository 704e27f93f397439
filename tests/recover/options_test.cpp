// SPDX-License-Identifier: GPL-3.0-or-later
// What a field.toml says: refused with its line, and written back.
#include <gtest/gtest.h>

#include "recover/recover.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

TEST(Options, UnknownKeysAndContradictionsAreRefused) {
  const auto read = [](const std::string& text) {
    return field_keys().read(Config::parse(text, "test.toml"));
  };
  const auto refusal = [&](const std::string& text) {
    return test::refusal_of([&] { read(text); });
  };
  EXPECT_EQ(refusal("bodie = \"block\""), "test.toml:1: bodie: unknown key, did you mean body?");
  EXPECT_EQ(refusal("[frames]\nfrom_deg = 10\nto_deg = -10"),
            "test.toml:3: frames.to_deg: found -10, expected more than 10");
  EXPECT_EQ(refusal("[[window]]\nname = \"cycle\""),
            "test.toml:2: window[0].name: found \"cycle\", the name of the last cycle, expected "
            "another one");
  EXPECT_EQ(
      refusal("[[window]]\nname = \"w\"\ntaper = \"box\""),
      "test.toml:3: window[0].taper: found \"box\", expected one of: tukey, hann, flattop, none");
  EXPECT_EQ(refusal("[[sensor]]\nname = \"s\""),
            "test.toml:1: sensor[0].set: give set or position");
  EXPECT_EQ(refusal("[[sensor]]\nset = \"s\"\nposition = [0, 0, 0]"),
            "test.toml:3: sensor[0].position: set and position exclude each other");
  EXPECT_EQ(refusal("[[sensor]]\nposition = [0, 0, 0]"),
            "test.toml:1: sensor[0].name: is missing, position needs it");
  EXPECT_EQ(refusal("[[panel]]\nname = \"p\"\ndirection = [0, 0, 0]"),
            "test.toml:3: panel[0].direction: found length 0, expected a direction");
  EXPECT_EQ(refusal("[lines]\nfrequencies_hz = [-5]"),
            "test.toml:2: lines.frequencies_hz: found -5, expected a number above 0");
  EXPECT_EQ(refusal("[air]\ndensity = 0"),
            "test.toml:2: air.density: found 0, expected a number above 0");
  EXPECT_EQ(refusal("[lines]\nquantities = [\"speed\"]"),
            "test.toml:2: lines.quantities: found \"speed\", expected some of: displacement, "
            "velocity, acceleration, normal_velocity");
  EXPECT_EQ(refusal("[frames]\nquantities = []"),
            "test.toml:2: frames.quantities: found none, expected at least one");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\ncycles = 2\nto_deg = 5"),
            "test.toml:3: window[0].cycles: cycles and to_deg exclude each other: cycles are the "
            "last ones of the run");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\nsegment_s = 0.1\ndomain = \"angle\""),
            "test.toml:3: window[0].segment_s: needs domain = \"time\": orders need segments of "
            "equal angle");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\nsegment_s = 0.1\nsegment_deg = 20"),
            "test.toml:3: window[0].segment_s: segment_s and segment_deg exclude each other");
  EXPECT_EQ(refusal("[frames]\nfrom_deg = 1\nto_s = 2"),
            "test.toml:1: frames.from_s: is missing, to_s needs it");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\noverlap = 1"),
            "test.toml:3: window[0].overlap: found 1, expected a number at least 0 and at most "
            "0.95");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\n[[window]]\nname = \"w\""),
            "test.toml:4: window[1].name: found \"w\" twice, expected different names");
  EXPECT_EQ(refusal("[output]\nskin = false"),
            "test.toml:2: output.skin: frames and lines need the geometry of the skin: set "
            "frames.on = false and lines.strongest = 0");
  EXPECT_NO_THROW(read(""));
}

TEST(Options, ResolvedTextReadsBackToTheSameChoices) {
  const auto again = [](const Options& options) {
    const std::string text = field_keys().toml_of(options);
    return field_keys().toml_of(field_keys().read(Config::parse(text, "resolved")));
  };
  EXPECT_EQ(again(Options{}), field_keys().toml_of(Options{}));
  const Options chosen = field_keys().read(Config::parse(
      "body = \"piston\"\n[frames]\nfrom_s = 0.01\nto_s = 0.02\nstep_s = 1e-4\n[lines]\norders = "
      "[2, 4.5]\n"
      "[[window]]\nname = \"w\"\ntaper = \"hann\"\ndomain = \"angle\"\nsegment_deg = "
      "30\noverlap = 0.2\n[output]\nsamples = false\nprecision = \"single\"\n[[sensor]]\nname = "
      "\"p\"\nposition = [1, 2, 3]\n"
      "[[panel]]\nname = \"top\"\ndirection = [0, 0, 1]\nangle_deg = 30\nexposed = true\n"
      "surfaces = [\"deck\", \"liner_4\"]\n",
      "chosen"));
  EXPECT_EQ(again(chosen), field_keys().toml_of(chosen));
  EXPECT_NE(field_keys().toml_of(chosen).find("step_s = 0.0001"), std::string::npos);
  Options none = chosen;
  none.windows.clear();
  EXPECT_NE(field_keys().toml_of(none).find("window = []"), std::string::npos);
  EXPECT_EQ(again(none), field_keys().toml_of(none));
}

}  // namespace
}  // namespace clatter::recover
