// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/ring/ring_lateral.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

namespace clatter::dynamics {
namespace {

constexpr int kCells = 72;
constexpr double kHalfWidth = 1e-3;  // of the cells, whose middle counts [m]

film::PadGrid ring_cells(double height, double radius) {
  return film::PadGrid::uniform(-std::numbers::pi, std::numbers::pi, kCells, height - kHalfWidth,
                                height + kHalfWidth, 1, radius, true);
}

}  // namespace

RingLateral::RingLateral(const film::ElasticSurface& liner, double height, double radius)
    : cells_(ring_cells(height, radius)),
      map_(liner, cells_),
      place_(static_cast<size_t>(map_.columns()), -1),
      stroke_(std::numeric_limits<double>::quiet_NaN()) {
  columns_.reserve(place_.size());
}

void RingLateral::move(double stroke) {
  if (stroke == stroke_) return;
  stroke_ = stroke;
  map_.at(stroke, by_cell_, &by_cell_slope_);
  for (const int column : columns_) place_[column] = -1;
  columns_.clear();
  for (Eigen::Index k = 0; k < by_cell_.nonZeros(); ++k) {
    const int column = by_cell_.innerIndexPtr()[k];
    int& place = place_[column];
    if (place >= 0) continue;
    place = 0;
    columns_.push_back(column);
  }
  std::sort(columns_.begin(), columns_.end());
  for (size_t k = 0; k < columns_.size(); ++k) place_[columns_[k]] = static_cast<int>(k);
  rows_.setZero(2, std::ssize(columns_));
  slope_.setZero(2, std::ssize(columns_));
  for (int i = 0; i < kCells; ++i) {
    const Eigen::Vector2d weight = 2.0 / kCells * film::pad_normal(cells_.angle(i)).head<2>();
    for (auto k = by_cell_.outerIndexPtr()[i]; k < by_cell_.outerIndexPtr()[i + 1]; ++k) {
      const int place = place_[by_cell_.innerIndexPtr()[k]];
      rows_.col(place) += by_cell_.valuePtr()[k] * weight;
      slope_.col(place) += by_cell_slope_.valuePtr()[k] * weight;
    }
  }
}

}  // namespace clatter::dynamics
