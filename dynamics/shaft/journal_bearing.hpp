// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Bearings of shafts.
#include <memory>
#include <string>
#include <utility>

#include "dynamics/force/port_element.hpp"
#include "dynamics/shaft/bearing_film.hpp"
#include "dynamics/shaft/shaft_axes.hpp"

namespace clatter::dynamics {

/// A spring and damper along the axis: the thrust collar.
struct ThrustLaw {
  double stiffness = 0.0, damping = 0.0;  // [N/m], [N s/m]
};

/// What all bearings have in common: a journal (port a) in a housing (port b) that may move and
/// turn, and the thrust collar. The bearing's axis is the shaft's; its tilt has no moment.
class ShaftBearing : public PortElement {
 public:
  /// @param offset of the journal's centre from the housing's point where the bearing is centred
  /// [m].
  ShaftBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
               const ShaftAxes& axes, const Eigen::Vector3d& offset, const ThrustLaw& thrust);
  /// The bearing sees the journal turn at `spin` [rad/s] besides its own motion: in a system at
  /// rest, where it would not bear.
  void assume_spin(double spin) { assumed_spin_ = spin; }

 protected:
  /// The law of the thrust collar, zero across the axis.
  PairForce thrust_force(const PairMotion& motion) const;
  JournalMotion journal(const PairMotion& motion) const;
  ShaftAxes axes_;

 private:
  Eigen::Vector3d offset_;
  ThrustLaw thrust_;
  double assumed_spin_ = 0.0;  // [rad/s]
};

/// A plain bearing with an oil film, whose law of the force is another's. All power that it takes
/// is lost.
class FilmedBearing : public ShaftBearing {
 public:
  FilmedBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
                const ShaftAxes& axes, const Eigen::Vector3d& offset, const ThrustLaw& thrust);
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  /// Also `<name>_eccentricity`, relative, and `<name>_friction` [N m], the moment on the journal.
  void record(History& history) const override;

 protected:
  PairForce force(double time, const PairMotion& motion) const override;
  virtual FilmForce film_force(const JournalMotion& motion) const = 0;
  virtual const BearingSize& size() const = 0;

 private:
  struct State {
    double eccentricity = 0.0, friction = 0.0;
  };
  std::string eccentricity_name_, friction_name_;
  mutable State last_;
  State finished_, accepted_;
};

/// A plain bearing whose film is an impedance (bearing_film.hpp).
class JournalBearing : public FilmedBearing {
 public:
  JournalBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
                 const ShaftAxes& axes, const Eigen::Vector3d& offset, const ThrustLaw& thrust,
                 const BearingFilm& film)
      : FilmedBearing(std::move(name), std::move(journal), std::move(housing), axes, offset,
                      thrust),
        film_(film) {}

 protected:
  FilmForce film_force(const JournalMotion& motion) const override {
    return film_.force(motion, name());
  }
  const BearingSize& size() const override { return film_.size(); }

 private:
  BearingFilm film_;
};

/// A bearing of constant stiffness and damping in all directions across the axis, without friction.
class LinearBearing : public ShaftBearing {
 public:
  /// @param stiffness [N/m]. @param damping [N s/m].
  LinearBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
                const ShaftAxes& axes, const Eigen::Vector3d& offset, const ThrustLaw& thrust,
                double stiffness, double damping);

 protected:
  PairForce force(double time, const PairMotion& motion) const override;

 private:
  double stiffness_, damping_;
};

}  // namespace clatter::dynamics
