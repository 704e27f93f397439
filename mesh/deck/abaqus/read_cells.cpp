// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/read_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/connector_kinds.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr std::array<std::pair<std::string_view, int>, 10> kPointTypes = {{{"MASS", 1},
                                                                           {"ROTARYI", 1},
                                                                           {"DCOUP3D", 1},
                                                                           {"SPRING1", 1},
                                                                           {"SPRING2", 2},
                                                                           {"SPRINGA", 2},
                                                                           {"DASHPOT1", 1},
                                                                           {"DASHPOT2", 2},
                                                                           {"DASHPOTA", 2},
                                                                           {kConnector, 2}}};

// Number of nodes of elements with one or two; 0 for other types.
int point_nodes(std::string_view type) {
  for (const auto& [name, nodes] : kPointTypes) {
    if (name == type) return nodes;
  }
  return 0;
}

// Numbers of nodes and elements are positive.
int32_t id_of(std::string_view field, const Lines& lines, std::string_view what) {
  const auto id = to_integer(field);
  if (!id || *id < 1) {
    lines.source().fail(lines.origin(),
                        fmt::format("found {}, expected {} (1 to 2147483647)", shown(field), what));
  }
  return *id;
}

int32_t node_of(std::string_view field, const Lines& lines) {
  return id_of(field, lines, "the number of a node");
}

// Takes "Bar-1." from "Bar-1.73", as Abaqus/CAE writes elements of the assembly; the number of the
// instance, 0 if there is none.
int32_t split_instance(std::string_view& node, Scope& scope) {
  const size_t dot = node.rfind('.');
  if (dot == std::string_view::npos) return 0;
  const std::string_view name = node.substr(0, dot);
  node.remove_prefix(dot + 1);
  std::vector<std::string>& names = scope.other_instances;
  const auto at = std::find(names.begin(), names.end(), name) - names.begin();
  if (at == std::ssize(names)) names.emplace_back(name);
  return static_cast<int32_t>(at + 1);
}

void read_node(const Lines& lines, const LocalSystem& system, char kind, NodeTable& nodes) {
  FieldWalk walk(lines.data());
  std::string_view field;
  walk.next(&field);
  nodes.ids.push_back(id_of(field, lines, "the number of a node"));
  nodes.origins.push_back(lines.origin());
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (double& x : at) {
    if (!walk.next(&field)) break;
    if (field.empty()) continue;
    const auto number = to_number(field);
    if (!number) {
      lines.source().fail(lines.origin(),
                          fmt::format("found {}, expected a coordinate", shown(field)));
    }
    x = *number;
  }
  if (kind != 'R' || !system.is_global()) at = system.global(cartesian(kind, at));
  nodes.xyz.insert(nodes.xyz.end(), at.begin(), at.end());
}

CellTable& table_of(Scope& scope, const SolidType& solid) {
  for (CellTable& table : scope.cells) {
    if (table.name == solid.name) return table;
  }
  scope.cells.emplace_back();
  CellTable& table = scope.cells.back();
  table.name = solid.name;
  table.type = solid.type;
  table.formulation = solid.formulation;
  return table;
}

// The name for `ignore` that skips extra nodes of an element, as CalculiX does.
constexpr const char* kExtraNodes = "EXTRA NODES";

// A number, then `n_nodes` nodes, over one or more lines.
class ElementWalk {
 public:
  ElementWalk(Lines& lines, std::string_view type, int n_nodes, Ignore& ignore)
      : lines_(lines), type_(type), n_nodes_(n_nodes), ignore_(ignore) {}

  // Calls begin(id, origin) and node(field) for each element of the table.
  template <class Begin, class Node>
  Lines::Kind run(const Begin& begin, const Node& node) {
    int missing = 0;
    Origin origin = lines_.origin();
    Lines::Kind kind = lines_.next();
    for (; kind == Lines::Kind::kData; kind = lines_.next()) {
      FieldWalk walk(lines_.data());
      std::string_view field;
      while (walk.next(&field)) {
        if (missing == 0) {
          if (origin == lines_.origin()) {
            refuse_extra();
            break;
          }
          origin = lines_.origin();
          begin(id_of(field, lines_, "the number of an element"), origin);
          missing = n_nodes_;
        } else {
          node(field);
          if (--missing == 0) origin = lines_.origin();
        }
      }
      if (missing == 1 && type_ == kConnector) {  // the second node is the ground
        missing = 0;
        origin = lines_.origin();
      }
    }
    if (missing > 0) {
      lines_.source().fail(origin, fmt::format("found {} nodes of an element {}, expected {}",
                                               n_nodes_ - missing, type_, n_nodes_));
    }
    return kind;
  }

 private:
  void refuse_extra() const {
    if (ignore_.skips(kExtraNodes)) return;
    lines_.source().fail(lines_.origin(),
                         fmt::format("found more than the {} nodes of an element {}; ignore = "
                                     "[\"{}\"] takes the first ones, as CalculiX does",
                                     n_nodes_, type_, kExtraNodes));
  }

  Lines& lines_;
  std::string_view type_;
  int n_nodes_;
  Ignore& ignore_;
};

Lines::Kind read_solids(Lines& lines, const SolidType& solid, Scope& scope, SetChunk* chunk,
                        Ignore& ignore) {
  CellTable& table = table_of(scope, solid);
  const auto first = table.ids.size();
  const Lines::Kind kind =
      ElementWalk(lines, solid.name, traits(solid.type).nodes, ignore)
          .run(
              [&](int32_t id, Origin origin) {
                table.ids.push_back(id);
                table.origins.push_back(origin);
              },
              [&](std::string_view node) { table.nodes.push_back(node_of(node, lines)); });
  if (chunk != nullptr) {
    chunk->table = static_cast<int32_t>(&table - scope.cells.data());
    chunk->row_begin = static_cast<int32_t>(first);
    chunk->row_end = static_cast<int32_t>(table.ids.size());
  }
  return kind;
}

Lines::Kind read_points(Lines& lines, const std::string& type, Scope& scope, SetChunk* chunk,
                        Ignore& ignore) {
  return ElementWalk(lines, type, point_nodes(type), ignore)
      .run(
          [&](int32_t id, Origin origin) {
            scope.points.push_back({type, id, 0, 0, origin});
            if (chunk == nullptr) return;
            chunk->id_lines.emplace_back(chunk->ids.size(), origin);
            chunk->ids.push_back(id);
          },
          [&](std::string_view node) {
            PointElement& point = scope.points.back();
            if (node.empty() && type == kConnector) return;  // the ground
            const bool first = point.node == 0;
            point.instance[first ? 0 : 1] = split_instance(node, scope);
            (first ? point.node : point.second) = node_of(node, lines);
          });
}

Lines::Kind read_thin(Lines& lines, const std::string& type, Scope& scope, SetChunk* chunk,
                      Ignore& ignore) {
  const auto face = thin_type(type);
  const int nodes = face ? traits(*face).nodes : line_nodes(type);
  return ElementWalk(lines, type, nodes, ignore)
      .run(
          [&](int32_t id, Origin origin) {
            scope.thin.push_back({type, face, id, origin, 0, {}});
            if (chunk == nullptr) return;
            chunk->id_lines.emplace_back(chunk->ids.size(), origin);
            chunk->ids.push_back(id);
          },
          [&](std::string_view node) {
            ThinElement& thin = scope.thin.back();
            thin.nodes[thin.count++] = node_of(node, lines);
          });
}

// Only the numbers are kept: sets may name them. A trailing comma continues the line.
Lines::Kind skip_elements(Lines& lines, const std::string& type, Scope& scope, Ignore& ignore) {
  bool goes_on = false;
  Origin open = 0;
  int64_t count = 0;
  Lines::Kind kind = lines.next();
  for (; kind == Lines::Kind::kData; kind = lines.next()) {
    std::string_view field;
    FieldWalk(lines.data()).next(&field);
    if (!goes_on) {
      scope.ignored_elements.push_back(id_of(field, lines, "the number of an element"));
      ++count;
    }
    goes_on = lines.data().ends_with(',');
    if (goes_on) open = lines.origin();
  }
  if (goes_on && kind == Lines::Kind::kEnd) {
    lines.source().fail(open, "the deck ends after a comma, expected the rest of the element");
  }
  ignore.skips(type, count);
  return kind;
}

const char* integration(Formulation formulation) {
  switch (formulation) {
    case Formulation::kFull:
    case Formulation::kFine:
      return ", full integration";
    case Formulation::kReduced:
      return ", reduced integration";
    case Formulation::kIncompatible:
      return ", incompatible modes";
    case Formulation::kDefault:
      return "";
  }
  return "";
}

int64_t elements_in(const Scope& scope) {
  size_t count = scope.points.size() + scope.thin.size() + scope.ignored_elements.size();
  for (const CellTable& table : scope.cells) count += table.ids.size();
  return static_cast<int64_t>(count);
}

Fate fate_of_type(const std::string& type, const Ignore& ignore) {
  if (ignore.lists(type)) return Fate::kIgnored;
  const bool known =
      solid_type(type) || point_nodes(type) > 0 || thin_type(type) || line_nodes(type) > 0;
  return known ? Fate::kRead : Fate::kRefused;
}

Lines::Kind read_type(const std::string& type, Lines& lines, Scope& scope, SetChunk* chunk,
                      Ignore& ignore) {
  if (fate_of_type(type, ignore) != Fate::kRead) return skip_elements(lines, type, scope, ignore);
  if (const auto solid = solid_type(type)) return read_solids(lines, *solid, scope, chunk, ignore);
  if (point_nodes(type) > 0) return read_points(lines, type, scope, chunk, ignore);
  return read_thin(lines, type, scope, chunk, ignore);
}

}  // namespace

Lines::Kind read_nodes(Lines& lines, Scope& scope, const LocalSystem& system, Ignore& ignore) {
  const Keyword keyword = lines.keyword();
  keyword.allow({"NSET", "SYSTEM"}, lines.source(), ignore);
  const char coordinates = coordinates_of(keyword, lines.source());
  const auto first = scope.nodes.ids.size();
  Lines::Kind kind = lines.next();
  for (; kind == Lines::Kind::kData; kind = lines.next()) {
    read_node(lines, system, coordinates, scope.nodes);
  }
  if (keyword.has("NSET")) {
    const std::string& name = keyword.required("NSET", lines.source());
    SetChunk& chunk = new_chunk(scope.node_sets, name, keyword.origin);
    chunk.row_begin = static_cast<int32_t>(first);
    chunk.row_end = static_cast<int32_t>(scope.nodes.ids.size());
  }
  return kind;
}

Lines::Kind read_elements(Lines& lines, Scope& scope, Ignore& ignore, Refusals& refusals,
                          std::map<std::string, std::string>& notes) {
  const Keyword keyword = lines.keyword();
  keyword.allow({"TYPE", "ELSET"}, lines.source(), ignore);
  const std::string type = folded(keyword.required("TYPE", lines.source()));
  SetChunk* chunk = nullptr;
  if (keyword.has("ELSET")) {
    chunk =
        &new_chunk(scope.element_sets, keyword.required("ELSET", lines.source()), keyword.origin);
  }
  Content& content = refusals.contents().count("element", type, lines.source(), keyword.origin, 0);
  content.fate = fate_of_type(type, ignore);
  const int64_t before = elements_in(scope);
  const Lines::Kind kind = read_type(type, lines, scope, chunk, ignore);
  content.count += elements_in(scope) - before;
  const auto solid = solid_type(type);
  if (content.fate == Fate::kRead && solid && !solid->variant.empty())
    notes.try_emplace(
        type, fmt::format("{}: {} is read as {}, without {}", lines.source().where(keyword.origin),
                          type, solid->name, solid->variant));
  if (content.fate == Fate::kRefused) {
    const std::string_view instead = replacement_of(type);
    const std::string why = instead.empty() ? "" : fmt::format(": {}", instead);
    refusals.add(
        fmt::format("{}: element type {} is not supported{}; ignore = [\"{}\"] skips it, and "
                    "with it its stiffness and mass: {} of the recipe replace them",
                    lines.source().where(keyword.origin), type, why, type,
                    "[[spring]], [[coupling]] and [[point_mass]]"));
  }
  return kind;
}

std::vector<Listed> listed_elements() {
  std::vector<Listed> rows;
  for (const SolidType& type : solid_types())
    rows.push_back({std::string(type.name), Fate::kRead,
                    fmt::format("{}{}", traits(type.type).name, integration(type.formulation))});
  for (const auto& [name, nodes] : kPointTypes)
    rows.push_back(
        {std::string(name), Fate::kRead, nodes == 1 ? "at one node" : "between two nodes"});
  for (const char* name : {"B31", "B32", "T3D2", "T3D3"})
    rows.push_back(
        {name, Fate::kRead,
         *name == 'B' ? "beam; with a middle node two" : "truss; with a middle node two"});
  for (const std::string_view name : shell_types())
    rows.push_back({std::string(name), Fate::kRead, "shell; on a face of a solid a surface"});
  for (const auto& [name, instead] : replaced_types())
    rows.push_back({std::string(name), Fate::kRefused, std::string(instead)});
  return rows;
}

}  // namespace clatter::mesh::deck::abaqus
