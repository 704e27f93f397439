// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/unv_kinds.hpp"

#include <array>

namespace clatter::mesh::deck {

UnvKind unv_kind(CellType type) {
  static constexpr std::array<int, 8> kCorners = {0, 1, 2, 3, 4, 5, 6, 7};
  static constexpr std::array<int, 10> kTet10 = {0, 4, 1, 5, 2, 6, 7, 9, 8, 3};
  static constexpr std::array<int, 20> kHex20 = {0,  8,  1, 11, 2, 13, 3, 9,  10, 12,
                                                 14, 15, 4, 16, 5, 18, 6, 19, 7,  17};
  static constexpr std::array<int, 15> kWedge15 = {0,  6, 1,  9, 2,  7, 8, 10,
                                                   11, 3, 12, 4, 14, 5, 13};
  const std::span<const int> corners(kCorners);
  switch (type) {
    case CellType::kTet4:
      return {111, corners.first(4)};
    case CellType::kTet10:
      return {118, kTet10};
    case CellType::kWedge6:
      return {112, corners.first(6)};
    case CellType::kWedge15:
      return {113, kWedge15};
    case CellType::kHex8:
      return {115, corners.first(8)};
    case CellType::kHex20:
      return {116, kHex20};
    default:
      return {0, {}};
  }
}

UnvKind unv_kind(FaceType type) {
  static constexpr std::array<int, 6> kTri6 = {0, 3, 1, 4, 2, 5};
  static constexpr std::array<int, 8> kQuad8 = {0, 4, 1, 5, 2, 6, 3, 7};
  static constexpr std::array<int, 4> kCorners = {0, 1, 2, 3};
  const std::span<const int> corners(kCorners);
  switch (type) {
    case FaceType::kTri3:
      return {91, corners.first(3)};
    case FaceType::kTri6:
      return {92, kTri6};
    case FaceType::kQuad4:
      return {94, corners};
    default:
      return {95, kQuad8};
  }
}

std::optional<CellType> unv_cell(int descriptor) {
  for (int t = 0; t < kCellTypes; ++t) {
    const auto type = static_cast<CellType>(t);
    if (descriptor > 0 && unv_kind(type).descriptor == descriptor) return type;
  }
  return std::nullopt;
}

// Plane stress 4x, plane strain 5x, membrane 7x, axisymmetric 8x, thin shell 9x.
std::optional<FaceType> unv_face(int descriptor) {
  const int family = descriptor / 10;
  if (family < 4 || family > 9) return std::nullopt;
  switch (descriptor % 10) {
    case 1:
      return FaceType::kTri3;
    case 2:
      return FaceType::kTri6;
    case 4:
      return FaceType::kQuad4;
    case 5:
      return FaceType::kQuad8;
    default:
      return std::nullopt;
  }
}

int unv_line_nodes(int descriptor) {
  if (descriptor == 11 || descriptor == 21 || descriptor == 22) return 2;
  return descriptor == 23 || descriptor == 24 ? 3 : 0;
}

}  // namespace clatter::mesh::deck
