// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Output to the user: results on stdout, progress and warnings on stderr.
#include <functional>
#include <string>

namespace clatter {

/// A line of information; silent with --quiet.
void say(const std::string& line);
/// A warning; shown even with --quiet.
void warn(const std::string& line);
/// A line of the result. On stdout, also with --quiet, so that
/// `clatter-modal part.fe.h5 -o part.modes.h5 --quiet | awk` receives only results. With --json,
/// stdout has only the JSON line, and this behaves like say().
void print_result(const std::string& line);
void set_json(bool json);
bool is_json();
void set_quiet(bool quiet);
bool is_quiet();

/// From now on lines go to `sink` instead of stderr, quiet or not: a child process forwards them to
/// its parent.
using LogSink = std::function<void(bool warning, const std::string& line)>;
void set_log_sink(LogSink sink);

}  // namespace clatter
