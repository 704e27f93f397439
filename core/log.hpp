#pragma once
// What a stage tells its user: plain lines on stderr; stdout is kept for results and --json.
#include <functional>
#include <string>

namespace clatter {

/// A line of information; silent with --quiet.
void say(const std::string& line);
/// A warning; shown even with --quiet.
void warn(const std::string& line);
void set_quiet(bool quiet);
bool is_quiet();

/// From now on lines go to `sink` in place of stderr, quiet or not: a child process hands them to
/// its parent.
using LogSink = std::function<void(bool warning, const std::string& line)>;
void set_log_sink(LogSink sink);

}  // namespace clatter
