// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>

#include "core/base/error.hpp"

namespace clatter::mesh {
namespace {

// Nodes of Gmsh's element types 1, 2, ...
constexpr std::array<int, 31> kNodes = {2,  3,  4,  4, 8,  6,  5,  3,  6,  9, 10, 27, 18, 14, 1, 8,
                                        20, 15, 13, 9, 10, 12, 15, 15, 21, 4, 5,  6,  20, 35, 56};

class Scanner {
 public:
  Scanner(std::istream& file, const std::string& path) : path_(path), file_(file) {}

  MshScan run() {
    read_format();
    for (std::string line; next_line(line);) {
      if (line == "$PhysicalNames") read_names();
      if (line == "$Nodes") scan_.nodes = count_nodes();
      if (line == "$Elements" && scan_.version == 2) scan_.binary ? read_binary() : read_text();
    }
    return std::move(scan_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", path_, what));
  }

  bool next_line(std::string& line) {
    if (!std::getline(file_, line)) return false;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return true;
  }

  std::string line_of(const char* section) {
    std::string line;
    if (!next_line(line)) fail(fmt::format("found the end of the file in {}", section));
    return line;
  }

  int64_t count_of(const char* section) {
    const std::string line = line_of(section);
    char* end = nullptr;
    const long long count = std::strtoll(line.c_str(), &end, 10);
    if (end == line.c_str() || count < 0)
      fail(fmt::format("{}: found '{}', expected a count", section, line.substr(0, 40)));
    return count;
  }

  // MSH 4 begins with the number of blocks.
  int64_t count_nodes() {
    if (scan_.version == 2) return count_of("$Nodes");
    if (!scan_.binary) {
      std::istringstream line(line_of("$Nodes"));
      int64_t blocks = 0, nodes = -1;
      line >> blocks >> nodes;
      if (!line || nodes < 0) fail("$Nodes: found no counts of blocks and nodes");
      return nodes;
    }
    uint64_t counts[2];
    if (!file_.read(reinterpret_cast<char*>(counts), sizeof counts))
      fail("found the end of the file in $Nodes");
    return static_cast<int64_t>(counts[1]);
  }

  void read_format() {
    if (line_of("line 1") != "$MeshFormat")
      fail("found no $MeshFormat in line 1, expected a Gmsh MSH file of version 2 or 4");
    std::istringstream line(line_of("$MeshFormat"));
    line.imbue(std::locale::classic());  // "2.2" is 22 in German (hard case P13)
    double version = 0.0;
    int kind = -1, bytes = 0;
    line >> version >> kind >> bytes;
    const bool known = (version >= 2.0 && version < 3.0) || (version >= 4.0 && version < 5.0);
    if (!known || (kind != 0 && kind != 1))
      fail(fmt::format("found MSH version {} of kind {}, expected 2 or 4, 0 (text) or 1 (binary)",
                       version, kind));
    scan_.version = static_cast<int>(version);
    scan_.binary = kind == 1;
    if (scan_.binary && read_int() != 1)
      fail("found binary numbers of another byte order, expected those of this machine");
  }

  void read_names() {
    const int64_t count = count_of("$PhysicalNames");
    for (int64_t i = 0; i < count; ++i) {
      const std::string text = line_of("$PhysicalNames");
      std::istringstream line(text);
      MshGroupName group{-1, 0, {}};
      line >> group.dim >> group.number;
      const size_t first = text.find('"'), last = text.rfind('"');
      if (!line || group.dim < 0 || group.dim > 3 || first == std::string::npos || last <= first)
        fail(fmt::format("$PhysicalNames: found '{}', expected: dimension number \"name\"",
                         text.substr(0, 60)));
      group.name = text.substr(first + 1, last - first - 1);
      scan_.names.push_back(group);
    }
  }

  void add(uint64_t element, long long group) {
    if (group < -std::numeric_limits<int>::max() || group > std::numeric_limits<int>::max())
      fail(
          fmt::format("element {}: found the group {}, expected a smaller number", element, group));
    const auto [at, is_new] = scan_.group_of.emplace(element, static_cast<int>(std::abs(group)));
    if (!is_new) fail(fmt::format("found two elements with the number {}", element));
  }

  void read_text() {
    const int64_t count = count_of("$Elements");
    for (int64_t i = 0; i < count; ++i) {
      const std::string text = line_of("$Elements");
      const char* at = text.c_str();
      const auto next = [&] {
        char* end = nullptr;
        const long long value = std::strtoll(at, &end, 10);
        if (end == at)
          fail(fmt::format("$Elements: found '{}', expected number, type, tags and nodes",
                           text.substr(0, 60)));
        at = end;
        return value;
      };
      const long long element = next();
      next();  // type
      const long long tags = next();
      if (element <= 0) fail(fmt::format("found element {}, expected a number > 0", element));
      add(static_cast<uint64_t>(element), tags > 0 ? next() : 0);
    }
  }

  int read_int() {
    int value = 0;
    if (!file_.read(reinterpret_cast<char*>(&value), sizeof value))
      fail("found the end of the file within binary numbers");
    return value;
  }

  void read_binary() {
    const int64_t count = count_of("$Elements");
    for (int64_t done = 0; done < count;) {
      const int type = read_int(), follow = read_int(), tags = read_int();
      if (type < 1 || type > static_cast<int>(kNodes.size()) || follow < 1 ||
          follow > count - done || tags < 0 || tags > 1000)
        fail(fmt::format("$Elements: found a block of type {}, {} elements, {} tags", type, follow,
                         tags));
      const int rest = kNodes[type - 1] + std::max(tags - 1, 0);
      for (int i = 0; i < follow; ++i) {
        const int element = read_int();
        if (element <= 0) fail(fmt::format("found element {}, expected a number > 0", element));
        add(static_cast<uint64_t>(element), tags > 0 ? read_int() : 0);
        file_.ignore(rest * static_cast<std::streamsize>(sizeof(int)));
      }
      done += follow;
    }
  }

  std::string path_;
  std::istream& file_;
  MshScan scan_;
};

}  // namespace

MshScan scan_msh(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(fmt::format("{}: file not found", path.string()));
  return scan_msh(file, path.string());
}

MshScan scan_msh(std::istream& file, const std::string& name) { return Scanner(file, name).run(); }

}  // namespace clatter::mesh
