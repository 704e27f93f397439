// SPDX-License-Identifier: GPL-3.0-or-later
// What a field.toml says: refused with its line, and written back.
#include <gtest/gtest.h>

#include "recover/recover.hpp"
#include "tests/refusal.hpp"

namespace clatter::recover {
namespace {

TEST(Options, UnknownKeysAndContradictionsAreRefused) {
  const auto read = [](const std::string& text) {
    return read_options(Config::parse(text, "test.toml"));
  };
  const auto refusal = [&](const std::string& text) {
    return test::refusal_of([&] { read(text); });
  };
  EXPECT_EQ(refusal("bodie = \"block\""), "test.toml:1: bodie: unknown key, did you mean body?");
  EXPECT_EQ(refusal("[frames]\nfrom_deg = 10\nto_deg = -10"),
            "test.toml:3: frames.to_deg: found -10, expected more than 10");
  EXPECT_EQ(
      refusal("[[window]]\nname = \"cycle\""),
      "test.toml:2: window[0].name: found 'cycle', expected a name without '/', other than cycle");
  EXPECT_EQ(
      refusal("[[window]]\nname = \"w\"\ntaper = \"box\""),
      "test.toml:3: window[0].taper: found \"box\", expected one of: tukey, hann, flattop, none");
  EXPECT_EQ(refusal("[[sensor]]\nname = \"s\""),
            "test.toml:1: sensor[0].set: expected either `set` (a set of the reduced model) or "
            "`position`");
  EXPECT_EQ(refusal("[[sensor]]\nset = \"s\"\nposition = [0, 0, 0]"),
            "test.toml:2: sensor[0].set: expected either `set` (a set of the reduced model) or "
            "`position`");
  EXPECT_EQ(refusal("[[panel]]\nname = \"p\"\ndirection = [0, 0, 0]"),
            "test.toml:3: panel[0].direction: found a zero vector, expected a direction");
  EXPECT_EQ(refusal("[lines]\nfrequencies_hz = [-5]"),
            "test.toml:2: lines.frequencies_hz: found -5, expected more than 0");
  EXPECT_EQ(refusal("[air]\ndensity = 0"),
            "test.toml:2: air.density: found 0, expected a number above 0");
  EXPECT_EQ(refusal("[lines]\nquantities = [\"speed\"]"),
            "test.toml:2: lines.quantities: found \"speed\", expected displacement, velocity, "
            "acceleration or normal_velocity");
  EXPECT_EQ(refusal("[frames]\nquantities = []"),
            "test.toml:2: frames.quantities: found none, expected at least one");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\ncycles = 2\nto_deg = 5"),
            "test.toml:4: window[0].to_deg: found with cycles, expected one of them");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\nsegment_s = 0.1\ndomain = \"angle\""),
            "test.toml:3: window[0].segment_s: found in a window over the angle, expected "
            "segment_deg");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\nsegment_s = 0.1\nsegment_deg = 20"),
            "test.toml:3: window[0].segment_s: found with segment_deg, expected one of them");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\noverlap = 1"),
            "test.toml:3: window[0].overlap: found 1, expected a number at least 0 and at most "
            "0.95");
  EXPECT_EQ(refusal("[[window]]\nname = \"w\"\n[[window]]\nname = \"w\""),
            "test.toml:4: window[1].name: found 'w' a second time, expected different names");
  EXPECT_EQ(refusal("[output]\nskin = false"),
            "test.toml:2: output.skin: found false with frames or lines, which need the geometry, "
            "expected frames.on = false and lines.strongest = 0");
  EXPECT_NO_THROW(read(""));
  EXPECT_NE(options_help().find("velocity_reference = 5e-08"), std::string::npos);
}

TEST(Options, ResolvedTextReadsBackToTheSameChoices) {
  const auto again = [](const Options& options) {
    return resolved_text(read_options(Config::parse(resolved_text(options), "resolved")));
  };
  EXPECT_EQ(again(Options{}), resolved_text(Options{}));
  const Options chosen = read_options(Config::parse(
      "body = \"piston\"\n[frames]\nfrom_s = 0.01\nto_s = 0.02\nstep_s = 1e-4\n[lines]\norders = "
      "[2, 4.5]\n"
      "[[window]]\nname = \"w\"\ntaper = \"hann\"\ndomain = \"angle\"\nsegment_deg = "
      "30\noverlap = 0.2\n[output]\nsamples = false\nprecision = \"single\"\n[[sensor]]\nname = "
      "\"p\"\nposition = [1, 2, 3]\n"
      "[[panel]]\nname = \"top\"\ndirection = [0, 0, 1]\nangle_deg = 30\nexposed = true\n"
      "surfaces = [\"deck\", \"liner_4\"]\n",
      "chosen"));
  EXPECT_EQ(again(chosen), resolved_text(chosen));
  EXPECT_NE(resolved_text(chosen).find("step_s = 0.0001"), std::string::npos);
}

}  // namespace
}  // namespace clatter::recover
