// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/reynolds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace clatter::film {
namespace {

// Solves for each cell along the two sides of a grid, and for the smallest grids. A boundary of the
// full film that moves by one cell in each solve crosses the grid in one.
constexpr int kSolvesPerCell = 10;
constexpr int kLeastSolves = 200;
// Rounding level of p / p_max, of theta - 1 and of theta / theta* - 1: below it a cell or a face on
// the border keeps its state.
constexpr double kBorder = 1e-13;

}  // namespace

void FilmCells::resize(int n) {
  for (Eigen::ArrayXd* values : {&content, &d_content, &flow_angle, &d_flow_angle, &flow_axial,
                                 &d_flow_axial, &carry, &d_carry})
    values->setZero(n);
}

void FilmCells::set_smooth(const Eigen::ArrayXd& h) {
  for (Eigen::ArrayXd* values : {&content, &flow_angle, &flow_axial, &carry}) *values = h;
  for (Eigen::ArrayXd* values : {&d_content, &d_flow_angle, &d_flow_axial, &d_carry})
    values->setOnes(h.size());
}

Reynolds::Reynolds(const PadGrid& grid, const Edges& edges, bool cavitation, bool reservoirs)
    : grid_(grid), edges_(edges), cavitation_(cavitation), reservoirs_(reservoirs) {
  build_faces();
  number_cells();
  const int n = grid_.size();
  full_.assign(n, 1);
  storage_.setZero(n);
  squeeze_.setZero(n);
  before_.setZero(n);
  x_.setZero(n);
  pressure_.setZero(n);
  fill_.setOnes(n);
  scratch_.setZero(n);
  magnitude_.setZero(n);
  conduct_.resize(faces_.size());
  carry_.resize(faces_.size());
  lift_.assign(faces_.size(), 0.0);
  limited_.assign(faces_.size(), 0);
  ratio_.assign(faces_.size(), 1.0);
  rim_limited_.assign(rims_.size(), 0);
  rim_ratio_.assign(rims_.size(), 1.0);
  end_limited_.assign(n, 0);
  covered_.setZero(n);
  rim_conduct_.resize(rims_.size());
  rim_carry_.resize(rims_.size());
  rim_entering_.resize(rims_.size());
  if (reservoirs_) exchange_.setZero(n);
  flows_.setZero(static_cast<Eigen::Index>(faces_.size() + rims_.size()) +
                 (reservoirs_ ? 2 : 1) * n);
}

void Reynolds::build_faces() {
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
  auto add_rim = [this](int cell, double length, double distance, double sign, bool axial,
                        const Edge& edge) {
    if (edge.kind == Edge::Kind::kPressure)
      rims_.push_back({cell, length, distance, sign, axial, edge});
  };
  for (int i = 0; i < n_i; ++i) {
    add_rim(grid_.cell(i, 0), grid_.arc(i), 0.5 * grid_.height(0), -1.0, true, edges_.axial_begin);
    add_rim(grid_.cell(i, n_j - 1), grid_.arc(i), 0.5 * grid_.height(n_j - 1), 1.0, true,
            edges_.axial_end);
  }
  if (grid_.periodic()) return;
  for (int j = 0; j < n_j; ++j) {
    add_rim(grid_.cell(0, j), grid_.height(j), 0.5 * grid_.arc(0), -1.0, false, edges_.angle_begin);
    add_rim(grid_.cell(n_i - 1, j), grid_.height(j), 0.5 * grid_.arc(n_i - 1), 1.0, false,
            edges_.angle_end);
  }
}

// The short side varies fastest. Around a closed ring the columns are taken alternately from both
// ends of the angular range, so that closing the ring only doubles the band.
void Reynolds::number_cells() {
  const int n_i = grid_.n_angle(), n_j = grid_.n_axial();
  row_.resize(grid_.size());
  const int axial_band = grid_.periodic() ? 2 * n_j : n_j;
  for (int i = 0; i < n_i; ++i) {
    const int folded = grid_.periodic() ? (2 * i < n_i ? 2 * i : 2 * (n_i - 1 - i) + 1) : i;
    for (int j = 0; j < n_j; ++j)
      row_[grid_.cell(i, j)] = axial_band <= n_i ? folded * n_j + j : j * n_i + i;
  }
  int band = 0;
  for (const Face& face : faces_) band = std::max(band, std::abs(row_[face.a] - row_[face.b]));
  lu_ = BandedLu(grid_.size(), band);
}

// The states of the last solution, of the content when there is none.
void Reynolds::guess_split() {
  if (!started_ && !stage_.steady)
    for (int c = 0; c < grid_.size(); ++c) full_[c] = before_[c] >= storage_[c];
  if (stage_.recesses != nullptr) guess_recesses();
  for (size_t f = 0; f < faces_.size(); ++f) {
    const double theta = fill_[upstream_of(f)];
    limited_[f] = within_window(f) ? false
                  : layers()       ? ratio_[f] * theta > 1.0
                                   : lift_[f] != 0.0 && theta < lowest_lifted(f);
  }
  for (size_t r = 0; r < rims_.size(); ++r)
    rim_limited_[r] = rim_ratio_[r] * fill_[rims_[r].cell] > 1.0;
  if (!partial_) return;
  for (int c = 0; c < grid_.size(); ++c) {
    if (is(CellKind::kOutside, c)) full_[c] = 1;
    end_limited_[c] = 2.0 * film_.content[c] * fill_[c] > film_.carry[c];
  }
}

// Changes states whose unknown violates its bound: cells by number, then faces, open edges and
// ends; true when there were any.
bool Reynolds::update_split() {
  const int n = grid_.size(), n_faces = static_cast<int>(faces_.size()),
            n_rims = static_cast<int>(rims_.size());
  auto value = [this](int cell) { return x_[row_[cell]]; };
  double highest = 0.0;
  for (int c = 0; c < n; ++c)
    if (is_full(c)) highest = std::max(highest, value(c));
  violated_.clear();
  for (int c = 0; c < n; ++c)
    if (!in_recess(c) && (is_full(c) ? value(c) < -kBorder * highest : value(c) > 1.0 + kBorder))
      violated_.push_back(c);
  // A full cell carries as much as its face takes, and so at first when it cavitates.
  for (size_t f = 0; f < faces_.size(); ++f) {
    const int upstream = upstream_of(f);
    if (layers() && is_full(upstream)) limited_[f] = 1;
    if (!is_full(upstream) && violates_limit(f, value(upstream)))
      violated_.push_back(n + static_cast<int>(f));
  }
  for (size_t r = 0; layers() && r < rims_.size(); ++r) {
    const int cell = rims_[r].cell;
    if (is_full(cell)) rim_limited_[r] = 1;
    if (rim_carry_[r] <= 0.0 || is_full(cell)) continue;
    const double excess = rim_ratio_[r] * value(cell) - 1.0;
    if (rim_limited_[r] != 0 ? excess < -kBorder : excess > kBorder)
      violated_.push_back(n + n_faces + static_cast<int>(r));
  }
  for (int c = 0; layers() && partial_ && c < n; ++c) {
    char& limited = end_limited_[c];
    if (is_full(c)) limited = 1;
    if (covered_[c] >= 0.0 || is_full(c)) continue;
    const double excess = 2.0 * value(c) * film_.content[c] / film_.carry[c] - 1.0;
    if (limited != 0 ? excess < -kBorder : excess > kBorder)
      violated_.push_back(n + n_faces + n_rims + c);
  }
  if (violated_.empty()) return false;
  violated_.resize(search_.count(violated_));
  for (int state : violated_) {
    if (state < n)
      full_[state] ^= 1;
    else if (state < n + n_faces)
      limited_[state - n] ^= 1;
    else if (state < n + n_faces + n_rims)
      rim_limited_[state - n - n_faces] ^= 1;
    else
      end_limited_[state - n - n_faces - n_rims] ^= 1;
  }
  return true;
}

// A state within rounding of its bound stays.
bool Reynolds::violates_limit(size_t face, double theta) const {
  if (carry_[face] == 0.0 || within_window(face)) return false;
  const bool limited = limited_[face] != 0;
  if (layers()) {
    const double excess = ratio_[face] * theta - 1.0;
    return limited ? excess < -kBorder : excess > kBorder;
  }
  if (lift_[face] == 0.0) return false;
  const double lowest = lowest_lifted(face), excess = theta - lowest;
  return limited ? excess > kBorder * lowest : excess < -kBorder * lowest;
}

int Reynolds::solve(const FilmCells& film, const Eigen::ArrayXd& content_before,
                    const FilmStage& stage) {
  film_ = film;
  stage_ = stage;
  weigh(film, content_before, stage);
  if (cavitation_) guess_split();
  started_ = true;
  search_.start();
  const int limit = kLeastSolves + kSolvesPerCell * (grid_.n_angle() + grid_.n_axial());
  for (int iteration = 1; iteration <= limit; ++iteration) {
    assemble();
    if (!lu_.factor())
      throw NumericsError("film: singular Reynolds matrix: a cell has neither storage nor flow");
    lu_.solve(x_.data());
    if (!x_.allFinite()) throw NumericsError("film: the Reynolds solution is not finite");
    if (!cavitation_ || !update_split()) {
      unpack();
      measure();
      return iteration;
    }
  }
  started_ = false;
  std::fill(full_.begin(), full_.end(), char{1});
  throw NumericsError(
      fmt::format("film: no split into full and cavitated cells found in {} solves", limit));
}

}  // namespace clatter::film
