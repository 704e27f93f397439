// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/gap_map.hpp"

#include <algorithm>

namespace clatter::film {

namespace {

void mark(const SparseRows& rows, int first, std::vector<char>& marks) {
  for (Eigen::Index k = 0; k < rows.nonZeros(); ++k)
    marks[static_cast<size_t>(first + rows.innerIndexPtr()[k])] = 1;
}

}  // namespace

GapMap::GapMap(const PistonLinerBodies& bodies, const ContactCoordinates& at, const PadGrid& pad,
               const Eigen::VectorXd& height_by_y)
    : at_(at),
      height_by_y_(height_by_y),
      always_(static_cast<size_t>(at.size()), 0),
      column_(static_cast<size_t>(at.size()), -1),
      cells_(pad.size()) {
  if (bodies.piston) {
    PatchMap(*bodies.piston, pad).at(0.0, piston_);
    piston_ *= -1.0;
    mark(piston_, 0, always_);
    pin_.setZero(cells_, 6);
  } else {
    pin_ = -rigid_radial(pad, 0.0, bodies.bore_axis);
  }
  if (bodies.liner) liner_map_.emplace(*bodies.liner, pad);
  std::fill(always_.begin() + at.pin(), always_.end(), 1);
  used_ = always_;
  list_columns();
}

void GapMap::move(double height) {
  if (!liner_map_) return;
  liner_map_->at(height, liner_, &liner_slope_);
  used_ = always_;
  mark(liner_, at_.liner(), used_);
  list_columns();
}

void GapMap::list_columns() {
  columns_.clear();
  for (int i = 0; i < at_.size(); ++i) {
    if (used_[static_cast<size_t>(i)] == 0) continue;
    column_[static_cast<size_t>(i)] = static_cast<int>(columns_.size());
    columns_.push_back(i);
  }
  gather(height_by_y_, height_by_column_);
}

void GapMap::gather(const Eigen::VectorXd& all, Eigen::VectorXd& picked) const {
  picked.resize(static_cast<Eigen::Index>(columns_.size()));
  for (size_t i = 0; i < columns_.size(); ++i)
    picked[static_cast<Eigen::Index>(i)] = all[columns_[i]];
}

void GapMap::add(const Eigen::VectorXd& y, Eigen::ArrayXd& gap) const {
  if (piston_.rows() > 0) gap += (piston_ * y.head(piston_.cols())).array();
  if (liner_map_) gap += (liner_ * y.segment(at_.liner(), liner_.cols())).array();
  gap += (pin_ * y.segment<6>(at_.pin())).array();
}

void GapMap::add_slope(const Eigen::VectorXd& y, Eigen::ArrayXd& slope) const {
  if (liner_map_) slope += (liner_slope_ * y.segment(at_.liner(), liner_slope_.cols())).array();
}

Eigen::VectorXd GapMap::slope_transposed(const Eigen::VectorXd& cells) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_.size()));
  if (!liner_map_) return result;
  for (int c = 0; c < cells_; ++c)
    for (SparseRows::InnerIterator entry(liner_slope_, c); entry; ++entry)
      result[column_[static_cast<size_t>(at_.liner() + entry.index())]] += entry.value() * cells[c];
  return result;
}

void GapMap::rows(double a, double b, const Eigen::ArrayXd& c, SparseRows& result) const {
  result.resize(cells_, static_cast<Eigen::Index>(columns_.size()));
  result.reserve(piston_.nonZeros() + liner_.nonZeros() + 7 * static_cast<Eigen::Index>(cells_));
  for (int cell = 0; cell < cells_; ++cell) {
    result.startVec(cell);
    const auto put = [&](int coordinate, double value) {
      result.insertBack(cell, column_[static_cast<size_t>(coordinate)]) = value;
    };
    if (piston_.rows() > 0)
      for (SparseRows::InnerIterator entry(piston_, cell); entry; ++entry)
        put(static_cast<int>(entry.index()), a * entry.value());
    if (liner_map_) {
      const int first = liner_.outerIndexPtr()[cell], end = liner_.outerIndexPtr()[cell + 1];
      for (int k = first; k < end; ++k)
        put(at_.liner() + liner_.innerIndexPtr()[k],
            a * liner_.valuePtr()[k] + b * liner_slope_.valuePtr()[k]);
    }
    for (int k = at_.pin(); k < at_.size(); ++k)
      put(k, c[cell] * height_by_y_[k] + (k < at_.axial() ? a * pin_(cell, k - at_.pin()) : 0.0));
  }
  result.finalize();
}

}  // namespace clatter::film
