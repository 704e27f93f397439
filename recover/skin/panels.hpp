// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Panels: named groups of skin faces, chosen by surface, direction, box and exposure.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/rom/reduced_model.hpp"
#include "recover/skin/skin.hpp"

namespace clatter::recover {

/// Conditions for a face to belong to a panel; all that are set must hold.
struct PanelRule {
  std::string name{};
  std::vector<std::string> surfaces{};         // on one of these surfaces of the mesh; empty: all
  std::optional<Eigen::Vector3d> direction{};  // outward normal within `angle_deg` of it
  double angle_deg = 45.0;
  std::optional<Eigen::Vector3d> box_min{}, box_max{};  // face centre inside [m]
  bool exposed = false;  // a side of the face is exposed, whose direction is meant (Exposure)
  bool may_be_empty = false;
};

struct Panel {
  std::string name{};
  std::vector<int32_t> faces{};  // ascending
  double area = 0.0;             // [m2]
};

/// "skin" (all faces), "exposed" (without bores, jackets and crankcase walls that face other
/// walls), and the exposed faces by side: thrust_side (+y), anti_thrust_side (-y), top (+z), bottom
/// (-z), end_plus_x, end_minus_x. Sides without a face are omitted. Of an assembly also the exposed
/// faces of the surface pan_skin of each reduced part.
std::vector<PanelRule> default_panels(const rom::Skin& skin);

/// Applies the rules in order. Panels may overlap.
/// @throws InputError for a rule that selects nothing, an unknown surface or a duplicate name; the
/// first two list what there is
std::vector<Panel> choose_panels(const std::vector<PanelRule>& rules, const rom::Skin& skin,
                                 const SkinGeometry& geometry);

}  // namespace clatter::recover
