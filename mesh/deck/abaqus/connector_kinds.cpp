// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/connector_kinds.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string>

namespace clatter::mesh::deck::abaqus {
namespace {

struct NamedKind {
  std::string_view name;  // folded
  ConnectorKind kind;
};

constexpr DofMask kTurns = 0b111000;

constexpr std::array kKinds = {
    NamedKind{"BEAM", {kAllDofs, 0}},
    NamedKind{"WELD", {kAllDofs, 0}},
    NamedKind{"HINGE", {0b110111, 0b001000}},
    NamedKind{"UJOINT", {0b010111, 0b101000}},
    NamedKind{"TRANSLATOR", {0b111110, 0b000001}},
    NamedKind{"CYLINDRICAL", {0b110110, 0b001001}},
    NamedKind{"PLANAR", {0b110001, 0b001110}},
    NamedKind{"BUSHING", {0, kAllDofs, false, true}},
    NamedKind{"JOIN", {kTranslations, 0}},
    NamedKind{"LINK", {0b000001, 0, true}},
    NamedKind{"AXIAL", {0, 0b000001, true}},
    NamedKind{"CARTESIAN", {0, kTranslations}},
    NamedKind{"PROJECTIONCARTESIAN", {0, kTranslations, false, true}},
    NamedKind{"SLOT", {0b000110, 0b000001}},
    NamedKind{"SLIDE-PLANE", {0b000001, 0b000110}},
    NamedKind{"ALIGN", {kTurns, 0}},
    NamedKind{"REVOLUTE", {0b110000, 0b001000}},
    NamedKind{"UNIVERSAL", {0b010000, 0b101000}},
    NamedKind{"CARDAN", {0, kTurns}},
    NamedKind{"ROTATION", {0, kTurns}},
    NamedKind{"PROJECTIONFLEXION-TORSION", {0, kTurns}},
};

ConnectorKind kind_named(const Fields& types, size_t i) {
  const std::string name = folded(types.text(i));
  for (const NamedKind& one : kKinds)
    if (one.name == name) return one.kind;
  std::vector<std::string_view> names;
  for (const NamedKind& one : kKinds) names.push_back(one.name);
  types.fail(
      fmt::format("*CONNECTOR SECTION: connection {} is not supported, expected {}; ignore "
                  "= [\"CONN3D2\", \"*CONNECTOR SECTION\"] skips all connections, which "
                  "[[spring]], [[equation]] and [[coupling]] of the recipe replace",
                  shown(types.text(i)), fmt::join(names, ", ")));
}

}  // namespace

ConnectorKind connector_kind(const Fields& types) {
  types.word(0, "a type of connection");
  const ConnectorKind first = kind_named(types, 0);
  if (types.blank(1)) return first;
  const ConnectorKind second = kind_named(types, 1);
  const bool moves_first = (first.components() & kTurns) == 0;
  const ConnectorKind& along = moves_first ? first : second;
  const ConnectorKind& about = moves_first ? second : first;
  if ((along.components() & kTurns) != 0 || (about.components() & kTranslations) != 0)
    types.fail(
        "*CONNECTOR SECTION: expected one type, or a translational and a rotational one of two");
  return {static_cast<DofMask>(along.constrained | about.constrained),
          static_cast<DofMask>(along.available | about.available), along.along_line,
          along.mean_axes};
}

}  // namespace clatter::mesh::deck::abaqus
