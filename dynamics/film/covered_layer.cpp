// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/covered_layer.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::film {
namespace {

// Cells of the liner for a row of the pad. With one the error of a slap's height is three times as
// large, with eight the same.
constexpr int kCellsPerRow = 4;
// A free part of a cell that is smaller than this part of it counts as covered: its thickness would
// be a quotient of rounding errors.
constexpr double kSliver = 1e-9;

double length_of(const PadGrid& grid) {
  return grid.axial_edges()[grid.n_axial()] - grid.axial_edges()[0];
}

}  // namespace

CoveredLayer::CoveredLayer(const PadFaces& pad)
    : pad_(pad),
      grid_(pad.grid()),
      extent_(pad.grid()),
      cells_(kCellsPerRow * pad.grid().n_axial() + 1),
      step_(length_of(grid_) / (kCellsPerRow * grid_.n_axial())),
      dry_(grid_.size(), 0) {
  held_.setZero(grid_.n_angle(), cells_);
  wet_below_.setZero(grid_.n_angle(), grid_.n_axial() + 1);
  // No step takes memory.
  const int most = cells_ + grid_.n_axial();
  below_.setZero(grid_.n_angle(), most + 1);
  on_liner_.setZero(grid_.n_angle(), most);
  for (Pieces* pieces : {&pieces_, &next_}) {
    pieces->edge.reserve(most + 1);
    pieces->liner.reserve(most);
    pieces->row.reserve(most);
    pieces->first.reserve(grid_.n_axial() + 1);
  }
  from_.reserve(most + 1);
  met_.setZero(grid_.n_angle());
  heights_.setZero(grid_.n_axial());
  for (int j = 0; j < grid_.n_axial(); ++j) heights_[j] = grid_.height(j);
  for (Eigen::ArrayXd& values : of_row_) values.setZero(grid_.n_axial());
  lower_.assign(grid_.n_angle(), -1);
  upper_.assign(grid_.n_angle(), -1);
  for (size_t r = 0; r < pad_.rims().size(); ++r) {
    const Rim& rim = pad_.rims()[r];
    if (rim.axial)
      (rim.sign < 0.0 ? lower_ : upper_)[rim.cell / grid_.n_axial()] = pad_.rim_flow(r);
  }
  known_.at.assign(static_cast<size_t>(pad_.end_flow(0)), 0);
  known_.volume.setZero(pad_.flow_count());
  known_.rate.setZero(pad_.flow_count());
}

void CoveredLayer::cut(double offset, Pieces& all) const {
  const Eigen::VectorXd& rows = grid_.axial_edges();
  const int n_j = grid_.n_axial();
  all.edge.assign(1, rows[0]);
  all.row.clear();
  all.liner.clear();
  all.first.assign(1, 0);
  int row = 0, cell = 0;
  const auto upper = [&](int k) { return rows[0] + offset + (k + 1) * step_; };
  while (cell + 1 < cells_ && upper(cell) <= rows[0] + kSliver * step_) ++cell;
  while (row < n_j) {
    const double next_row = rows[row + 1], next_cell = cell + 1 < cells_ ? upper(cell) : INFINITY;
    all.row.push_back(row);
    all.liner.push_back(cell);
    all.edge.push_back(std::min(next_row, next_cell));
    // Edges that differ by rounding are one.
    if (next_cell < next_row + kSliver * step_) ++cell;
    if (next_row < next_cell + kSliver * step_) {
      all.edge.back() = next_row;
      all.first.push_back(all.count());
      ++row;
    }
  }
}

CoveredLayer::Position CoveredLayer::find(double z) const {
  const auto& edge = pieces_.edge;
  const int last = pieces_.count() - 1;
  if (z <= edge.front()) return {0, 0.0, z - edge.front()};
  if (z >= edge.back()) return {last, 1.0, z - edge.back()};
  const auto above = std::upper_bound(edge.begin(), edge.end(), z);
  const int piece = std::clamp(static_cast<int>(above - edge.begin()) - 1, 0, last);
  return {piece, (z - edge[piece]) / pieces_.width(piece), 0.0};
}

// `beyond`: thickness outside of the pad [m].
double CoveredLayer::volume_below(int column, const Position& at, double beyond) const {
  const double low = below_(column, at.piece), high = below_(column, at.piece + 1);
  return low + at.part * (high - low) + at.beyond * beyond;
}

double CoveredLayer::thickness(int column, int piece) const {
  return (below_(column, piece + 1) - below_(column, piece)) / pieces_.width(piece);
}

void CoveredLayer::start(const Eigen::ArrayXd& profile) {
  offset_ = 0.0;
  held_.setZero();
  std::fill(dry_.begin(), dry_.end(), char{0});
  cut(offset_, pieces_);
  lay_out(profile);
}

// The layer as it lies at the start of a step.
void CoveredLayer::lay_out(const Eigen::ArrayXd& profile) {
  const int n_j = grid_.n_axial();
  below_.col(0).setZero();
  for (int i = 0; i < grid_.n_angle(); ++i) {
    for (int j = 0; j < n_j; ++j)
      wet_below_(i, j + 1) = wet_below_(i, j) + (dry_[grid_.cell(i, j)] == 0);
    free_.setZero(cells_);
    for (int p = 0; p < pieces_.count(); ++p)
      if (dry_[grid_.cell(i, pieces_.row[p])]) free_[pieces_.liner[p]] += pieces_.width(p);
    for (int p = 0; p < pieces_.count(); ++p) {
      const int cell = grid_.cell(i, pieces_.row[p]), k = pieces_.liner[p];
      double thickness = profile[cell];
      if (dry_[cell]) thickness = free_[k] > kSliver * step_ ? held_(i, k) / free_[k] : 0.0;
      below_(i, p + 1) = below_(i, p) + thickness * pieces_.width(p);
    }
  }
}

const KnownFlows& CoveredLayer::slide(double travel, const FilmCells& film,
                                      const FilmStage& stage) {
  std::fill(known_.at.begin(), known_.at.end(), char{0});
  extent_.set(stage.cover, stage.recesses);
  const double shift = -travel;
  meet(shift, film, stage);
  const Eigen::VectorXd& rows = grid_.axial_edges();
  for (int j = 0; j <= grid_.n_axial(); ++j)
    slide_past(j, find(rows[j] - shift), shift, 2.0 * stage.speed_axial);
  return known_;
}

// The layer beyond the edge over which the liner comes in; -1 where the gap does not take all of
// it.
void CoveredLayer::meet(double shift, const FilmCells& film, const FilmStage& stage) {
  const bool up = shift > 0.0;
  const OutsideLayers* outside = stage.outside;
  for (int i = 0; i < grid_.n_angle(); ++i) {
    const Eigen::Index flow = up ? lower_[i] : upper_[i];
    met_[i] = -1.0;
    if (flow < 0) continue;
    const Rim& rim = pad_.rims()[static_cast<size_t>(flow - pad_.rim_flow(0))];
    const double layer =
        outside != nullptr ? (up ? outside->begin : outside->end)[i] : rim.edge.layer;
    if (2.0 * layer <= film.carry[rim.cell] && layer <= rim.edge.fill * film.content[rim.cell])
      met_[i] = layer;
  }
}

// The rows that pass the lower edge of row `j` while the liner moves there.
std::pair<int, int> CoveredLayer::passing(int j, const Position& from, double shift) const {
  const int row = pieces_.row[from.piece], last = grid_.n_axial() - 1;
  const double height = length_of(grid_) / grid_.n_axial();
  const int reach = std::abs(shift) > height ? static_cast<int>(std::abs(shift) / height) + 1 : 0;
  return {std::clamp(std::min(j - 1, row) - reach, 0, last),
          std::clamp(std::max(j, row) + reach, 0, last)};
}

bool CoveredLayer::all_dry(int column, std::pair<int, int> rows) const {
  if (wet_below_(column, rows.second + 1) > wet_below_(column, rows.first)) return false;
  for (int j = rows.first; j <= rows.second; ++j)
    if (!extent_.is_plain(grid_.cell(column, j))) return false;
  return true;
}

// What passes the lower edge of row `j`, or the upper edge of the pad, in all columns.
void CoveredLayer::slide_past(int j, const Position& from, double shift, double speed) {
  const int n_j = grid_.n_axial();
  const std::pair<int, int> rows = passing(j, from, shift);
  for (int i = 0; i < grid_.n_angle(); ++i) {
    const Eigen::Index flow = j == 0     ? lower_[i]
                              : j == n_j ? upper_[i]
                                         : static_cast<Eigen::Index>(i) * (n_j - 1) + j - 1;
    const bool enters = from.beyond != 0.0;
    if (flow < 0 || (enters && met_[i] < 0.0) || !all_dry(i, rows)) continue;
    const double outward = j == 0 ? -grid_.arc(i) : grid_.arc(i);
    known_.at[static_cast<size_t>(flow)] = 1;
    known_.volume[flow] = outward * (below_(i, pieces_.first[j]) - volume_below(i, from, met_[i]));
    known_.rate[flow] = outward * (enters ? met_[i] : thickness(i, from.piece)) * speed;
  }
}

void CoveredLayer::advance(double travel, const Reynolds& film, const OilContent& moved,
                           Eigen::ArrayXd& content) {
  const double shift = -travel;
  offset_ += shift;
  offset_ -= step_ * std::ceil(offset_ / step_);
  cut(offset_, next_);
  from_.clear();
  for (const double z : next_.edge) from_.push_back(find(z - shift));
  for (int i = 0; i < grid_.n_angle(); ++i) bring(i, shift, moved.carried());
  std::swap(pieces_, next_);
  for (int c = 0; c < grid_.size(); ++c) dry_[c] = film.extent().is_plain(c) && !film.is_full(c);
  for (int i = 0; i < grid_.n_angle(); ++i) exchange(i, film.cells(), content);
  lay_out(moved.profile());
}

// What lay on each new piece of a column at the start of the step, or came over an edge.
void CoveredLayer::bring(int column, double shift, const Eigen::ArrayXd& carried) {
  const Eigen::Index rim = shift > 0.0 ? lower_[column] : upper_[column];
  const double brought = rim < 0 ? 0.0 : std::max(-carried[rim], 0.0) / grid_.arc(column),
               entering = shift != 0.0 ? brought / std::abs(shift) : 0.0;
  for (int p = 0; p < next_.count(); ++p)
    on_liner_(column, p) =
        volume_below(column, from_[p + 1], entering) - volume_below(column, from_[p], entering);
}

// Oil on the pieces of one column; the liner takes from the skirt what it lacks and gives it what
// it cannot carry.
void CoveredLayer::exchange(int column, const FilmCells& film, Eigen::ArrayXd& content) {
  const Eigen::ArrayXd &carry = film.carry, &storage = film.content;
  const int n_j = grid_.n_axial(), count = pieces_.count();
  const auto cell = [&](int p) { return grid_.cell(column, pieces_.row[p]); };
  const auto on_liner = on_liner_.row(column);
  Eigen::ArrayXd &liner = of_row_[0], &skirt = of_row_[1], &part = of_row_[2], &taken = of_row_[3];
  liner.setZero();
  part.setOnes();
  taken.setZero();  // from the skirt, per width [m2]
  for (int p = 0; p < count; ++p) liner[pieces_.row[p]] += on_liner[p];
  for (int j = 0; j < n_j; ++j) {
    const double held = content[grid_.cell(column, j)] * grid_.height(j);
    skirt[j] = std::max(held - liner[j], 0.0) / grid_.height(j);
    if (liner[j] > held) part[j] = held / liner[j];
  }
  for (Eigen::ArrayXd* values : {&have_, &free_, &want_, &offer_}) values->setZero(cells_);
  for (int p = 0; p < count; ++p) {
    if (!dry_[cell(p)]) continue;
    const int k = pieces_.liner[p], j = pieces_.row[p];
    const double width = pieces_.width(p);
    free_[k] += width;
    have_[k] += on_liner[p] * part[j];
    want_[k] += 0.5 * carry[cell(p)] * width;
    offer_[k] += skirt[j] * width;
  }
  for (int p = 0; p < count; ++p) {
    if (!dry_[cell(p)]) continue;
    const int k = pieces_.liner[p], j = pieces_.row[p];
    const double lack = want_[k] - have_[k], width = pieces_.width(p);
    if (lack > 0.0 && offer_[k] > 0.0)
      taken[j] += std::min(lack / offer_[k], 1.0) * skirt[j] * width;
    else if (lack < 0.0)
      taken[j] += lack * width / free_[k];
  }
  for (int k = 0; k < cells_; ++k)
    held_(column, k) = std::min(have_[k] + std::min(std::max(want_[k] - have_[k], 0.0), offer_[k]),
                                std::max(want_[k], 0.0));
  // Cells of the pad then have what rests on them and their part of the cells of the liner.
  Eigen::ArrayXd& held = part;
  held = skirt * heights_ - taken;
  for (int p = 0; p < count; ++p)
    if (const int k = pieces_.liner[p]; dry_[cell(p)])
      held[pieces_.row[p]] += held_(column, k) * pieces_.width(p) / free_[k];
  spread(column, held, storage, content);
}

// Moves oil between cells with a common cell of the liner until they hold `held` [m2]. None gets
// more than its gap holds by that: full cells have a pressure.
void CoveredLayer::spread(int column, const Eigen::ArrayXd& held, const Eigen::ArrayXd& storage,
                          Eigen::ArrayXd& content) {
  const int n_j = grid_.n_axial();
  double over = 0.0, before = 0.0;  // over the lower edge of a row: what should pass, what did [m2]
  const auto room = [&](int j, double more) {
    const int c = grid_.cell(column, j);
    return content[c] * heights_[j] + more <= storage[c] * heights_[j];
  };
  for (int j = 0; j < n_j; ++j) {
    const int c = grid_.cell(column, j);
    if (!dry_[c]) {
      over = before = 0.0;
      continue;
    }
    const double own = content[c] * heights_[j];
    over += own - held[j];  // over its upper edge
    double passes = over;
    if (j + 1 == n_j || !dry_[c + 1] || (passes > 0.0 && !room(j + 1, passes)) ||
        (passes < 0.0 && own - passes > storage[c] * heights_[j]))
      passes = 0.0;
    content[c] = std::max(own + before - passes, 0.0) / heights_[j];  // below by rounding
    before = passes;
  }
}

void CoveredLayer::save(std::vector<double>& state) const {
  state.push_back(offset_);
  state.insert(state.end(), held_.data(), held_.data() + held_.size());
  state.insert(state.end(), dry_.begin(), dry_.end());
}

size_t CoveredLayer::saved_size() const {
  return 1 + static_cast<size_t>(held_.size()) + dry_.size();
}

std::vector<double>::const_iterator CoveredLayer::restore(std::vector<double>::const_iterator next,
                                                          const Eigen::ArrayXd& profile) {
  offset_ = *next++;
  std::copy(next, next + held_.size(), held_.data());
  next += held_.size();
  for (char& dry : dry_) dry = *next++ != 0.0;
  cut(offset_, pieces_);
  lay_out(profile);
  return next;
}

}  // namespace clatter::film
