// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesh/deck/abaqus/cells.hpp"
#include "mesh/deck/abaqus/face_rows.hpp"
#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// A candidate for a free face, by its sorted corners: the same for both cells that share it.
struct Candidate {
  FaceCorners corners;
  CellFaceId id;
  bool chosen;
};

// Faces of all other cells whose nodes are all selected.
void add_neighbours(const Numbering& numbering, const std::vector<bool>& chosen,
                    const std::vector<bool>& selected, std::vector<Candidate>& faces) {
  const auto is_selected = [&](int32_t row) { return selected[row]; };
  for (int32_t cell = 0; cell < numbering.cells(); ++cell) {
    const auto nodes = numbering.nodes_of(cell);
    if (chosen[cell] || std::count_if(nodes.begin(), nodes.end(), is_selected) < 3) {
      continue;
    }
    for (int32_t f = 0; f < face_count(numbering, cell); ++f) {
      const FaceRows face = face_rows(numbering, {cell, f});
      if (std::all_of(face.begin(), face.end(), is_selected)) {
        faces.push_back({sorted_corners(face), {cell, f}, false});
      }
    }
  }
}

// The faces of those cells for which `wanted` is true of all rows and that no other cell has.
template <class Wanted>
std::vector<CellFaceId> free_faces(const Numbering& numbering, const std::vector<int32_t>& cells,
                                   const Wanted& wanted) {
  std::vector<Candidate> all;
  std::vector<bool> chosen(static_cast<size_t>(numbering.cells()), false);
  std::vector<bool> selected(static_cast<size_t>(numbering.nodes()), false);
  for (const int32_t cell : cells) {
    chosen[cell] = true;
    for (int32_t f = 0; f < face_count(numbering, cell); ++f) {
      const FaceRows face = face_rows(numbering, {cell, f});
      if (!std::all_of(face.begin(), face.end(), wanted)) continue;
      all.push_back({sorted_corners(face), {cell, f}, true});
      for (const int32_t row : face) selected[row] = true;
    }
  }
  add_neighbours(numbering, chosen, selected, all);
  std::sort(all.begin(), all.end(),
            [](const Candidate& a, const Candidate& b) { return a.corners < b.corners; });
  std::vector<CellFaceId> faces;
  for (size_t i = 0, end = 0; i < all.size(); i = end) {
    while (end < all.size() && all[end].corners == all[i].corners) ++end;
    if (end == i + 1 && all[i].chosen) faces.push_back(all[i].id);
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

// Key of Model::surface_names; "instance.name" refers to a surface of the instance.
std::string key_of(const Model& model, size_t use, const std::string& name) {
  std::string rest = name;
  for (size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1)) {
    const int instance = model.numbering.find_use(name.substr(0, dot));
    if (instance < 0) continue;
    use = static_cast<size_t>(instance);
    rest = name.substr(dot + 1);
    break;
  }
  return fmt::format("{}:{}", use, folded(rest));
}

class SurfaceReader {
 public:
  explicit SurfaceReader(Model& model) : model_(model), numbering_(model.numbering) {}

  void read(size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"NAME", "TYPE", "INTERNAL"}, model_.source, model_.ignore);
    const std::string& name = keyword.required("NAME", model_.source);
    const std::string type = keyword.choice("TYPE", "ELEMENT");
    const std::string key = key_of(model_, use, name);
    if (model_.surface_names.contains(key) || model_.node_surfaces.contains(key)) {
      model_.source.fail(card.origin(), fmt::format("found a second surface {}", name));
    }
    if (type == "NODE") return read_nodes(use, card, key);
    if (type != "ELEMENT") {
      model_.source.fail(card.origin(), fmt::format("*SURFACE: found TYPE={}, expected ELEMENT or "
                                                    "NODE",
                                                    *keyword.find("TYPE")));
    }
    edge_rows_.clear();
    const std::vector<CellFaceId> faces = faces_of(use, card);
    if (!edge_rows_.empty()) {
      if (!faces.empty())
        model_.source.fail(card.origin(),
                           fmt::format("surface {}: found faces and edges of shells, "
                                       "expected one of them",
                                       name));
      sort_unique(edge_rows_);
      model_.node_surfaces[key] = std::move(edge_rows_);
      return;
    }
    // Without faces because the user ignores its elements: not in the mesh.
    const bool none = faces.empty() && card.size() > 0;
    model_.surface_names[key] =
        none ? "" : add_surface(model_, numbering_.public_name(use, name), faces);
  }

  std::vector<CellFaceId> faces_of(size_t use, const Card& card) {
    std::vector<CellFaceId> faces;
    for (size_t i = 0; i < card.size(); ++i) add_line(use, card.line(i, model_.source), faces);
    return faces;
  }

 private:
  void read_nodes(size_t use, const Card& card, const std::string& key) {
    std::vector<int32_t> rows;
    std::set<double> areas;
    for (size_t i = 0; i < card.size(); ++i) {
      const Fields fields = card.line(i, model_.source);
      fields.at_most(2, "a node or node set, area");
      areas.insert(fields.number_or(1, "area", 1.0));
      const auto more = model_.sets.nodes_at(fields, 0, use);
      rows.insert(rows.end(), more.begin(), more.end());
    }
    sort_unique(rows);
    if (areas.size() > 1)
      model_.deck.notes.push_back(
          fmt::format("{}: the areas of its nodes are left out: they count alike in a coupling, "
                      "*DISTRIBUTING COUPLING has weights",
                      model_.source.where(card.origin())));
    model_.node_surfaces[key] = std::move(rows);
  }

  static int32_t side_of(const Fields& fields) {
    const std::string side = folded(fields.text(1));
    if (side == "SNEG" || side == "S1") return kSneg;  // S1 to S6: as CalculiX numbers them
    if (side.empty() || side == "SPOS" || side == "S2") return kSpos;
    fields.fail(
        fmt::format("found face {} of shells, expected SPOS, SNEG or E1 to E4", shown(side)));
  }

  // "elements, E2", or S4: the nodes of the second side of shells. False for faces.
  bool takes_edge(const Fields& fields, int32_t element) {
    const std::string label = folded(fields.text(1));
    if (label.size() != 2) return false;
    const bool numbered = label[0] == 'S' && label[1] >= '3' && label[1] <= '6';
    if (label[0] != 'E' && !numbered) return false;
    const ThinElement& thin = *numbering_.thin(element);
    const int32_t corners = traits(*thin.face).corners;
    const int32_t edge = label[1] - (numbered ? '3' : '1');
    if (edge < 0 || edge >= corners)
      fields.fail(fmt::format("found edge {} of shell {} {}, expected E1 to E{}", label, thin.type,
                              thin.id, corners));
    edge_rows_.push_back(thin.nodes[edge]);
    edge_rows_.push_back(thin.nodes[(edge + 1) % corners]);
    if (thin.count > corners) edge_rows_.push_back(thin.nodes[corners + edge]);
    return true;
  }

  // "elements, S3", or "elements": all their faces on the outside of the model. Elements of two
  // dimensions are the faces of the solids that they lie on.
  void add_line(size_t use, const Fields& fields, std::vector<CellFaceId>& faces) {
    fields.at_most(2, "elements, face");
    std::vector<int32_t> cells = model_.sets.elements_at(fields, 0, use);
    const auto is_shell = [&](int32_t element) { return model_.is_shell(element); };
    const bool has_shells = std::ranges::any_of(cells, is_shell);
    for (const int32_t element : cells)
      if (is_shell(element) && !takes_edge(fields, element))
        faces.emplace_back(element, side_of(fields));
    std::erase_if(cells, is_shell);
    if (has_shells && cells.empty()) return;
    std::vector<const ThinElement*> thin;
    for (const int32_t element : cells) {
      const ThinElement* one = numbering_.thin(element);
      if (one != nullptr && one->face) thin.push_back(one);
    }
    const bool only_thin = !thin.empty() && thin.size() == cells.size();
    if (!thin.empty()) add_thin(thin, faces);
    if (only_thin) return;
    std::erase_if(cells, [&](int32_t element) { return element >= numbering_.cells(); });
    if (fields.blank(1)) {
      const auto found = free_faces(numbering_, cells, [](int32_t) { return true; });
      faces.insert(faces.end(), found.begin(), found.end());
      return;
    }
    const std::string face = folded(fields.text(1));
    const auto number = face.starts_with('S') ? to_integer(face.substr(1)) : std::nullopt;
    if (!number) {
      fields.fail(
          fmt::format("found face {}, expected S1 to S6: faces of solids", shown(fields.text(1))));
    }
    for (const int32_t cell : cells) {
      const int32_t f = face_of_number(numbering_.table_of(cell).type, *number);
      if (f < 0) {
        fields.fail(fmt::format("found face {}, which elements {} do not have", face,
                                numbering_.table_of(cell).name));
      }
      faces.emplace_back(cell, f);
    }
  }

  void add_thin(const std::vector<const ThinElement*>& thin, std::vector<CellFaceId>& faces) {
    std::set<FaceCorners> wanted;
    std::vector<bool> selected(static_cast<size_t>(numbering_.nodes()), false);
    for (const ThinElement* one : thin) {
      FaceRows face{
          {}, static_cast<size_t>(one->count), static_cast<size_t>(traits(*one->face).corners)};
      std::copy_n(one->nodes.begin(), one->count, face.rows.begin());
      wanted.insert(sorted_corners(face));
      for (const int32_t row : face) selected[row] = true;
    }
    std::vector<Candidate> all;
    add_neighbours(numbering_, std::vector<bool>(numbering_.cells(), false), selected, all);
    for (const Candidate& one : all) {
      if (wanted.erase(one.corners) > 0) faces.push_back(one.id);
    }
  }

  Model& model_;
  const Numbering& numbering_;
  std::vector<int32_t> edge_rows_;  // of the surface that is read
};

}  // namespace

std::string add_surface(Model& model, const std::string& name,
                        const std::vector<CellFaceId>& faces) {
  constexpr int64_t kMostFaces = int64_t{1} << 25;  // of all surfaces: a gigabyte
  model.faces += static_cast<int64_t>(faces.size());
  if (model.faces > kMostFaces) {
    throw InputError(fmt::format("{}: surface {}: all surfaces have more than {} faces",
                                 model.source.files().front(), name, kMostFaces));
  }
  SurfaceBuilder surface;
  std::set<CellFaceId> known;
  for (const CellFaceId& id : faces) {
    if (!known.insert(id).second) continue;
    if (model.is_shell(id.first)) {
      add_shell_faces(model, id, surface);
      continue;
    }
    FaceRows face = face_rows(model.numbering, id);
    for (int32_t& row : face.rows) row = model.node_map.mesh_node_of(id.first, row);
    const CellType type = model.numbering.table_of(id.first).type;
    surface.add(traits(type).faces[id.second].type, face.rows);
  }
  auto& surfaces = model.deck.mesh.surfaces;
  std::string free_name = name;
  for (int i = 2; surfaces.contains(free_name); ++i) free_name = fmt::format("{}_{}", name, i);
  surfaces[free_name] = surface.finish();
  return free_name;
}

void build_surfaces(Model& model) {
  SurfaceReader reader(model);
  for_each_card(model, {"SURFACE"}, [&](size_t use, const Card& card) { reader.read(use, card); });
}

std::string surface_named(Model& model, size_t use, const std::string& name, Origin origin) {
  const std::string key = key_of(model, use, name);
  const auto known = model.surface_names.find(key);
  if (known != model.surface_names.end() && known->second.empty()) {
    model.source.fail(origin, fmt::format("surface {} has no face of a solid", shown(name)));
  }
  if (known != model.surface_names.end()) return known->second;
  const std::vector<int32_t>* rows = node_surface(model, use, name);
  if (rows == nullptr && model.refusals.has_lost(folded(name))) throw FollowUp();
  if (rows == nullptr) model.source.fail(origin, fmt::format("found no surface {}", shown(name)));
  return model.surface_names[key] = surface_of_nodes(model, *rows, name, origin);
}

std::vector<CellFaceId> faces_named(Model& model, size_t use, const std::string& name,
                                    Origin origin) {
  const std::string key = key_of(model, use, name);
  for (size_t other = 0; other < model.numbering.uses().size(); ++other) {
    for (const Card& card : model.numbering.uses()[other].scope->cards) {
      if (card.keyword().key != "SURFACE" ||
          key_of(model, other, card.keyword().choice("NAME", "")) != key) {
        continue;
      }
      if (card.keyword().choice("TYPE", "ELEMENT") != "ELEMENT") {
        model.source.fail(
            origin, fmt::format("found a surface {} of nodes, expected one of faces", shown(name)));
      }
      const std::vector<CellFaceId> faces = SurfaceReader(model).faces_of(other, card);
      if (std::ranges::any_of(faces, [&](CellFaceId id) { return model.is_shell(id.first); }))
        model.source.fail(
            origin,
            fmt::format("found shells in surface {}, expected faces of solids", shown(name)));
      return faces;
    }
  }
  model.source.fail(origin, fmt::format("found no surface {}", shown(name)));
}

const std::vector<int32_t>* node_surface(const Model& model, size_t use, const std::string& name) {
  const auto rows = model.node_surfaces.find(key_of(model, use, name));
  return rows != model.node_surfaces.end() ? &rows->second : nullptr;
}

std::string surface_of_nodes(Model& model, const std::vector<int32_t>& rows,
                             const std::string& name, Origin origin) {
  const Numbering& numbering = model.numbering;
  std::vector<bool> wanted(static_cast<size_t>(numbering.nodes()), false);
  for (const int32_t row : rows) wanted[row] = true;
  const auto is_requested = [&](int32_t row) { return static_cast<bool>(wanted[row]); };
  std::vector<int32_t> cells;
  for (int32_t cell = 0; cell < numbering.cells(); ++cell) {
    const auto nodes = numbering.nodes_of(cell);
    if (std::count_if(nodes.begin(), nodes.end(), is_requested) >= 3) cells.push_back(cell);
  }
  auto faces = free_faces(numbering, cells, is_requested);
  std::vector<CellFaceId> shells;
  for (int32_t element = numbering.first_thin(); element < numbering.elements(); ++element) {
    const ThinElement& thin = numbering.thin()[element - numbering.first_thin()];
    if (model.is_shell(element) &&
        std::all_of(thin.nodes.begin(), thin.nodes.begin() + thin.count, is_requested))
      shells.emplace_back(element, kSpos);
  }
  for (const CellFaceId& id : faces) {
    for (const int32_t row : face_rows(numbering, id)) wanted[row] = false;
  }
  for (const CellFaceId& id : shells) {
    const ThinElement& thin = numbering.thin()[id.first - numbering.first_thin()];
    for (int32_t i = 0; i < thin.count; ++i) wanted[thin.nodes[i]] = false;
  }
  faces.insert(faces.end(), shells.begin(), shells.end());
  for (const int32_t row : rows) {
    if (!wanted[row]) continue;
    model.source.fail(origin, fmt::format("surface {} of nodes: node {} belongs to no outer face "
                                          "whose nodes all belong to it, expected complete faces",
                                          name, numbering.node_ids()[row]));
  }
  return add_surface(model, name, faces);
}

}  // namespace clatter::mesh::deck::abaqus
