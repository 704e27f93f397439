// SPDX-License-Identifier: GPL-3.0-or-later
// Shells with their PSHELL.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// Poisson's ratios of stretching and bending that differ by no more are the same.
constexpr double kSameRatio = 1e-6;

// Bending of a membrane over that of a plate: it leaves no motion without stiffness.
constexpr double kMembrane = 1e-6;

// Of properties without materials, as our writer has them.
bool is_mere_mesh(const Model& model) {
  return model.raw.materials.empty() && model.raw.other_materials.empty();
}

class ShellProperties {
 public:
  explicit ShellProperties(Model& model) : model_(model) {}

  /// Index into Mesh::regions.
  int32_t region_of(const RawSkin& cell) {
    const auto [at, fresh] = regions_.try_emplace(cell.property, -1);
    if (fresh) at->second = add_region(cell);
    if (at->second < 0) throw FollowUp();
    return at->second;
  }

  void note_shear() const {
    if (without_shear_ > 0)
      model_.deck.notes.push_back(fmt::format(
          "{}: MID3 of {} PSHELL is blank, rigid in shear across the sheet in Nastran: here 5/6 of "
          "the shear stiffness of MID2",
          model_.source.where(first_without_shear_), without_shear_));
    if (membranes_ > 0)
      model_.deck.notes.push_back(fmt::format(
          "{}: MID2 of {} PSHELL is blank, a membrane without bending: here {:g} of that of a "
          "plate, so that grids off solids and other sheets are held across it",
          model_.source.where(first_membrane_), membranes_, kMembrane));
  }

 private:
  int32_t add_region(const RawSkin& cell) {
    const int32_t property = cell.property;
    Mesh& mesh = model_.deck.mesh;
    const auto named = model_.raw.region_names.find(property);
    const std::string name =
        named == model_.raw.region_names.end() ? fmt::format("pid_{}", property) : named->second;
    if (std::ranges::find(mesh.regions, name) != mesh.regions.end())
      model_.source.fail(cell.origin, fmt::format("{} {}: {} is a region of solids, expected a "
                                                  "property of shells alone",
                                                  cell.kind, cell.id, shown(name)));
    Region region;
    const auto shell = model_.raw.shells.find(property);
    if (shell != model_.raw.shells.end()) {
      region.where = model_.source.where(shell->second.origin);
      const RawShell& raw = shell->second;
      model_.deck.shells.push_back(shell_of(name, region.where, property, raw));
      if (!is_mere_mesh(model_) && raw.plies.empty())
        region.material = use(property, raw, raw.material);
    } else if (!model_.raw.shells.empty() || !model_.raw.solids.empty()) {
      model_.source.fail(cell.origin,
                         fmt::format("{} {}: found no PSHELL {}", cell.kind, cell.id, property));
    }
    mesh.regions.push_back(name);
    model_.deck.regions.push_back(std::move(region));
    return static_cast<int32_t>(mesh.regions.size()) - 1;
  }

  recipe::Shell shell_of(const std::string& region, const std::string& where, int32_t property,
                         const RawShell& raw) {
    const auto fail = [&](const std::string& message) {
      model_.source.fail(raw.origin, fmt::format("{} {}: {}", raw.card, property, message));
    };
    if (!raw.refusal.empty())
      fail(raw.refusal + "; ignore = [\"CQUAD4\"] and the like leave cells out");
    recipe::Shell shell{recipe::Source(where), {region}, {}};
    fe::ShellSection& section = shell.section;
    section.area_mass = raw.area_mass * model_.raw.control.mass_factor;
    if (!raw.plies.empty()) {
      add_layers(property, raw, shell);
    } else if (is_mere_mesh(model_)) {
      section.thickness = raw.thickness;
    } else {
      section.thickness = raw.thickness;
      section.bending = raw.inertia;
      take_materials(property, raw, shell);
      if (!(section.thickness >= 0.0) || !(section.bending > 0.0) || !(section.shear > 0.0))
        fail("found a T, 12I/T**3 or TS/T below 0, or a stiffness of 0");
    }
    if (!(section.area_mass >= 0.0)) fail("found NSM below 0");
    return shell;
  }

  std::string use(int32_t property, const RawShell& raw, int32_t material) {
    const std::string name =
        use_material(model_, fmt::format("{} {}", raw.card, property), material, raw.origin);
    const RawMaterial& found = model_.raw.materials.at(material);
    const bool is_soft = found.kind == Material::Kind::kOrthotropic &&
                         (found.constants[7] == 0.0 || found.constants[8] == 0.0);
    if (is_soft && soft_.insert(material).second)
      model_.deck.notes.push_back(
          fmt::format("{}: G1Z or G2Z of MAT8 {} is blank, rigid in shear across the sheet in "
                      "Nastran: here G12",
                      model_.source.where(found.origin), material));
    return name;
  }

  void add_layers(int32_t property, const RawShell& raw, recipe::Shell& shell) {
    for (const RawPly& ply : raw.plies) {
      shell.layers.push_back({shell.source, ply_material(property, raw, ply.material),
                              ply.thickness, ply.angle * std::numbers::pi / 180.0});
    }
  }

  /// TREF of a PCOMP counts, not that of its materials, and its GE where it has one: a material of
  /// its own where they differ. Nastran takes 0 for a blank GE; damping layers keep theirs.
  std::string ply_material(int32_t property, const RawShell& raw, int32_t id) {
    std::map<std::string, Material>& materials = model_.deck.materials;
    const size_t known = materials.size();
    const std::string name = use(property, raw, id);
    const bool is_new = materials.size() > known;
    const Material& plain = materials.at(name);
    const double loss = raw.loss_factor.value_or(plain.loss_factor);
    if (!raw.loss_factor && loss != 0.0 && with_losses_.insert(property).second)
      model_.deck.notes.push_back(fmt::format(
          "{}: {} {}: GE of its materials counts; Nastran takes 0 where its own GE is blank",
          model_.source.where(raw.origin), raw.card, property));
    if (raw.reference_temperature == plain.reference_temperature && loss == plain.loss_factor)
      return name;
    Material material = plain;
    material.name = fmt::format("{}_of_{}", name, property);
    material.reference_temperature = raw.reference_temperature;
    material.loss_factor = loss;
    if (is_new) materials.erase(name);  // nothing has it as it is
    return materials.insert_or_assign(material.name, material).first->first;
  }

  bool are_alike(const RawShell& raw) const {
    const auto is_isotropic = [&](int32_t id) {
      return id == 0 || material_card(model_, id) == "MAT1";
    };
    if (!is_isotropic(raw.material) || !is_isotropic(raw.bending) || !is_isotropic(raw.shear))
      return false;
    const double sheet = material_of(model_, raw.material).constants[1];
    return std::abs(sheet - material_of(model_, raw.bending).constants[1]) <= kSameRatio;
  }

  /// Of isotropic materials with the same Poisson's ratio the first one is enough.
  void take_materials(int32_t property, const RawShell& raw, recipe::Shell& shell) {
    use(property, raw, raw.material);
    if (raw.bending == 0) {
      if (membranes_++ == 0) first_membrane_ = raw.origin;
      shell.section.bending = kMembrane;
      return;
    }
    const std::string bending = use(property, raw, raw.bending);
    const int32_t across = raw.shear == 0 ? raw.bending : raw.shear;
    const std::string shear = use(property, raw, across);
    if (raw.shear == 0 && without_shear_++ == 0) first_without_shear_ = raw.origin;
    fe::ShellSection& section = shell.section;
    if (raw.shear != 0) section.shear = raw.shear_ratio;
    if (!are_alike(raw)) {
      if (raw.bending != raw.material) shell.bending_material = bending;
      if (across != raw.material) shell.shear_material = shear;
      return;
    }
    const std::vector<double> sheet = material_of(model_, raw.material).constants;
    const auto shear_of = [](const std::vector<double>& of) {
      return of[0] / (2.0 * (1.0 + of[1]));
    };
    section.bending *= material_of(model_, raw.bending).constants[0] / sheet[0];
    section.shear *= shear_of(material_of(model_, across).constants) / shear_of(sheet);
  }

  Model& model_;
  std::map<int32_t, int32_t> regions_;  // by property; -1: refused
  std::set<int32_t> soft_;              // MAT8 that are noted
  std::set<int32_t> with_losses_;       // laminates that are noted
  int64_t without_shear_ = 0;
  Origin first_without_shear_ = 0;
  int64_t membranes_ = 0;
  Origin first_membrane_ = 0;
};

class ShellReader {
 public:
  explicit ShellReader(Model& model) : model_(model), properties_(model) {}

  ShellCell read(const RawSkin& raw) {
    ShellCell cell;
    cell.kind = raw.kind;
    cell.id = raw.id;
    cell.region = properties_.region_of(raw);
    cell.offset = raw.offset;
    cell.face = face_of_shell(model_, raw);
    const auto shell = model_.raw.shells.find(raw.property);
    if (shell == model_.raw.shells.end()) return cell;
    take_thickness(raw, shell->second, cell);
    if (!shell->second.plies.empty())
      cell.offset += shell->second.bottom + 0.5 * shell->second.thickness;
    if (has_directions(shell->second)) cell.axis = axis_of(raw, cell.face);
    return cell;
  }

  void note() const { properties_.note_shear(); }

 private:
  void take_thickness(const RawSkin& raw, const RawShell& property, ShellCell& cell) const {
    const double usual = property.thickness;
    for (size_t i = 0; i < static_cast<size_t>(traits(raw.type).corners); ++i) {
      const double own = raw.thickness[i];
      const double t = std::isnan(own) ? usual : raw.is_relative ? own * usual : own;
      if (!property.plies.empty() && t != usual)
        model_.source.fail(raw.origin,
                           fmt::format("{} {}: found T{} = {:g}, expected blank fields: its {} has "
                                       "the thickness",
                                       raw.kind, raw.id, i + 1, t, property.card));
      if (!(t > 0.0) && !(t == 0.0 && is_mere_mesh(model_)))
        model_.source.fail(raw.origin,
                           fmt::format("{} {}: found a thickness of {:g}, expected more than 0: T "
                                       "of its PSHELL, or T1 to T{}",
                                       raw.kind, raw.id, t, traits(raw.type).corners));
      cell.face.values[i] = t;
    }
  }

  bool has_directions(const RawShell& property) const {
    const auto turns = [&](int32_t id) {
      return id > 0 && !is_mere_mesh(model_) && material_card(model_, id) != "MAT1";
    };
    return std::ranges::any_of(property.plies,
                               [&](const RawPly& ply) { return turns(ply.material); }) ||
           turns(property.material) || turns(property.bending) || turns(property.shear);
  }

  // THETA from the side of the first two grids, about the normal; or direction x of MCID.
  Eigen::Vector3d axis_of(const RawSkin& raw, const ShellFace& face) const {
    const auto at = [&](size_t i) {
      return Eigen::Vector3d(model_.deck.mesh.nodes.row(face.nodes[i]));
    };
    if (raw.system != kNoSystem) {
      const bool is_curved = raw.system > 0 && model_.systems.get(raw.system, raw.origin).kind !=
                                                   System::Kind::kRectangular;
      if (is_curved)
        model_.source.fail(raw.origin, fmt::format("{} {}: MCID {} is a curved system, expected a "
                                                   "rectangular one, or THETA",
                                                   raw.kind, raw.id, raw.system));
      return model_.systems.directions(raw.system, at(0), raw.origin).col(0);
    }
    const size_t last = static_cast<size_t>(traits(face.type).corners) - 1;
    const Eigen::Vector3d side = at(1) - at(0);
    const Eigen::Vector3d normal =
        (last == 3 ? (at(2) - at(0)).cross(at(3) - at(1)) : side.cross(at(2) - at(0))).normalized();
    const Eigen::Vector3d first = (side - side.dot(normal) * normal).normalized();
    const double angle = raw.angle * std::numbers::pi / 180.0;
    return std::cos(angle) * first + std::sin(angle) * normal.cross(first);
  }

  Model& model_;
  ShellProperties properties_;
};

void check_shell_numbers(const Model& model) {
  const auto& cells = model.raw.shell_cells;
  std::vector<int32_t> ids;
  for (const RawSkin& cell : cells) ids.push_back(cell.id);
  const IdIndex index(ids);
  if (index.duplicates().empty()) return;
  const auto& [first, second] = index.duplicates().front();
  model.source.fail(cells[second].origin,
                    fmt::format("cell {}: found another one with this number at {}", ids[second],
                                model.source.where(cells[first].origin)));
}

}  // namespace

ShellFace face_of_shell(const Model& model, const RawSkin& raw) {
  ShellFace face{.type = raw.type};
  for (size_t i = 0; i < static_cast<size_t>(traits(raw.type).nodes); ++i)
    face.nodes[i] = model.find(raw.grids[i], raw.origin);
  return face;
}

void build_shells(Model& model) {
  if (model.raw.shell_cells.empty()) return;
  check_shell_numbers(model);
  ShellReader reader(model);
  std::vector<ShellCell> cells;
  std::vector<Origin> origins;
  for (const RawSkin& raw : model.raw.shell_cells)
    if (model.refusals.attempt([&] { cells.push_back(reader.read(raw)); }))
      origins.push_back(raw.origin);
  model.hinges = add_shells(
      model.deck, cells, [&](size_t i) { return model.source.where(origins[i]); }, model.refusals);
  reader.note();
}

}  // namespace clatter::mesh::deck::nastran
