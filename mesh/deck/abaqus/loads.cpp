// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/deck/abaqus/cells.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// The first value of a step replaces that of earlier ones, the next ones are added.
template <class Map, class Key, class Value>
void put(Map& map, const Key& key, const Value& value) {
  const auto [at, is_new] = map.emplace(key, value);
  if (is_new) return;
  if (at->second.step == value.step) {
    at->second.value += value.value;
  } else {
    at->second = value;
  }
}

template <class Map>
void forget_others(Map& map, StepNumber step) {
  std::erase_if(map, [&](const auto& entry) { return entry.second.step != step; });
}

bool is_new(const Card& card) { return card.keyword().choice("OP", "MOD") == "NEW"; }

}  // namespace

double Loads::begin(const Card& card) {
  card.keyword().allow({"OP", "AMPLITUDE", "FOLLOWER", "CONSTANTRESULTANT", "REGIONTYPE"},
                       model_->source, model_->ignore);
  return model_->ignore.lists("AMPLITUDE") ? 1.0 : amplitude_factor(*model_, card);
}

void Loads::read_forces(size_t use, const Card& card, StepNumber step) {
  const double factor = begin(card);
  if (is_new(card)) forget_others(forces_, step);
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model_->source);
    fields.at_most(3, "nodes, DoF, force");
    const int32_t dof = fields.integer(1, "DoF", 1, 6);
    const double value = factor * fields.number(2, "force");
    for (const int32_t row : model_->sets.nodes_at(fields, 0, use)) {
      const auto [node_index, dofs] = held_dofs(*model_, row, static_cast<DofMask>(1 << (dof - 1)));
      const int32_t id = model_->numbering.node_ids()[row];
      if (node_index == NodeMap::kNone) {
        fields.fail(fmt::format("found a force on node {}, which belongs to no element", id));
      }
      if (dofs == 0) {
        fields.fail(fmt::format("found a moment on node {}, which has no rotations", id));
      }
      const int direction = __builtin_ctz(dofs);
      put(forces_, std::pair(node_index, direction),
          Value{value, step, &model_->node_map.displacement_system(row)});
    }
  }
}

void Loads::read_element_loads(size_t use, const Card& card, StepNumber step) {
  const double factor = begin(card);
  if (is_new(card)) {
    forget_others(faces_, step);
    forget_others(gravity_, step);
    std::erase_if(rotations_, [&](const Rotation& other) { return other.step != step; });
  }
  for (size_t i = 0; i < card.size(); ++i) {
    model_->refusals.attempt(
        [&] { read_element_load(use, card.line(i, model_->source), factor, step); });
  }
}

void Loads::read_element_load(size_t use, const Fields& fields, double factor, StepNumber step) {
  const std::string label = folded(fields.text(1));
  if (label == "GRAV") return add_gravity(use, fields, factor, step);
  if (label == "CENTRIF") return add_rotation(use, fields, factor, step);
  for (const auto& [name, direction] : {std::pair("BX", 0), {"BY", 1}, {"BZ", 2}})
    if (label == name) return add_force_per_volume(use, fields, direction, factor, step);
  if (label == "P") return add_shell_pressure(use, fields, factor, step);
  const auto number = label.starts_with('P') ? to_integer(label.substr(1)) : std::nullopt;
  if (!number || *number < 1 || *number > 6) {
    fields.fail(
        fmt::format("load {} is not supported, expected P1 to P6, P, GRAV, CENTRIF, BX, BY or "
                    "BZ; ignore = [\"*DLOAD\"] leaves out all loads of elements: [[load]] "
                    "of the recipe replaces them",
                    fields.text(1)));
  }
  fields.at_most(3, "elements, face, pressure");
  const double value = factor * fields.number(2, "pressure");
  for (const int32_t element : model_->sets.elements_at(fields, 0, use)) {
    if (element >= model_->numbering.cells()) {
      fields.fail(
          fmt::format("found a pressure on {}, which has elements that are no solids; "
                      "*DSLOAD on a surface of their faces loads the solids",
                      fields.text(0)));
    }
    const FlatTable& table = model_->numbering.table_of(element);
    const int32_t face = face_of_number(table.type, *number);
    if (face < 0) {
      fields.fail(fmt::format("found face {}, which elements {} do not have", label, table.name));
    }
    put(faces_, CellFaceId(element, face), Value{value, step, nullptr});
  }
}

// Elements, P, pressure: along the normal of shells, on the side that it leaves (Abaqus Analysis
// User's Guide, distributed loads; CalculiX 2.20 does the same).
void Loads::add_shell_pressure(size_t use, const Fields& fields, double factor, StepNumber step) {
  fields.at_most(3, "elements, P, pressure");
  const double value = factor * fields.number(2, "pressure");
  for (const int32_t element : model_->sets.elements_at(fields, 0, use)) {
    if (!model_->is_shell(element))
      fields.fail(
          fmt::format("found a pressure P on {}, which has elements that are no shells, "
                      "expected P1 to P6 of solids",
                      fields.text(0)));
    put(faces_, CellFaceId(element, kSneg), Value{value, step, nullptr});
  }
}

std::vector<bool> Loads::covered_by(size_t use, const Fields& fields) const {
  std::vector<bool> covered(static_cast<size_t>(model_->numbering.elements()), false);
  for (const int32_t element : model_->sets.elements_or_all(fields, 0, use))
    if (element >= 0) covered[static_cast<size_t>(element)] = true;
  return covered;
}

// Elements, CENTRIF, omega^2, a point of the axis, its direction.
void Loads::add_rotation(size_t use, const Fields& fields, double factor, StepNumber step) {
  fields.at_most(9, "elements, CENTRIF, omega^2, point of the axis, direction");
  Rotation rotation;
  for (size_t k = 0; k < 3; ++k) {
    const auto d = static_cast<int>(k);
    rotation.what.point[d] = fields.number_or(3 + k, "point of the axis", 0.0);
    rotation.what.axis[d] = fields.number_or(6 + k, "direction of the axis", 0.0);
  }
  if (!(rotation.what.axis.norm() > 0.0)) fields.fail("expected a direction of the axis");
  rotation.what.axis.normalize();
  rotation.what.omega_squared = factor * fields.number(2, "omega^2");
  if (!(rotation.what.omega_squared >= 0.0)) {
    fields.fail(fmt::format("found omega^2 = {}, expected 0 or more", rotation.what.omega_squared));
  }
  rotation.step = step;
  rotation.origin = fields.origin();
  rotation.covered = covered_by(use, fields);
  // Replaces the value of an earlier step on the same elements.
  std::erase_if(rotations_, [&](const Rotation& other) {
    return other.step != step && other.covered == rotation.covered;
  });
  rotations_.push_back(std::move(rotation));
}

// Elements, GRAV, acceleration, direction.
void Loads::add_gravity(size_t use, const Fields& fields, double factor, StepNumber step) {
  fields.at_most(6, "elements, GRAV, acceleration, direction");
  Eigen::Vector3d direction;
  for (size_t k = 0; k < 3; ++k) {
    direction[static_cast<int>(k)] = fields.number_or(3 + k, "direction of gravity", 0.0);
  }
  if (!(direction.norm() > 0.0)) fields.fail("expected a direction of gravity");
  add_acceleration(use, fields, factor * fields.number(2, "acceleration") * direction.normalized(),
                   step);
}

// Elements, BX, BY or BZ, force per volume: an acceleration where all have the same density.
void Loads::add_force_per_volume(size_t use, const Fields& fields, int direction, double factor,
                                 StepNumber step) {
  fields.at_most(3, "elements, direction, force per volume");
  std::set<double> densities;
  for (const Region& region : model_->deck.regions) {
    const auto material = model_->deck.materials.find(region.material);
    densities.insert(material == model_->deck.materials.end() ? 0.0 : material->second.density);
  }
  for (const recipe::Shell& shell : model_->deck.shells)
    if (shell.section.area_mass > 0.0) densities.insert(0.0);
  if (densities.size() != 1 || !(*densities.begin() > 0.0)) {
    fields.fail(fmt::format(
        "{} acts on {}, expected one density, by which a force per volume is an "
        "acceleration; ignore = [\"*DLOAD\"] leaves out all loads of elements: "
        "[[load]] of the recipe replaces them",
        folded(fields.text(1)),
        densities.size() > 1 ? "materials of several densities" : "a material without density"));
  }
  const double force = factor * fields.number(2, "force per volume");
  add_acceleration(use, fields, force / *densities.begin() * Eigen::Vector3d::Unit(direction),
                   step);
}

void Loads::add_acceleration(size_t use, const Fields& fields, const Eigen::Vector3d& a,
                             StepNumber step) {
  Gravity& gravity = gravity_[{a[0], a[1], a[2]}];
  if (gravity.step != step) gravity = Gravity();
  const std::vector<bool> more = covered_by(use, fields);
  gravity.times.resize(more.size(), 0);
  gravity.step = step;
  gravity.origin = fields.origin();
  for (size_t i = 0; i < more.size(); ++i) gravity.times[i] += more[i] ? 1 : 0;
  // Ends gravity of an earlier step on these elements: there is one field for all of them.
  std::erase_if(gravity_, [&](const auto& entry) { return entry.second.step != step; });
}

void Loads::read_pressures(size_t use, const Card& card, StepNumber step) {
  const double factor = begin(card);
  if (is_new(card)) forget_others(surfaces_, step);
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model_->source);
    if (folded(fields.text(1)) != "P") {
      fields.fail(fmt::format("load {} is not supported, expected P", fields.text(1)));
    }
    fields.at_most(3, "surface, P, pressure");
    const std::string surface =
        surface_named(*model_, use, fields.word(0, "a surface"), fields.origin());
    put(surfaces_, surface, Value{factor * fields.number(2, "pressure"), step, nullptr});
  }
}

std::vector<double> Loads::initial_field() const {
  return model_->initial.empty() ? std::vector<double>(model_->numbering.nodes(), 0.0)
                                 : model_->initial;
}

void Loads::read_temperatures(size_t use, const Card& card, StepNumber) {
  const double factor = begin(card);
  if (temperature_.empty() || is_new(card)) temperature_ = initial_field();
  for (size_t i = 0; i < card.size(); ++i) {
    const Fields fields = card.line(i, model_->source);
    fields.at_most(2, "nodes, temperature");
    const double value = factor * fields.number(1, "temperature");
    for (const int32_t row : model_->sets.nodes_at(fields, 0, use)) {
      temperature_[row] = value;
    }
  }
}

bool Loads::empty() const {
  return forces_.empty() && faces_.empty() && surfaces_.empty() && gravity_.empty() &&
         rotations_.empty() && temperature_.empty();
}

void Loads::list(Step& out, StepNumber step) {
  for (const auto& [dof, force] : forces_) {
    if (force.value != 0.0) {
      out.forces.push_back({dof.first, dof.second, force.value, *force.system});
    }
  }
  list_pressures(out);
  list_gravity(out);
  list_rotations(out);
  list_temperature(out, step);
}

// Faces with the same pressure are one surface; steps share it.
void Loads::list_pressures(Step& out) {
  std::map<double, std::vector<CellFaceId>> by_value;
  for (const auto& [face, load] : faces_) by_value[load.value].push_back(face);
  for (const auto& [value, faces] : by_value) {
    if (value == 0.0) continue;
    std::string& name = made_surfaces_[faces];
    if (name.empty()) {
      name = add_surface(*model_, fmt::format("dload_{}", made_surfaces_.size()), faces);
    }
    out.pressures.push_back({name, value});
  }
  for (const auto& [surface, load] : surfaces_) {
    if (load.value != 0.0) out.pressures.push_back({surface, load.value});
  }
}

void Loads::list_gravity(Step& out) const {
  for (const auto& [vector, gravity] : gravity_) {
    std::set<int> times;  // of what has mass
    for (size_t i = 0; i < gravity.times.size(); ++i)
      if (has_mass(static_cast<int32_t>(i))) times.insert(gravity.times[i]);
    if (times.size() > 1) {
      model_->source.fail(gravity.origin,
                          "GRAV, BX, BY or BZ acts on some elements only, which is not supported, "
                          "expected all, also those of *MASS and beams: a line without an element "
                          "set loads them all");
    }
    if (!times.empty()) out.acceleration += *times.begin() * Eigen::Vector3d(vector.data());
  }
}

// Solids, shells, beams and masses.
bool Loads::has_mass(int32_t element) const {
  if (model_->region_of(element) >= 0) return true;
  if (const PointElement* point = model_->numbering.point(element); point != nullptr)
    return point->type == "MASS";
  return model_->numbering.thin(element) != nullptr;
}

// Lines with one axis and speed are one.
std::vector<Loads::Rotation> Loads::united_rotations() const {
  std::vector<Rotation> out;
  for (const Rotation& one : rotations_) {
    const auto same = std::ranges::find_if(out, [&](const Rotation& other) {
      return other.what.omega_squared == one.what.omega_squared &&
             other.what.axis == one.what.axis && other.what.point == one.what.point;
    });
    if (same == out.end())
      out.push_back(one);
    else
      for (size_t i = 0; i < one.covered.size(); ++i)
        same->covered[i] = same->covered[i] || one.covered[i];
  }
  return out;
}

// Only entire regions rotate: the rotating part of a section is a region of its own (mesh.cpp).
// Masses and beams do so with all of the part, or not.
void Loads::list_rotations(Step& out) const {
  const Mesh& mesh = model_->deck.mesh;
  for (const Rotation& rotation : united_rotations()) {
    if (rotation.what.omega_squared == 0.0) continue;
    std::vector<bool> turning(mesh.regions.size(), false);
    const auto region_of = [&](size_t i) { return model_->region_of(static_cast<int32_t>(i)); };
    for (size_t i = 0; i < rotation.covered.size(); ++i)
      if (rotation.covered[i] && region_of(i) >= 0)
        turning[static_cast<size_t>(region_of(i))] = true;
    for (size_t i = 0; i < rotation.covered.size(); ++i)
      if (!rotation.covered[i] && region_of(i) >= 0 && turning[static_cast<size_t>(region_of(i))])
        model_->source.fail(rotation.origin,
                            "CENTRIF acts on a part of the shells of a section, expected all");
    out.rotations.push_back(rotation.what);
    std::vector<std::string>& names = out.rotations.back().regions;
    for (size_t r = 0; r < turning.size(); ++r) {
      if (turning[r]) names.push_back(mesh.regions[r]);
    }
    size_t others = 0, turned = 0;  // masses and beams
    for (size_t i = 0; i < rotation.covered.size(); ++i) {
      if (region_of(i) >= 0 || !has_mass(static_cast<int32_t>(i))) continue;
      ++others;
      turned += rotation.covered[i] ? 1 : 0;
    }
    const bool everything = names.size() == mesh.regions.size() && turned == others;
    if (turned > 0 && !everything)
      model_->source.fail(rotation.origin,
                          "CENTRIF acts on *MASS or beams and not on the whole part, which is not "
                          "supported, expected all: a line without an element set loads them all");
    if (everything) names.clear();
  }
}

// A uniform initial temperature is the materials' reference; others are subtracted from the field.
void Loads::list_temperature(Step& out, StepNumber step) {
  if (temperature_.empty()) return;
  const std::vector<double> initial = initial_field();
  const bool uniform =
      std::all_of(initial.begin(), initial.end(), [&](double t) { return t == initial.front(); });
  if (temperature_ == initial) return;
  RowMatrix field(model_->deck.mesh.nodes.rows(), 1);
  for (int32_t row = 0; row < model_->numbering.nodes(); ++row) {
    const int32_t node = model_->node_map.mesh_node(row);
    if (node == NodeMap::kNone) continue;
    const auto at = static_cast<size_t>(row);
    field(node, 0) = uniform ? temperature_[at] : temperature_[at] - initial[at];
  }
  out.temperature = fmt::format("temperature_{}", step);
  model_->deck.mesh.fields[out.temperature] = std::move(field);
}

}  // namespace clatter::mesh::deck::abaqus
