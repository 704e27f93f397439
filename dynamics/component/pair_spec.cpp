// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/pair_spec.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {

PairSpec read_pair_points(const Config& table, const std::string& kind, size_t number) {
  PairSpec pair;
  pair.name = kind + " " + (table.has("name") ? read_name(table) : fmt::format("{}", number));
  pair.a = read_point(table, "a");
  pair.b = read_point(table, "b");
  return pair;
}

PairSpec read_pair(const Config& table, const std::string& kind, size_t number) {
  PairSpec pair = read_pair_points(table, kind, number);
  pair.stiffness = table.number("stiffness_n_m", Range::between(0.0, 1e20));
  pair.damping = table.number_or("damping_n_s_m", 0.0, Range::between(0.0, 1e15));
  if (pair.stiffness == 0.0 && pair.damping == 0.0)
    table.fail("stiffness_n_m", "found 0 and no damping, expected one of both above 0");
  return pair;
}

PairPorts ports_of(const PairSpec& pair, ModelBuilder& model) {
  if (pair.a.body == pair.b.body && pair.a.set.empty() && pair.b.set.empty())
    throw InputError(fmt::format(
        "{}: is a point of {} as a is, which never move apart, expected one of another body",
        pair.b.where, pair.a.body.empty() ? "the ground" : '"' + pair.a.body + '"'));
  PairPorts ports;
  ports.a = model.port(pair.a);
  ports.b = model.port(pair.b, model.position(pair.a, std::nullopt));
  return ports;
}

}  // namespace clatter::dynamics
