// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Laws of the bearings of shafts.
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/bearing/bearing_film.hpp"
#include "dynamics/bearing/shaft_axes.hpp"
#include "dynamics/given/spline.hpp"
#include "dynamics/law/pair_law.hpp"
#include "dynamics/law/radial_table.hpp"

namespace clatter::dynamics {

/// A spring and damper along the axis: the thrust collar.
struct ThrustLaw {
  double stiffness = 0.0, damping = 0.0;  // [N/m], [N s/m]
};

/// Where a bearing is.
struct BearingPlace {
  ShaftAxes axes = {};
  /// Of the journal's centre from the housing's point where the bearing is centred [m].
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  ThrustLaw thrust = {};
  /// The journal is seen to turn at this speed besides its own motion: in a system at rest, where
  /// it would not bear [rad/s].
  double assumed_spin = 0.0;
};

/// What all bearings have in common: a journal (point a) in a housing (point b) that may move and
/// turn, and the thrust collar. The bearing's axis is the shaft's; its tilt has no moment.
class BearingLaw : public PairLaw {
 public:
  explicit BearingLaw(const BearingPlace& place) : place_(place) {}

 protected:
  JournalMotion journal(const PairMotion& motion) const;
  /// The thrust collar, and the force on the journal across the axis, of which no power is stored.
  PairForce with_thrust(const PairMotion& motion, const FilmForce& across) const;
  const ShaftAxes& axes() const { return place_.axes; }

 private:
  BearingPlace place_;
};

/// The same in all directions across the axis, without friction: a spring or a table.
class RadialBearing : public BearingLaw {
 public:
  /// @param largest eccentricity [m]; StepRefused beyond.
  RadialBearing(const BearingPlace& place, RadialForce law,
                double largest = std::numeric_limits<double>::infinity())
      : BearingLaw(place), law_(std::move(law)), largest_(largest) {}
  PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) override;

 private:
  RadialForce law_;
  double largest_;
};

/// Stiffnesses and damping across the axis, 11, 12, 21, 22 along the shaft's first and second axis,
/// over the speed of the journal; beyond the table as at its ends.
struct BearingCoefficients {
  std::vector<Spline> stiffness, damping;  // 4 each; [N/m], [N s/m], over [rad/s]
};

/// F = - K d - C d' of such coefficients. All power that it takes is lost, below 0 where it drives.
class CoefficientBearing : public BearingLaw {
 public:
  CoefficientBearing(const BearingPlace& place, BearingCoefficients coefficients)
      : BearingLaw(place), coefficients_(std::move(coefficients)) {}
  PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) override;

 private:
  BearingCoefficients coefficients_;
};

/// A plain bearing with an oil film. All power that it takes is lost.
class FilmedBearing : public BearingLaw {
 public:
  using BearingLaw::BearingLaw;
  PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) override;
  /// `<name>_eccentricity`, relative, and `<name>_friction` [N m], the moment on the journal.
  void record(const std::string& name, const PairMotion& motion, const PairForce& force,
              History& history) const override;

 protected:
  virtual FilmForce film_force(const Stage& stage, const JournalMotion& motion,
                               bool with_derivatives) = 0;
  virtual const BearingSize& size() const = 0;
};

/// A plain bearing whose film is an impedance (bearing_film.hpp).
class ImpedanceBearing : public FilmedBearing {
 public:
  ImpedanceBearing(const BearingPlace& place, const BearingFilm& film)
      : FilmedBearing(place), film_(film) {}

 protected:
  FilmForce film_force(const Stage&, const JournalMotion& motion, bool) override {
    return film_.force(motion);
  }
  const BearingSize& size() const override { return film_.size(); }

 private:
  BearingFilm film_;
};

}  // namespace clatter::dynamics
