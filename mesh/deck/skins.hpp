// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Two-dimensional cells of a deck beside its solids: those that are a face of a solid are surfaces.
#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/deck/deck.hpp"
#include "mesh/deck/faces_by_nodes.hpp"

namespace clatter::mesh::deck {

/// A cell as a deck has it (CPS6, S3, CTRIA3).
struct SkinCell {
  std::string kind;
  FaceType type = FaceType::kTri3;
  std::array<NodeIndex, kMaxFaceNodes> nodes{};  // of the mesh; -1: of no solid
};

class Skins {
 public:
  /// Finds the faces of the cells.
  Skins(Deck& deck, std::vector<SkinCell> cells);

  /// True for a face of the boundary or between regions.
  bool is_surface(size_t cell) const { return found_[cell].is_surface(); }
  bool is_inside(size_t cell) const { return found_[cell].fit == FacesByNodes::Fit::kInside; }
  const SkinCell& cell(size_t cell) const { return cells_[cell]; }
  size_t size() const { return cells_.size(); }
  /// Of its corners; 0 unless all nodes belong to solids.
  double area(size_t cell) const;
  /// The faces of those cells as a surface, each once, under an unused name that begins with
  /// `name`; none when no cell is a face.
  void add_surface(const std::string& name, const std::vector<size_t>& cells);
  /// One line for Deck::notes: how many are faces, inside of a region, or elsewhere and left out.
  void note(const std::string& where) const;

 private:
  Deck& deck_;
  std::vector<SkinCell> cells_;
  std::vector<FacesByNodes::Found> found_;
  std::vector<std::string> surfaces_;
};

/// A note of what a section or property gives to faces of solids, which is left out.
/// @param thickness 0: not known. @param mass in the deck's units.
std::string skin_loss(const std::string& what, double thickness, double mass);

/// "12 CPS6, 3 S3".
std::string counted(const std::map<std::string, int64_t>& kinds);

}  // namespace clatter::mesh::deck
