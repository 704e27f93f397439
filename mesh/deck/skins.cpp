// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/skins.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "mesh/deck/cell_repair.hpp"

namespace clatter::mesh::deck {
namespace {

/// The cells as repair_cells() will leave them: faces with repeated nodes are triangles.
std::optional<Mesh> repaired(const Mesh& mesh) {
  if (!has_repeated_corners(mesh)) return std::nullopt;
  Mesh copy;
  copy.nodes = mesh.nodes;
  copy.cells = mesh.cells;
  try {
    repair_cells(copy, mesh.name);
  } catch (const InputError&) {
    return std::nullopt;  // it is refused later, with the deck's name
  }
  return copy;
}

/// A quadrilateral with the same corner twice is a triangle.
void drop_repeated_corner(SkinCell& cell) {
  const bool quadratic = traits(cell.type).order == 2;
  if (traits(cell.type).corners != 4) return;
  for (size_t i = 0; i < 4; ++i) {
    const size_t j = (i + 1) % 4;
    if (cell.nodes[i] != cell.nodes[j] || cell.nodes[i] < 0) continue;
    std::vector<NodeIndex> kept;
    for (size_t k = 0; k < 4; ++k)
      if (k != std::max(i, j)) kept.push_back(cell.nodes[k]);
    for (size_t k = 0; k < 4 && quadratic; ++k)
      if (k != i) kept.push_back(cell.nodes[4 + k]);
    cell.type = quadratic ? FaceType::kTri6 : FaceType::kTri3;
    cell.nodes.fill(0);
    std::ranges::copy(kept, cell.nodes.begin());
    return;
  }
}

}  // namespace

Skins::Skins(Deck& deck, std::vector<SkinCell> cells) : deck_(deck), cells_(std::move(cells)) {
  found_.resize(cells_.size());
  if (cells_.empty()) return;
  const std::optional<Mesh> other = repaired(deck.mesh);
  const FacesByNodes faces(other ? *other : deck.mesh);
  for (size_t c = 0; c < cells_.size(); ++c) {
    drop_repeated_corner(cells_[c]);
    const auto nodes =
        std::span(cells_[c].nodes).first(static_cast<size_t>(traits(cells_[c].type).nodes));
    if (*std::min_element(nodes.begin(), nodes.end()) < 0) continue;
    found_[c] = faces.find(cells_[c].type, nodes);
  }
}

double Skins::area(size_t cell) const {
  const SkinCell& one = cells_[cell];
  const auto corners = static_cast<size_t>(traits(one.type).corners);
  if (*std::min_element(one.nodes.begin(), one.nodes.begin() + corners) < 0) return 0.0;
  const auto at = [&](size_t i) -> Eigen::Vector3d { return deck_.mesh.nodes.row(one.nodes[i]); };
  const bool triangle = corners == 3;
  const Eigen::Vector3d d = at(triangle ? 1 : 2) - at(0);
  const Eigen::Vector3d e = at(triangle ? 2 : 3) - at(triangle ? 0 : 1);
  return 0.5 * d.cross(e).norm();
}

void Skins::add_surface(const std::string& name, const std::vector<size_t>& cells) {
  SurfaceBuilder surface;
  std::set<std::array<int32_t, kMaxFaceNodes>> known;
  for (const size_t c : cells) {
    if (!is_surface(c)) continue;
    const BoundaryFace& face = found_[c].face;
    if (known.insert(face.ids).second) surface.add(face.type, face.ids);
  }
  if (known.empty()) return;
  std::string free_name = name == "skin" ? "skin_of_the_deck" : name;  // "skin" is the boundary
  const std::string base = free_name;
  for (int i = 2; deck_.mesh.surfaces.contains(free_name); ++i)
    free_name = fmt::format("{}_{}", base, i);
  deck_.mesh.surfaces[free_name] = surface.finish();
  surfaces_.push_back(free_name);
}

void Skins::note(const std::string& where) const {
  if (cells_.empty()) return;
  std::map<std::string, int64_t> faces, inside, elsewhere;
  for (size_t c = 0; c < cells_.size(); ++c)
    ++(is_surface(c) ? faces : is_inside(c) ? inside : elsewhere)[cells_[c].kind];
  std::vector<std::string> parts;
  constexpr size_t kShown = 8;
  if (!faces.empty()) {
    const std::vector<std::string> names(
        surfaces_.begin(),
        surfaces_.begin() + static_cast<long>(std::min(kShown, surfaces_.size())));
    parts.push_back(fmt::format(
        "{}: faces of solids, now the surface{} {}{}", counted(faces),
        surfaces_.size() == 1 ? "" : "s", fmt::join(names, ", "),
        surfaces_.size() > kShown ? fmt::format(" and {} more", surfaces_.size() - kShown) : ""));
  }
  if (!inside.empty())
    parts.push_back(fmt::format("{}: inside a region, left out", counted(inside)));
  if (!elsewhere.empty())
    parts.push_back(fmt::format("{}: not the face of a solid, left out", counted(elsewhere)));
  deck_.notes.push_back(fmt::format("{}: {}", where, fmt::join(parts, "; ")));
}

std::string skin_loss(const std::string& what, double thickness, double mass) {
  std::string text = what + " gives stiffness to faces of solids";
  if (thickness > 0.0) text += fmt::format(", {} thick", thickness);
  if (mass > 0.0) text += fmt::format(", {:.4g} of mass in the deck's units", mass);
  return text + ": left out";
}

std::string counted(const std::map<std::string, int64_t>& kinds) {
  std::string out;
  for (const auto& [kind, count] : kinds)
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, kind);
  return out;
}

}  // namespace clatter::mesh::deck
