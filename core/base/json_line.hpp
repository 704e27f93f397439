// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Output of --json: one JSON object per line on stdout.
#include <string>
#include <utility>
#include <vector>

namespace clatter {

/// (key, value) pairs of an object; values are already JSON text.
using JsonMembers = std::vector<std::pair<std::string, std::string>>;

/// A quoted JSON string, bytes that are not UTF-8 replaced by U+FFFD; a number as JSON, null when
/// it is not finite.
std::string json_text(const std::string& text);
std::string json_number(double value);
/// {"key": value, ...} in the given order.
std::string json_object(const JsonMembers& members);
/// Prints an object as one line on stdout.
void print_json(const JsonMembers& members);

}  // namespace clatter
