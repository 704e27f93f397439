// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The row of the cells of a sheet.
#include "core/keys/keys.hpp"
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

template <class Rows>
keys::Row cells_of_sheet(Rows& key, SheetCells& at) {
  return key.choice(
      "cells", at,
      {{"quadrilaterals", SheetCells::kQuadrilaterals},
       {"triangles", SheetCells::kTriangles},
       {"quadratic", SheetCells::kQuadratic}},
      "quadrilaterals, with triangles where they must be; or triangles, which are stiffer in their "
      "plane; or quadratic quadrilaterals and triangles, as exact with twice the size or more");
}

}  // namespace clatter::mesh
