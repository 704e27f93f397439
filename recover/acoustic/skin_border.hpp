// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where the skin of a body is not closed.
#include "core/base/matrix.hpp"

namespace clatter::recover {

/// Edges that belong to one face only.
struct SkinBorder {
  int64_t edges = 0;
  double widest = 0.0;  // [m], largest side of the box around one connected border
};

/// @param nodes n_s x 3 [m]
/// @param triangles n_f x 6, quadratic
SkinBorder skin_border(const RowMatrix& nodes, const IndexMatrix& triangles);

}  // namespace clatter::recover
