// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Load tables: over the crank angle (periodic) or over time.
#include <filesystem>
#include <functional>
#include <string>

#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// Reads a table over the crank angle. It must cover one cycle of 4 pi rad: from its first angle to
/// one period later, with or without a closing row; a closing row must repeat the first value
/// (within 1 % of the table's range). A step of more than 20 times the median step is a gap.
/// Returns value over crank angle [rad], period 4 pi. `unit` is the required unit of the column,
/// such as "Pa". InputError "file:line: ..." otherwise.
Spline read_cycle_table(const std::filesystem::path& path, const std::string& column,
                        const std::string& unit, Spline::Kind kind);

/// Reads a table of absolute pressure [Pa] over the crank angle, as read_cycle_table(). InputError
/// also for a value below 0 or above 1 GPa.
Spline read_gas_table(const std::filesystem::path& path, const std::string& column,
                      Spline::Kind kind);

/// When a crank is next at a point of a table over its angle, after a time [s].
/// @param angle of the crank [rad] at a time [s], ascending. @param time of an angle, its inverse.
std::function<double(double)> rows_in_time(Spline table, std::function<double(double)> angle,
                                           std::function<double(double)> time);

/// Reads a table over time [s] that must cover [begin, end].
Spline read_time_table(const std::filesystem::path& path, const std::string& column,
                       const std::string& unit, Spline::Kind kind, double begin, double end);

}  // namespace clatter::dynamics
