// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shapes of rigid surfaces that a factor scales over the cycle: keys scale, at_bar, scale_table,
// scale_column.
#include <filesystem>
#include <optional>
#include <string>

#include "core/keys/keys.hpp"
#include "dynamics/film/cycle_scale.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

struct CylinderSpec;

/// The factor of a shape over the crank angle from the cylinder's firing TDC.
struct ShapeScale {
  std::optional<bool> by_gas;   // the shape is that at
  double reference = 0.0;       // this gauge pressure of the gas [Pa]; or
  std::filesystem::path table;  // the factor is a column of this file
  std::string column = "scale";
  std::optional<Spline> factor;
  std::string where;  // "file:line: key", for messages
  bool is_given() const { return by_gas || factor; }
};
const keys::Keys<ShapeScale>& shape_scale_keys();

struct ScaledShapeSpec {
  film::LinerShape shape;
  ShapeScale scale;
};

/// The shape with its factor over the time of the clock. @param gas the cylinder's pressure.
/// InputError for gas that the scene does not have.
film::ScaledShape scaled_shape(const ScaledShapeSpec& spec, const CylinderSpec& cylinder,
                               const SliderCrank& crank, const std::optional<Spline>& gas);

/// InputError where a gas deformation is added to a part that is elastic, and so has it already.
void check_scaled_shapes(const CylinderSpec& cylinder, bool elastic_block);

}  // namespace clatter::dynamics
