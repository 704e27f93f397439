// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to the files that call Gmsh: converts its exceptions to our errors.
#include <fmt/format.h>
#include <gmsh.h>

#include <string>

#include "core/base/child_process.hpp"
#include "core/base/error.hpp"

static_assert(GMSH_API_VERSION_MAJOR == 4 && GMSH_API_VERSION_MINOR >= 8,
              "written against Gmsh 4.8; later versions rename calls (hard case G10)");

namespace clatter::mesh {

/// Runs `call`; an exception of Gmsh becomes a `Failure` "what: reason". `what` is also the step
/// reported if Gmsh ends this process.
template <class Failure = NumericsError, class Call>
auto gmsh_call(const std::string& what, const Call& call) {
  enter_step(what);
  try {
    return call();
  } catch (const Error&) {
    throw;
  } catch (const std::string& reason) {
    throw Failure(fmt::format("{}: {}", what, reason));
  } catch (const std::exception& reason) {
    throw Failure(fmt::format("{}: {}", what, reason.what()));
  }
}

}  // namespace clatter::mesh
