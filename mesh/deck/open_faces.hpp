// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which two-dimensional cells between nodes of solids are no skins of them, but walls in the air.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/cell.hpp"

namespace clatter::mesh::deck {

/// Cells by their corners, which the faces of solids close.
class OpenFaces {
 public:
  /// @param corners three or four node numbers above 0.
  void add(std::span<const int32_t> corners);
  bool empty() const { return faces_.empty(); }
  /// Closes those that are a face of a cell, or a triangle of its corners. After the last add().
  /// @param nodes of the cell, in the order of cell.hpp.
  void close(CellType type, std::span<const int32_t> nodes);
  /// Whether no face has closed it.
  bool is_open(std::span<const int32_t> corners) const;

 private:
  using Corners = std::array<int32_t, 4>;  // ascending; a triangle begins with 0
  struct Face {
    Corners corners;
    bool closed = false;
  };
  static Corners sorted(std::span<const int32_t> corners);
  /// Index; the number of faces for none.
  size_t find(const Corners& corners) const;

  std::vector<Face> faces_;
  bool is_sorted_ = false;
};

}  // namespace clatter::mesh::deck
