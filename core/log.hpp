#pragma once
// What a stage tells its user: plain lines on stderr; stdout is kept for results and --json.
#include <string>

namespace clatter {

/// A line of information; silent with --quiet.
void say(const std::string& line);
/// A warning; shown even with --quiet.
void warn(const std::string& line);
void set_quiet(bool quiet);
bool is_quiet();

}  // namespace clatter
