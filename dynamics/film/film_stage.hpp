// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the film of one pad is solved for: thicknesses, step and walls of one implicit stage.
#include <Eigen/Core>
#include <vector>

#include "dynamics/film/cover.hpp"
#include "dynamics/film/recess.hpp"

namespace clatter::film {

/// Where the oil of a cell is that it does not fill, and how the sliding wall carries it. One wall
/// rests on the grid, the other slides past it at 2 U_m.
///
///   kStriated  streamers across the gap, which move at U_m like a full film (Jakobsson and Floberg
///              1957): flux theta c U_m
///   kLayer     a layer on the sliding wall, which moves with it, up to half of the gap, and the
///              rest on the wall of the grid: flux min(2 theta s, c) U_m
///
/// Both agree for a full film and wherever the flux is given, as behind a rupture in steady flow; a
/// layer of thickness t has the flux 2 t U_m with the content t in the second, 2 t in the first.
enum class Cavity { kStriated, kLayer };

/// Thicknesses of the film cell by cell and their derivatives by the gap h; n each.
///
/// With smooth surfaces all of them equal h; rough ones: see flow_factors.hpp.
struct FilmCells {
  Eigen::ArrayXd content, d_content;        // volume per area s(h) [m]
  Eigen::ArrayXd flow_angle, d_flow_angle;  // g with g^3 = phi_x h^3, along the circumference [m]
  Eigen::ArrayXd flow_axial, d_flow_axial;  // the same along the axis [m]
  Eigen::ArrayXd carry, d_carry;            // c, thickness carried by the mean wall velocity [m]

  const Eigen::ArrayXd& flow(bool axial) const { return axial ? flow_axial : flow_angle; }
  const Eigen::ArrayXd& d_flow(bool axial) const { return axial ? d_flow_axial : d_flow_angle; }

  void resize(int n);
  /// Smooth surfaces: every thickness is `h`.
  void set_smooth(const Eigen::ArrayXd& h);
};

/// Layers on the sliding wall beyond the first and the last axial edge, by column [m], n_angle
/// each.
struct OutsideLayers {
  Eigen::ArrayXd begin, end;
};

/// Faces and rims over which the sliding wall carries oil as it lies, whatever the solution.
struct KnownFlows {
  std::vector<char> at;   // by face and rim, as PadFaces lists flows: its volume is known
  Eigen::ArrayXd volume;  // carried since the start of the step, as flows [m3]
  Eigen::ArrayXd rate;    // of it now [m3/s]
};

/// Data of one implicit stage that do not depend on the cell.
struct FilmStage {
  double kappa = 1.0;      // dt * a_ii [s]
  double viscosity = 0.0;  // [Pa s]
  double speed_angle =
      0.0;  // mean wall velocity relative to the grid, along the circumference [m/s]
  double speed_axial = 0.0;  // the same along the axis [m/s]
  bool steady = false;  // true: div q = 0, no storage; kappa and the content before are not used
  /// Bulk modulus of the oil [Pa]: a full cell holds (1 + p / B) s. 0: incompressible. A body of
  /// mass m per area stops on a cell that fills within sqrt(m s / B) instead of instantly.
  double bulk_modulus = 0.0;
  /// Reynolds::profile() at the start of the step, n: where it varies, a face carries a limited
  /// linear profile instead of the upstream value, second order in the cell size. Null: first
  /// order.
  const Eigen::ArrayXd* profile_before = nullptr;
  /// Striated when steady: then the content of a layer does not follow from its flux.
  Cavity cavity = Cavity::kStriated;
  /// Part of the pad inside the liner, which slides with its ends at 2 U_m along the axis. Null:
  /// all of it. Not when steady.
  const Cover* cover = nullptr;
  /// Grooves and windows (recess.hpp); null: none. Windows not when steady and not without
  /// cavitation.
  const RecessCells* recesses = nullptr;
  /// Instead of the layers of the edges; null: those.
  const OutsideLayers* outside = nullptr;
  /// Where the wall carries nothing in this stage, because what it carried is in the content
  /// before; null: nowhere.
  const KnownFlows* known = nullptr;

  /// Of the balance over the stage [s]; 1 when steady.
  double duration() const { return steady ? 1.0 : kappa; }
  double speed(bool axial) const { return axial ? speed_axial : speed_angle; }
  /// Whether oil that does not fill its cell is a layer.
  bool layers() const { return cavity == Cavity::kLayer && !steady; }
};

}  // namespace clatter::film
