// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/faces_by_nodes.hpp"

#include <algorithm>

namespace clatter::mesh::deck {
namespace {

// True when the corners of `face` follow each other as in `nodes`.
bool same_sense(const BoundaryFace& face, std::span<const int32_t> nodes) {
  const auto corners = static_cast<size_t>(traits(face.type).corners);
  const auto* begin = face.ids.begin();
  const auto at = static_cast<size_t>(std::find(begin, begin + corners, nodes[0]) - begin);
  return face.ids[(at + 1) % corners] == nodes[1];
}

}  // namespace

FacesByNodes::Found FacesByNodes::find(FaceType type, std::span<const int32_t> nodes) const {
  Found found;
  const auto [first, last] =
      std::equal_range(faces_.begin(), faces_.end(), FaceRef{face_key(type, nodes), 0, 0, 0},
                       [](const FaceRef& a, const FaceRef& b) { return a.key < b.key; });
  if (first == last) return found;
  found.face = face_at(mesh_, *first);
  found.has_more_nodes = traits(type).order < traits(found.face.type).order;
  const auto all = found.face.nodes();
  const bool same =
      all.size() == nodes.size() && std::is_permutation(nodes.begin(), nodes.end(), all.begin());
  found.fit = Fit::kOtherNodes;
  if (!same && !found.has_more_nodes) return found;
  found.fit = Fit::kBoundary;
  if (last - first == 1) return found;
  const BoundaryFace other = face_at(mesh_, *(first + 1));
  const auto region = [&](const BoundaryFace& face) { return mesh_.cells[face.block].region; };
  found.fit = region(found.face) == region(other) ? Fit::kInside : Fit::kBetween;
  if (!same_sense(found.face, nodes)) found.face = other;
  return found;
}

}  // namespace clatter::mesh::deck
