// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The rings of a piston: friction on the liner, and of the piston in its grooves.
#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/element/crank_angle.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/film/axial_motion.hpp"
#include "dynamics/film/viscosity.hpp"
#include "dynamics/given/motion.hpp"
#include "dynamics/ring/ring_lateral.hpp"
#include "dynamics/ring/ring_law.hpp"

namespace clatter::dynamics {

/// Rings and what they have in common.
struct RingPackOptions {
  std::string name = "rings";
  std::vector<RingSpec> rings;   // from the highest to the lowest
  double bore_radius = 0.0;      // [m]
  double viscosity = 0.01;       // of the oil without a law over temperature [Pa s]
  film::ViscosityOptions oil;    // its law over temperature, at the height of the ring
  double reversal_speed = 1e-2;  // u_0 of the faces [m/s]
  double groove_speed = 1e-3;    // u_g of the smoothed sign in the grooves [m/s]
};

/// The bodies. Coordinates of the element: [liner patches | their fit | pin x, y, z, rx, ry, rz |
/// liner axial | rotation of a free crank]; those of a liner at rest are absent. Stroke and gas are
/// over the time of the crank's clock.
struct RingPackBodies {
  std::optional<film::ElasticSurface> liner;
  Eigen::Vector2d bore_axis, liner_axial;             // (x, y) from the pin's centre [m]
  std::function<Motion<double>(double time)> stroke;  // of the pin's centre, engine z
  std::function<double(double time)> gas;  // gauge pressure in the cylinder [Pa]; empty: none
  CrankAngle crank;
};

/// Forces of the rings.
///
/// A ring stays in the bore and is carried along the stroke by its groove. Its face gets
///
///   T = -2 pi R_b W' f(S) U / sqrt(U^2 + u_0^2),   W' = W'_0 + g <p> b,   S = mu |U| / W'
///
/// f by ring_law.hpp, p the gauge pressure in the cylinder, of which the part g is behind the ring
/// of width b along the stroke; U is the speed of the piston along the liner on the bore's axis.
/// The groove carries N = m z'' + (g - g') <p> A - T along the stroke, g' that of the next lower
/// ring, A the ring's area. Against the piston's lateral slip s in the groove, relative to the bore
/// at this height, it holds with
///
///   F = -mu_g |N| s / sqrt(s^2 + u_g^2)
///
/// on the piston at the groove, and the opposite on the patches of the liner beside the ring. Gas
/// and inertia act on the piston elsewhere: its gas load and its mass contain those of the rings.
///
/// With a free crank p, z'' and the heights are those at its angle; U is the speed of the pin by
/// its own coordinate, which counts from the stroke of the clock. Of the derivatives by that angle
/// the tangent has that of m z'', by far the largest in short steps: it grows as 1 / kappa^2.
class RingPack : public ForceElement {
 public:
  /// @param coordinates without that of a free crank.
  RingPack(RingPackOptions options, RingPackBodies bodies, std::vector<int> coordinates);

  std::string name() const override { return options_.name; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// On the piston: `ring_friction_force` along the stroke [N], `ring_groove_force` across it, y
  /// [N], both lost powers `ring_friction_power`, `ring_groove_power` [W], and the friction of each
  /// ring from the highest, `ring_1_friction` [N].
  void record(History& history) const override;

 private:
  struct Totals {
    double groove = 0.0, axial_lost = 0.0, lateral_lost = 0.0, input = 0.0;
    std::vector<double> friction;  // of each ring [N]
  };
  /// A ring at an instant.
  struct Instant {
    double friction, friction_slope;  // T [N], by U [N s/m]
    double groove_load, groove_sign;  // |N| [N], d|N|/dN
    Eigen::Vector2d slip, force;      // s [m/s], F [N]
    double load_by_turn;              // of N by the rotation of a free crank [N/rad]
  };
  int pin() const { return n_liner_; }
  void list_touched(Response& response);
  double groove_load(size_t ring, double pressure, double acceleration, double friction) const;
  void find_rows(size_t ring, double stroke);
  /// A stroke at the crank's angle.
  struct Stroke {
    Motion<double> motion;        // of the ideal pin
    double clock_rate, pressure;  // z_B' by the clock [m/s]; gauge pressure [Pa]
    double acceleration_by_turn;  // of the motion
  };
  void add_ring(size_t ring, const Stroke& stroke, const Eigen::VectorXd& y,
                const Eigen::VectorXd& v);
  void add_tangent(const Instant& at, double kappa, double stroke_rate, Response& response);

  RingPackOptions options_;
  RingPackBodies bodies_;
  int n_liner_;  // patches and fit
  film::Viscosity viscosity_;
  Eigen::RowVectorXd axial_;          // the piston along the liner, on the bore's axis; n_e
  std::vector<RingLateral> lateral_;  // of an elastic liner
  std::vector<int> touched_place_;    // of a coordinate among the touched ones; -1: none
  std::vector<int> touched_;
  Eigen::Matrix2Xd slide_, slide_rate_;  // ds/dv and ds/dy of a ring by the touched coordinates
  Eigen::RowVectorXd axial_touched_;
  Eigen::Matrix2Xd slide_by_y_, force_by_y_;
  std::vector<Instant> instants_;
  Totals last_, finished_, accepted_;
};

}  // namespace clatter::dynamics
