#pragma once
// How a program tells its user that it ends with an error: a line on stderr, with --json also an
// object on stdout.
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace clatter {

/// The place that the words of an error name, "file:line:column: place: what is wrong" with all but
/// the file optional.
struct ErrorPlace {
  std::string file;   // one that is there, or that the program was to read or write; else empty
  int64_t line = 0;   // from 1; 0: none said
  std::string place;  // key, dataset or group: one word; else empty
};
ErrorPlace place_of(const std::string& message);

/// Prints "`program`: error: `message`" on stderr; with --json (core/base/log.hpp) also, on stdout,
/// {"error": {"program", "message", "file", "line", "place", "exit_code"}} without the members that
/// the message does not say. Returns the exit code.
int report_error(std::string_view program, const std::string& message, ExitCode code);

}  // namespace clatter
