// SPDX-License-Identifier: GPL-3.0-or-later
// What a run says of its accuracy, and the name of a file that must not be trusted.
#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/error.hpp"
#include "dynamics/run/run_file.hpp"
#include "dynamics/run/run_summary.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

TEST(AccuracyWarnings, NameTheScaleThatIsTooCoarse) {
  const auto line = [](double own) {
    return accuracy_warnings({{"block", 1e-3, 0.04, 0.05, own}}, Accuracy{}, 100).front();
  };
  // 0.1 or 0.02 m/s, times 0.01 / (0.05 * 100 steps * sqrt(0.04 / 0.01)).
  EXPECT_NE(line(0.0).find("[accuracy] is too coarse; set velocity_m_s = 1.0e-04 there"),
            std::string::npos)
      << line(0.0);
  EXPECT_NE(
      line(0.02).find("the body's own velocity_m_s is too coarse; set velocity_m_s = 2.0e-05"),
      std::string::npos)
      << line(0.02);
}

TEST(RunFiles, ARunThatMustNotBeTrustedIsKeptUnderANameOfItsOwn) {
  RunResult result;
  result.complete = true;
  result.energy_residue = 0.1;  // warned of
  EXPECT_EQ(written_file("a/b.run.h5", result), "a/b.run.h5");
  EXPECT_TRUE(is_finished(result));
  EXPECT_NO_THROW(require_finished(result, "a/b.run.h5"));
  result.energy_residue = 0.9;
  EXPECT_EQ(written_file("a/b.run.h5", result), "a/b.run.refused.h5");
  EXPECT_FALSE(is_finished(result));  // for make it is still to be done
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { require_finished(result, "a/b.run.h5"); }),
      {"a/b.run.refused.h5: energy_residue is 0.9, good up to 0.01, refused above 0.5"});
}

}  // namespace
}  // namespace clatter::dynamics
