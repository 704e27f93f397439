// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where on a pad a stage has a film: inside the liner and outside of recesses.
#include <utility>
#include <vector>

#include "dynamics/film/film_stage.hpp"
#include "dynamics/film/pad_faces.hpp"

namespace clatter::film {

/// What a cell is in a stage.
enum class CellKind : char {
  kFilm,
  kBesideGroove,  // film, part of which a groove covers
  kGroove,        // pressure and fill are those of its reservoir
  kWindow,        // without pressure, its fill is not bounded
  kOutside,       // of the liner: it has the pressure of the edge
};

/// The part of a face or rim that has a film, and its derivatives by the pad's height.
struct OpenPart {
  double distance, distance_slope = 0.0;      // [m]
  double length = 1.0, length_slope = 0.0;    // factor of the length
  double carried = 1.0, carried_slope = 0.0;  // of the length over which the liner carries
  double outer = 1.0, outer_slope = 0.0;      // cover of the less covered cell over that of
  bool outer_is_b = true;                     // the other

  /// `values` of both cells at the centres of their covered parts.
  std::pair<double, double> beside(double a, double b) const;
  /// From derivatives by the values at those centres to derivatives by `values`.
  void to_cells(double& by_a, double& by_b) const;
  /// The part is outside, where walls that overlap have no thickness at all.
  bool closed() const { return length == 0.0 && carried == 0.0; }
};

/// Kinds of the cells of one stage, and the open parts of faces and rims between them.
class FilmExtent {
 public:
  explicit FilmExtent(const PadGrid& grid) : grid_(grid) {}
  /// Both are read until the next call; null: none.
  void set(const Cover* cover, const RecessCells* recesses);

  /// Part of the pad is outside the liner.
  bool partial() const { return partial_; }
  bool is(CellKind kind, int cell) const { return kind_[cell] == kind; }
  bool in_recess(int cell) const {
    return is(CellKind::kGroove, cell) || is(CellKind::kWindow, cell);
  }
  /// The pressure or the fill of the cell is given.
  bool is_given(int cell) const {
    return is(CellKind::kGroove, cell) || is(CellKind::kOutside, cell);
  }
  /// A film over the entire cell: inside the liner, and no recess covers a part of it.
  bool is_plain(int cell) const {
    return is(CellKind::kFilm, cell) && (!partial_ || cover_->share[cell % grid_.n_axial()] == 1.0);
  }
  OpenPart open(const Face& face) const;
  OpenPart open(const Rim& rim) const;

 private:
  CellKind kind_of(int cell) const;
  OpenPart covered_part(const Face& face) const;
  void end_at_recess(const Face& face, OpenPart& part) const;

  PadGrid grid_;
  const Cover* cover_ = nullptr;
  const RecessCells* recesses_ = nullptr;
  bool partial_ = false;
  std::vector<CellKind> kind_;  // by cell
};

}  // namespace clatter::film
