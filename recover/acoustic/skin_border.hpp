// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where the skin of a body is not closed.
#include "core/rom/reduced_model.hpp"

namespace clatter::recover {

/// Edges that belong to one face only, without those of sheets, which have no inside.
struct SkinBorder {
  int64_t edges = 0;
  double widest = 0.0;  // [m], largest side of the box around one connected border
};

SkinBorder skin_border(const rom::Skin& skin);

}  // namespace clatter::recover
