// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Force of a hydraulic tensioner or lash adjuster.
#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/body/modal_body.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/hydraulic/chamber.hpp"
#include "dynamics/hydraulic/plunger_axis.hpp"

namespace clatter::dynamics {

/// A spring that pushes plunger and housing apart: force - rate s, never below 0.
struct PlungerSpring {
  double force = 0.0;  // at travel 0 [N]
  double rate = 0.0;   // [N/m]
};

/// Elastic ends of the plunger's travel.
struct PlungerStops {
  /// Lowest and highest travel [m].
  std::array<double, 2> ends{-std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity()};
  double stiffness = 1e8;  // [N/m]
};

/// How the pressure on the plunger is found.
enum class HydraulicModel : char {
  kHydraulic,         // by the content of the chamber
  kConstantPressure,  // that of the supply
  kConstantForce,     // pressure and spring as at the start
};

/// The coordinates that a hydraulic element owns: content of the chamber [kg], a state, and the
/// lift of a moving ball [m].
/// @param travel [m] and @param pressure [Pa] at the start, at `time` [s]. @param pressure_scale
/// pressure error that the tolerance refers to, at the oil's own modulus and so less for aerated
/// oil [Pa].
ModalBody make_chamber_body(const std::string& name, const Chamber& chamber, double time,
                            double travel, double pressure, double pressure_scale = 1e5);

/// F = A (p - p_outside) + spring, along a plunger axis.
class HydraulicElement : public ForceElement {
 public:
  /// @param own y indices of content and, with a moving ball, of its lift; empty for the models
  /// without a state. @param start travel and @param time of the start, for a constant force.
  HydraulicElement(std::string name, PlungerAxis axis, Chamber chamber, const PlungerSpring& spring,
                   HydraulicModel model, std::vector<int> own, double start, double time);

  /// Without them the travel is free.
  void set_stops(const PlungerStops& stops) { stops_ = stops; }

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_pressure` [Pa], `_travel` [m], `_force` [N]; of the hydraulic model also `_content`
  /// [kg], `_leak_flow`, `_valve_flow`, `_relief_flow` [m3/s, into the chamber] and `_lift` [m].
  void record(History& history) const override;
  struct Instant {
    ChamberState chamber;
    double travel = 0.0, force = 0.0, content = 0.0;
  };
  /// The last accepted state, and the last finished stage.
  const Instant& accepted() const { return accepted_; }
  const Instant& finished() const { return finished_; }
  const Chamber& chamber() const { return chamber_; }

 private:
  bool is_hydraulic() const { return model_ == HydraulicModel::kHydraulic; }
  double own_lift(const Eigen::VectorXd& y) const;
  /// How far the plunger is in a stop, in that of the lowest travel positive [m].
  double in_stop(double travel) const;
  /// Force on the plunger and its derivative by the travel at a constant pressure.
  std::pair<double, double> force(double travel, double pressure) const;
  void move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v, Instant& at) const;
  void add_own(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
               bool with_tangent, Response& response) const;

  std::string name_;
  mutable PlungerAxis axis_;  // it keeps its last motion, which power() looks at as well
  Chamber chamber_;
  PlungerSpring spring_;
  PlungerStops stops_;
  HydraulicModel model_;
  double constant_force_ = 0.0, time_ = 0.0;
  int plunger_size_;
  bool has_ball_;
  Instant last_, finished_, accepted_;
  mutable Instant at_;                   // of power(): working memory
  std::array<std::string, 8> recorded_;  // names of histories
  Eigen::RowVectorXd row_;               // dF/dy
};

}  // namespace clatter::dynamics
