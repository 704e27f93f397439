// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/component_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

void check_name(const Config& table, const std::string& key) {
  if (!table.has(key)) return;
  const std::string name = table.text(key);
  if (name.empty() || name == "." || name.find('/') != std::string::npos)
    table.fail(key, fmt::format("found \"{}\", expected a name without /", name));
}

void check_new_name(const Config& table, const std::string& kind, const std::string& name,
                    std::map<std::string, std::string>& found) {
  std::string same = name;
  std::replace(same.begin(), same.end(), ' ', '_');
  const auto [first, is_new] = found.emplace(same, name);
  if (!is_new)
    table.fail("name", fmt::format("found \"{}\" after a {} \"{}\", expected each name once "
                                   "(_ and blank are the same)",
                                   name, kind, first->second));
}

Eigen::Quaterniond read_quaternion(const Config& table, const std::string& key) {
  const std::vector<double> q = table.numbers(key);
  if (q.size() != 4)
    table.fail(key, fmt::format("found {} numbers, expected 4: w, x, y, z", q.size()));
  const Eigen::Vector4d found(q[0], q[1], q[2], q[3]);
  if (!(std::abs(found.norm() - 1.0) < 1e-3))
    table.fail(key, fmt::format("found length {:g}, expected 1", found.norm()));
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

const Keys<BodySpec>& body_keys() {
  static const Keys<BodySpec> keys(
      "body", "a part with a reduced model", [](auto& key, BodySpec& body) {
        key.where(body.where);
        key.path("rom", body.rom, "its reduced model, stem.rom.h5").required();
        key.choice("model", body.elastic, {{"elastic", true}, {"rigid", false}},
                   "with all of its modes, or its rigid motions alone");
        key.number("mode_limit_hz", body.mode_limit_hz, Range::between(0.0, 1e9),
                   "modes above have no inertia; 0: all have it");
        error_scale_rows(key, body);
      });
  return keys;
}

const Keys<PointSpec>& point_keys() {
  static const Keys<PointSpec> keys("point", "a point of a body", [](auto& key, PointSpec& point) {
    key.text("body", point.body, "the body; without it the ground");
    key.text("set", point.set, "set of the body's reduced model, of one node");
    key.vector("at_mm", point.at, kPositionMm,
               "where the point is at the start, in the scene's axes")
        .excludes("set", "the node of a set has its own position");
    key.check([](const Config& at, PointSpec& found) { found.where = at.where_named(); });
  });
  return keys;
}

}  // namespace clatter::dynamics
