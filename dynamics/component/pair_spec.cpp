// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/pair_spec.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::dynamics {

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
