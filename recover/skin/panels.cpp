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
#include "recover/skin/exposure.hpp"

namespace clatter::recover {
namespace {

/// Whether a side of a face with this outward normal has the rule's direction.
bool has_direction(const PanelRule& rule, const Eigen::Vector3d& normal) {
  // A face exactly on the limit (45 degrees between two sides) belongs to the panel.
  constexpr double kSlack = 1e-9;
  return !rule.direction || normal.dot(rule.direction->normalized()) >=
                                std::cos(rule.angle_deg * std::numbers::pi / 180.0) - kSlack;
}

bool accepts(const PanelRule& rule, const Eigen::Vector3d& normal, const Eigen::Vector3d& centre,
             bool front, bool back) {
  if (!(front && has_direction(rule, normal)) && !(back && has_direction(rule, -normal)))
    return false;
  if (rule.box_min && (centre.array() < rule.box_min->array()).any()) return false;
  if (rule.box_max && (centre.array() > rule.box_max->array()).any()) return false;
  return true;
}

/// For each face, whether it lies on one of the rule's surfaces.
std::vector<bool> on_surfaces(const PanelRule& rule, const rom::Skin& skin) {
  const auto count = static_cast<size_t>(skin.triangles.rows());
  if (rule.surfaces.empty()) return std::vector<bool>(count, true);
  const std::string owner = fmt::format("panel '{}'", rule.name);
  if (skin.faces.empty())
    throw InputError(
        owner +
        ": surfaces: the reduced model has no surfaces by name, expected one condensed "
        "by this version: condense the part again");
  std::vector<bool> chosen(count, false);
  for (const std::string& name : rule.surfaces)
    for (int32_t face : find_named(skin.faces, owner, "surface of the skin", name))
      chosen[face] = true;
  return chosen;
}

[[noreturn]] void refuse_empty(const PanelRule& rule, const rom::Skin& skin,
                               const Exposure& exposure) {
  const Eigen::RowVector3d low = skin.nodes.colwise().minCoeff(),
                           high = skin.nodes.colwise().maxCoeff();
  size_t open = 0;
  for (size_t face = 0; face < exposure.front.size(); ++face) open += exposure.of_face(face);
  std::vector<std::string> names;
  for (const auto& [name, faces] : skin.faces) names.push_back(name);
  throw InputError(fmt::format(
      "panel '{}': found no face, expected at least one: the skin has {} faces{}, lies between "
      "({:.4g}, {:.4g}, {:.4g}) and ({:.4g}, {:.4g}, {:.4g}) m, and has the surfaces [{}]",
      rule.name, exposure.front.size(),
      rule.exposed ? fmt::format(", {} of them exposed", open) : "", low[0], low[1], low[2],
      high[0], high[1], high[2], fmt::join(names, ", ")));
}

}  // namespace

std::vector<PanelRule> default_panels(const rom::Skin& skin) {
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
  for (const auto& [name, faces] : skin.faces)
    if (name.ends_with("_skin"))
      rules.push_back({.name = name, .surfaces = {name}, .exposed = true, .may_be_empty = true});
  return rules;
}

std::vector<Panel> choose_panels(const std::vector<PanelRule>& rules, const rom::Skin& skin,
                                 const SkinGeometry& geometry) {
  const bool needs_exposure =
      std::any_of(rules.begin(), rules.end(), [](const PanelRule& rule) { return rule.exposed; });
  const auto count = static_cast<int32_t>(skin.triangles.rows());
  const Exposure exposure =
      needs_exposure ? exposure_of(skin, geometry) : Exposure{std::vector<bool>(count, true), {}};

  std::vector<Panel> panels;
  std::set<std::string> names;
  for (const PanelRule& rule : rules) {
    if (!names.insert(rule.name).second)
      throw InputError(fmt::format("panel '{}': found twice, expected different names", rule.name));
    Panel panel{.name = rule.name};
    const std::vector<bool> chosen = on_surfaces(rule, skin);
    for (int32_t face = 0; face < count; ++face) {
      const bool front = !rule.exposed || exposure.front[face];
      const bool back = rule.exposed && exposure.of_back(face);
      if (!chosen[face] || !accepts(rule, geometry.face_normal.row(face),
                                    geometry.face_centre.row(face), front, back))
        continue;
      panel.faces.push_back(face);
      panel.area += geometry.face_area[face];
    }
    if (panel.faces.empty() && rule.may_be_empty) continue;
    if (panel.faces.empty()) refuse_empty(rule, skin, exposure);
    panels.push_back(std::move(panel));
  }
  return panels;
}

}  // namespace clatter::recover
