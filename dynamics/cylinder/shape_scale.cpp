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

std::optional<ShapeScale> read_shape_scale(const Config& entry) {
  ShapeScale scale;
  if (entry.has("scale") && entry.has("scale_table"))
    entry.fail("scale_table", "found beside scale, expected one of the two");
  if (entry.has("scale")) {
    entry.choice("scale", {"gas"});
    scale.reference = entry.number("at_bar", Range::between(0.1, 1e4)) * 1e5;
    scale.where = entry.where("scale");
    return scale;
  }
  if (!entry.has("scale_table")) return std::nullopt;
  scale.table = entry.path("scale_table");
  scale.where = entry.where("scale_table");
  scale.factor = read_cycle_table(scale.table, entry.text_or("scale_column", "scale"), "1",
                                  Spline::Kind::kMonotoneCubic);
  return scale;
}

film::ScaledShape scaled_shape(const ScaledShapeSpec& spec, const CylinderSpec& cylinder,
                               const CrankMotion& crank, const std::optional<Spline>& gas) {
  const ShapeScale& scale = spec.scale;
  if (scale.factor)
    return {spec.shape, [turn = crank.turn, table = *scale.factor](double time) {
              return scale_at(turn(time), table, 0.0, 1.0);
            }};
  if (!gas) throw InputError(scale.where + ": found \"gas\" in a scene without it, expected [gas]");
  return {spec.shape,
          [turn = crank.turn, table = *gas, ambient = cylinder.gas->ambient,
           at = scale.reference](double time) { return scale_at(turn(time), table, ambient, at); }};
}

void check_scaled_shapes(const CylinderSpec& cylinder, bool elastic_block) {
  if (elastic_block) refuse_elastic(cylinder.scaled_bore, "block");
  if (cylinder.piston.elastic) refuse_elastic(cylinder.scaled_skirt, "piston");
}

}  // namespace clatter::dynamics
