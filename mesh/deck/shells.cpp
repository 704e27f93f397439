// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/shells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/mesh/orient_shells.hpp"

namespace clatter::mesh::deck {
namespace {

// Of FlatShape: a flat shell is off the sheet by as much, and beyond the second one it is not one.
constexpr double kNotedWarp = 0.1, kMostWarp = 0.5;
// Thickness over the longest side: beyond them it is likely to be in other units.
constexpr double kThin = 1e-4, kThick = 20.0;

/// The cells of one region and type.
struct ShellRows {
  std::vector<NodeIndex> nodes;
  std::vector<int32_t> ids;
  std::vector<double> thickness, offset, axis;
};

class ShellAdder {
 public:
  ShellAdder(Deck& deck, const std::function<std::string(size_t)>& where)
      : deck_(deck), where_(where) {
    on_solid_.resize(static_cast<size_t>(deck.mesh.nodes.rows()), false);
    for (const CellBlock& block : deck.mesh.cells)
      for (const int32_t node : block.nodes.reshaped()) on_solid_[static_cast<size_t>(node)] = true;
  }

  void add(size_t i, const ShellCell& cell) {
    ShellFace face = cell.face;
    drop_repeated_corner(face);
    check(i, cell, face);
    check_thickness(i, face);
    append(cell, face);
    find_hinge(i, cell, face);
  }

  std::vector<ShellHinge> finish() {
    for (auto& [key, rows] : rows_) add_block(key.first, key.second, rows);
    std::vector<bool> keep;
    for (const ShellBlock& block : deck_.mesh.shells) keep.push_back(has_side(block.region));
    const int64_t turned = orient_shells(deck_.mesh.shells, keep);
    const auto note = [&](size_t i, const std::string& text) {
      deck_.notes.push_back(fmt::format("{}: {}", where_(i), text));
    };
    if (turned > 0)
      note(0, fmt::format("{} shells are turned to the side of their neighbours; pressures and "
                          "offsets stay on the side that the deck has",
                          turned));
    if (warped_ > 0)
      note(worst_, fmt::format("{} shells are warped by more than {} of their size, this one by "
                               "{:.2g}: smaller ones or triangles follow a curved sheet better",
                               warped_, kNotedWarp, most_warp_));
    const auto note_thickness = [&](const Odd& odd, const char* what, const char* guess) {
      if (odd.count > 0)
        note(odd.first, fmt::format("{} shells are {}, this one {:.3g} of its longest side: is the "
                                    "thickness given in {} by mistake?",
                                    odd.count, what, odd.ratio, guess));
    };
    note_thickness(thin_, "very thin", "m instead of mm");
    note_thickness(thick_, "very thick", "mm instead of m");
    return std::move(hinges_);
  }

 private:
  int32_t label(NodeIndex node) const { return deck_.mesh.node_ids[static_cast<size_t>(node)]; }

  void check(size_t i, const ShellCell& cell, const ShellFace& face) {
    FlatShape shape = shape_of(face, deck_.mesh.nodes);
    if (shape.warp > kMostWarp)
      shape.defect = fmt::format(
          "is warped by {:.2g} of its size, expected at most {}: two triangles follow such a sheet",
          shape.warp, kMostWarp);
    if (!shape.defect.empty()) {
      const Eigen::Vector3d at = deck_.mesh.nodes.row(face.nodes[0]);
      throw InputError(fmt::format("{}: {} {} at node {} ({:g}, {:g}, {:g}) {}", where_(i),
                                   cell.kind, cell.id, label(face.nodes[0]), at.x(), at.y(), at.z(),
                                   shape.defect));
    }
    if (shape.warp <= kNotedWarp || traits(face.type).order == 2) return;
    ++warped_;
    if (shape.warp <= most_warp_) return;
    most_warp_ = shape.warp;
    worst_ = i;
  }

  void check_thickness(size_t i, const ShellFace& face) {
    const auto corners = static_cast<size_t>(traits(face.type).corners);
    double longest = 0.0;
    for (size_t k = 0; k < corners; ++k)
      longest = std::max(longest, (deck_.mesh.nodes.row(face.nodes[(k + 1) % corners]) -
                                   deck_.mesh.nodes.row(face.nodes[k]))
                                      .norm());
    const double ratio =
        *std::max_element(face.values.begin(), face.values.begin() + corners) / longest;
    const auto take = [&](Odd& odd) {
      if (odd.count++ == 0) odd = {1, i, ratio};
    };
    if (ratio > 0.0 && ratio < kThin) take(thin_);
    if (ratio > kThick) take(thick_);
  }

  void append(const ShellCell& cell, const ShellFace& face) {
    ShellRows& rows = rows_[{cell.region, face.type}];
    const auto count = static_cast<size_t>(traits(face.type).nodes);
    const auto corners = static_cast<size_t>(traits(face.type).corners);
    rows.nodes.insert(rows.nodes.end(), face.nodes.begin(), face.nodes.begin() + count);
    rows.thickness.insert(rows.thickness.end(), face.values.begin(), face.values.begin() + corners);
    for (size_t k = 0; corners + k < count; ++k)
      rows.thickness.push_back(0.5 * (face.values[k] + face.values[(k + 1) % corners]));
    rows.ids.push_back(cell.id);
    rows.offset.push_back(cell.offset);
    rows.axis.insert(rows.axis.end(), cell.axis.begin(), cell.axis.end());
  }

  void find_hinge(size_t i, const ShellCell& cell, const ShellFace& face) {
    std::vector<NodeIndex> found;
    for (size_t k = 0; k < static_cast<size_t>(traits(face.type).nodes); ++k)
      if (on_solid_[static_cast<size_t>(face.nodes[k])]) found.push_back(face.nodes[k]);
    if (found.empty()) return;
    const std::string part = found.size() == 1
                                 ? fmt::format("node {}", label(found[0]))
                                 : fmt::format("edge {}-{}", label(found[0]), label(found[1]));
    hinges_.push_back(
        {where_(i), fmt::format("{} of shell {} {}", part, cell.kind, cell.id), std::move(found)});
  }

  void add_block(int32_t region, FaceType type, ShellRows& rows) {
    ShellBlock& block = deck_.mesh.shells.emplace_back();
    const auto cells = static_cast<Eigen::Index>(rows.ids.size());
    const Eigen::Index columns = traits(type).nodes;
    block.type = type;
    block.region = region;
    block.nodes = Eigen::Map<const IndexMatrix>(rows.nodes.data(), cells, columns);
    const recipe::Shell* shell = section_of(region);
    const double usual = shell != nullptr ? shell->thickness() : 0.0;
    if (std::ranges::any_of(rows.thickness, [&](double t) { return t != usual; }))
      block.thickness = Eigen::Map<const RowMatrix>(rows.thickness.data(), cells, columns);
    if (std::ranges::any_of(rows.offset, [](double offset) { return offset != 0.0; }))
      block.offset = Eigen::Map<const Eigen::VectorXd>(rows.offset.data(), cells);
    if (std::ranges::any_of(rows.axis, [](double along) { return along != 0.0; }))
      block.axis = Eigen::Map<const RowMatrix>(rows.axis.data(), cells, 3);
    block.ids = std::move(rows.ids);
  }

  // Turned over, layers would be in another order, and shear of a material that is not orthotropic
  // would stretch it the other way.
  bool has_side(int32_t region) const {
    const recipe::Shell* shell = section_of(region);
    if (shell == nullptr) return false;
    const auto leans = [&](const std::string& material) {
      const auto found = deck_.materials.find(material);
      return found != deck_.materials.end() && found->second.kind == Material::Kind::kAnisotropic;
    };
    return !shell->layers.empty() || leans(shell->bending_material) ||
           leans(shell->shear_material) ||
           leans(deck_.regions[static_cast<size_t>(region)].material);
  }

  // Null in a mesh without properties.
  const recipe::Shell* section_of(int32_t region) const {
    const std::string& name = deck_.mesh.regions[static_cast<size_t>(region)];
    for (const recipe::Shell& shell : deck_.shells)
      if (std::ranges::find(shell.regions, name) != shell.regions.end()) return &shell;
    return nullptr;
  }

  Deck& deck_;
  const std::function<std::string(size_t)>& where_;
  std::vector<bool> on_solid_;
  std::map<std::pair<int32_t, FaceType>, ShellRows> rows_;
  std::vector<ShellHinge> hinges_;
  int64_t warped_ = 0;
  double most_warp_ = 0.0;
  size_t worst_ = 0;  // the cell of most_warp_
  struct Odd {
    int64_t count = 0;
    size_t first = 0;
    double ratio = 0.0;
  };
  Odd thin_, thick_;
};

}  // namespace

std::vector<ShellHinge> add_shells(Deck& deck, const std::vector<ShellCell>& cells,
                                   const std::function<std::string(size_t)>& where,
                                   Refusals& refusals) {
  if (cells.empty()) return {};
  ShellAdder adder(deck, where);
  for (size_t i = 0; i < cells.size(); ++i) refusals.attempt([&] { adder.add(i, cells[i]); });
  return adder.finish();
}

}  // namespace clatter::mesh::deck
