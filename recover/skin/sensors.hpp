// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sensors: channels of displacement, each a linear combination of the reduced coordinates.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "core/rom/skin_rows.hpp"
#include "recover/skin/skin.hpp"

namespace clatter::recover {

/// A boundary set of the reduced model, or the skin node nearest to a point.
struct SensorRule {
  std::string name{};
  std::string set{};                           // boundary set; empty: `position` is used
  std::optional<Eigen::Vector3d> position{};   // [m]
  std::optional<Eigen::Vector3d> direction{};  // for a point; without it x, y, z and the normal
};

struct Sensor {
  std::string name{};
  std::string kind{};                  // of the set, or "skin"
  std::vector<std::string> labels{};   // one per channel
  Eigen::MatrixXd position{};          // channels x 3 [m]
  Eigen::MatrixXd direction{};         // channels x 3, unit vectors
  std::vector<int32_t> is_rotation{};  // 1: the channel is an angle [rad]
  Eigen::MatrixXd rows{};              // channels x r: displacement = rows q
};

/// Finds the sensors; with no rule every set of kind "sensor".
/// @param T rows of the model's skin
/// @throws InputError for an unknown set, a duplicate name, or a position farther from the skin
/// than the part is large; says the distance of positions from their nodes
std::vector<Sensor> find_sensors(const std::vector<SensorRule>& rules,
                                 const rom::ReducedModel& model, const rom::SkinRows& T,
                                 const SkinGeometry& geometry);

}  // namespace clatter::recover
