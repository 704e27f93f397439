// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr std::array kSolids = {
    SolidType{"C3D4", CellType::kTet4, Formulation::kDefault},
    SolidType{"C3D5", CellType::kPyramid5, Formulation::kDefault},
    SolidType{"C3D6", CellType::kWedge6, Formulation::kReduced},
    SolidType{"C3D8", CellType::kHex8, Formulation::kFull},
    SolidType{"C3D8I", CellType::kHex8, Formulation::kIncompatible},
    SolidType{"C3D8R", CellType::kHex8, Formulation::kReduced},
    SolidType{"C3D10", CellType::kTet10, Formulation::kDefault},
    SolidType{"C3D15", CellType::kWedge15, Formulation::kReduced},
    SolidType{"C3D20", CellType::kHex20, Formulation::kFull},
    SolidType{"C3D20R", CellType::kHex20, Formulation::kReduced},
};

constexpr std::array<std::pair<std::string_view, int>, 9> kPointTypes = {{{"MASS", 1},
                                                                          {"ROTARYI", 1},
                                                                          {"DCOUP3D", 1},
                                                                          {"SPRING1", 1},
                                                                          {"SPRING2", 2},
                                                                          {"SPRINGA", 2},
                                                                          {"DASHPOT1", 1},
                                                                          {"DASHPOT2", 2},
                                                                          {"DASHPOTA", 2}}};

// Number of nodes of elements with one or two; 0 for other types.
int point_nodes(std::string_view type) {
  for (const auto& [name, nodes] : kPointTypes) {
    if (name == type) return nodes;
  }
  return 0;
}

// Corners of the faces by number, as bit masks.
constexpr unsigned bits(int a, int b, int c, int d = -1) {
  return 1u << a | 1u << b | 1u << c | (d < 0 ? 0u : 1u << d);
}
constexpr std::array<unsigned, 4> kTet = {bits(0, 1, 2), bits(0, 3, 1), bits(1, 3, 2),
                                          bits(2, 3, 0)};
constexpr std::array<unsigned, 5> kWedge = {bits(0, 1, 2), bits(3, 5, 4), bits(0, 3, 4, 1),
                                            bits(1, 4, 5, 2), bits(2, 5, 3, 0)};
constexpr std::array<unsigned, 6> kHex = {bits(0, 1, 2, 3), bits(4, 7, 6, 5), bits(0, 4, 5, 1),
                                          bits(1, 5, 6, 2), bits(2, 6, 7, 3), bits(3, 7, 4, 0)};
constexpr std::array<unsigned, 5> kPyramid = {bits(0, 1, 2, 3), bits(0, 4, 1), bits(1, 4, 2),
                                              bits(2, 4, 3), bits(3, 4, 0)};

std::span<const unsigned> numbered_faces(CellType type) {
  switch (traits(type).corners) {
    case 4:
      return kTet;
    case 5:
      return kPyramid;
    case 6:
      return kWedge;
    default:
      return kHex;
  }
}

unsigned corners_of(CellType type, size_t face) {
  const CellFace& cell_face = traits(type).faces[face];
  unsigned out = 0;
  for (int i = 0; i < traits(cell_face.type).corners; ++i) {
    out |= 1u << cell_face.nodes[static_cast<size_t>(i)];
  }
  return out;
}

// Numbers of nodes and elements are positive.
int32_t id_of(std::string_view field, const Lines& lines, std::string_view what) {
  const auto id = to_integer(field);
  if (!id || *id < 1) {
    lines.source().fail(lines.spot(),
                        fmt::format("found '{}', expected {} (1 or more)", field, what));
  }
  return *id;
}

void read_node(const Lines& lines, NodeTable* nodes) {
  FieldWalk walk(lines.data());
  std::string_view field;
  walk.next(&field);
  nodes->ids.push_back(id_of(field, lines, "the number of a node"));
  nodes->spots.push_back(lines.spot());
  for (int k = 0; k < 3; ++k) {
    std::optional<double> x = 0.0;
    if (walk.next(&field) && !field.empty()) x = to_number(field);
    if (!x) {
      lines.source().fail(lines.spot(), fmt::format("found '{}', expected a coordinate", field));
    }
    nodes->xyz.push_back(*x);
  }
}

CellTable& table_of(Scope* scope, const SolidType& solid) {
  for (CellTable& table : scope->cells) {
    if (table.name == solid.name) return table;
  }
  scope->cells.emplace_back();
  CellTable& table = scope->cells.back();
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
  ElementWalk(Lines* lines, std::string_view type, int n_nodes, Ignore* ignore)
      : lines_(lines), type_(type), n_nodes_(n_nodes), ignore_(ignore) {}

  // Calls begin(id, spot) and node(id) for each element of the table.
  template <class Begin, class Node>
  Lines::Kind run(const Begin& begin, const Node& node) {
    int missing = 0;
    Spot spot = lines_->spot();
    Lines::Kind kind = lines_->next();
    for (; kind == Lines::Kind::kData; kind = lines_->next()) {
      FieldWalk walk(lines_->data());
      std::string_view field;
      while (walk.next(&field)) {
        if (missing == 0) {
          if (spot == lines_->spot()) {
            refuse_extra();
            break;
          }
          spot = lines_->spot();
          begin(id_of(field, *lines_, "the number of an element"), spot);
          missing = n_nodes_;
        } else {
          node(id_of(field, *lines_, "the number of a node"));
          if (--missing == 0) spot = lines_->spot();
        }
      }
    }
    if (missing > 0) {
      lines_->source().fail(spot, fmt::format("found {} nodes of an element {}, expected {}",
                                              n_nodes_ - missing, type_, n_nodes_));
    }
    return kind;
  }

 private:
  void refuse_extra() const {
    if (ignore_->skips(kExtraNodes)) return;
    lines_->source().fail(lines_->spot(),
                          fmt::format("found more than the {} nodes of an element {}; ignore = "
                                      "[\"{}\"] takes the first ones, as CalculiX does",
                                      n_nodes_, type_, kExtraNodes));
  }

  Lines* lines_;
  std::string_view type_;
  int n_nodes_;
  Ignore* ignore_;
};

Lines::Kind read_solids(Lines* lines, const SolidType& solid, Scope* scope, SetChunk* chunk,
                        Ignore* ignore) {
  CellTable& table = table_of(scope, solid);
  const auto first = table.ids.size();
  const Lines::Kind kind = ElementWalk(lines, solid.name, traits(solid.type).nodes, ignore)
                               .run(
                                   [&](int32_t id, Spot spot) {
                                     table.ids.push_back(id);
                                     table.spots.push_back(spot);
                                   },
                                   [&](int32_t node) { table.nodes.push_back(node); });
  if (chunk != nullptr) {
    chunk->table = static_cast<int32_t>(&table - scope->cells.data());
    chunk->row_begin = static_cast<int32_t>(first);
    chunk->row_end = static_cast<int32_t>(table.ids.size());
  }
  return kind;
}

Lines::Kind read_points(Lines* lines, const std::string& type, Scope* scope, SetChunk* chunk,
                        Ignore* ignore) {
  return ElementWalk(lines, type, point_nodes(type), ignore)
      .run(
          [&](int32_t id, Spot spot) {
            scope->points.push_back({type, id, 0, 0, spot});
            if (chunk == nullptr) return;
            chunk->id_lines.emplace_back(chunk->ids.size(), spot);
            chunk->ids.push_back(id);
          },
          [&](int32_t node) {
            PointElement& point = scope->points.back();
            (point.node == 0 ? point.node : point.second) = node;
          });
}

// Only the numbers are kept: sets may name them. A trailing comma continues the line.
Lines::Kind skip_elements(Lines* lines, const std::string& type, Scope* scope, Ignore* ignore) {
  bool goes_on = false;
  Spot open = 0;
  int64_t count = 0;
  Lines::Kind kind = lines->next();
  for (; kind == Lines::Kind::kData; kind = lines->next()) {
    std::string_view field;
    FieldWalk(lines->data()).next(&field);
    if (!goes_on) {
      scope->ignored_elements.push_back(id_of(field, *lines, "the number of an element"));
      ++count;
    }
    goes_on = lines->data().ends_with(',');
    if (goes_on) open = lines->spot();
  }
  if (goes_on && kind == Lines::Kind::kEnd) {
    lines->source().fail(open, "the deck ends after a comma, expected the rest of the element");
  }
  ignore->skips(type, count);
  return kind;
}

}  // namespace

std::optional<SolidType> solid_type(std::string_view name) {
  const std::string key = folded(name);
  for (const SolidType& solid : kSolids) {
    if (solid.name == key) return solid;
  }
  return std::nullopt;
}

int face_of_number(CellType type, int number) {
  const auto wanted = numbered_faces(type);
  if (number < 1 || number > static_cast<int>(wanted.size())) return -1;
  for (size_t f = 0; f < wanted.size(); ++f) {
    if (corners_of(type, f) == wanted[static_cast<size_t>(number - 1)]) return static_cast<int>(f);
  }
  return -1;
}

int number_of_face(CellType type, int face) {
  const auto faces = numbered_faces(type);
  const unsigned corners = corners_of(type, static_cast<size_t>(face));
  return static_cast<int>(std::find(faces.begin(), faces.end(), corners) - faces.begin()) + 1;
}

Lines::Kind read_nodes(Lines* lines, Scope* scope, Ignore* ignore) {
  const Keyword keyword = lines->keyword();
  keyword.allow({"NSET", "SYSTEM"}, lines->source(), ignore);
  if (keyword.choice("SYSTEM", "R") != "R") {
    lines->source().fail(keyword.spot, fmt::format("*NODE: found SYSTEM={}, expected R: only "
                                                   "rectangular coordinates are supported",
                                                   *keyword.find("SYSTEM")));
  }
  const auto first = scope->nodes.ids.size();
  Lines::Kind kind = lines->next();
  for (; kind == Lines::Kind::kData; kind = lines->next()) read_node(*lines, &scope->nodes);
  if (keyword.has("NSET")) {
    const std::string& name = keyword.required("NSET", lines->source());
    SetChunk& chunk = new_chunk(&scope->node_sets, name, keyword.spot);
    chunk.row_begin = static_cast<int32_t>(first);
    chunk.row_end = static_cast<int32_t>(scope->nodes.ids.size());
  }
  return kind;
}

Lines::Kind read_elements(Lines* lines, Scope* scope, Ignore* ignore, Refusals* refusals) {
  const Keyword keyword = lines->keyword();
  keyword.allow({"TYPE", "ELSET"}, lines->source(), ignore);
  const std::string type = folded(keyword.required("TYPE", lines->source()));
  SetChunk* chunk = nullptr;
  if (keyword.has("ELSET")) {
    chunk =
        &new_chunk(&scope->element_sets, keyword.required("ELSET", lines->source()), keyword.spot);
  }
  if (ignore->skips(type, 0)) return skip_elements(lines, type, scope, ignore);
  if (const auto solid = solid_type(type)) return read_solids(lines, *solid, scope, chunk, ignore);
  if (point_nodes(type) > 0) {
    return read_points(lines, type, scope, chunk, ignore);
  }
  refusals->add(fmt::format("{}: element type {} is not supported; ignore = [\"{}\"] skips it",
                            lines->source().where(keyword.spot), type, type));
  return skip_elements(lines, type, scope, ignore);
}

}  // namespace clatter::mesh::deck::abaqus
