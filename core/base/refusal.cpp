// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/refusal.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <filesystem>

#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"

namespace clatter {
namespace {

/// Parses a leading ":12"; 0 when there is none.
int64_t take_number(std::string_view& text) {
  int64_t value = 0;
  if (!text.starts_with(':')) return 0;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + text.size(), value);
  if (error != std::errc() || value < 1) return 0;
  text.remove_prefix(static_cast<size_t>(end - text.data()));
  return value;
}

}  // namespace

ErrorPosition position_in(const std::string& message) {
  ErrorPosition found;
  std::error_code ignored;
  size_t colon = message.find(':');
  for (; colon != std::string::npos; colon = message.find(':', colon + 1)) {
    const std::filesystem::path path = message.substr(0, colon);
    if (is_planned(path) || std::filesystem::is_regular_file(path, ignored)) break;
  }
  if (colon == std::string::npos) return found;
  found.file = message.substr(0, colon);
  std::string_view rest = std::string_view(message).substr(colon);
  found.line = take_number(rest);
  take_number(rest);  // the column
  if (!rest.starts_with(": ")) return found;
  rest.remove_prefix(2);
  const std::string_view first = rest.substr(0, std::min(rest.find(": "), rest.size()));
  if (first.size() < rest.size() && first.find(' ') == std::string_view::npos) found.place = first;
  return found;
}

int report_error(std::string_view program, const std::string& message, ExitCode code) {
  std::fputs(fmt::format("{}: error: {}\n", program, message).c_str(), stderr);
  if (!is_json()) return static_cast<int>(code);
  const ErrorPosition at = position_in(message);
  JsonMembers members = {{"program", json_text(std::string(program))},
                         {"message", json_text(message)}};
  if (!at.file.empty()) members.emplace_back("file", json_text(at.file));
  if (at.line > 0) members.emplace_back("line", std::to_string(at.line));
  if (!at.place.empty()) members.emplace_back("place", json_text(at.place));
  members.emplace_back("exit_code", std::to_string(static_cast<int>(code)));
  print_json({{"error", json_object(members)}});
  return static_cast<int>(code);
}

}  // namespace clatter
