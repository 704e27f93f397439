// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Keys that the tables of several components have.
//
// Ranges, here and in the tables of components, are those of any machine, from model engines to
// ship diesels, with a wide margin: a value outside is a slip of unit or sign. They also keep
// products and powers of values finite.
#include <Eigen/Core>
#include <string>
#include <string_view>

#include "core/base/config.hpp"
#include "dynamics/component/loaded_body.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/given/crank_clock.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// Ranges of displacement_um and velocity_m_s, of [accuracy] and of single bodies.
inline const Range kDisplacementScaleUm = Range::between(1e-15, 1e6);
inline const Range kVelocityScale = Range::between(1e-18, 1e4);

/// displacement_um and velocity_m_s of a body, where the table has them.
template <class Body>
void read_error_scales(const Config& table, Body& body) {
  if (table.has("displacement_um"))
    body.displacement_scale = table.number("displacement_um", kDisplacementScaleUm) * 1e-6;
  if (table.has("velocity_m_s")) body.velocity_scale = table.number("velocity_m_s", kVelocityScale);
}

/// rom, model, mode_limit_hz and the scales of the error test.
void read_body(const Config& table, const std::string& name, BodySpec& body);

/// speed_rpm and [[engine.order]] of [engine], or speed_table and speed_column.
CrankClock read_crank_clock(const Config& engine);

/// The key "interpolation", "linear" | "cubic".
Spline::Kind read_interpolation(const Config& table, std::string_view fallback);

/// The name of a body or cylinder: a group of the run file. InputError for "", "." and one with /.
std::string read_name(const Config& table);

/// The key "quaternion", w, x, y, z of length 1; the identity without it.
Eigen::Vector4d read_quaternion(const Config& table);

/// Three numbers, each at most `limit` in size.
Eigen::Vector3d read_vector(const Config& table, std::string_view key, double limit);

/// A direction: three numbers that are not all 0, scaled to length 1.
Eigen::Vector3d read_direction(const Config& table, std::string_view key);

/// The sub-table `key` of an element, a point: body, and set or at_mm.
PointSpec read_point(const Config& table, std::string_view key);

}  // namespace clatter::dynamics
