// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The row of a dimension of a part.
#include "core/keys/keys.hpp"

namespace clatter::mesh {

/// A positive length in the part's unit.
template <class Rows>
keys::Row length(Rows& key, const char* name, double& at, const char* meaning) {
  return key.number(name, at, Range::positive(), meaning).shown_in("length_unit");
}

}  // namespace clatter::mesh
