// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The pressure of a motored engine for the tests, as `clatter motored-cycle` writes it.
#include <filesystem>

namespace clatter::dynamics::testing {

/// A motored cycle: polytropic between intake valve closing and exhaust valve opening with the same
/// exponent both ways, constant outside.
struct MotoredCycle {
  double bore = 0.107;        // [m]
  double stroke = 0.130;      // [m]
  double rod_length = 0.210;  // [m]
  double pin_offset = 0.0;    // [m]
  double compression_ratio = 17.0;
  double exponent = 1.34;                              // n
  double intake_pressure = 1e5;                        // absolute [Pa]
  double valves_closed_half = 3.14159265358979323846;  // closed for |theta| below this [rad]
};

/// Absolute pressure p = p_IVC (V_IVC / V)^n at crank angle theta [rad], 0 = firing TDC, [Pa].
double motored_pressure(const MotoredCycle& cycle, double theta);

/// Writes "crank_angle [deg], pressure [bar]" over -360..360 deg every `step` rad.
void write_motored_cycle(const std::filesystem::path& path, const MotoredCycle& cycle, double step);

}  // namespace clatter::dynamics::testing
