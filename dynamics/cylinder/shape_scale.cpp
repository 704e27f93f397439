// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/shape_scale.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/base/error.hpp"
#include "dynamics/cylinder/cylinder_spec.hpp"
#include "dynamics/given/load_table.hpp"

namespace clatter::dynamics {
namespace {

/// The factor by the gas pressure, or by its table, over time.
film::ScaleState scale_at(const Motion<double>& turn, const Spline& table, double zero,
                          double size) {
  return {(table(turn.position) - zero) / size, table.slope(turn.position) * turn.velocity / size};
}

void refuse_elastic(const std::vector<ScaledShapeSpec>& shapes, const char* part) {
  for (const ScaledShapeSpec& shape : shapes)
    if (shape.scale.reference > 0.0)
      throw InputError(
          fmt::format("{}: found \"gas\" on an elastic {}, whose deformation by the gas "
                      "is already in its reduced model, expected model = \"rigid\"",
                      shape.scale.where, part));
}

}  // namespace

const keys::Keys<ShapeScale>& shape_scale_keys() {
  static const keys::Keys<ShapeScale> keys(
      "scale", "factor of a shape over the cycle", [](auto& key, ShapeScale& scale) {
        key.choice("scale", scale.by_gas, {{"gas", true}},
                   "the shape is times the pressure of the gas over at_bar");
        key.number("at_bar", scale.reference, Range::between(0.1, 1e4),
                   "gauge pressure of the gas at which the shape is as given")
            .of("scale");
        key.path("scale_table", scale.table, "CSV of its factor over the crank angle")
            .excludes("scale");
        key.text("scale_column", scale.column, "column of the factor").needs("scale_table");
        key.check([](const Config& table, ShapeScale& found) {
          found.where = table.where(found.by_gas ? "scale" : "scale_table");
          if (!found.table.empty())
            found.factor =
                read_cycle_table(found.table, found.column, "1", Spline::Kind::kMonotoneCubic);
        });
      });
  return keys;
}

film::ScaledShape scaled_shape(const ScaledShapeSpec& spec, const CylinderSpec& cylinder,
                               const SliderCrank& crank, const std::optional<Spline>& gas) {
  const ShapeScale& scale = spec.scale;
  if (scale.factor)
    return {spec.shape, [crank, table = *scale.factor](double time) {
              return scale_at(crank.turn(time), table, 0.0, 1.0);
            }};
  if (!gas) throw InputError(scale.where + ": scale = \"gas\" needs [gas]");
  return {spec.shape, [crank, table = *gas, ambient = cylinder.gas->ambient, at = scale.reference](
                          double time) { return scale_at(crank.turn(time), table, ambient, at); }};
}

void check_scaled_shapes(const CylinderSpec& cylinder, bool elastic_block) {
  if (elastic_block) refuse_elastic(cylinder.scaled_bore, "block");
  if (cylinder.piston.elastic) refuse_elastic(cylinder.scaled_skirt, "piston");
}

}  // namespace clatter::dynamics
