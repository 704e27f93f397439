// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which cells of a film are full, which of its flows are at their bounds, and what flows by that.
#include <Eigen/Core>
#include <vector>

#include "dynamics/film/split_search.hpp"
#include "dynamics/film/stage_terms.hpp"

namespace clatter::film {

/// A quantity that is linear in the fill theta of one cell, by its values for an empty and for a
/// full one.
struct FillLaw {
  double empty, full;
  double at(double theta) const { return empty + (full - empty) * theta; }
};

/// A split of the piecewise linear system of one stage into its states: cells full or cavitated,
/// and lifts, layers on faces and rims, and layers at the end of the liner within or at their
/// bound. It decides what each flow is by the fill upstream.
class FilmSplit {
 public:
  /// All cells are full.
  explicit FilmSplit(const PadFaces& pad);

  bool is_full(int cell) const { return full_[cell] != 0; }

  /// Begins the search for the split of a stage: with the states of the last solution, whose fills
  /// are `fill`, n, with those of the content when there is none.
  void guess(const StageTerms& terms, const Eigen::ArrayXd& fill);
  /// Changes states whose unknown violates its bound: cells by number, then faces, rims and ends;
  /// true when there were any. `x`: the solution for this split by rows, n.
  bool update(const StageTerms& terms, const Eigen::VectorXd& x);
  /// All cells are full, and the next guess follows the content.
  void forget();

  /// theta on a face, by that of its upstream cell.
  FillLaw on_face(const StageTerms& terms, size_t face) const {
    const FaceTerms& at = terms.faces()[face];
    if (is_full(at.upstream())) return {1.0, 1.0};
    const bool limited = limited_[face] != 0;
    if (terms.layers()) return limited ? FillLaw{1.0, 1.0} : FillLaw{0.0, at.ratio};
    if (!limited) return {at.lift, 1.0};
    return {0.0, at.lift > 0.0 ? 2.0 : 0.0};
  }
  /// theta on a rim over which oil leaves, by that of its cell.
  FillLaw on_rim(const StageTerms& terms, size_t rim) const {
    const RimTerms& at = terms.rims()[rim];
    if (is_full(at.cell) || rim_limited_[rim] != 0) return {1.0, 1.0};
    return {0.0, at.ratio};
  }
  /// Thickness [m] that leaves a cell with each part of its area that is covered (negative) or
  /// uncovered: the oil on the grid's wall.
  FillLaw at_end(const StageTerms& terms, int cell) const;
  /// The same at a solution: theta and pressure [Pa] of the cell.
  double end_thickness(const StageTerms& terms, int cell, double theta, double pressure) const;
  /// Its slope by the gap.
  double end_slope(const StageTerms& terms, int cell, double theta, double pressure) const;

  /// Whether the flux over a face, or over a rim over which oil leaves, follows the content of its
  /// upstream cell instead of c.
  bool carries_content(const StageTerms& terms, size_t face) const;
  bool rim_carries_content(const StageTerms& terms, size_t rim) const;

 private:
  void list_cells(const StageTerms& terms, const Eigen::VectorXd& x);
  void list_faces(const StageTerms& terms, const Eigen::VectorXd& x);
  void list_rims(const StageTerms& terms, const Eigen::VectorXd& x);
  void list_ends(const StageTerms& terms, const Eigen::VectorXd& x);
  bool violates_limit(const StageTerms& terms, size_t face, double theta) const;
  char& state(int number);
  int rim_state(size_t rim) const;
  int end_state(int cell) const;

  std::vector<char> full_;         // by cell
  std::vector<char> limited_;      // by face: the lift is at its bound, or the layer at c
  std::vector<char> rim_limited_;  // by rim: the layer is at c
  std::vector<char> end_limited_;  // the same by cell, where the liner ends
  bool started_ = false;           // there is a last solution
  SplitSearch search_;
  std::vector<int> violated_;
};

}  // namespace clatter::film
