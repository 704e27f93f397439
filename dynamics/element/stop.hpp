// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contact of a point of one body with a plane of another.
#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "dynamics/element/element.hpp"
#include "dynamics/element/point_on_plane.hpp"
#include "dynamics/element/rigid_contact.hpp"
#include "dynamics/law/bristle.hpp"
#include "dynamics/law/creep_watch.hpp"

namespace clatter::dynamics {

/// Normal force N of a contact by its depth d and the rate of the depth, d'; N >= 0.
struct NormalForce {
  double force = 0.0, by_depth = 0.0, by_rate = 0.0;  // [N], [N/m], [N s/m]
  double stored = 0.0, lost = 0.0;                    // [J], [W]
};

/// Coulomb friction mu N against slip. Below its limit a contact sticks (bristle.hpp). One with a
/// slip speed creeps: mu grows as at_rest (3 x - x^3) / 2 up to its largest value at
/// x = |slip| / slip_speed = 1, falls to `kinetic` at x = 2 by a cubic, and stays.
struct FrictionLaw {
  double kinetic = 0.0, at_rest = 0.0;  // coefficients; at_rest >= kinetic
  std::optional<double> slip_speed;     // [m/s]
  double stiffness = 1e8;               // in the plane [N/m]
  double damping_time = 1e-4;           // damping in the plane over stiffness [s]
};

/// Records `<name>_gap` [m], `<name>_force`, the normal force [N], and with friction `<name>_slip`
/// [m/s]; spaces of the name are underscores.
class Stop : public ForceElement {
 public:
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void begin_step(double time) override {
    if (creep_) creep_->begin_step(time);
  }
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  void record(History& history) const override;
  double gap() const { return accepted_[0]; }           // [m]
  double normal_force() const { return accepted_[1]; }  // [N]
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;
  void archive(Archive& archive) override {
    if (creep_) creep_->archive(archive);
  }
  std::optional<double> crept() const override {
    return creep_ ? std::optional(creep_->longest()) : std::nullopt;
  }

 protected:
  Stop(const std::string& name, PointOnPlane pair, const FrictionLaw& friction);
  virtual NormalForce normal(double depth, double rate) const = 0;
  /// "<name>_<what>" with underscores.
  std::string history_name(const char* what) const;

  PointOnPlane pair_;
  FrictionLaw friction_;

 private:
  Eigen::Vector2d slip(const PlaneMotion& at) const;
  /// Friction against the slip, in the plane's two tangents, at a normal force.
  Bristle::Force friction(const Stage& stage, const Eigen::Vector2d& slip, double normal);

  std::string name_;
  std::array<std::string, 3> recorded_;
  std::array<double, 3> last_{}, finished_{}, accepted_{};  // gap, force, slip
  double time_ = 0.0;
  Eigen::Vector2d slip_ = Eigen::Vector2d::Zero();  // of the last evaluation [m/s]
  std::optional<Bristle> bristle_;
  std::optional<CreepWatch> creep_;                    // with a slip speed
  Eigen::Vector2d against_ = Eigen::Vector2d::Zero();  // friction of the last evaluation [N]
  Eigen::RowVectorXd by_normal_;
  Eigen::Matrix2Xd by_slip_, by_against_;
  Matrix3X by_force_;
};

/// N = k d^n (1 + chi d'), never below 0: for n = 3/2 Hertz with the damping of Hunt and Crossley
/// (1975). The loss of an impact depends on its speed v alone, for any mass, k and n:
/// chi v - ln(1 + chi v) = -chi e v - ln(1 - chi e v).
class CompliantStop : public Stop {
 public:
  /// @param stiffness k [N/m^n]. @param exponent n >= 1. @param damping chi [s/m].
  CompliantStop(const std::string& name, PointOnPlane pair, double stiffness, double exponent,
                double damping, const FrictionLaw& friction)
      : Stop(name, std::move(pair), friction), k_(stiffness), n_(exponent), chi_(damping) {}

 protected:
  NormalForce normal(double depth, double rate) const override;

 private:
  double k_, n_, chi_;
};

/// A rigid contact: an impact changes velocities at once (impact_law.hpp). Alone and without
/// friction it reverses the normal velocity u to -e u, and loses (1 - e^2) u^2 / 2 times the mass
/// of the contact point.
///
/// Where impacts accumulate the point is held: N = k d + c d', critically damped with the mass that
/// the contact had, never below 0. It flies again when it has lifted by 1 um.
class RigidStop : public Stop, public RigidContact {
 public:
  /// @param restitution e, 0 to 1. @param rest_stiffness k of the contact that holds it [N/m].
  /// @param friction of impulses: its kinetic coefficient; while held as of a compliant stop.
  RigidStop(const std::string& name, PointOnPlane pair, double restitution, double rest_stiffness,
            const FrictionLaw& friction);

  int events() const override { return 2; }
  double event_function(int index, double time, const Eigen::VectorXd& y,
                        const Eigen::VectorXd& v) const override;
  bool is_one_sided(int) const override { return true; }
  void at_event(int index, double time) override;
  std::optional<Touch> touch(double time, const Eigen::VectorXd& y,
                             const Eigen::VectorXd& v) const override;
  void take_impulse(double impulse, double mass) override;
  bool at_accumulation(int index) override;
  /// Also `<name>_impulse`: of all impacts so far [N s].
  void record(History& history) const override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

  void accept_step(double time) override {
    Stop::accept_step(time);
    if (held_) deepest_ = std::max(deepest_, -gap());
  }
  void archive(Archive& archive) override {
    Stop::archive(archive);
    archive(deepest_);
  }

  bool is_held() const { return held_; }
  double rest_stiffness() const { return stiffness_; }  // [N/m]
  double deepest() const { return deepest_; }           // below the plane while held [m]
  /// It was held so softly that the contact was not rigid (hard case S5).
  bool has_sunk() const;

 protected:
  NormalForce normal(double depth, double rate) const override;

 private:
  static constexpr int kLift = kTouch + 1;
  double restitution_, stiffness_;
  bool held_ = false;
  double mass_ = 0.0;     // of the contact point along the normal, at the last impact [kg]
  double impulse_ = 0.0;  // [N s]
  double deepest_ = 0.0;  // [m]
  std::string impulse_name_;
};

}  // namespace clatter::dynamics
