// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/pad_faces.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace clatter::film {
namespace {

// Outflow exceeds what a cell holds by more than the rounding of its sums.
constexpr double kRounding = 1e-14;

}  // namespace

PadFaces::PadFaces(const PadGrid& grid, const Edges& edges, bool grooves)
    : grid_(grid), liner_end_(edges.liner_end), grooves_(grooves) {
  add_faces();
  add_rims(edges);
  number_cells();
}

void PadFaces::add_faces() {
  const int n_i = grid_.n_angle(), n_j = grid_.n_axial();
  for (int i = 0; i < n_i; ++i)
    for (int j = 0; j + 1 < n_j; ++j)
      faces_.push_back({grid_.cell(i, j), grid_.cell(i, j + 1), grid_.arc(i),
                        0.5 * (grid_.height(j) + grid_.height(j + 1)), true,
                        j > 0 ? grid_.cell(i, j - 1) : -1,
                        j + 2 < n_j ? grid_.cell(i, j + 2) : -1});
  auto around = [this, n_i](int i, int j) {
    if (grid_.periodic()) return grid_.cell((i + n_i) % n_i, j);
    return i >= 0 && i < n_i ? grid_.cell(i, j) : -1;
  };
  for (int i = 0; i + (grid_.periodic() ? 0 : 1) < n_i; ++i)
    for (int j = 0; j < n_j; ++j) {
      const int next = (i + 1) % n_i;
      faces_.push_back({grid_.cell(i, j), grid_.cell(next, j), grid_.height(j),
                        0.5 * (grid_.arc(i) + grid_.arc(next)), false, around(i - 1, j),
                        around(i + 2, j)});
    }
}

void PadFaces::add_rims(const Edges& edges) {
  const int n_i = grid_.n_angle(), n_j = grid_.n_axial();
  auto add = [this](int cell, double length, double distance, double sign, bool axial,
                    const Edge& edge) {
    if (edge.kind == Edge::Kind::kPressure)
      rims_.push_back({cell, length, distance, sign, axial, edge});
  };
  for (int i = 0; i < n_i; ++i) {
    add(grid_.cell(i, 0), grid_.arc(i), 0.5 * grid_.height(0), -1.0, true, edges.axial_begin);
    add(grid_.cell(i, n_j - 1), grid_.arc(i), 0.5 * grid_.height(n_j - 1), 1.0, true,
        edges.axial_end);
  }
  if (grid_.periodic()) return;
  for (int j = 0; j < n_j; ++j) {
    add(grid_.cell(0, j), grid_.height(j), 0.5 * grid_.arc(0), -1.0, false, edges.angle_begin);
    add(grid_.cell(n_i - 1, j), grid_.height(j), 0.5 * grid_.arc(n_i - 1), 1.0, false,
        edges.angle_end);
  }
}

// The short side varies fastest. Around a closed ring the columns are taken alternately from both
// ends of the angular range, so that closing the ring only doubles the band.
void PadFaces::number_cells() {
  const int n_i = grid_.n_angle(), n_j = grid_.n_axial();
  row_.resize(grid_.size());
  const int axial_band = grid_.periodic() ? 2 * n_j : n_j;
  for (int i = 0; i < n_i; ++i) {
    const int folded = grid_.periodic() ? (2 * i < n_i ? 2 * i : 2 * (n_i - 1 - i) + 1) : i;
    for (int j = 0; j < n_j; ++j)
      row_[grid_.cell(i, j)] = axial_band <= n_i ? folded * n_j + j : j * n_i + i;
  }
}

int PadFaces::band() const {
  int band = 0;
  for (const Face& face : faces_) band = std::max(band, std::abs(row(face.a) - row(face.b)));
  return band;
}

void PadFaces::leaving(const Eigen::ArrayXd& flows, Eigen::ArrayXd& rate) const {
  const int n = grid_.size();
  rate = flows.segment(end_flow(0), n);
  if (grooves_) rate += flows.tail(n);
  Eigen::Index k = 0;
  for (const Face& face : faces_) {
    rate[face.a] += flows[k];
    rate[face.b] -= flows[k++];
  }
  for (const Rim& rim : rims_) rate[rim.cell] += flows[k++];
  rate /= grid_.area();
}

void PadFaces::add_up_edges(const Eigen::ArrayXd& moved, EdgeVolumes& volumes) const {
  volumes.lower.setZero(grid_.n_angle());
  volumes.upper.setZero(grid_.n_angle());
  volumes.sides = volumes.sides_moved = 0.0;
  Eigen::Index k = rim_flow(0);
  for (const Rim& rim : rims_) {
    const double volume = moved[k++];
    if (rim.axial) {
      (rim.sign < 0.0 ? volumes.lower : volumes.upper)[rim.cell / grid_.n_axial()] += volume;
    } else {
      volumes.sides += volume;
      volumes.sides_moved += std::abs(volume);
    }
  }
  volumes.ends = moved.segment(k, grid_.size()).sum();
  volumes.ends_moved = moved.segment(k, grid_.size()).abs().sum();
  if (!grooves_) return;
  volumes.recesses = moved.tail(grid_.size()).sum();
  volumes.recesses_moved = moved.tail(grid_.size()).abs().sum();
}

// From the first to the second; -1 is outside.
std::pair<int, int> PadFaces::cells_of(Eigen::Index flow) const {
  if (flow < rim_flow(0)) return {faces_[flow].a, faces_[flow].b};
  if (flow < end_flow(0)) return {rims_[flow - rim_flow(0)].cell, -1};
  return {static_cast<int>(flow - end_flow(0)) % grid_.size(), -1};
}

// In each pass a cell gives at most what it held and what the pass before let in: flows only fall.
void PadFaces::limit_outflow(const Eigen::ArrayXd& content, Eigen::ArrayXd& sent,
                             Eigen::ArrayXd& before) const {
  // From the donor to the receiver.
  auto ends = [&](Eigen::Index k) {
    const auto [from, to] = cells_of(k);
    return sent[k] > 0.0 ? std::pair{from, to} : std::pair{to, from};
  };
  Eigen::ArrayXd held, leaving, share;
  for (;;) {
    held = content * grid_.area();
    leaving.setZero(grid_.size());
    for (Eigen::Index k = 0; k < sent.size(); ++k) {
      const auto [donor, receiver] = ends(k);
      if (donor >= 0) leaving[donor] += std::abs(sent[k]);
      if (receiver >= 0) held[receiver] += std::abs(sent[k]);
    }
    if (!(leaving > held * (1.0 + kRounding)).any()) break;
    share = (leaving > held).select(held / leaving, 1.0);
    for (Eigen::Index k = 0; k < sent.size(); ++k)
      if (const int donor = ends(k).first; donor >= 0) sent[k] *= share[donor];
  }
  before = (held - leaving).max(0.0) / grid_.area();
}

}  // namespace clatter::film
