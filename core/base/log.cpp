// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <utility>

namespace clatter {
namespace {

bool quiet_flag = false;
bool json_flag = false;

LogSink& sink() {
  static LogSink instance;
  return instance;
}

spdlog::logger& logger() {
  static const auto instance = [] {
    auto made = spdlog::stderr_color_st("clatter");
    made->set_pattern("%v");
    return made;
  }();
  return *instance;
}

}  // namespace

void say(const std::string& line) {
  if (sink()) return sink()(false, line);
  if (!quiet_flag) logger().info(line);
}

void warn(const std::string& line) {
  if (sink()) return sink()(true, line);
  logger().warn("warning: " + line);
}

void print_result(const std::string& line) {
  if (json_flag || sink()) return say(line);  // stdout of a child process is captured
  std::fputs((line + "\n").c_str(), stdout);
}

void set_json(bool json) { json_flag = json; }

bool is_json() { return json_flag; }

void set_quiet(bool quiet) { quiet_flag = quiet; }

bool is_quiet() { return quiet_flag; }

void set_log_sink(LogSink chosen) { sink() = std::move(chosen); }

}  // namespace clatter
