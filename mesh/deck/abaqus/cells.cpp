// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/cells.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "mesh/deck/field_text.hpp"

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

}  // namespace

std::span<const SolidType> solid_types() { return kSolids; }

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

}  // namespace clatter::mesh::deck::abaqus
