#pragma once
// What a stage tells its user: results on stdout, progress and warnings on stderr.
#include <functional>
#include <string>

namespace clatter {

/// A line of information; silent with --quiet.
void say(const std::string& line);
/// A warning; shown even with --quiet.
void warn(const std::string& line);
/// A line of the result: what the user ran the stage for. On stdout, also with --quiet, so that
/// `clatter-modal part.fe.h5 -o part.modes.h5 --quiet | awk` gets it and nothing else. With --json
/// stdout has the one JSON line alone, and this goes the way of say().
void print_result(const std::string& line);
void set_json(bool json);
bool is_json();
void set_quiet(bool quiet);
bool is_quiet();

/// From now on lines go to `sink` in place of stderr, quiet or not: a child process hands them to
/// its parent.
using LogSink = std::function<void(bool warning, const std::string& line)>;
void set_log_sink(LogSink sink);

}  // namespace clatter
