// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Reduced models defined without a mesh: simple bodies with known solutions.
#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "core/rom/reduced_model.hpp"

namespace clatter::dynamics::testing {

/// A rigid piston: one node "pin" with 6 coordinates, centre of mass at the pin; unit load "gas"
/// (per Pa, along -z, of `area`).
rom::ReducedModel rigid_piston(double mass, double inertia, double area);

/// A clamped bar of `elements` two-node rod elements (area 1 cm2, steel) by Craig-Bampton in closed
/// form: tip coordinate (set "tip", x) and `modes` fixed-interface modes.
rom::ReducedModel clamped_bar(double length, int elements, int modes);

/// An elastic piston: pin node and a skirt grid ("skirt", two sides of `strips` x `rows` patches)
/// around the axis at y = `axis`.
rom::ReducedModel elastic_piston(double radius, int strips, int rows, double axis = 0.0);
/// An elastic block: liner grid "liner_4", "liner_4_axial", "main_4", "main_5", "mounts", "sensor".
/// @param off of "liner_4_axial" from the bore's axis (x, y) [m].
rom::ReducedModel elastic_block(double radius, int strips, int rows,
                                const Eigen::Vector2d& off = Eigen::Vector2d::Zero());
/// The same with a second bore at x = 65 mm: "liner_3", "liner_3_axial", "main_3", and the unit
/// load "head_3_gas" on "head_3".
rom::ReducedModel two_bore_block(double radius, int strips, int rows);

/// Four bores 130 mm apart with "liner_1" .. "liner_4", each with "_axial" and the unit load
/// "head_1_gas" .. "head_4_gas"; bearings "main_1" .. "main_5", "mounts".
rom::ReducedModel four_bore_block(double radius, int strips, int rows);

/// Writes the model as a .rom.h5.
void write_rom(const std::filesystem::path& path, const rom::ReducedModel& model);

}  // namespace clatter::dynamics::testing
