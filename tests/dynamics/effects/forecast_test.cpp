// SPDX-License-Identifier: GPL-3.0-or-later
// What --effects predicts and prints, and the catalogue in docs/effects.md.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "dynamics/run/effect_report.hpp"
#include "dynamics/run/run_forecast.hpp"
#include "dynamics/scene/effect_catalogue.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/paths.hpp"

namespace clatter::dynamics {
namespace {

constexpr const char* kPlain = "[time]\ncycles = 2\n[accuracy]\ntolerance = 1e-3\n";

class EffectForecast : public testing::SlapScenes {};

const Effect& row(const RunForecast& forecast, const std::string& name) {
  for (const Effect& effect : forecast.effects.effects())
    if (effect.name == name) return effect;
  throw std::runtime_error(name);
}

// Contacts of the skirt differ with every rounding: counts are means over scenes that differ by
// less than anyone can measure.
TEST_F(EffectForecast, CountsOfAProbeAreThoseOfTheRun) {
  constexpr int kScenes = 4;
  double steps = 0.0, evaluations = 0.0;
  for (int k = 0; k < kScenes; ++k) {
    const Scene plain =
        scene(fmt::format("{}[contact]\nclearance_um = {}\n", kPlain, 20.0 + 1e-6 * k));
    RunResult result;
    testing::complete_file(plain, folder_ / fmt::format("plain_{}.run.h5", k), result);
    ProbeLimits limits;
    limits.seconds = 1e3;  // all of the cycle, however slow the machine
    const RunForecast found = probe_run(plain, load_bodies(plain), limits);
    const auto ratio = [](long long predicted, long long counted) {
      return static_cast<double>(predicted) / static_cast<double>(counted);
    };
    // The second cycle is taken as the first, a tenth stands for all of it.
    steps += ratio(found.statistics.accepted, result.statistics.accepted) / kScenes;
    evaluations += ratio(found.statistics.evaluations, result.statistics.evaluations) / kScenes;
    // A refused trial state ends an evaluation of all elements before the film's or after it.
    EXPECT_NEAR(ratio(row(found, "oil film").evaluations, found.statistics.evaluations), 1.0, 0.01);
    EXPECT_EQ(row(found, "mounts").evaluations, 0);
    EXPECT_EQ(row(found, "oil film").unknowns, 2 * 6 * 6);
  }
  EXPECT_NEAR(steps, 1.0, 0.25);
  EXPECT_NEAR(evaluations, 1.0, 0.3);
}

TEST_F(EffectForecast, AProbeEndsAtItsLimitsAndSaysWhatItSaw) {
  const Scene plain = scene(kPlain);
  ProbeLimits limits;
  limits.seconds = limits.of_run = 0.0;
  const RunForecast found = probe_run(plain, load_bodies(plain), limits);
  EXPECT_NE(found.source.find("a probe of 30 of 720 deg"), std::string::npos) << found.source;
  EXPECT_GT(found.statistics.accepted, 100);
  // Cycles that are recorded together have one model, whose operators are made once.
  const Scene both = scene("[time]\ncycles = 2\nrecord_cycles = 2\n[accuracy]\ntolerance = 1e-3\n");
  const RunForecast of_both = probe_run(both, load_bodies(both), limits);
  EXPECT_EQ(of_both.statistics.accepted, found.statistics.accepted);
  EXPECT_EQ(2 * of_both.statistics.operators, found.statistics.operators);
}

TEST_F(EffectForecast, TheRunOfTheSameSceneIsUsedAndNoOther) {
  const Scene plain = scene(kPlain);
  RunResult result;
  testing::complete_file(plain, folder_ / "plain.run.h5", result);
  const auto model = build_model(plain, load_bodies(plain));
  const auto found = measured_run(plain, *model, folder_ / "plain.run.h5");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->statistics.accepted, result.statistics.accepted);
  EXPECT_EQ(found->statistics.total_seconds, result.statistics.total_seconds);
  double sum = found->other_seconds;
  for (const Effect& effect : found->effects.effects()) sum += effect.seconds;
  EXPECT_NEAR(sum, result.statistics.element_seconds, 1e-9);
  const Scene other = scene("[time]\ncycles = 2\n[accuracy]\ntolerance = 2e-3\n");
  EXPECT_FALSE(measured_run(other, *model, folder_ / "plain.run.h5").has_value());
  EXPECT_FALSE(measured_run(plain, *model, folder_ / "none.run.h5").has_value());
}

TEST_F(EffectForecast, UnknownsOfTheRowsAreThoseOfTheModel) {
  for (const char* changes : {"", testing::kElasticBlock, "[rod]\nmodel = \"massless\"\n",
                              "[crank]\nspeed = \"free\"\npolar_kg_m2 = 1\n"}) {
    const Scene changed = scene(changes);
    const auto model = build_model(changed, load_bodies(changed));
    int64_t sum = 0;
    for (const Effect& effect : model->effects.effects()) {
      EXPECT_TRUE(effect.on || effect.unknowns == 0) << effect.name;
      sum += effect.unknowns;
    }
    EXPECT_EQ(sum, model->system.modes() + 2 * 6 * 6) << changes;
  }
}

TEST_F(EffectForecast, LinesFitATerminalAndHaveEachEffect) {
  const Scene plain = scene(kPlain);
  ProbeLimits limits;
  limits.seconds = limits.of_run = 0.0;
  const RunForecast forecast = probe_run(plain, load_bodies(plain), limits);
  std::string text;
  for (const std::string& line : effect_lines(forecast)) {
    EXPECT_LE(line.size(), 120u) << line;
    text += line + "\n";
  }
  for (const Effect& effect : forecast.effects.effects())
    EXPECT_NE(text.find((effect.on ? "on  " : "off ") + effect.name + ":"), std::string::npos)
        << effect.name;
  EXPECT_NE(text.find("on  oil film: 72 unknowns, "), std::string::npos) << text;
  EXPECT_NE(text.find("off friction factors: cost not known: off"), std::string::npos) << text;
}

TEST(EffectLines, AreWrappedBetweenWords) {
  EXPECT_EQ(wrapped("  one two three", 9, 4), (std::vector<std::string>{"  one two", "    three"}));
  EXPECT_EQ(wrapped("longer_than_that a", 5, 1),
            (std::vector<std::string>{"longer_than_that", " a"}));
}

TEST(EffectCatalogue, NamesEachEffectOnceAndCompletely) {
  std::set<std::string_view> names;
  for (const EffectFamily& family : effect_catalogue())
    for (const EffectEntry& entry : family.entries) {
      EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
      for (const std::string_view text : {entry.name, entry.equation, entry.needs, entry.key})
        EXPECT_FALSE(text.empty()) << entry.name;
    }
  EXPECT_GE(names.size(), 60u);
}

// Where this fails, the tables to put into the document are the expected text.
TEST(EffectCatalogue, IsThatOfTheDocument) {
  std::stringstream text;
  text << std::ifstream(CLATTER_SOURCE_DIR "/docs/effects.md").rdbuf();
  const std::string all = text.str(), begin = "<!-- catalogue -->\n\n", end = "<!-- end -->";
  const size_t first = all.find(begin), last = all.find(end);
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(last, std::string::npos);
  EXPECT_EQ(all.substr(first + begin.size(), last - first - begin.size()), effect_tables());
}

}  // namespace
}  // namespace clatter::dynamics
