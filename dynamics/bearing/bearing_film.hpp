// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Force and friction of a journal bearing by impedance methods.
#include <Eigen/Core>
#include <string>

#include "dynamics/bearing/bearing_maps.hpp"

namespace clatter::dynamics {

struct BearingSize {
  double diameter = 0.0, width = 0.0;  // [m]
  double clearance = 0.0;              // relative, psi: of diameters, over the diameter
  double viscosity = 0.0;              // [Pa s]
  double radial_clearance() const { return 0.5 * clearance * diameter; }  // [m]
};

enum class BearingModel { kButenschoen, kMoes };

/// The journal as seen from the bearing, in a plane whose axes do not turn with the journal.
struct JournalMotion {
  Eigen::Vector2d offset, velocity;  // of its centre [m], [m/s]
  double spin = 0.0;                 // relative to the bearing [rad/s]
};

/// Force [N] and moment [N m] on the journal, (x, y, moment), and its derivatives by
/// offset, velocity, spin.
struct FilmForce {
  Eigen::Vector3d value;
  Eigen::Matrix<double, 3, 5> by_motion;
};

/// The oil film of a bearing of width b, diameter d, relative clearance psi, viscosity eta. With
/// the eccentricity e (over the radial clearance) and the effective speed w = spin - 2 delta',
/// delta the direction of e,
///
///   Butenschoen: F = b d eta/psi^2 [ So_D(|e|) (-|w| cos beta e_r + w sin beta e_t)
///                                    - So_V(+-|e|) |e|' e_r ]
///   Moes:        F = -b d eta/psi^2 |n| W(e, n),  n = e' - spin/2 w x e
///   friction:    M = -pi b d^2 eta spin / (2 psi sqrt(1 - e^2)) - (offset x F)/2
///
/// Couette's and Poiseuille's part; the bearing gets -M - offset x F, so that it has the lesser
/// moment. Below kCentred in e Butenschoen's force is blended into that of a centred film, which is
/// the same in all directions, so that e = 0 is regular; the changes of sign of |e|' and w, where
/// the film cavitates on its other side, are smoothed over kSmoothing. Elsewhere both are as given.
class BearingFilm {
 public:
  static constexpr double kCentred = 0.05;
  static constexpr double kSmoothing = 0.1;     // [rad/s], of relative eccentricity [1/s]
  static constexpr double kLargest = 1 - 1e-6;  // eccentricity

  BearingFilm(const BearingSize& size, BearingModel model);
  const BearingSize& size() const { return size_; }
  double eccentricity(const JournalMotion& motion) const {
    return motion.offset.norm() / size_.radial_clearance();
  }
  /// StepRefused where the journal touches the bearing: e above kLargest, or no number.
  FilmForce force(const JournalMotion& motion) const;

 private:
  BearingSize size_;
  BearingModel model_;
  ButenschoenMap butenschoen_;
  MoesMap moes_;
};

}  // namespace clatter::dynamics
