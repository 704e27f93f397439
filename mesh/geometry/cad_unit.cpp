// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/cad_unit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::mesh {
namespace {

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(
        fmt::format("{}: {}", path.string(),
                    std::filesystem::exists(path) ? "cannot be read" : "file not found"));
  return {std::istreambuf_iterator<char>(file), {}};
}

// The quoted name of CONVERSION_BASED_UNIT('INCH', ...), else the prefix of SI_UNIT.
std::string unit_of_statement(const std::string& statement) {
  const size_t named = statement.find("CONVERSION_BASED_UNIT('");
  if (named != std::string::npos) {
    const size_t begin = statement.find('\'', named) + 1;
    std::string name = statement.substr(begin, statement.find('\'', begin) - begin);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name;
  }
  if (statement.find("SI_UNIT(") == std::string::npos) return "";
  constexpr std::array<std::pair<const char*, const char*>, 5> kPrefixes = {{{".MILLI.", "mm"},
                                                                             {".CENTI.", "cm"},
                                                                             {".DECI.", "dm"},
                                                                             {".MICRO.", "um"},
                                                                             {".KILO.", "km"}}};
  for (const auto& [prefix, unit] : kPrefixes)
    if (statement.find(prefix) != std::string::npos) return unit;
  return "m";
}

// A file in inches also has the millimetre that defines them: a named unit has priority.
std::string step_unit(const std::string& text) {
  std::string si;
  for (size_t at = text.find("LENGTH_UNIT"); at != std::string::npos;
       at = text.find("LENGTH_UNIT", at + 1)) {
    const size_t before = text.rfind(';', at), begin = before == std::string::npos ? 0 : before + 1;
    std::string statement = text.substr(begin, text.find(';', at) - begin);
    std::erase_if(statement, [](unsigned char c) { return std::isspace(c) != 0; });
    const std::string unit = unit_of_statement(statement);
    if (statement.find("CONVERSION_BASED_UNIT") != std::string::npos) return unit;
    if (si.empty()) si = unit;
  }
  return si;
}

// Columns 1 to 72 of the lines with a G in column 73.
std::string iges_global_section(const std::string& text) {
  std::string section;
  size_t begin = 0;
  while (begin < text.size()) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.size() > 72 && line[72] == 'G') section += line.substr(0, 72);
    if (line.size() > 72 && line[72] == 'D') break;
    begin = end + 1;
  }
  return section;
}

// Parameters are separated by commas, texts begin with their length: 4HINCH.
std::vector<std::string> iges_parameters(const std::string& section) {
  std::vector<std::string> parameters(1);
  size_t i = 0;
  while (i < section.size() && section[i] != ';') {
    std::string& now = parameters.back();
    const bool counted =
        section[i] == 'H' && !now.empty() && std::all_of(now.begin(), now.end(), [](char c) {
          return std::isdigit(static_cast<unsigned char>(c)) != 0;
        });
    if (counted && now.size() < 6) {
      const size_t length = std::stoul(now);
      now = section.substr(i + 1, length);
      i += 1 + length;
      if (i < section.size() && section[i] == ',') parameters.emplace_back();
      ++i;
    } else {
      if (section[i] == ',')
        parameters.emplace_back();
      else if (section[i] != ' ')
        now += section[i];
      ++i;
    }
  }
  return parameters;
}

std::string iges_unit(const std::string& text) {
  constexpr std::array<const char*, 11> kFlags = {"inch", "mm",  "",   "foot", "mile",     "m",
                                                  "km",   "mil", "um", "cm",   "microinch"};
  const std::vector<std::string> parameters = iges_parameters(iges_global_section(text));
  if (parameters.size() < 14) return "";
  for (size_t flag = 1; flag <= kFlags.size(); ++flag)
    if (parameters[13] == std::to_string(flag)) return kFlags[flag - 1];
  return "";
}

}  // namespace

bool is_cad(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".step" || extension == ".stp" || extension == ".brep" ||
         extension == ".iges" || extension == ".igs";
}

std::string cad_unit(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".step" || extension == ".stp") return step_unit(text_of(path));
  if (extension == ".iges" || extension == ".igs") return iges_unit(text_of(path));
  return "";
}

}  // namespace clatter::mesh
