// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/motored_cycle.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics::testing {
namespace {

SliderCrank mechanism(const MotoredCycle& cycle) {
  return SliderCrank(0.5 * cycle.stroke, cycle.rod_length, cycle.pin_offset, CrankClock{1.0});
}

double pin_height(const MotoredCycle& cycle, double theta) {
  return mechanism(cycle).piston_pin(theta).position;
}

/// Highest and lowest position of the pin on the line y = e: rod and crank collinear.
double highest(const MotoredCycle& cycle) {
  const double reach = cycle.rod_length + 0.5 * cycle.stroke;
  return std::sqrt(reach * reach - cycle.pin_offset * cycle.pin_offset);
}

double lowest(const MotoredCycle& cycle) {
  const double reach = cycle.rod_length - 0.5 * cycle.stroke;
  return std::sqrt(reach * reach - cycle.pin_offset * cycle.pin_offset);
}

/// Volume above the piston at crank angle theta [rad], [m3].
double cylinder_volume(const MotoredCycle& cycle, double theta) {
  const double area = 0.25 * std::numbers::pi * cycle.bore * cycle.bore;
  const double top = highest(cycle);
  const double swept = area * (top - lowest(cycle));
  return swept / (cycle.compression_ratio - 1.0) + area * (top - pin_height(cycle, theta));
}

}  // namespace

double motored_pressure(const MotoredCycle& cycle, double theta) {
  const double turn = 4.0 * std::numbers::pi;
  const double wrapped = theta - turn * std::round(theta / turn);
  if (std::abs(wrapped) >= cycle.valves_closed_half) return cycle.intake_pressure;
  const double ratio =
      cylinder_volume(cycle, cycle.valves_closed_half) / cylinder_volume(cycle, wrapped);
  return cycle.intake_pressure * std::pow(ratio, cycle.exponent);
}

void write_motored_cycle(const std::filesystem::path& path, const MotoredCycle& cycle,
                         double step) {
  std::ofstream stream(path);
  stream << fmt::format(
      "# motored cycle: bore {:.6g} mm, stroke {:.6g} mm, rod {:.6g} mm, pin offset {:.6g} mm, "
      "ratio "
      "{:.6g}, n = {:.6g}, intake {:.6g} bar\n# p = p_IVC (V_IVC / V)^n, valves closed from {:.6g} "
      "to "
      "{:.6g} deg; 0 deg = firing TDC; absolute pressure\ncrank_angle [deg], pressure [bar]\n",
      cycle.bore * 1e3, cycle.stroke * 1e3, cycle.rod_length * 1e3, cycle.pin_offset * 1e3,
      cycle.compression_ratio, cycle.exponent, cycle.intake_pressure * 1e-5,
      -cycle.valves_closed_half / kDegree, cycle.valves_closed_half / kDegree);
  const int rows = static_cast<int>(std::lround(4.0 * std::numbers::pi / step));
  for (int i = 0; i <= rows; ++i) {
    const double theta = -2.0 * std::numbers::pi + 4.0 * std::numbers::pi * i / rows;
    stream << fmt::format("{:.10g}, {:.12g}\n", theta / kDegree,
                          motored_pressure(cycle, theta) * 1e-5);
  }
}

}  // namespace clatter::dynamics::testing
