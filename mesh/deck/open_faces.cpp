// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/open_faces.hpp"

#include <algorithm>

namespace clatter::mesh::deck {

OpenFaces::Corners OpenFaces::sorted(std::span<const int32_t> corners) {
  Corners out{};
  std::copy(corners.begin(), corners.end(), out.begin());
  std::ranges::sort(out);
  return out;
}

void OpenFaces::add(std::span<const int32_t> corners) { faces_.push_back({sorted(corners)}); }

size_t OpenFaces::find(const Corners& corners) const {
  const auto at = std::ranges::lower_bound(faces_, corners, {}, &Face::corners);
  const bool found = at != faces_.end() && at->corners == corners;
  return found ? static_cast<size_t>(at - faces_.begin()) : faces_.size();
}

void OpenFaces::close(CellType type, std::span<const int32_t> nodes) {
  if (!is_sorted_) {
    std::ranges::sort(faces_, {}, &Face::corners);
    // clang 14, by which the readers are fuzzed, cannot compile std::ranges::unique.
    const auto same = [](const Face& a, const Face& b) { return a.corners == b.corners; };
    faces_.erase(std::unique(faces_.begin(), faces_.end(), same), faces_.end());
    is_sorted_ = true;
  }
  const auto mark = [&](std::span<const int32_t> corners) {
    const size_t at = find(sorted(corners));
    if (at < faces_.size()) faces_[at].closed = true;
  };
  for (const CellFace& face : traits(type).faces) {
    const auto count = static_cast<size_t>(traits(face.type).corners);
    std::array<int32_t, 4> corners{};
    for (size_t i = 0; i < count; ++i) corners[i] = nodes[static_cast<size_t>(face.nodes[i])];
    mark(std::span(corners).first(count));
    for (size_t left_out = 0; count == 4 && left_out < 4; ++left_out)
      mark(std::array{corners[(left_out + 1) % 4], corners[(left_out + 2) % 4],
                      corners[(left_out + 3) % 4]});
  }
}

bool OpenFaces::is_open(std::span<const int32_t> corners) const {
  const size_t at = find(sorted(corners));
  return at < faces_.size() && !faces_[at].closed;
}

}  // namespace clatter::mesh::deck
