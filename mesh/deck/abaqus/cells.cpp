// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/cells.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "mesh/deck/field_text.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr std::array kSolids = {
    SolidType{"C3D4", CellType::kTet4, Formulation::kDefault, ""},
    SolidType{"C3D5", CellType::kPyramid5, Formulation::kDefault, ""},
    SolidType{"C3D6", CellType::kWedge6, Formulation::kReduced, ""},
    SolidType{"C3D8", CellType::kHex8, Formulation::kFull, ""},
    SolidType{"C3D8I", CellType::kHex8, Formulation::kIncompatible, ""},
    SolidType{"C3D8R", CellType::kHex8, Formulation::kReduced, ""},
    SolidType{"C3D10", CellType::kTet10, Formulation::kDefault, ""},
    SolidType{"C3D15", CellType::kWedge15, Formulation::kReduced, ""},
    SolidType{"C3D20", CellType::kHex20, Formulation::kFull, ""},
    SolidType{"C3D20R", CellType::kHex20, Formulation::kReduced, ""},
};

// Letters of variants that are read as the type without them.
constexpr std::array<std::pair<char, std::string_view>, 4> kVariants = {
    {{'H', "the pressure as an unknown of its own"},
     {'M', "the modified interpolation"},
     {'S', "improved stress at the surface"},
     {'T', "temperatures as unknowns"}}};

// Elements that a solid of the same nodes replaces.
constexpr std::string_view kContinuumShell =
    "a continuum shell; the same nodes as TYPE=C3D8I (bends like a shell, one element through the "
    "thickness) with a *SOLID SECTION replace it; for layers, one element and *ORIENTATION each";
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kReplaced = {
    {{"SC6R",
      "a continuum shell; the same nodes as TYPE=C3D6 or, with mid-side nodes, C3D15 and a *SOLID "
      "SECTION replace it: C3D6 is too stiff in bending, take several through the thickness"},
     {"SC8R", kContinuumShell},
     {"CSS8", kContinuumShell}}};

// Families of two-dimensional elements; the number of nodes follows.
constexpr std::array<std::string_view, 8> kThinFamilies = {"CPS",  "CPE", "SFM3D", "M3D",
                                                           "STRI", "R3D", "DS",    "S"};

constexpr std::array<std::string_view, 8> kShellTypes = {"S3", "S3R", "S4",  "S4R",
                                                         "S6", "S8",  "S8R", "STRI65"};

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
    out |= 1u << cell_face.nodes[i];
  }
  return out;
}

}  // namespace

std::span<const SolidType> solid_types() { return kSolids; }

std::optional<SolidType> solid_type(std::string_view name) {
  std::string key = folded(name);
  for (const SolidType& solid : kSolids) {
    if (solid.name == key) return solid;
  }
  std::string_view variant;
  for (const auto& [letter, meaning] : kVariants) {
    const size_t at = key.starts_with("C3D") ? key.find_first_not_of("0123456789", 3) : key.npos;
    const size_t letters = at == key.npos ? key.npos : key.find(letter, at);
    if (letters == key.npos) continue;
    key.erase(letters, 1);
    if (variant.empty()) variant = meaning;
  }
  if (key == "C3D10I") key = "C3D10", variant = "improved stress at the surface";
  for (SolidType solid : kSolids) {
    if (solid.name != key || variant.empty()) continue;
    solid.variant = variant;
    return solid;
  }
  return std::nullopt;
}

std::span<const std::pair<std::string_view, std::string_view>> replaced_types() {
  return kReplaced;
}

std::string_view replacement_of(std::string_view name) {
  for (const auto& [type, what] : kReplaced)
    if (type == folded(name)) return what;
  return "";
}

std::optional<FaceType> thin_type(std::string_view name) {
  const std::string key = folded(name);
  for (const std::string_view family : kThinFamilies) {
    if (!key.starts_with(family) || key.size() == family.size()) continue;
    const std::string_view rest = std::string_view(key).substr(family.size());
    if (family == "STRI" && rest.starts_with("65")) return FaceType::kTri6;
    switch (rest.front()) {
      case '3':
        return FaceType::kTri3;
      case '4':
        return FaceType::kQuad4;
      case '6':
        return FaceType::kTri6;
      case '8':
        return FaceType::kQuad8;
      default:
        break;
    }
  }
  return std::nullopt;
}

std::span<const std::string_view> shell_types() { return kShellTypes; }

bool is_shell_type(std::string_view name) {
  return std::ranges::find(kShellTypes, folded(name)) != kShellTypes.end();
}

int line_nodes(std::string_view name) {
  const std::string key = folded(name);
  if (key.starts_with("T3D2") || key.starts_with("B31") || key.starts_with("B33")) return 2;
  return key.starts_with("T3D3") || key.starts_with("B32") ? 3 : 0;
}

int face_of_number(CellType type, int number) {
  const auto wanted = numbered_faces(type);
  if (number < 1 || number > static_cast<int>(wanted.size())) return -1;
  for (size_t f = 0; f < wanted.size(); ++f) {
    if (corners_of(type, f) == wanted[number - 1]) return static_cast<int>(f);
  }
  return -1;
}

int number_of_face(CellType type, int face) {
  const auto faces = numbered_faces(type);
  const unsigned corners = corners_of(type, static_cast<size_t>(face));
  return static_cast<int>(std::find(faces.begin(), faces.end(), corners) - faces.begin()) + 1;
}

}  // namespace clatter::mesh::deck::abaqus
