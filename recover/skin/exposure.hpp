// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which sides of a skin's faces meet the open air.
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "recover/skin/skin.hpp"

namespace clatter::recover {

/// Sides of each face from whose centre the way straight off the face leaves the body freely.
/// Faces that touch another one, of a part that is joined there, do not.
struct Exposure {
  std::vector<bool> front;  // along the normal
  std::vector<bool> back;   // against it: of sheets; empty where there are none

  bool of_back(size_t face) const { return !back.empty() && back[face]; }
  bool of_face(size_t face) const { return front[face] || of_back(face); }
};

Exposure exposure_of(const rom::Skin& skin, const SkinGeometry& geometry);

}  // namespace clatter::recover
