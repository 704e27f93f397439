#include "core/log.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

namespace clatter {
namespace {

bool quiet_flag = false;

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
  if (!quiet_flag) logger().info(line);
}

void warn(const std::string& line) { logger().warn("warning: " + line); }

void set_quiet(bool quiet) { quiet_flag = quiet; }

bool is_quiet() { return quiet_flag; }

}  // namespace clatter
