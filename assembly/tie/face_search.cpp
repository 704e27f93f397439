// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/tie/face_search.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::assembly {

Eigen::AlignedBox3d box_of(const TieFace& face) {
  Eigen::AlignedBox3d box;
  for (Eigen::Index k = 0; k < face.x.rows(); ++k) box.extend(face.x.row(k).transpose());
  return box;
}

FaceSearch::FaceSearch(const std::vector<TieFace>& faces, double distance) {
  double sum = 0.0, largest = 0.0;
  for (const TieFace& face : faces) {
    Eigen::AlignedBox3d box = box_of(face);
    // A curved face exceeds the box of its nodes by a small part of its size.
    const double margin = distance + 0.1 * box.diagonal().norm();
    box.min().array() -= margin;
    box.max().array() += margin;
    sum += box.diagonal().norm();
    largest = std::max(largest, box.diagonal().norm());
    boxes_.push_back(box);
  }
  // Limits the cells per face to about a thousand for faces of very different sizes.
  size_ = std::max(sum / static_cast<double>(std::max<size_t>(1, faces.size())), 0.1 * largest);
  for (size_t f = 0; f < boxes_.size(); ++f)
    each_cell(boxes_[f], [&](uint64_t key) { cells_[key].push_back(static_cast<int32_t>(f)); });
}

FaceSearch::Cell FaceSearch::cell_of(const Eigen::Vector3d& x) const {
  return (x / size_).array().floor().cast<int64_t>();
}

template <typename Visit>
void FaceSearch::each_cell(const Eigen::AlignedBox3d& box, const Visit& visit) const {
  const Cell low = cell_of(box.min()), high = cell_of(box.max());
  for (int64_t i = low.x(); i <= high.x(); ++i)
    for (int64_t j = low.y(); j <= high.y(); ++j)
      for (int64_t k = low.z(); k <= high.z(); ++k)
        visit(static_cast<uint64_t>(i) * 73856093u ^ static_cast<uint64_t>(j) * 19349663u ^
              static_cast<uint64_t>(k) * 83492791u);
}

std::vector<int32_t> FaceSearch::near(const Eigen::AlignedBox3d& box) const {
  std::vector<int32_t> found;
  each_cell(box, [&](uint64_t key) {
    const auto cell = cells_.find(key);
    if (cell == cells_.end()) return;
    for (const int32_t face : cell->second)
      if (boxes_[face].intersects(box)) found.push_back(face);
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace clatter::assembly
