#pragma once
// What --json prints: one JSON object a line on stdout.
#include <string>
#include <utility>
#include <vector>

namespace clatter {

/// (key, value) pairs of an object; values are already JSON text.
using JsonMembers = std::vector<std::pair<std::string, std::string>>;

/// A text as a JSON string with quotes; a number as JSON, null when it is not finite.
std::string json_text(const std::string& text);
std::string json_number(double value);
/// {"key": value, ...} in the order given.
std::string json_object(const JsonMembers& members);
/// Prints such an object as one line on stdout.
void print_json(const JsonMembers& members);

}  // namespace clatter
