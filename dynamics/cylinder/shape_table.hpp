// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Warm, bolted, worn shapes of bore and skirt: [[contact.bore_shape]] and [[contact.skirt_shape]].
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/cylinder/shape_scale.hpp"
#include "dynamics/film/gap.hpp"

namespace clatter::dynamics {

/// A shape that is added to a surface: a case of a shape file, columns of a table by angle, or an
/// order around with amplitudes along the height, with or without a factor over the crank angle.
struct ShapeTable {
  std::filesystem::path file, table;  // or the order
  std::string name;                   // of the case
  std::optional<int> order;
  std::vector<std::string> columns;
  std::vector<double> angle, height, amplitude;  // of columns [rad]; of the order [m], [m]
  double phase = 0.0, factor = 1.0;              // of the order [rad]; of all deviations
  ShapeScale scale;
  film::LinerShape shape;  // that follows
};
const keys::Keys<ShapeTable>& shape_keys();

}  // namespace clatter::dynamics
