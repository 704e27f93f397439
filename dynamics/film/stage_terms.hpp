// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The terms in the oil balance of each cell at one stage, before it is known which cells are full.
#include <Eigen/Core>
#include <cmath>
#include <utility>
#include <vector>

#include "dynamics/film/film_extent.hpp"
#include "dynamics/film/flow_factors.hpp"

namespace clatter::film {

/// Flow from a to b over a face, over the stage: conduct (x_a - x_b) + carry theta, x being the
/// unknowns of pressure and theta the fill on the face.
struct FaceTerms {
  int a, b;  // as of Face
  double conduct = 0.0, carry = 0.0;
  double lift = 0.0;   // l, excess on the face over the upstream cell
  double ratio = 1.0;  // of layers, 2 (1 + l) s / c, at least 1

  int upstream() const { return carry > 0.0 ? a : b; }
  /// theta + l (1 - theta) meets its bound, 2 theta for l > 0 and 0 for l < 0, at this theta.
  double lowest_lifted() const {
    const double size = std::abs(lift);
    return size / (1.0 + size);
  }
};

/// Flow out over a rim, over the stage: conduct (x - pressure) + carry theta, or `entering` instead
/// of the second where carry is not positive.
struct RimTerms {
  int cell;
  double pressure;  // [Pa]
  double conduct = 0.0, carry = 0.0, entering = 0.0;
  double ratio = 1.0;           // of layers, 2 s / c, at least 1
  ValueSlope inflow{0.0, 0.0};  // thickness that U_m carries in [m], by the gap
};

/// Terms of one stage of the film on the faces of a pad. Nondimensional: volumes over
/// `volume_scale`, pressures over `pressure_scale`.
class StageTerms {
 public:
  explicit StageTerms(PadFaces faces);
  /// `content_before` is m~ [m], n (not read when steady). Keeps copies of both others.
  void set(const FilmCells& film, const Eigen::ArrayXd& content_before, const FilmStage& stage);

  const PadFaces& pad() const { return pad_; }
  const PadGrid& grid() const { return pad_.grid(); }
  const FilmExtent& extent() const { return extent_; }
  const FilmCells& film() const { return film_; }
  const FilmStage& stage() const { return stage_; }

  const std::vector<FaceTerms>& faces() const { return faces_; }
  const std::vector<RimTerms>& rims() const { return rims_; }
  // By cell, n: storage s, storage by pressure s / B, m~.
  const Eigen::ArrayXd& storage() const { return storage_; }
  const Eigen::ArrayXd& squeeze() const { return squeeze_; }
  const Eigen::ArrayXd& before() const { return before_; }
  /// Conductance from a cell to the groove beside it; 0 where there is none.
  double exchange(int cell) const { return pad_.grooves() ? exchange_[cell] : 0.0; }
  /// Volume per thickness that the stage covers at the end of the liner [1/m], negative where it
  /// uncovers.
  double covered(int cell) const { return extent_.partial() ? covered_[cell] : 0.0; }
  /// The same for a cell that is covered all at once.
  double slid(int cell) const;

  double volume_scale() const { return volume_scale_; }      // [m3]
  double pressure_scale() const { return pressure_scale_; }  // [Pa]
  /// The stage's duration over 12 mu [1/Pa], over the volume scale.
  double mobility() const { return mobility_ / volume_scale_; }

  bool layers() const { return stage_.layers(); }
  bool compressible() const { return stage_.bulk_modulus > 0.0; }
  /// The liner carries all of its oil across a window.
  bool within_window(const FaceTerms& face) const {
    return extent_.is(CellKind::kWindow, face.a) && extent_.is(CellKind::kWindow, face.b);
  }
  /// The cell with whose content a layer on the sliding wall is compared: that upstream, or beside
  /// a groove the one whose gap it fills.
  int content_cell(const FaceTerms& face) const;
  /// The open part of face or rim `k`, over which the wall carries nothing where that is known.
  OpenPart open_face(size_t f) const;
  OpenPart open_rim(size_t r) const;
  /// Thickness that U_m carries in over an edge [m], with its slope by the gap.
  ValueSlope entering(const Edge& edge, int cell) const;
  /// Oil content of the cells relative to that when just full, theta + p / B; n.
  Eigen::ArrayXd density(const Eigen::ArrayXd& pressure, const Eigen::ArrayXd& fill) const;

 private:
  struct Sums {
    double conduct = 0.0, carry = 0.0;
  };
  void weigh_faces(Sums& sums);
  void weigh_rims(Sums& sums);
  void scale(Sums sums, const Eigen::ArrayXd& content_before);
  void weigh_ends();
  void weigh_grooves();
  double lift(const Face& face) const;

  PadFaces pad_;
  FilmExtent extent_;
  FilmCells film_;
  FilmStage stage_;
  std::vector<FaceTerms> faces_;
  std::vector<RimTerms> rims_;
  Eigen::ArrayXd storage_, squeeze_, before_, exchange_, covered_;
  double volume_scale_ = 1.0, pressure_scale_ = 1.0, mobility_ = 0.0;
};

}  // namespace clatter::film
