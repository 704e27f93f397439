// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/limits_option.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::mesh {

void declare_limits(CommandLine& line, ChildLimits& limits) {
  line.option("--time-limit", limits.seconds,
              "seconds of wall time that gmsh may take; 0: no limit");
  line.memory_limit("gmsh is stopped there with a message");
}

void check_limits(const ChildLimits& limits) {
  if (!(limits.seconds >= 0.0))
    throw InputError(fmt::format("--time-limit: found {}, expected seconds or 0", limits.seconds));
}

}  // namespace clatter::mesh
