// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/film_split.hpp"

#include <algorithm>

namespace clatter::film {
namespace {

// Rounding level of p / p_max, of theta - 1 and of theta / theta* - 1: below it a cell or a face on
// the border keeps its state.
constexpr double kBorder = 1e-13;

// A state within rounding of its bound stays.
bool leaves(bool limited, double excess, double border = kBorder) {
  return limited ? excess < -border : excess > border;
}

}  // namespace

FilmSplit::FilmSplit(const PadFaces& pad)
    : full_(pad.grid().size(), 1),
      limited_(pad.faces().size(), 0),
      rim_limited_(pad.rims().size(), 0),
      end_limited_(pad.grid().size(), 0) {}

void FilmSplit::forget() {
  started_ = false;
  std::fill(full_.begin(), full_.end(), char{1});
}

void FilmSplit::guess(const StageTerms& terms, const Eigen::ArrayXd& fill) {
  const int n = terms.grid().size();
  const FilmExtent& extent = terms.extent();
  const RecessCells* recesses = terms.stage().recesses;
  if (!started_ && !terms.stage().steady)
    for (int c = 0; c < n; ++c) full_[c] = terms.before()[c] >= terms.storage()[c];
  started_ = true;
  search_.start();
  // States in recesses do not depend on the solution.
  for (int c = 0; recesses != nullptr && c < n; ++c)
    if (extent.in_recess(c)) full_[c] = extent.is(CellKind::kGroove, c) && recesses->fill[c] == 1.0;
  auto theta = [&](int c) { return extent.is(CellKind::kGroove, c) ? recesses->fill[c] : fill[c]; };
  for (size_t f = 0; f < limited_.size(); ++f) {
    const FaceTerms& face = terms.faces()[f];
    const double upstream = theta(face.upstream());
    limited_[f] = terms.within_window(face) ? false
                  : terms.layers()          ? face.ratio * upstream > 1.0
                                            : face.lift != 0.0 && upstream < face.lowest_lifted();
  }
  for (size_t r = 0; r < rim_limited_.size(); ++r) {
    const RimTerms& rim = terms.rims()[r];
    rim_limited_[r] = rim.ratio * theta(rim.cell) > 1.0;
  }
  for (int c = 0; extent.partial() && c < n; ++c) {
    if (extent.is(CellKind::kOutside, c)) full_[c] = 1;
    end_limited_[c] = 2.0 * terms.film().content[c] * theta(c) > terms.film().carry[c];
  }
}

bool FilmSplit::update(const StageTerms& terms, const Eigen::VectorXd& x) {
  violated_.clear();
  list_cells(terms, x);
  list_faces(terms, x);
  if (terms.layers()) list_rims(terms, x);
  if (terms.layers() && terms.extent().partial()) list_ends(terms, x);
  if (violated_.empty()) return false;
  violated_.resize(search_.count(violated_));
  for (const int number : violated_) state(number) ^= 1;
  return true;
}

// States are numbered in this order.
int FilmSplit::rim_state(size_t rim) const {
  return static_cast<int>(full_.size() + limited_.size() + rim);
}
int FilmSplit::end_state(int cell) const { return rim_state(rim_limited_.size()) + cell; }

char& FilmSplit::state(int number) {
  size_t at = static_cast<size_t>(number);
  for (std::vector<char>* states : {&full_, &limited_, &rim_limited_}) {
    if (at < states->size()) return (*states)[at];
    at -= states->size();
  }
  return end_limited_[at];
}

void FilmSplit::list_cells(const StageTerms& terms, const Eigen::VectorXd& x) {
  const int n = terms.grid().size();
  auto value = [&](int cell) { return x[terms.pad().row(cell)]; };
  double highest = 0.0;
  for (int c = 0; c < n; ++c)
    if (is_full(c)) highest = std::max(highest, value(c));
  for (int c = 0; c < n; ++c)
    if (!terms.extent().in_recess(c) &&
        (is_full(c) ? value(c) < -kBorder * highest : value(c) > 1.0 + kBorder))
      violated_.push_back(c);
}

// A full cell carries as much as its face takes, and so at first when it cavitates.
void FilmSplit::list_faces(const StageTerms& terms, const Eigen::VectorXd& x) {
  const int n = terms.grid().size();
  for (size_t f = 0; f < limited_.size(); ++f) {
    const int upstream = terms.faces()[f].upstream();
    if (terms.layers() && is_full(upstream)) limited_[f] = 1;
    if (!is_full(upstream) && violates_limit(terms, f, x[terms.pad().row(upstream)]))
      violated_.push_back(n + static_cast<int>(f));
  }
}

void FilmSplit::list_rims(const StageTerms& terms, const Eigen::VectorXd& x) {
  for (size_t r = 0; r < rim_limited_.size(); ++r) {
    const RimTerms& rim = terms.rims()[r];
    if (is_full(rim.cell)) rim_limited_[r] = 1;
    if (rim.carry <= 0.0 || is_full(rim.cell)) continue;
    if (leaves(rim_limited_[r] != 0, rim.ratio * x[terms.pad().row(rim.cell)] - 1.0))
      violated_.push_back(rim_state(r));
  }
}

void FilmSplit::list_ends(const StageTerms& terms, const Eigen::VectorXd& x) {
  const FilmCells& film = terms.film();
  for (int c = 0; c < terms.grid().size(); ++c) {
    if (is_full(c)) end_limited_[c] = 1;
    if (terms.covered(c) >= 0.0 || is_full(c)) continue;
    if (leaves(end_limited_[c] != 0,
               2.0 * x[terms.pad().row(c)] * film.content[c] / film.carry[c] - 1.0))
      violated_.push_back(end_state(c));
  }
}

bool FilmSplit::violates_limit(const StageTerms& terms, size_t face, double theta) const {
  const FaceTerms& at = terms.faces()[face];
  if (at.carry == 0.0 || terms.within_window(at)) return false;
  const bool limited = limited_[face] != 0;
  if (terms.layers()) return leaves(limited, at.ratio * theta - 1.0);
  if (at.lift == 0.0) return false;
  const double lowest = at.lowest_lifted();
  return leaves(!limited, theta - lowest, kBorder * lowest);
}

FillLaw FilmSplit::at_end(const StageTerms& terms, int cell) const {
  if (terms.covered(cell) > 0.0) {
    const double brought = 0.5 * terms.entering(terms.pad().liner_end(), cell).value;
    return {-brought, -brought};
  }
  const double half = 0.5 * terms.film().carry[cell], rest = terms.film().content[cell] - half;
  if (!terms.layers()) return {0.0, rest};
  if (is_full(cell) || end_limited_[cell] != 0) return {-half, rest};
  return {0.0, 0.0};
}

double FilmSplit::end_thickness(const StageTerms& terms, int cell, double theta,
                                double pressure) const {
  const bool squeezed = terms.covered(cell) < 0.0 && terms.compressible();
  return at_end(terms, cell).at(theta) +
         (squeezed ? terms.film().content[cell] * pressure / terms.stage().bulk_modulus : 0.0);
}

double FilmSplit::end_slope(const StageTerms& terms, int cell, double theta,
                            double pressure) const {
  if (terms.covered(cell) > 0.0) return -0.5 * terms.entering(terms.pad().liner_end(), cell).slope;
  const double d_half = 0.5 * terms.film().d_carry[cell], d_content = terms.film().d_content[cell];
  const double squeezed = terms.compressible() ? pressure / terms.stage().bulk_modulus : 0.0;
  if (!terms.layers()) return theta * (d_content - d_half) + squeezed * d_content;
  if (is_full(cell) || end_limited_[cell] != 0) return (theta + squeezed) * d_content - d_half;
  return 0.0;
}

bool FilmSplit::carries_content(const StageTerms& terms, size_t face) const {
  const FaceTerms& at = terms.faces()[face];
  return terms.layers() && !is_full(at.upstream()) && limited_[face] == 0 && at.ratio > 1.0;
}

bool FilmSplit::rim_carries_content(const StageTerms& terms, size_t rim) const {
  const RimTerms& at = terms.rims()[rim];
  return at.ratio > 1.0 && !is_full(at.cell) && rim_limited_[rim] == 0;
}

}  // namespace clatter::film
