// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Keys that the tables of several components have.
//
// Ranges, here and in the tables of components, are those of any machine, from model engines to
// ship diesels, with a wide margin: a value outside is a slip of unit or sign. They also keep
// products and powers of values finite.
#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/keys/keys.hpp"
#include "dynamics/component/loaded_body.hpp"
#include "dynamics/component/model_builder.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

using keys::Keys;

/// Ranges of displacement_um and velocity_m_s, of [accuracy] and of single bodies.
inline const Range kDisplacementScaleUm = Range::between(1e-15, 1e6);
inline const Range kVelocityScale = Range::between(1e-18, 1e4);
/// Of coordinates [mm], and of angles [deg].
inline const Range kPositionMm = Range::between(-1e6, 1e6), kAngleDeg = Range::between(-1e6, 1e6);
/// Of springs and dampers, [N/m] and [N s/m], in general.
inline const Range kAnyStiffness = Range::between(0.0, 1e20),
                   kAnyDamping = Range::between(0.0, 1e15);

/// InputError for a name that is no group of the run file: "", "." and one with /.
void check_name(const Config& table, const std::string& key = "name");
/// InputError for a name that `found` has: histories, energies and states of elements are found by
/// name, where _ and blank are the same (hard case S3). Adds it.
void check_new_name(const Config& table, const std::string& kind, const std::string& name,
                    std::map<std::string, std::string>& found);

/// The key "name".
template <class S>
keys::Row name_row(Keys<S>& key, std::string& at) {
  key.check([](const Config& table, S&) { check_name(table); });
  return key.text("name", at, "name in messages and in the run file");
}

/// All tables [[kind]], with names of their own; one without a name has its number, from 1.
template <class S>
std::vector<S> read_named(const Config& root, const std::string& kind, const Keys<S>& keys) {
  std::vector<S> list;
  std::map<std::string, std::string> found;
  for (const Config& table : root.tables(kind)) {
    S& spec = list.emplace_back(keys.read(table));
    if (spec.name.empty()) spec.name = std::to_string(list.size());
    check_new_name(table, kind, spec.name, found);
  }
  return list;
}

/// The same with names of elements, "stop 1" or "stop table".
template <class S>
std::vector<S> read_elements(const Config& root, const std::string& kind, const Keys<S>& keys) {
  std::vector<S> list = read_named(root, kind, keys);
  for (S& spec : list) spec.name = kind + " " + spec.name;
  return list;
}

/// The scales of the error test of a body.
template <class S, class Body>
void error_scale_rows(Keys<S>& key, Body& body) {
  key.number("displacement_um", body.displacement_scale, kDisplacementScaleUm,
             "displacement of this body that the error test refers to, instead of [accuracy]");
  key.number("velocity_m_s", body.velocity_scale, kVelocityScale,
             "velocity of this body that the error test refers to, instead of [accuracy]");
}

/// The key "interpolation".
template <class S>
keys::Row interpolation_row(Keys<S>& key, Spline::Kind& at) {
  return key.choice("interpolation", at,
                    {{"linear", Spline::Kind::kLinear}, {"cubic", Spline::Kind::kMonotoneCubic}},
                    "between the rows of the table; cubic is monotone");
}

/// The key "axis" of what turns about x, y or z.
template <class S>
keys::Row axis_row(Keys<S>& key, int& at) {
  return key.choice("axis", at, {{"x", 0}, {"y", 1}, {"z", 2}},
                    "axis about which it turns, right-handed");
}

/// The key "quaternion" of length 1.
Eigen::Quaterniond read_quaternion(const Config& table, const std::string& key);
template <class S>
keys::Row quaternion_row(Keys<S>& key, Eigen::Quaterniond& at) {
  return key.value("quaternion", at, "list of 4 numbers w, x, y, z of length 1",
                   "attitude at the start; [1, 0, 0, 0] without it",
                   [](const Config& table, const std::string& name, Eigen::Quaterniond& value) {
                     value = read_quaternion(table, name);
                   });
}

/// rom, model, mode_limit_hz and the scales of the error test.
const Keys<BodySpec>& body_keys();

/// A point of an element: body, and set or at_mm.
const Keys<PointSpec>& point_keys();

}  // namespace clatter::dynamics
