// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Private to the files that call Gmsh: converts its exceptions to our errors.
#include <fmt/format.h>
#include <gmsh.h>

#include <new>
#include <string>

#include "core/base/child_process.hpp"
#include "core/base/error.hpp"

static_assert(GMSH_API_VERSION_MAJOR == 4 && GMSH_API_VERSION_MINOR >= 8,
              "written against Gmsh 4.8; later versions rename calls (hard case G10)");

namespace clatter::mesh {

/// True for what Gmsh says when an allocation failed.
inline bool says_memory_ran_out(const std::string& reason) {
  return reason.find("bad_alloc") != std::string::npos ||
         reason.find("Out of memory") != std::string::npos;
}

/// Runs `call`; an exception of Gmsh becomes a `Failure` "what: reason", or std::bad_alloc where
/// memory ran out. `what` is also the step reported if Gmsh ends this process.
template <class Failure = NumericsError, class Call>
auto gmsh_call(const std::string& what, const Call& call) {
  enter_step(what);
  try {
    return call();
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::string& reason) {
    if (says_memory_ran_out(reason)) throw std::bad_alloc();
    throw Failure(fmt::format("{}: {}", what, reason));
  } catch (const std::exception& reason) {
    throw Failure(fmt::format("{}: {}", what, reason.what()));
  }
}

}  // namespace clatter::mesh
