// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/hydraulic/chamber.hpp"

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

namespace {

/// A mass flow into the chamber by a pressure difference outside - chamber, and its derivative by
/// the chamber's pressure. Its density is that of the side from which it comes.
struct MassFlow {
  double value, by_pressure;
};

MassFlow mass_flow(const ChamberFluid& fluid, const VolumeFlow& flow, double inside,
                   double outside) {
  if (flow.value > 0.0) {
    const double density = fluid.density(outside);
    return {density * flow.value, -density * flow.by_pressure};
  }
  const double density = fluid.density(inside);
  return {density * flow.value, density * (flow.value / fluid.modulus(inside) - flow.by_pressure)};
}

}  // namespace

double ChamberSpec::area() const { return 0.25 * std::numbers::pi * diameter * diameter; }

Chamber::Chamber(const ChamberSpec& spec, std::function<double(double)> supply)
    : spec_(spec),
      fluid_(spec.dry ? ChamberFluid::air(spec.oil) : ChamberFluid::oil(spec.oil)),
      valve_(spec.valve, spec.oil.density),
      supply_(std::move(supply)),
      area_(spec.area()),
      conductance_(leak_conductance(spec.leak, spec.diameter, spec.oil.viscosity)) {}

double Chamber::content(double travel, double pressure) const {
  return fluid_.density(pressure) * (spec_.volume + area_ * travel);
}

void Chamber::move(double time, double travel, double content, double lift,
                   ChamberState& state) const {
  const double swept = valve_.has_moving_ball() ? spec_.valve.seat_area() : 0.0;
  const double volume = spec_.volume + area_ * travel - swept * lift;
  if (!(volume > 0.0))
    throw StepRefused(
        "hydraulic chamber: no volume left",
        fmt::format("{:.4g} mm3 at a travel of {:.4g} mm", 1e9 * volume, 1e3 * travel));
  if (!(content > 0.0))
    throw StepRefused("hydraulic chamber: no content left", fmt::format("{:.4g} kg", content));
  const double p = fluid_.pressure(content / volume), modulus = fluid_.modulus(p);
  state.volume = volume;
  state.supply = supply_(time);
  state.pressure = {p, -modulus * area_ / volume, modulus / content, modulus * swept / volume};
  add_flows(state, content, lift);
}

void Chamber::add_flows(ChamberState& state, double content, double lift) const {
  const double p = state.pressure.value, supply = state.supply, outside = spec_.outside;
  const double far = spec_.leak.to_supply ? supply : outside;
  const VolumeFlow leak{conductance_ * (far - p), conductance_, 0.0};
  const VolumeFlow valve = valve_.flow(supply - p, lift);
  VolumeFlow relief = relief_flow(spec_.relief, p - outside);
  relief.value = -relief.value;
  const MassFlow by_leak = mass_flow(fluid_, leak, p, far);
  const MassFlow by_valve = mass_flow(fluid_, valve, p, supply);
  const MassFlow by_relief = mass_flow(fluid_, relief, p, outside);
  state.leak = by_leak.value;
  state.valve = by_valve.value;
  state.relief = by_relief.value;
  state.leak_flow = leak.value;
  state.valve_flow = valve.value;
  state.relief_flow = relief.value;
  state.lift = valve_.lift(supply - p, lift);
  const double by_pressure = by_leak.by_pressure + by_valve.by_pressure + by_relief.by_pressure;
  const double upstream = valve.value > 0.0 ? fluid_.density(supply) : content / state.volume;
  state.inflow = {state.leak + state.valve + state.relief, by_pressure * state.pressure.by_travel,
                  by_pressure * state.pressure.by_content,
                  by_pressure * state.pressure.by_lift + upstream * valve.by_lift};
}

double Chamber::stored(const ChamberState& state, double content) const {
  const double p = state.pressure.value;
  return content * (fluid_.enthalpy(p) - fluid_.enthalpy(spec_.outside)) -
         (p - spec_.outside) * state.volume;
}

double Chamber::lost(const ChamberState& state) const {
  const double inside = fluid_.enthalpy(state.pressure.value);
  const double supply = fluid_.enthalpy(state.supply), outside = fluid_.enthalpy(spec_.outside);
  return state.leak * ((spec_.leak.to_supply ? supply : outside) - inside) +
         state.valve * (supply - inside) + state.relief * (outside - inside);
}

double Chamber::input(const ChamberState& state) const {
  const double flow = state.valve + (spec_.leak.to_supply ? state.leak : 0.0);
  return flow * (fluid_.enthalpy(state.supply) - fluid_.enthalpy(spec_.outside));
}

}  // namespace clatter::dynamics
