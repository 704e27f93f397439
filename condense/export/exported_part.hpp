// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A reduced part in the units and with the node numbers of the program that will read it.
#include <optional>
#include <string>
#include <vector>

#include "core/base/units.hpp"
#include "core/rom/dof_map.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

struct ExportOptions {
  std::optional<UnitSystem> units;  // absent: as the format's row in export.cpp says
  rom::NodeNumbering numbering;
  int32_t first_element = 0;   // of CalculiX; 0: after those of the deck, else as nodes
  bool deck_nodes = false;     // writes nodes that the rest of the deck has as well
  bool binary = false;         // binary where a format has both
  int32_t superelement = 100;  // its number in Nastran's partitioned bulk data
  std::string interface;  // set of the six coordinates of OpenFAST's interface; empty: the only
};

/// What a writer gets. Coordinates, positions and matrices are in `units`.
struct ExportedPart {
  rom::ReducedModel model;
  std::vector<rom::MappedDof> map;  // entry j is coordinate j
  UnitSystem units;
  ExportOptions options;

  bool held() const { return model.inertia_force.rows() > 0; }  // by supports
};

/// `model` in `units`: a displacement counts in lengths, a modal coordinate has the mass 1 where it
/// had 1 kg. Loads and contact grids, which no format has, are left out.
rom::ReducedModel in_units(rom::ReducedModel model, const UnitSystem& units);

/// InputError when a new node gets a number that is taken.
ExportedPart exported_part(const rom::ReducedModel& model, const UnitSystem& units,
                           const ExportOptions& options);

/// "SI: m, kg, s, N", "units mm-t-s".
std::string text_of(const UnitSystem& units);

}  // namespace clatter::condense
