// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The gap of one pad at one state, and where on the pad it carries.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/film/contact_model.hpp"
#include "dynamics/film/cover.hpp"
#include "dynamics/film/recess.hpp"

namespace clatter::film {

/// h = c + d(z) + G_l(z) y_l - G_p y_p at the cells of a pad (n), its derivatives by the k
/// coordinates of map().columns() and along the stroke, and the area of the cells inside the liner.
class PadGap {
 public:
  PadGap(const ContactModel& model, const PadGrid& grid);

  /// Cover, gap and its derivative by height.
  void set(const PadState& state);
  /// by_y(), at the state that is set.
  void find_directions() { map_.rows(1.0, 0.0, by_height_, by_y_); }
  /// rate_by_y(), likewise.
  void find_rate_directions(const PadState& state);

  const PadGrid& grid() const { return grid_; }
  const GapMap& map() const { return map_; }
  const Eigen::ArrayXd& value() const { return value_; }            // h [m]
  const Eigen::ArrayXd& by_height() const { return by_height_; }    // dh/dz along the stroke [1]
  const SparseRows& by_y() const { return by_y_; }                  // dh/dy, n x k
  const SparseRows& rate_by_y() const { return rate_by_y_; }        // dh'/dy, n x k
  const Eigen::ArrayXd& area() const { return area_; }              // covered area [m2]
  const Eigen::ArrayXd& area_slope() const { return area_slope_; }  // by height [m]
  /// Of the pad by the liner; null: it is covered everywhere.
  const Cover* cover() const { return ends_ ? &cover_ : nullptr; }
  /// Null: none.
  const RecessCells* recesses() const { return recess_map_ ? &recesses_ : nullptr; }
  int cells_of_recess(size_t k) const { return recess_map_->cells_of(k); }
  /// Rate of the gap by what moves the walls, n [m/s]; null: nothing does.
  const Eigen::ArrayXd* wall_rate() const { return scaled_ ? &scaled_->rate() : nullptr; }

  /// h' at velocities v (n_e) and that of the stroke [m/s], n.
  Eigen::ArrayXd rate(const Eigen::VectorXd& v, double stroke_velocity) const;
  /// Inside the liner and not in a recess, n.
  Eigen::Array<bool, Eigen::Dynamic, 1> carrying() const;
  /// Smallest gap that can carry [m]; infinite when the pad is outside the liner.
  double lowest() const;

 private:
  void add_recesses(const std::vector<Recess>& recesses);
  void place_recesses(double position);

  PadGrid grid_;
  GapMap map_;
  Eigen::ArrayXd rest_;  // clearance and skirt relief [m]
  std::vector<LinerShapeMap> liner_shapes_;
  std::optional<ScaledGap> scaled_;
  std::optional<CoverMap> ends_;
  std::optional<RecessMap> recess_map_;
  bool recesses_move_ = false;  // some are on the liner
  Eigen::ArrayXd value_, by_height_, area_, area_slope_;
  SparseRows by_y_, rate_by_y_;
  Cover cover_;
  RecessCells recesses_;
};

}  // namespace clatter::film
