// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A hydraulic element whose plunger moves as given.
#include <functional>
#include <memory>
#include <utility>

#include "dynamics/given/motion.hpp"
#include "dynamics/hydraulic/hydraulic_element.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics::testing {

inline constexpr double kBar = 1e5;  // [Pa]

using GivenMotion = std::function<Motion<double>(double)>;

/// A point that moves along an axis as given.
class GivenPort : public Port {
 public:
  GivenPort(const Eigen::Vector3d& axis, GivenMotion motion)
      : Port({}), axis_(axis), motion_(std::move(motion)) {}
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  bool is_driven() const override { return true; }

 private:
  Eigen::Vector3d axis_;
  GivenMotion motion_;
};

/// The tensioner of the reference: its leak goes to the supply.
ChamberSpec reference_tensioner();

/// Housing at rest, plunger that moves as given along x; travel 0 at position 0.
struct HydraulicRig {
  System system;
  HydraulicElement* element = nullptr;
  std::unique_ptr<Integrator> method;

  /// @param pressure of the chamber at time 0 and @param supply [Pa].
  HydraulicRig(const ChamberSpec& spec, double pressure, double supply, const GivenMotion& motion);
  /// Starts at time 0.
  void start(const StepOptions& options);
  void run_to(double time);
  double pressure() const { return element->accepted().chamber.pressure.value; }
};

/// A plunger of 20 g on a spring to the ground, shaken at 85 Hz, with a tensioner behind it.
struct ShakenPlunger {
  System system;
  HydraulicElement* element = nullptr;
  explicit ShakenPlunger(CheckValveSpec::Ball ball);
};

/// Steps of equal length.
StepOptions equal_steps(double dt, const Tableau* method = &tr_bdf2());
/// Speed from time 0 on, before at rest.
GivenMotion steady(double speed);
/// amplitude sin(2 pi frequency t).
GivenMotion sine(double amplitude, double frequency);

/// Adds the mass that came in, by the method's sums over its stages, and compares it with the
/// change of the content.
class OilBalance : public StageObserver {
 public:
  OilBalance(const HydraulicElement& element, const Tableau& method)
      : element_(element), method_(method) {}
  void stage(int index, const StageState&) override;
  void accept(double dt) override;
  /// |came in - change| over the mass exchanged.
  double residue() const;
  double exchanged() const { return exchanged_; }  // [kg]

 private:
  const HydraulicElement& element_;
  const Tableau& method_;
  double inflow_[4] = {}, first_ = -1.0, came_in_ = 0.0, exchanged_ = 0.0;
};

}  // namespace clatter::dynamics::testing
