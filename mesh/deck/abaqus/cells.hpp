// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Element types and their face numbers.
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "core/mesh/cell.hpp"
#include "mesh/deck/deck.hpp"

namespace clatter::mesh::deck::abaqus {

/// A solid element type. C3D8 and C3D20 are fully integrated, C3D8I has incompatible modes, R means
/// reduced integration; C3D6 and C3D15 have the two and nine points of reduced wedges. Variants
/// without a counterpart of their own (H hybrid, M modified, S stress at the surface, T with
/// temperatures, C3D10I) are read as the type without these letters.
struct SolidType {
  std::string_view name;
  CellType type;
  Formulation formulation;
  std::string_view variant;  // what the nearest counterpart leaves out; empty: nothing
};

/// All that are supported.
std::span<const SolidType> solid_types();
/// By folded name; none for types that are not supported solids.
std::optional<SolidType> solid_type(std::string_view name);

/// Why an element type is refused, and what replaces it; empty for types without an entry.
std::string_view replacement_of(std::string_view name);
/// Those types.
std::span<const std::pair<std::string_view, std::string_view>> replaced_types();

/// The face that a two-dimensional element is (CPS6, S3, STRI65, M3D4R, SFM3D8), by folded name;
/// none for other types.
std::optional<FaceType> thin_type(std::string_view name);
/// Two-dimensional elements that are read as shells.
std::span<const std::string_view> shell_types();
bool is_shell_type(std::string_view name);
/// Nodes of a one-dimensional element (T3D2, B31), 2 or 3; 0 for other types.
int line_nodes(std::string_view name);

/// Index into traits(type).faces of face `number` (1 for S1, P1); -1 where the cell has no such
/// face.
///   tet      1 1-2-3    2 1-4-2    3 2-4-3    4 3-4-1
///   wedge    1 1-2-3    2 4-6-5    3 1-4-5-2  4 2-5-6-3  5 3-6-4-1
///   hex      1 1-2-3-4  2 5-8-7-6  3 1-5-6-2  4 2-6-7-3  5 3-7-8-4  6 4-8-5-1
///   pyramid  1 1-2-3-4  2 1-5-2    3 2-5-3    4 3-5-4    5 4-5-1
int face_of_number(CellType type, int number);
/// The inverse: 1, 2, ...
int number_of_face(CellType type, int face);

}  // namespace clatter::mesh::deck::abaqus
