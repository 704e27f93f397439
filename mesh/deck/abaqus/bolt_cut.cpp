// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/bolt_cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr const char* kCard = "*PRE-TENSION SECTION";

/// The number of a cell in the deck.
int32_t label(const Numbering& numbering, int32_t cell) {
  const FlatTable& table = numbering.table_of(cell);
  return table.ids[cell - table.first];
}

/// Cells with a node of the cut, ascending.
std::vector<int32_t> cells_at(const Numbering& numbering, const std::vector<int32_t>& rows) {
  std::vector<bool> on_cut(static_cast<size_t>(numbering.nodes()), false);
  for (const int32_t row : rows) on_cut[row] = true;
  std::vector<int32_t> cells;
  for (int32_t cell = 0; cell < numbering.cells(); ++cell) {
    const auto nodes = numbering.nodes_of(cell);
    if (std::any_of(nodes.begin(), nodes.end(), [&](int32_t row) { return on_cut[row]; }))
      cells.push_back(cell);
  }
  return cells;
}

/// Groups of cells that are connected by faces (union-find by the position in a list).
class Groups {
 public:
  explicit Groups(size_t cells) : parent_(cells) { std::iota(parent_.begin(), parent_.end(), 0U); }
  size_t of(size_t cell) {
    while (parent_[cell] != cell) cell = parent_[cell] = parent_[parent_[cell]];
    return cell;
  }
  void join(size_t a, size_t b) { parent_[of(a)] = of(b); }

 private:
  std::vector<size_t> parent_;
};

}  // namespace

BoltCut cut_along(const Numbering& numbering, std::vector<CellFaceId> near, size_t use,
                  Origin origin) {
  const auto fail = [&](const std::string& text) {
    numbering.source().fail(origin, fmt::format("{}: {}", kCard, text));
  };
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  if (near.empty()) fail("found a surface without faces, expected a cut through the bolt");
  BoltCut cut;
  cut.origin = origin;
  cut.use = use;
  cut.near = std::move(near);
  std::map<FaceCorners, CellFaceId> faces;  // of the cut: first of the near, then of the far side
  for (const CellFaceId& id : cut.near) {
    const FaceRows face = face_rows(numbering, id);
    cut.rows.insert(cut.rows.end(), face.begin(), face.end());
    if (!faces.emplace(sorted_corners(face), id).second)
      fail(fmt::format("found both sides of a face in its surface (element {}), expected one side",
                       label(numbering, id.first)));
  }
  sort_unique(cut.rows);

  const std::vector<int32_t> cells = cells_at(numbering, cut.rows);
  const auto position = [&](int32_t cell) {
    return static_cast<size_t>(std::lower_bound(cells.begin(), cells.end(), cell) - cells.begin());
  };
  Groups groups(cells.size());
  std::map<FaceCorners, size_t> open;  // faces of one cell so far
  std::map<CellFaceId, CellFaceId> far_of;
  for (size_t c = 0; c < cells.size(); ++c) {
    for (int32_t f = 0; f < face_count(numbering, cells[c]); ++f) {
      const FaceCorners corners = sorted_corners(face_rows(numbering, {cells[c], f}));
      const auto cut_face = faces.find(corners);
      if (cut_face != faces.end()) {
        if (cut_face->second != CellFaceId(cells[c], f)) far_of[cut_face->second] = {cells[c], f};
        continue;
      }
      const auto [other, is_new] = open.try_emplace(corners, c);
      if (!is_new) groups.join(c, other->second);
    }
  }
  std::vector<bool> is_near(cells.size(), false);
  for (const CellFaceId& id : cut.near) {
    const auto far = far_of.find(id);
    if (far == far_of.end())
      fail(fmt::format("found a face on the outside (element {}), expected a cut through the bolt",
                       label(numbering, id.first)));
    cut.far.push_back(far->second);
    is_near[groups.of(position(id.first))] = true;
  }
  for (const CellFaceId& id : cut.far) {
    if (is_near[groups.of(position(id.first))])
      fail(fmt::format("element {} is on both sides: the surface does not cut the bolt in two",
                       label(numbering, id.first)));
  }
  for (size_t c = 0; c < cells.size(); ++c)
    if (is_near[groups.of(c)]) cut.cells.push_back(cells[c]);
  return cut;
}

}  // namespace clatter::mesh::deck::abaqus
