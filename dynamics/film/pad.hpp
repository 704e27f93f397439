// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One pad of a piston-liner contact: its gap, film, asperities and friction, their force and
// tangent.
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/film/friction.hpp"
#include "dynamics/film/pad_contact.hpp"
#include "dynamics/film/pad_film.hpp"
#include "dynamics/film/pad_gap.hpp"
#include "dynamics/film/pad_snapshot.hpp"

namespace clatter::film {

/// Reported scalars, summed up over the pads.
struct PadSums {
  double lowest_gap = std::numeric_limits<double>::infinity();      // that can carry [m]
  double lowest_outside = std::numeric_limits<double>::infinity();  // wherever it is [m]
  double side = 0.0, moment = 0.0;             // side force on the piston [N], moment about x [N m]
  double rubbing = 0.0;                        // friction [N]
  double film_load = 0.0, contact_load = 0.0;  // [N]
  double film_peak = 0.0, contact_peak = 0.0;  // [Pa]
  double oil = 0.0, space = 0.0;               // in the gap, and of it [m3]
};

/// Forces of one pad on the k coordinates of columns(). An effect that is off has no member.
class Pad {
 public:
  /// `centre` [rad] of two pads, around which the grid is laid. `model` is read while this is used.
  Pad(const ContactModel& model, std::string name, double centre);

  /// The content at the start of the run, from the state at its start.
  void start(const PadState& state);
  /// Throws StepRefused. `first_step`: no step was accepted since start().
  void evaluate(const PadState& state, bool first_step, bool with_tangent);

  const std::vector<int>& columns() const { return gap_.map().columns(); }
  /// Adds to the forces on all coordinates, n_e.
  void add_force(Eigen::VectorXd& force) const;
  /// Adds the force's derivative; coordinate i has row and column `row[i]` of `tangent`, a free
  /// crank's the last column.
  void add_tangent(const std::vector<int>& row, Eigen::MatrixXd& tangent) const;
  const PadGap& gap() const { return gap_; }
  std::optional<PadFilm>& film() { return film_; }
  const std::optional<PadFilm>& film() const { return film_; }

  /// Adds to the power at velocities v (n_e).
  void add_power(const Eigen::VectorXd& v, const PinStroke& pin, dynamics::Power& power) const;
  void add_sums(PadSums& sums) const;
  PadSnapshot snapshot() const;

 private:
  std::string place() const { return gap_.grid().periodic() ? name_ : name_ + " pad"; }
  double end_force() const { return contact_ ? contact_->end_force(gap_) : 0.0; }
  Eigen::Vector3d friction_wrench() const;
  void update_load(const PadState& state, bool first_step);
  void update_tangent();
  void add_load_tangent();
  void add_end_tangent();
  void update_crank_column(double slide_by_turn);
  Eigen::Matrix3Xd friction_tangent() const;

  const ContactModel& model_;
  std::string name_;
  PadGap gap_;
  std::optional<PadFilm> film_;
  std::optional<PadContact> contact_;
  std::optional<Friction> friction_;
  Eigen::Matrix<double, Eigen::Dynamic, 3>
      levers_;               // (F, M_x, M_y) about the pin's centre per unit axial force, n x 3
  Eigen::ArrayXd load_;      // covered area times (p + p_c) [N], n
  Eigen::VectorXd force_;    // without friction, k
  RowMatrix tangent_;        // of the force, with friction, k x k
  Eigen::VectorXd by_turn_;  // the same by the rotation of a free crank, k
  RowMatrix derivative_;     // dx/dy of the film, then d(load)/dy, n x k
};

}  // namespace clatter::film
