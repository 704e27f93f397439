// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/gmsh_in_child.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "core/base/error.hpp"
#include "mesh/part/mesh_wire.hpp"

namespace clatter::mesh {
namespace {

constexpr std::string_view kInfo = "Info    : ";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    std::erase_if(line, [](unsigned char c) { return c < 0x20; });
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

// "std::__cxx11::basic_string<char, ...>" is shortened to std::string.
std::string shortened(std::string line) {
  const size_t from = line.find("std::__cxx11::basic_string<"), to = line.rfind(" >");
  if (from != std::string::npos && to != std::string::npos && to > from)
    line.replace(from, to + 2 - from, "std::string");
  return line.substr(0, 200);
}

// The last line that is not a progress message: "terminate called after throwing ...".
std::string last_words(const ChildEnd& end) {
  const std::vector<std::string> lines = lines_of(end.chatter);
  const auto at = std::find_if(lines.rbegin(), lines.rend(),
                               [](const std::string& line) { return !line.starts_with(kInfo); });
  return at == lines.rend() ? "" : shortened(*at);
}

}  // namespace

std::string last_step(const ChildEnd& end) {
  const std::vector<std::string> lines = lines_of(end.chatter);
  const auto at = std::find_if(lines.rbegin(), lines.rend(),
                               [](const std::string& line) { return line.starts_with(kInfo); });
  if (at == lines.rend()) return end.step.empty() ? "its start" : end.step;
  std::string news = at->substr(kInfo.size());
  if (news.starts_with('[')) news.erase(0, news.find(']') + 2);  // "[ 20%] Meshing ..."
  return news;
}

std::string describe_end(const ChildEnd& end, const ChildLimits& limits) {
  const std::string words = last_words(end);
  return fmt::format("gmsh {} at: {}{}", end.describe(limits), last_step(end),
                     words.empty() ? "" : fmt::format(" (last output: {})", words));
}

ChildLimits with_news(ChildLimits limits) {
  limits.doing = [](const ChildEnd& so_far) {
    constexpr size_t kWidth = 60;  // Gmsh's optimiser prints many numbers
    return fmt::format("mesh: still at: {:.{}}", last_step(so_far), kWidth);
  };
  return limits;
}

MshContents read_msh_contents(const std::filesystem::path& path, const ChildLimits& limits) {
  const ChildEnd end = run_in_child(with_news(limits), [&] {
    GmshSession session("msh");
    return to_wire(session.import_msh(path));
  });
  if (end.done()) return from_wire<MshContents>(end.result);
  const std::string what = fmt::format("{}: {}", path.string(), describe_end(end, limits));
  if (end.kind == ChildEnd::Kind::kTimeLimit || end.kind == ChildEnd::Kind::kMemoryLimit)
    throw NumericsError(what);
  throw InputError(what + ", expected a valid MSH file");
}

}  // namespace clatter::mesh
