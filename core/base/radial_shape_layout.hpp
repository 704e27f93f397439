// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Names in a shape file, clatter/shape/1: radial shapes of a bore or skirt (docs/formats.md).

namespace clatter {

inline constexpr const char* kShapeSchema = "clatter/shape/1";
inline constexpr const char* kShapeAxisPoint = "axis_point";  // 3 [m]
inline constexpr const char* kShapeAxis = "axis";
inline constexpr const char* kShapeZeroAngle = "zero_angle";
inline constexpr const char* kShapeHeight = "height";        // n_h [m]
inline constexpr const char* kShapeAngle = "angle";          // n_a [rad]
inline constexpr const char* kShapeCases = "cases";          // a group for each case
inline constexpr const char* kShapeDeviation = "deviation";  // of a case, n_h x n_a [m]

}  // namespace clatter
