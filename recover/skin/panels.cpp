// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/panels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "core/base/error.hpp"
#include "core/base/named.hpp"

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

/// For each face, whether it lies on one of the rule's surfaces.
std::vector<bool> on_surfaces(const PanelRule& rule, const SurfaceFaces& surfaces, size_t count) {
  if (rule.surfaces.empty()) return std::vector<bool>(count, true);
  const std::string owner = fmt::format("panel '{}'", rule.name);
  if (surfaces.empty())
    throw InputError(
        owner +
        ": surfaces: the reduced model has no surfaces by name, expected one condensed "
        "by this version: condense the part again");
  std::vector<bool> chosen(count, false);
  for (const std::string& name : rule.surfaces)
    for (int32_t face : find_named(surfaces, owner, "surface of the skin", name))
      chosen[face] = true;
  return chosen;
}

[[noreturn]] void refuse_empty(const PanelRule& rule, const RowMatrix& nodes,
                               const std::vector<bool>& exposed, const SurfaceFaces& surfaces) {
  const Eigen::RowVector3d low = nodes.colwise().minCoeff(), high = nodes.colwise().maxCoeff();
  const auto open = std::count(exposed.begin(), exposed.end(), true);
  std::vector<std::string> names;
  for (const auto& [name, faces] : surfaces) names.push_back(name);
  throw InputError(fmt::format(
      "panel '{}': found no face, expected at least one: the skin has {} faces{}, lies between "
      "({:.4g}, {:.4g}, {:.4g}) and ({:.4g}, {:.4g}, {:.4g}) m, and has the surfaces [{}]",
      rule.name, exposed.size(), rule.exposed ? fmt::format(", {} of them exposed", open) : "",
      low[0], low[1], low[2], high[0], high[1], high[2], fmt::join(names, ", ")));
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
                                 const IndexMatrix& triangles, const SkinGeometry& geometry,
                                 const SurfaceFaces& surfaces) {
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
    const std::vector<bool> chosen = on_surfaces(rule, surfaces, exposed.size());
    for (int32_t face = 0; face < triangles.rows(); ++face)
      if (chosen[face] && accepts(rule, geometry.face_normal.row(face),
                                  geometry.face_centre.row(face), exposed[face])) {
        panel.faces.push_back(face);
        panel.area += geometry.face_area[face];
      }
    if (panel.faces.empty() && rule.may_be_empty) continue;
    if (panel.faces.empty()) refuse_empty(rule, nodes, exposed, surfaces);
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace clatter::recover
