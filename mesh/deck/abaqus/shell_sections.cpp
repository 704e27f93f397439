// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/shell_sections.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

/// Where a shell is, and its unit normal.
struct Place {
  Eigen::Vector3d centre, normal;
};

Place place_of(const Model& model, const ShellFace& face) {
  const auto at = [&](size_t i) {
    return Eigen::Vector3d(model.deck.mesh.nodes.row(face.nodes[i]));
  };
  const auto corners = static_cast<size_t>(traits(face.type).corners);
  Place place{at(0), {}};
  for (size_t i = 1; i < corners; ++i) place.centre += at(i);
  place.centre /= static_cast<double>(corners);
  place.normal = (at(2) - at(0)).cross(at(corners - 1) - at(1)).normalized();
  if (corners == 3) place.normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
  return place;
}

/// Direction 1 of the material in the plane of a shell: of an orientation the direction that
/// follows the one about which its second line turns, projected; without one x, or z where the
/// normal is within 0.1 degrees of x (Abaqus Analysis User's Guide, Orientations; Conventions).
/// CalculiX takes axis 1 where the second line is absent, Abaqus axis 2: that is refused unless
/// axis 1 is the normal.
/// @param system name of one in Deck::systems, or empty.
Eigen::Vector3d shell_direction(const Model& model, const std::string& system, const Place& place,
                                Origin origin) {
  constexpr double kAlong = 0.1;  // sine of the angle between direction and normal
  const Eigen::Vector3d& normal = place.normal;
  const auto projected = [&](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(v - v.dot(normal) * normal);
  };
  if (system.empty()) {
    const bool along_x = std::abs(normal.x()) > std::cos(0.1 * std::numbers::pi / 180.0);
    return projected(along_x ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX()).normalized();
  }
  const auto fail = [&](const char* message) {
    model.source.fail(
        origin, fmt::format("orientation {}: {}, at a shell at ({:g}, {:g}, {:g})", system, message,
                            place.centre.x(), place.centre.y(), place.centre.z()));
  };
  const Eigen::Matrix3d axes = axes_at(model.deck.systems.at(system), place.centre);
  const int turned = model.turned_axis.at(system);
  int nearest = 0;
  (axes.transpose() * normal).cwiseAbs().maxCoeff(&nearest);
  if (turned == 0 && nearest != 0)
    fail(
        "found no second line, without which Abaqus takes axis 2 for direction 1 and CalculiX "
        "axis 1, expected \"3, 0.\" for axis 1");
  const Eigen::Vector3d along = projected(axes.col(std::max(turned, 1) % 3));
  if (along.norm() < kAlong)
    fail(
        "its direction that is projected is along the normal, expected another axis in its "
        "second line");
  return along.normalized();
}

double positive(const Fields& fields, size_t i, const char* what) {
  const double value = fields.number(i, what);
  if (!(value > 0.0))
    fields.fail(fmt::format("found a {} of {:g}, expected more than 0", what, value));
  return value;
}

}  // namespace

ShellFace face_of_shell(const Model& model, size_t thin) {
  const ThinElement& element = model.numbering.thin()[thin];
  ShellFace face{.type = *element.face};
  for (size_t i = 0; i < static_cast<size_t>(element.count); ++i)
    face.nodes[i] = model.node_map.mesh_node(element.nodes[i]);
  return face;
}

void ShellSections::read() {
  for_each_card(model_, {"NODALTHICKNESS"},
                [&](size_t use, const Card& card) { read_thickness(use, card); });
  size_t section = 0;
  std::vector<int32_t>& regions = model_.shells.regions;
  for_each_card(model_, {"SHELLSECTION"}, [&](size_t use, const Card& card) {
    const size_t at = section++;
    regions.resize(section, -1);
    gifts_.resize(section);
    if (std::ranges::find(model_.shells.section_of, static_cast<int32_t>(at)) ==
        model_.shells.section_of.end())
      return;  // only skins of solids
    gifts_[at] = gift_of(use, card);
    regions[at] = add_region(use, card, static_cast<int32_t>(at));
  });
  for (const IdSet* set : model_.shells.sets) {
    gifts_.emplace_back();
    regions.push_back(
        new_region(model_.numbering.main_use(), set->name, set->chunks.front().origin, ""));
  }
}

ShellCell ShellSections::cell_of(size_t thin) const {
  const ThinElement& element = model_.numbering.thin()[thin];
  const auto section = static_cast<size_t>(model_.shells.section_of[thin]);
  if (model_.shells.regions[section] < 0) throw FollowUp();
  const ShellGift& gift = gifts_[section];
  ShellCell cell{element.type, element.id, model_.shells.regions[section],
                 face_of_shell(model_, thin), -gift.offset * gift.thickness};
  std::array<double, 4>& t = cell.face.values;
  t.fill(gift.thickness);
  const auto corners = static_cast<size_t>(traits(*element.face).corners);
  for (size_t i = 0; gift.is_nodal && i < corners; ++i) t[i] = nodal(element, i);
  if (gift.has_directions) {
    const Place place = place_of(model_, cell.face);
    cell.axis = shell_direction(model_, gift.system, place, gift.origin);
  }
  if (!gift.is_nodal || gift.offset == 0.0) return cell;
  if (std::any_of(t.begin(), t.begin() + corners, [&](double one) { return one != t[0]; }))
    model_.source.fail(element.origin,
                       fmt::format("element {}: found OFFSET and a *NODAL THICKNESS that varies "
                                   "over it, expected one of them",
                                   element.id));
  cell.offset = -gift.offset * t[0];
  return cell;
}

void ShellSections::read_thickness(size_t use, const Card& card) {
  card.keyword().allow({}, model_.source, model_.ignore);
  if (nodal_.empty())
    nodal_.assign(static_cast<size_t>(model_.numbering.nodes()),
                  std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model_.source);
    fields.at_most(2, "nodes, thickness");
    const double t = positive(fields, 1, "thickness");
    for (const int32_t row : model_.sets.nodes_at(fields, 0, use))
      nodal_[static_cast<size_t>(row)] = t;
  }
}

double ShellSections::nodal(const ThinElement& element, size_t i) const {
  const auto row = static_cast<size_t>(element.nodes[i]);
  if (nodal_.empty() || std::isnan(nodal_[row]))
    model_.source.fail(element.origin,
                       fmt::format("element {}: found no *NODAL THICKNESS of node {}", element.id,
                                   model_.numbering.node_ids()[row]));
  return nodal_[row];
}

ShellGift ShellSections::gift_of(size_t use, const Card& card) const {
  const Keyword& keyword = card.keyword();
  keyword.allow({"ELSET", "MATERIAL", "OFFSET", "NODALTHICKNESS", "DENSITY", "POISSON",
                 "SECTIONINTEGRATION", "CONTROLS", "THICKNESSMODULUS", "TEMPERATURE", "ORIENTATION",
                 "COMPOSITE", "LAYUP", "SYMMETRIC"},
                model_.source, model_.ignore);
  ShellGift gift;
  gift.origin = card.origin();
  gift.offset = offset_of(card);
  gift.is_nodal = keyword.has("NODALTHICKNESS");
  if (const std::string* system = keyword.find("ORIENTATION"))
    gift.system = system_named(model_, use, *system, card.origin());
  if (keyword.has("COMPOSITE")) {
    gift.plies = plies_of(use, card);
    for (const Ply& ply : gift.plies) {
      gift.thickness += ply.thickness;
      gift.has_directions = gift.has_directions || !is_isotropic(ply.material);
    }
    return gift;
  }
  gift.material = material_of(keyword.required("MATERIAL", model_.source), card.origin());
  gift.has_directions = !is_isotropic(gift.material);
  if (gift.is_nodal) return gift;
  if (card.size() == 0)
    model_.source.fail(card.origin(), "*SHELL SECTION: found no data line, expected a thickness");
  const Fields fields = card.line(0, model_.source);
  fields.at_most(2, "thickness, integration points");
  gift.thickness = positive(fields, 0, "thickness");
  return gift;
}

// Thickness, integration points, material, angle or orientation, name.
std::vector<Ply> ShellSections::plies_of(size_t use, const Card& card) const {
  std::vector<Ply> plies;
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model_.source);
    fields.at_most(5, "thickness, integration points, material, angle or orientation, name");
    Ply& ply = plies.emplace_back();
    ply.thickness = positive(fields, 0, "thickness");
    ply.material = material_of(std::string(fields.text(2)), fields.origin());
    const std::string turned(fields.text(3));
    if (const auto degrees = to_number(turned))
      ply.angle = *degrees * std::numbers::pi / 180.0;
    else if (!turned.empty())
      ply.system = system_named(model_, use, turned, fields.origin());
  }
  if (plies.empty())
    model_.source.fail(card.origin(), "*SHELL SECTION: found no data line, expected one a layer");
  if (!card.keyword().has("SYMMETRIC")) return plies;
  const std::vector<Ply> half = plies;
  plies.insert(plies.end(), half.rbegin(), half.rend());
  return plies;
}

bool ShellSections::is_isotropic(const std::string& material) const {
  return model_.deck.materials.at(material).kind == Material::Kind::kIsotropic;
}

// An orientation of its own has to be at the same angle from the section's on all shells.
double ShellSections::angle_of(const Ply& ply, const ShellGift& gift, int32_t section) const {
  constexpr double kSame = 1e-6;
  if (ply.system.empty() || is_isotropic(ply.material)) return ply.angle;
  std::optional<double> angle;
  for (size_t thin = 0; thin < model_.shells.section_of.size(); ++thin) {
    if (model_.shells.section_of[thin] != section) continue;
    const Place place = place_of(model_, face_of_shell(model_, thin));
    const auto direction = [&](const std::string& system) {
      return shell_direction(model_, system, place, gift.origin);
    };
    const Eigen::Vector3d from = direction(gift.system), to = direction(ply.system);
    const double here = std::atan2(from.cross(to).dot(place.normal), from.dot(to));
    if (angle && std::abs(std::remainder(here - *angle, 2.0 * std::numbers::pi)) > kSame)
      model_.source.fail(gift.origin,
                         fmt::format("*SHELL SECTION: orientation {} of a layer is at several "
                                     "angles from that of the section, expected an angle in its "
                                     "place, or a section for each part of the sheet",
                                     ply.system));
    angle = angle.value_or(here);
  }
  return angle.value_or(0.0);
}

// From the mid-surface to the nodes, along the normal, over the thickness: 0.5 where the nodes
// are on the top surface (Abaqus Analysis User's Guide, defining the reference surface).
double ShellSections::offset_of(const Card& card) const {
  const std::string text = card.keyword().choice("OFFSET", "0");
  if (text == "SPOS") return 0.5;
  if (text == "SNEG") return -0.5;
  if (const auto number = to_number(text)) return *number;
  model_.source.fail(card.origin(),
                     fmt::format("*SHELL SECTION: found OFFSET={}, expected a number, SPOS or "
                                 "SNEG",
                                 text));
}

int32_t ShellSections::add_region(size_t use, const Card& card, int32_t section) {
  const ShellGift& gift = gifts_[static_cast<size_t>(section)];
  const Keyword& keyword = card.keyword();
  const std::string& elset = keyword.required("ELSET", model_.source);
  const IdSets& sets = model_.numbering.uses()[use].scope->element_sets;
  const auto set = sets.find(folded(elset));
  const int32_t index =
      new_region(use, set == sets.end() ? elset : set->second.name, card.origin(), gift.material);
  const Region& region = model_.deck.regions.back();
  const std::string& name = model_.deck.mesh.regions.back();
  recipe::Shell shell{recipe::Source(region.where), {name}, {}};
  if (gift.plies.empty()) shell.section.thickness = gift.thickness;
  for (const Ply& ply : gift.plies)
    shell.layers.push_back(
        {shell.source, ply.material, ply.thickness, angle_of(ply, gift, section)});
  if (const std::string* density = keyword.find("DENSITY")) {
    shell.section.area_mass = to_number(*density).value_or(-1.0);
    if (!(shell.section.area_mass >= 0.0))
      model_.source.fail(card.origin(), fmt::format("*SHELL SECTION: found DENSITY={}, expected "
                                                    "a mass per area",
                                                    *density));
  }
  model_.deck.shells.push_back(std::move(shell));
  return index;
}

int32_t ShellSections::new_region(size_t use, const std::string& set, Origin origin,
                                  const std::string& material) {
  const std::string name = model_.numbering.public_name(use, set);
  std::vector<std::string>& names = model_.deck.mesh.regions;
  if (std::ranges::find(names, name) != names.end())
    model_.source.fail(origin, fmt::format("found a second region {}", name));
  Region region;
  region.where = model_.source.where(origin);
  region.material = material;
  names.push_back(name);
  model_.deck.regions.push_back(std::move(region));
  return static_cast<int32_t>(names.size()) - 1;
}

std::string ShellSections::material_of(const std::string& wanted, Origin origin) const {
  const auto known = model_.material_names.find(folded(wanted));
  if (known == model_.material_names.end()) {
    if (model_.refusals.has_lost(folded(wanted))) throw FollowUp();
    model_.source.fail(origin, fmt::format("found no material {}", shown(wanted)));
  }
  const Material& material = model_.deck.materials.at(known->second);
  if (material.constants.empty())
    model_.source.fail(origin, fmt::format("*SHELL SECTION: material {} has no *ELASTIC", wanted));
  return known->second;
}

}  // namespace clatter::mesh::deck::abaqus
