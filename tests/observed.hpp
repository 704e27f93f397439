// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a hard case did: expectations that also print the figure and its limit, for the page of
// `make hard`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace clatter::test {

/// One line of the page: `[ observed ] refused: ...`.
inline void observed(const std::string& what) { fmt::print("[ observed ] {}\n", what); }

/// Expects value <= limit (NaN fails) and prints `[ observed ] largest residual: 2e-13 (at most
/// 1e-09)`.
inline void expect_at_most(const std::string& what, double value, double limit) {
  observed(fmt::format("{}: {:.3g} (at most {:.3g})", what, value, limit));
  EXPECT_LE(value, limit) << what;
}

/// Expects value >= limit (NaN fails) and prints `[ observed ] smallest MAC: 1 (at least 0.9)`.
inline void expect_at_least(const std::string& what, double value, double limit) {
  observed(fmt::format("{}: {:.3g} (at least {:.3g})", what, value, limit));
  EXPECT_GE(value, limit) << what;
}

}  // namespace clatter::test
