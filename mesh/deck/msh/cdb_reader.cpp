// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/cdb_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <unordered_map>

#include "core/base/error.hpp"
#include "mesh/deck/field_text.hpp"
#include "mesh/deck/msh/cdb_elements.hpp"
#include "mesh/deck/msh/cdb_materials.hpp"
#include "mesh/deck/msh/text_lines.hpp"

namespace clatter::mesh {
namespace {

constexpr int kPoint = 15;  // Gmsh's type
constexpr size_t kMostCdbNodes = 20;
constexpr int kMostNumber = 30000;                // of a material or element type
constexpr size_t kMostMembers = size_t{1} << 26;  // of all components: half a gigabyte

std::vector<std::string> fields_of(std::string_view text) {
  std::vector<std::string> fields;
  while (true) {
    const size_t comma = text.find(',');
    fields.emplace_back(deck::trimmed(text.substr(0, comma)));
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

// "(3i9,6e21.13e3)": columns of an integer, how many, columns of a real.
struct Format {
  size_t integers = 0, integer_width = 0, real_width = 0;
};

Format format_of(const TextLines& line) {
  Format format;
  std::string text;
  for (const char c : line.trimmed_text())
    if (c != '(' && c != ')' && c != ' ') text += c;
  size_t real_count = 0;
  for (const std::string& part : fields_of(text)) {
    const size_t letter = part.find_first_of("iIeEgG");
    if (letter == std::string::npos) line.fail("expected a format, as (3i9,6e21.13e3)");
    const size_t count = letter == 0 ? 1 : static_cast<size_t>(std::atoi(part.c_str()));
    const auto width = static_cast<size_t>(std::atoi(part.c_str() + letter + 1));
    const bool integer = part[letter] == 'i' || part[letter] == 'I';
    (integer ? format.integers : real_count) = count;
    (integer ? format.integer_width : format.real_width) = width;
  }
  if (format.integers == 0 || format.integer_width == 0 || format.integer_width > 40)
    line.fail("expected a format, as (3i9,6e21.13e3) or (19i10)");
  return format;
}

struct CdbElement {
  size_t tag;
  int material, type;
  std::vector<size_t> nodes;
  std::string where;
};

class CdbReader {
 public:
  CdbReader(std::istream& file, std::string name, const std::vector<std::string>& ignore)
      : lines_(file, std::move(name)) {
    for (const std::string& one : ignore) {
      const size_t digit = one.find_first_of("0123456789");
      if (digit != std::string::npos) ignored_.insert(std::atoi(one.c_str() + digit));
    }
    out_.scan.version = 4;
  }

  ForeignMesh run() {
    while (lines_.next()) read_command();
    if (elements_.empty()) lines_.fail("found no EBLOCK with elements, expected some");
    std::map<int, std::set<int>> types_of;  // by material
    for (const CdbElement& element : elements_)
      if (is_cdb_solid(routine_of(element))) types_of[element.material].insert(element.type);
    for (const CdbElement& element : elements_) add(element, types_of[element.material].size() > 1);
    add_components();
    out_.contents.elements = tables_.finish();
    out_.scan.nodes = static_cast<int64_t>(out_.contents.node_tags.size());
    note_left_out();
    return std::move(out_);
  }

 private:
  void read_command() {
    const std::string_view text = lines_.trimmed_text();
    if (text.empty() || text.front() == '!' || text.front() == '/') return;
    const std::vector<std::string> fields = fields_of(text.substr(0, text.find('!')));
    const std::string command = deck::capitals(fields[0]);
    const auto integer = [&](size_t i, const char* what) {
      const auto value = i < fields.size() ? deck::to_integer(fields[i]) : std::nullopt;
      if (!value) lines_.fail(fmt::format("{}: found no {} in field {}", command, what, i + 1));
      return *value;
    };
    if (command == "NBLOCK") return read_nodes();
    if (command == "EBLOCK") return read_elements(fields);
    if (command == "CMBLOCK") return read_component(fields);
    if (command == "ET") {
      routines_[integer(1, "number")] = integer(2, "element type");
    } else if ((command == "KEYOPT" || command == "KEYOP") && integer(2, "key") == 2) {
      keyopts_[integer(1, "number of an element type")] = integer(3, "value");
    } else if (command == "MP") {
      materials_.read_mp(lines_, fields);
    } else if (command == "MPDATA") {
      materials_.read_mpdata(lines_, fields);
    } else if (changes_model(command)) {
      ++left_out_[command];
    }
  }

  // Supports, loads, constraints, contact and what is beside the solids' material.
  static bool changes_model(const std::string& command) {
    static const std::set<std::string> kCommands = {
        "D",  "F",      "SFE",   "SF",   "BF",       "BFE",     "CP",
        "CE", "CERIG",  "RBE3",  "ACEL", "OMEGA",    "TB",      "TBDATA",
        "M",  "NROTAT", "LOCAL", "CS",   "SFEBLOCK", "BFBLOCK", "NMODIF"};
    return kCommands.contains(command);
  }

  bool at_end() const {
    const std::string_view text = lines_.trimmed_text();
    return text == "-1" || text.starts_with("N,") || text.starts_with("END");
  }

  void read_nodes() {
    lines_.require("a format");
    const Format format = format_of(lines_);
    const size_t first = format.integers * format.integer_width;
    if (format.real_width == 0) lines_.fail("expected a format with real numbers");
    while (true) {
      lines_.require("a node or -1");
      if (at_end()) return;
      const int64_t number = lines_.integer(0, format.integer_width, "the number of a node");
      if (number < 0) return;
      out_.contents.node_tags.push_back(static_cast<size_t>(number));
      for (size_t k = 0; k < 3; ++k)
        out_.contents.coordinates.push_back(
            lines_.real(first + k * format.real_width, format.real_width, "a coordinate"));
    }
  }

  void read_elements(const std::vector<std::string>& command) {
    if (command.size() < 3 || deck::capitals(command[2]) != "SOLID")
      lines_.fail(
          "found EBLOCK without SOLID, expected the form of solids: CDWRITE, DB with "
          "blocked elements writes it");
    lines_.require("a format");
    const Format format = format_of(lines_);
    const auto at = [&](size_t i, const char* what) {
      return lines_.integer(i * format.integer_width, format.integer_width, what);
    };
    while (true) {
      lines_.require("an element or -1");
      if (at_end()) return;
      CdbElement element;
      element.where = lines_.where();
      const int64_t material = at(0, "a material"), type = at(1, "an element type");
      if (material < 0) return;
      if (material > kMostNumber || type < 0 || type > kMostNumber)
        lines_.fail(fmt::format("found material {} and type {}, expected numbers up to {}",
                                material, type, kMostNumber));
      element.material = static_cast<int>(material);
      element.type = static_cast<int>(type);
      const int64_t count = at(8, "the number of nodes");
      element.tag = static_cast<size_t>(at(10, "the number of an element"));
      if (count < 1 || count > static_cast<int64_t>(kMostCdbNodes))
        lines_.fail(fmt::format("found {} nodes, expected 1 to {}", count, kMostCdbNodes));
      constexpr size_t kFirst = 11;  // fields before the nodes
      size_t field = kFirst;
      for (int64_t i = 0; i < count; ++i, ++field) {
        if (field == format.integers) {
          lines_.require("more nodes");
          field = 0;
        }
        element.nodes.push_back(static_cast<size_t>(at(field, "a node")));
      }
      elements_.push_back(std::move(element));
    }
  }

  // Numbers; a negative one ends a range.
  void read_component(const std::vector<std::string>& command) {
    if (command.size() < 4) lines_.fail("CMBLOCK: expected name, NODE or ELEM, how many");
    const std::string name = command[1];
    const std::string kind = deck::capitals(command[2]);
    const auto count = deck::to_integer(command[3]);
    if (!count || *count < 0) lines_.fail("CMBLOCK: expected how many numbers");
    lines_.require("a format");
    const Format format = format_of(lines_);
    std::vector<size_t>& members =
        (kind.starts_with("NODE") ? node_components_ : element_components_)[name];
    for (int32_t i = 0; i < *count; ++i) {
      const size_t field = static_cast<size_t>(i) % format.integers;
      if (field == 0) lines_.require("numbers of a component");
      const int64_t number =
          lines_.integer(field * format.integer_width, format.integer_width, "a number");
      if (number < 0 && members.empty()) lines_.fail("found the end of a range without its start");
      if (number < 0) {
        const auto last = static_cast<size_t>(-number);
        if (last > members.back()) members_ += last - members.back();
        if (members_ > kMostMembers) lines_.fail("found too many members of components");
        for (size_t k = members.back() + 1; k <= last; ++k) members.push_back(k);
      } else {
        members.push_back(static_cast<size_t>(number));
      }
    }
  }

  int routine_of(const CdbElement& element) const {
    const auto found = routines_.find(element.type);
    if (found == routines_.end())
      throw InputError(fmt::format("{}: element {} has the type {}, which no ET defines",
                                   element.where, element.tag, element.type));
    return found->second;
  }

  void add(const CdbElement& element, bool several_types) {
    const int routine = routine_of(element);
    if (!is_cdb_solid(routine)) {
      if (!ignored_.contains(routine))
        throw InputError(
            fmt::format("{}: element {} has the type {}, expected SOLID185, 186 or 187 (or 45, 92, "
                        "95); --ignore "
                        "{} leaves out all of these, and their stiffness and mass: [[spring]], "
                        "[[coupling]] and "
                        "[[point_mass]] of the recipe replace them",
                        element.where, element.tag, routine, routine));
      ++out_.ignored[fmt::format("elements of type {}", routine)];
      return;
    }
    const auto cell = cdb_cell(routine, element.nodes);
    if (!cell)
      throw InputError(
          fmt::format("{}: element {} of SOLID{} has {} nodes, expected 8, 20 or (SOLID187) 10 and "
                      "none omitted",
                      element.where, element.tag, routine, element.nodes.size()));
    const int group =
        several_types ? element.material * (kMostNumber + 1) + element.type : element.material;
    std::string& name = region_names_[group];
    if (name.empty()) {
      name = fmt::format("mat_{}", element.material);
      if (several_types) name += fmt::format("_type_{}", element.type);
      deck::Region& region = out_.regions[name];
      region.where = element.where;
      if (materials_.has(element.material)) {
        const deck::Material material = materials_.material(element.material);
        region.material = material.name;
        out_.materials[material.name] = material;
      }
    }
    const auto keyopt = keyopts_.find(element.type);
    const deck::Formulation formulation =
        cdb_formulation(routine, keyopt == keyopts_.end() ? 0 : keyopt->second, cell->type);
    if (formulation != deck::Formulation::kDefault)
      out_.regions[name].formulation[cell->type] = formulation;
    group_of_element_[element.tag] = group;
    ++cells_in_[group];
    tables_.add(3, traits(cell->type).gmsh_type, fmt::format("SOLID{}", routine), {group},
                element.tag, cell->nodes);
  }

  void add_components() {
    name_regions();
    for (const auto& [group, name] : region_names_) out_.scan.names.push_back({3, group, name});
    std::map<size_t, std::vector<int>> groups_of;
    int number = 0;
    for (const auto& [name, members] : node_components_) {
      out_.scan.names.push_back({0, ++number, name});
      for (const size_t node : members) groups_of[node].push_back(number);
    }
    for (auto& [node, groups] : groups_of) {
      groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
      tables_.add(0, kPoint, "Point", groups, node, {node});
    }
  }

  // A component of one complete region names it; one that cuts regions is left out.
  void name_regions() {
    std::vector<std::string> left;
    for (const auto& [name, members] : element_components_) {
      std::map<int, int64_t> found;
      for (const size_t tag : members) {
        const auto group = group_of_element_.find(tag);
        if (group != group_of_element_.end()) ++found[group->second];
      }
      const bool one = found.size() == 1 &&
                       found.begin()->second == cells_in_[found.begin()->first] &&
                       !out_.regions.contains(name);
      if (!one) {
        left.push_back(name);
        continue;
      }
      std::string& region = region_names_[found.begin()->first];
      auto node = out_.regions.extract(region);
      node.key() = name;
      out_.regions.insert(std::move(node));
      region = name;
    }
    if (!left.empty())
      out_.notes.push_back(
          fmt::format("{}: components of elements that are not one complete material "
                      "are left out: {}",
                      lines_.where(), fmt::join(left, ", ")));
  }

  void note_left_out() {
    if (left_out_.empty()) return;
    std::vector<std::string> all;
    for (const auto& [command, count] : left_out_)
      all.push_back(fmt::format("{} ({})", command, count));
    out_.notes.push_back(
        fmt::format("{}: mesh and materials are read; left out are {}: write [[support]], "
                    "[[load]], [[coupling]], "
                    "[[equation]] of the recipe instead",
                    lines_.where(), fmt::join(all, ", ")));
  }

  TextLines lines_;
  std::set<int> ignored_;  // element types
  ForeignMesh out_;
  ElementTables tables_;
  std::vector<CdbElement> elements_;
  std::map<int, int> routines_, keyopts_;  // ET: number -> type; its KEYOPT(2)
  CdbMaterials materials_;
  std::map<std::string, std::vector<size_t>> node_components_, element_components_;
  std::map<int, std::string> region_names_;  // by group
  std::map<int, int64_t> cells_in_;
  std::unordered_map<size_t, int> group_of_element_;
  std::map<std::string, int64_t> left_out_;
  size_t members_ = 0;  // of ranges of all components
};

}  // namespace

ForeignMesh read_cdb(const std::filesystem::path& path, const std::vector<std::string>& ignore) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: file not found", path.string()));
  return read_cdb(file, path.string(), ignore);
}

ForeignMesh read_cdb(std::istream& file, const std::string& name,
                     const std::vector<std::string>& ignore) {
  return CdbReader(file, name, ignore).run();
}

}  // namespace clatter::mesh
