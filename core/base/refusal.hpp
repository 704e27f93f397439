// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// How a program reports the error that ends it: a line on stderr, with --json also an object on
// stdout.
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace clatter {

/// Position named by an error message, "file:line:column: place: what is wrong", all but the file
/// optional.
struct ErrorPosition {
  std::string file;   // one that exists or is a registered input or output; else empty
  int64_t line = 0;   // from 1; 0: none given
  std::string place;  // one word: key, dataset or group; else empty
};
ErrorPosition position_in(const std::string& message);

/// Prints "`program`: error: `message`" on stderr; with --json (core/base/log.hpp) also, on stdout,
/// {"error": {"program", "message", "file", "line", "place", "exit_code"}} without members that the
/// message does not give. Returns the exit code.
int report_error(std::string_view program, const std::string& message, ExitCode code);

}  // namespace clatter
