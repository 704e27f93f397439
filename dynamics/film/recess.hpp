// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Grooves, holes and windows: areas of skirt or liner that are too deep to carry.
#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "dynamics/film/grid.hpp"

namespace clatter::film {

/// An area of the skirt or the liner that is too deep to carry: it has a given pressure and no
/// asperities.
///
///   kGroove  a groove or hole that is connected to a reservoir: what flows in and out is the
///            reservoir's, and the sliding wall carries its fill out of it
///   kWindow  a part of the skirt that is cut away, at the pressure 0 of the crankcase: what flows
///            in stays on the liner and is carried on with it
struct Recess {
  enum class Kind { kGroove, kWindow };
  Kind kind = Kind::kGroove;
  bool on_liner = false;                       // kGroove only
  double bottom = 0.0, top = 0.0;              // z from the pin's centre, on the liner engine z [m]
  double angle_begin = 0.0;                    // [rad]
  double angle_span = 2.0 * std::numbers::pi;  // [rad], counted right-handed about z from there
  double pressure = 0.0;                       // gauge [Pa] >= 0; of a groove
  double fill = 1.0;  // of the oil in a groove, 0 to 1; 1 where pressure > 0
};

/// Whether film and reservoirs exchange oil.
bool has_grooves(const std::vector<Recess>& recesses);

/// The recesses at the cells of a pad, n each.
struct RecessCells {
  /// Covered fraction of the cell's height. 1: the film has `pressure` and, in a groove, `fill`.
  /// Below: the rest of the cell, beside the edge of the groove, exchanges oil with it.
  Eigen::ArrayXd share;
  Eigen::ArrayXd share_slope;  // by the height of the pad [1/m]
  Eigen::ArrayXd pressure;     // [Pa]
  Eigen::ArrayXd fill;         // [1]
  Eigen::Array<bool, Eigen::Dynamic, 1> window;

  bool covered(Eigen::Index cell) const { return share[cell] == 1.0; }
  bool groove(Eigen::Index cell) const { return covered(cell) && !window[cell]; }
  bool open(Eigen::Index cell) const { return covered(cell) && window[cell]; }
};

/// Where the recesses are on a pad.
///
/// A column of cells belongs to a recess when its centre does, and on the skirt a row likewise. On
/// the liner the edges of a groove pass the rows: w is the fraction of a row inside. Where two
/// recesses meet, the one that covers more of a cell counts.
class RecessMap {
 public:
  RecessMap(std::vector<Recess> recesses, const PadGrid& pad);
  /// Number of cells that recess `k` covers on the pad; of one on the liner, columns.
  int cells_of(size_t k) const;
  /// Writes the recesses when the pad's z = 0 is at engine z `height` [m].
  void at(double height, RecessCells& cells) const;

 private:
  bool has_column(const Recess& recess, int i) const;
  std::vector<Recess> recesses_;
  PadGrid pad_;
};

/// Conductance from the edge of a groove to the centre of the part of a cell beside it, over that
/// between the centres of two cells.
inline double groove_conductance(double share) { return 2.0 / (1.0 - share); }

}  // namespace clatter::film
