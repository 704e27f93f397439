// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Messages of the errors that rejected input and failed computations end with.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::test {

/// The message of the error of type `Expected` that `action` ends with; "accepted" if it does not.
/// Errors of other types fail the test.
template <class Expected = InputError, class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const Expected& error) {
    return error.what();
  }
  return "accepted";
}

/// One line that contains all the parts.
inline void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' in: " << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << "one line: " << text;
}

}  // namespace clatter::test
