// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The speed of a crankshaft over one cycle, as measured.
#include <filesystem>
#include <string>

#include "dynamics/given/crank_clock.hpp"

namespace clatter::dynamics {

/// A clock whose speed is that of a table, the same in each cycle. Over the crank angle the table
/// is one cycle (load_table.hpp), over time it begins at crank angle 0 and covers 720 deg, to 0.1
/// %; it is a monotone cubic. The angle over time is the periodic cubic spline through 1440 points
/// of its integral, whose derivatives are speed and acceleration, so that 720 deg take the same
/// time in each cycle, exactly. InputError "file:line: ..." for speeds that are not positive, a
/// time that does not cover 720 deg, or a speed there that differs by more than 1 % from that at
/// the begin.
CrankClock read_speed_table(const std::filesystem::path& path, const std::string& column);

}  // namespace clatter::dynamics
