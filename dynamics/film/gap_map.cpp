// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/gap_map.hpp"

#include <algorithm>

namespace clatter::film {

namespace {

void mark(const SparseRows& rows, int first, std::vector<char>& marks) {
  for (Eigen::Index k = 0; k < rows.nonZeros(); ++k) marks[first + rows.innerIndexPtr()[k]] = 1;
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
  liner_before_.assign(liner_.innerIndexPtr(), liner_.innerIndexPtr() + liner_.nonZeros());
  liner_map_->at(height, liner_, &liner_slope_);
  if (std::equal(liner_before_.begin(), liner_before_.end(), liner_.innerIndexPtr(),
                 liner_.innerIndexPtr() + liner_.nonZeros()))
    return;  // the same patches
  used_ = always_;
  mark(liner_, at_.liner(), used_);
  list_columns();
}

void GapMap::list_columns() {
  columns_.clear();
  for (int i = 0; i < at_.size(); ++i) {
    if (used_[i] == 0) continue;
    column_[i] = static_cast<int>(columns_.size());
    columns_.push_back(i);
  }
  gather(height_by_y_, height_by_column_);
  find_pattern();
}

void GapMap::find_pattern() {
  pattern_.resize(cells_, static_cast<Eigen::Index>(columns_.size()));
  pattern_.reserve(piston_.nonZeros() + liner_.nonZeros() + 7 * static_cast<Eigen::Index>(cells_));
  for (int cell = 0; cell < cells_; ++cell) {
    pattern_.startVec(cell);
    const auto put = [&](int coordinate) { pattern_.insertBack(cell, column_[coordinate]) = 0.0; };
    const auto put_row = [&](const SparseRows& rows, int first) {
      if (rows.rows() == 0) return;
      for (SparseRows::InnerIterator entry(rows, cell); entry; ++entry)
        put(first + static_cast<int>(entry.index()));
    };
    put_row(piston_, 0);
    put_row(liner_, at_.liner());
    for (int k = at_.pin(); k < at_.size(); ++k) put(k);
  }
  pattern_.finalize();
}

void GapMap::gather(const Eigen::VectorXd& all, Eigen::VectorXd& picked) const {
  picked.resize(static_cast<Eigen::Index>(columns_.size()));
  for (size_t i = 0; i < columns_.size(); ++i)
    picked[static_cast<Eigen::Index>(i)] = all[columns_[i]];
}

void GapMap::add(const Eigen::VectorXd& y, Eigen::ArrayXd& gap, Eigen::ArrayXd& slope) const {
  if (piston_.rows() > 0) gap += (piston_ * y.head(piston_.cols())).array();
  gap += (pin_ * y.segment<6>(at_.pin())).array();
  if (!liner_map_) return;
  const double* y_l = y.data() + at_.liner();
  for (int cell = 0; cell < cells_; ++cell) {
    double value = 0.0, change = 0.0;
    for (int k = liner_.outerIndexPtr()[cell]; k < liner_.outerIndexPtr()[cell + 1]; ++k) {
      const double moved = y_l[liner_.innerIndexPtr()[k]];
      value += liner_.valuePtr()[k] * moved;
      change += liner_slope_.valuePtr()[k] * moved;
    }
    gap[cell] += value;
    slope[cell] += change;
  }
}

void GapMap::add_slope(const Eigen::VectorXd& y, Eigen::ArrayXd& slope) const {
  if (liner_map_) slope += (liner_slope_ * y.segment(at_.liner(), liner_slope_.cols())).array();
}

Eigen::VectorXd GapMap::slope_transposed(const Eigen::VectorXd& cells) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(columns_.size()));
  if (!liner_map_) return result;
  for (int c = 0; c < cells_; ++c)
    for (SparseRows::InnerIterator entry(liner_slope_, c); entry; ++entry)
      result[column_[at_.liner() + entry.index()]] += entry.value() * cells[c];
  return result;
}

void GapMap::rows(double a, double b, const Eigen::ArrayXd& c, SparseRows& result) const {
  result = pattern_;
  double* value = result.valuePtr();
  const int with_axial = at_.size() - at_.pin();
  for (int cell = 0; cell < cells_; ++cell) {
    if (piston_.rows() > 0)
      for (int k = piston_.outerIndexPtr()[cell]; k < piston_.outerIndexPtr()[cell + 1]; ++k)
        *value++ = a * piston_.valuePtr()[k];
    if (liner_map_)
      for (int k = liner_.outerIndexPtr()[cell]; k < liner_.outerIndexPtr()[cell + 1]; ++k)
        *value++ = a * liner_.valuePtr()[k] + b * liner_slope_.valuePtr()[k];
    for (int k = 0; k < with_axial; ++k)
      *value++ = c[cell] * height_by_y_[at_.pin() + k] + (k < 6 ? a * pin_(cell, k) : 0.0);
  }
}

}  // namespace clatter::film
