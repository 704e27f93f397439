// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil on the liner where no skirt covers it, remembered height by height.
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <vector>

#include "dynamics/film/edge_volumes.hpp"
#include "dynamics/film/grid.hpp"
#include "dynamics/film/oil_balance.hpp"

namespace clatter::film {

/// A piston ring above the skirt, by what it leaves on the liner.
struct RingOptions {
  double height = 0.0;       // above the pin's centre [m], above the skirt
  double face_radius = 0.0;  // R of its face along the stroke [m]
  double load = 0.0;         // W', radial load on a unit length of the circumference [N/m]
  double least = 0.0;        // least layer that it leaves [m]: that in the valleys of the honing
  /// What gas behind the ring adds to W' over time [N/m]; empty: nothing.
  std::function<double(double time)> gas_load = {};
};

/// Thickness of the layer that a flooded ring leaves, t = 3/2 mu U R / W', at least `least` [m].
///
/// The ring is a parabola h_0 (1 + x^2 / (2 R h_0)) under the load W', loaded hydrodynamically with
/// rupture where p = dp/dx = 0 (Martin 1916: h_0 = 4.895 mu (U/2) R / W'). The film there, 1.2257
/// h_0, is carried at U/2; the product of the two factors over 4 is 3/2 to rounding. No squeeze, no
/// starvation: a layer that is thinner than this passes below the ring as it is.
/// @param viscosity mu [Pa s]. @param speed |U| [m/s]. @param gas_load of W' [N/m].
double ring_layer(const RingOptions& ring, double viscosity, double speed, double gas_load = 0.0);

/// The layer and what supplies and thins it.
struct LinerLayerOptions {
  double bottom = 0.0, top = 0.0;  // heights that it covers [m], engine frame
  double cell = 0.0;               // height of its cells [m]; 0: that of a row of the pads
  double splash = 0.0;             // rate at which it thickens below the skirt [m/s], up to
  double splash_thickness = 0.0;   // this thickness [m]
  /// Largest thickness below the skirt [m]; more drips off.
  double most = std::numeric_limits<double>::infinity();
  std::vector<RingOptions> rings;

  /// Number of cells along the stroke, for pads with rows of the height `row` [m].
  double cells(double row) const;
};

/// The layer on the liner below and above one pad, in the columns of its grid.
///
/// Volume per length of the circumference [m2] in cells that are fixed to the liner, so that what
/// is not touched does not move at all. A cell at an edge of the pad holds oil on its free part
/// only. The leading edge meets what lies on the stretch that it sweeps in a step (`meet`); what
/// the gap does not take is pushed ahead, onto the free part. The trailing edge leaves what flows
/// out on the stretch that it uncovers. Both follow from the volumes that the film moved in an
/// accepted step (`advance`), so that oil is neither made nor lost; where the film took more than
/// there was, by the error of the tableau, the rest is owed and taken from what comes next.
///
/// The pad moves as in the film, by the tableau's integral of the stroke's speed.
class LinerLayer {
 public:
  /// InputError when the options cannot hold the pad or a ring is not above it.
  LinerLayer(const LinerLayerOptions& options, const PadGrid& pad);

  /// The run begins with the pad at engine z `height` [m] and this thickness [m] wherever the pad
  /// is not.
  void start(double height, double thickness);
  /// Thickness that each edge meets on the way by `travel` [m], n_angle each [m].
  void meet(double travel, Eigen::ArrayXd& lower, Eigen::ArrayXd& upper) const;
  /// An accepted step of `dt` [s], in which the pad moved by `travel` [m] and the film moved
  /// `volumes`; `left` [m]: what each ring leaves, in the order of the options.
  void advance(double dt, double travel, const EdgeVolumes& volumes,
               const std::vector<double>& left);

  /// Volume on the liner, less what is owed [m3].
  double volume() const;
  /// Thickness of each cell on its free part, n_angle x cells [m]; 0 where the pad covers it.
  Eigen::ArrayXXd thickness() const;
  /// Centres of the cells, engine z [m].
  Eigen::VectorXd heights() const;
  /// Without `gap` and `first`.
  const OilBalance& balance() const { return balance_; }

  /// The state as numbers.
  void save(std::vector<double>& state) const;
  size_t saved_size() const;
  /// Takes `saved_size()` numbers from `next` on; returns where they end.
  std::vector<double>::const_iterator restore(std::vector<double>::const_iterator next);

 private:
  enum class Side { kBelow, kAbove };
  double edge(Side side, double height) const;
  double floor_of(int cell) const { return options_.bottom + cell * step_; }
  int cell_at(double height) const;
  double free(Side side, double edge, int cell) const;
  int first_free(Side side, double edge) const;
  void meet_one(Side side, double travel, Eigen::ArrayXd& thickness) const;
  void move_edge(Side side, double travel, const Eigen::ArrayXd& out);
  void put(Side side, double edge, Eigen::ArrayXd& rest);
  void pass_ring(const RingOptions& ring, double travel, double left);
  void splash(double dt);
  double arc_sum(const Eigen::ArrayXd& by_column) const { return (arc_ * by_column).sum(); }

  LinerLayerOptions options_;
  double skirt_bottom_, skirt_top_;
  Eigen::ArrayXd arc_;  // widths of the columns [m], n_angle
  double step_ = 0.0;   // height of a cell [m]
  double height_ = 0.0;
  Eigen::ArrayXXd held_;                    // volume per length, n_angle x cells [m2]
  Eigen::ArrayXd owed_below_, owed_above_;  // taken before it was there, n_angle [m2]
  mutable Eigen::ArrayXd sum_;  // working memory, also of meet(), so that no step takes memory
  Eigen::ArrayXd rest_;
  OilBalance balance_;
};

}  // namespace clatter::film
