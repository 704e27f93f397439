// SPDX-License-Identifier: GPL-3.0-or-later
// Force and tangent of the piston-liner contact, pad by pad, and both pads together.
#include "dynamics/film/pad_state.hpp"

namespace clatter::film {

void PistonLiner::update_force(Pad& pad) const {
  pad.force = pad.gap_by_y.transpose() * pad.load.matrix();
  pad.force += end_force(pad) * pad.map.height_by_column();
}

// Derivative of the friction wrench, 3 x k.
Eigen::Matrix3Xd PistonLiner::friction_tangent(const Pad& pad) const {
  const auto weighted = [&pad](const Eigen::ArrayXd& slope) {
    return Eigen::MatrixX3d(pad.levers.array().colwise() * slope);
  };
  Eigen::MatrixX3d rub = pad.gap_by_y.transpose() * weighted(pad.friction->gap_slope());
  if (damping_) rub += pad.rate_by_y.transpose() * weighted(pad.friction->rate_slope());
  if (pad.film) rub += pad.derivative.transpose() * weighted(pad.friction->film_slope());
  if (pad.ends)
    rub += pad.map.height_by_column() *
           (pad.friction->height_slope().matrix().transpose() * pad.levers);
  return rub.transpose();
}

void PistonLiner::update_tangent(Pad& pad) {
  const Eigen::VectorXd& height = pad.map.height_by_column();
  pad.gap_directions = pad.gap_by_y;
  if (pad.film) {
    pad.film->reynolds.sensitivities(pad.gap_directions, pad.derivative, &height);
    const Eigen::ArrayXd& thickening = pad.film->thickening;  // dp/dP of full cells
    for (Eigen::Index c = 0; c < thickening.size(); ++c)
      if (pad.film->reynolds.is_full(static_cast<int>(c))) pad.derivative.row(c) *= thickening[c];
  } else {
    pad.derivative.setZero(pad.grid.size(), height.size());
  }
  pad.tangent.setZero(height.size(), height.size());
  if (pad.friction) {
    const Eigen::Matrix3Xd slide = axial_.slide(Eigen::all, pad.map.columns());
    pad.tangent.noalias() += slide.transpose() * friction_tangent(pad);
  }
  const auto add_row = [&pad](int cell, double factor, const SparseRows& rows) {
    double* row = pad.derivative.row(cell).data();
    for (SparseRows::InnerIterator entry(rows, cell); entry; ++entry)
      row[entry.index()] += factor * entry.value();
  };
  for (int c = 0; c < pad.grid.size(); ++c) {
    const double area = pad.area[c];
    const bool full = pad.film && pad.film->reynolds.is_full(c);
    const bool touching = asperity_ && pad.contact_slope[c] != 0.0;
    if (!full && !touching) continue;  // carries no load
    pad.derivative.row(c) *= full ? area : 0.0;
    if (touching) add_row(c, area * pad.contact_slope[c], pad.gap_by_y);
    if (touching && damping_) add_row(c, area * pad.contact_rate_slope[c], pad.rate_by_y);
    for (SparseRows::InnerIterator entry(pad.gap_by_y, c); entry; ++entry)
      pad.tangent.row(entry.index()) += entry.value() * pad.derivative.row(c);
  }
  if (pad.ends) add_end_tangent(pad);
  if (!bodies_.liner) return;
  // The liner's weights move with the stroke: d2h / (dy_l dz) under load.
  const Eigen::VectorXd cross = pad.map.slope_transposed(pad.load.matrix());
  pad.tangent += cross * height.transpose() + height * cross.transpose();
}

// By the rotation of the crank: what the sliding speed U changes of film and friction.
void PistonLiner::update_crank_column(Pad& pad) const {
  Eigen::ArrayXd by_turn = Eigen::ArrayXd::Zero(pad.grid.size()), load = by_turn;
  if (pad.film) {
    pad.film->reynolds.speed_sensitivity(by_turn);
    by_turn *= -0.5 * slide_by_turn_;                         // the mean wall velocity is -U / 2
    const Eigen::ArrayXd& thickening = pad.film->thickening;  // dp/dP of full cells
    for (int c = 0; c < pad.grid.size(); ++c) {
      if (!pad.film->reynolds.is_full(c)) continue;
      if (thickening.size() > 0) by_turn[c] *= thickening[c];
      load[c] = pad.area[c] * by_turn[c];
    }
  }
  pad.force_by_turn = pad.gap_by_y.transpose() * load.matrix();
  if (!pad.friction) return;
  by_turn *= pad.friction->film_slope();
  by_turn += slide_by_turn_ * pad.friction->speed_slope();
  pad.rub_by_turn = pad.levers.transpose() * by_turn.matrix();
}

// The coordinates of both pads and the crank's, ascending; none where they are all.
void PistonLiner::list_touched(dynamics::Response& response) {
  std::fill(touched_row_.begin(), touched_row_.end(), -1);
  for (const auto& pad : pads_)
    for (const int column : pad->map.columns()) touched_row_[column] = 0;
  response.touched.clear();
  if (bodies_.crank.is_free()) touched_row_[size()] = 0;
  const auto n = static_cast<int>(coordinates_.size());
  for (int i = 0; i < n; ++i) {
    int& row = touched_row_[i];
    if (row < 0) continue;
    row = static_cast<int>(response.touched.size());
    response.touched.push_back(i);
  }
  touched_count_ = static_cast<int>(response.touched.size());
  if (touched_count_ == n) response.touched.clear();
}

void PistonLiner::collect(bool with_tangent, dynamics::Response& response) {
  response.force.setZero(std::ssize(coordinates_));
  for (const auto& pad : pads_) {
    const std::vector<int>& columns = pad->map.columns();
    for (size_t i = 0; i < columns.size(); ++i)
      response.force[columns[i]] += pad->force[static_cast<Eigen::Index>(i)];
    if (pad->friction) response.force += axial_.slide.transpose() * friction_wrench(*pad);
  }
  list_touched(response);
  if (!with_tangent) return;
  const Eigen::Index n = touched_count_;
  response.tangent.setZero(n, n);
  for (const auto& pad : pads_) {
    const std::vector<int>& columns = pad->map.columns();
    for (size_t j = 0; j < columns.size(); ++j)
      for (size_t i = 0; i < columns.size(); ++i)
        response.tangent(touched_row_[columns[i]], touched_row_[columns[j]]) +=
            pad->tangent(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    if (!bodies_.crank.is_free()) continue;
    for (size_t i = 0; i < columns.size(); ++i) {
      double& entry = response.tangent(touched_row_[columns[i]], n - 1);
      entry += pad->force_by_turn(static_cast<Eigen::Index>(i));
      if (pad->friction) entry += axial_.slide.col(columns[i]).dot(pad->rub_by_turn);
    }
  }
}

}  // namespace clatter::film
