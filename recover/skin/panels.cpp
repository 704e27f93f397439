// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/panels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

bool accepts(const PanelRule& rule, const Eigen::Vector3d& normal, const Eigen::Vector3d& centre,
             bool is_exposed) {
  if (rule.exposed && !is_exposed) return false;
  // A face exactly on the limit (45 degrees between two sides) belongs to the panel.
  constexpr double kSlack = 1e-9;
  if (rule.direction && normal.dot(rule.direction->normalized()) <
                            std::cos(rule.angle_deg * std::numbers::pi / 180.0) - kSlack)
    return false;
  if (rule.box_min && (centre.array() < rule.box_min->array()).any()) return false;
  if (rule.box_max && (centre.array() > rule.box_max->array()).any()) return false;
  return true;
}

}  // namespace

std::vector<PanelRule> default_panels() {
  std::vector<PanelRule> rules{{.name = "skin"}, {.name = "exposed", .exposed = true}};
  const auto side = [&](const char* name, double x, double y, double z) {
    rules.push_back({.name = name,
                     .direction = Eigen::Vector3d(x, y, z),
                     .exposed = true,
                     .may_be_empty = true});
  };
  side("thrust_side", 0, 1, 0);
  side("anti_thrust_side", 0, -1, 0);
  side("top", 0, 0, 1);
  side("bottom", 0, 0, -1);
  side("end_plus_x", 1, 0, 0);
  side("end_minus_x", -1, 0, 0);
  return rules;
}

std::vector<Panel> choose_panels(const std::vector<PanelRule>& rules, const RowMatrix& nodes,
                                 const IndexMatrix& triangles, const SkinGeometry& geometry) {
  const bool needs_exposure =
      std::any_of(rules.begin(), rules.end(), [](const PanelRule& rule) { return rule.exposed; });
  std::vector<bool> exposed(static_cast<size_t>(triangles.rows()), true);
  if (needs_exposure) exposed = exposed_faces(nodes, triangles, geometry);

  std::vector<Panel> panels;
  std::set<std::string> names;
  for (const PanelRule& rule : rules) {
    if (!names.insert(rule.name).second)
      throw InputError(fmt::format("panel '{}': found twice, expected different names", rule.name));
    Panel panel{.name = rule.name};
    for (int32_t face = 0; face < triangles.rows(); ++face)
      if (accepts(rule, geometry.face_normal.row(face), geometry.face_centre.row(face),
                  exposed[static_cast<size_t>(face)])) {
        panel.faces.push_back(face);
        panel.area += geometry.face_area[face];
      }
    if (panel.faces.empty() && rule.may_be_empty) continue;
    if (panel.faces.empty())
      throw InputError(fmt::format("panel '{}': found no face, expected at least one", rule.name));
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace clatter::recover
