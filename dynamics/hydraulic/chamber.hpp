// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The chamber of a hydraulic element: pressure and flows from its volume and its content.
#include <functional>

#include "dynamics/hydraulic/chamber_fluid.hpp"
#include "dynamics/hydraulic/check_valve.hpp"
#include "dynamics/hydraulic/flow_laws.hpp"

namespace clatter::dynamics {

/// What a chamber is made of.
struct ChamberSpec {
  double diameter = 10e-3;  // of the plunger [m]
  double volume = 2.5e-6;   // at travel 0 [m3]
  double outside = 1e5;     // pressure behind the plunger [Pa]
  OilSpec oil;
  bool dry = false;  // air in place of oil, in chamber and supply
  LeakGap leak;
  CheckValveSpec valve;
  ReliefSpec relief;

  double area() const;  // of the plunger [m2]
};

/// A value with its derivatives by travel of the plunger, content and lift of a moving ball.
struct ByMotion {
  double value = 0.0, by_travel = 0.0, by_content = 0.0, by_lift = 0.0;
};

/// The chamber at one instant.
struct ChamberState {
  double volume = 0.0, supply = 0.0;             // [m3], [Pa]
  ByMotion pressure;                             // absolute [Pa]
  ByMotion inflow;                               // of mass, the rate of the content [kg/s]
  double leak = 0.0, valve = 0.0, relief = 0.0;  // mass flows into the chamber [kg/s]
  double leak_flow = 0.0, valve_flow = 0.0, relief_flow = 0.0;  // volumes into the chamber [m3/s]
  double lift = 0.0;                                            // of the ball [m]
};

/// A volume V = V0 + A s - A_b x with the travel s of the plunger and the lift x of a moving ball,
/// which sweeps its seat's area A_b. Its content m, of oil and air, is the state:
///
///   rho(p) = m / V,   m' = sum rho(p_upstream) Q,   p > 0 by the fluid's law for every m, V > 0
///
/// For outflow this is p' = E/V (Q - V') of the literature, d ln rho = dp / E. As a state, m has
/// what p has not: the mass balance is that of the integrator's sums, to rounding; a sealed chamber
/// is a spring without drift; p stays positive without a bound that would lose volume.
class Chamber {
 public:
  /// @param supply absolute pressure over time [Pa], > 0.
  Chamber(const ChamberSpec& spec, std::function<double(double)> supply);

  /// At a content > 0 [kg]. StepRefused when volume or content are not positive.
  void move(double time, double travel, double content, double lift, ChamberState& state) const;
  /// Content at a pressure, with the ball on its seat [kg].
  double content(double travel, double pressure) const;

  /// Energy of the content over that at the outside pressure, m (h - h_out) - (p - p_out) V [J].
  double stored(const ChamberState& state, double content) const;
  /// Power lost in leak, check valve and relief valve, each (h_upstream - h_downstream) |flow| [W].
  double lost(const ChamberState& state) const;
  /// Power of the oil that comes from the supply [W].
  double input(const ChamberState& state) const;

  const ChamberSpec& spec() const { return spec_; }
  const CheckValve& valve() const { return valve_; }
  const ChamberFluid& fluid() const { return fluid_; }
  double conductance() const { return conductance_; }  // of the leak gap [m3/(s Pa)]
  double supply(double time) const { return supply_(time); }

 private:
  void add_flows(ChamberState& state, double content, double lift) const;
  ChamberSpec spec_;
  ChamberFluid fluid_;
  CheckValve valve_;
  std::function<double(double)> supply_;
  double area_, conductance_;
};

}  // namespace clatter::dynamics
