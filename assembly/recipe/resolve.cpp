// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/resolve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "assembly/recipe/parts.hpp"
#include "core/keys/keys.hpp"

namespace clatter::assembly {

void Resolver::name_materials(const recipe::File& file) {
  for (const auto& [name, one] : file.materials) {
    fe::MaterialTable table = one.material;
    fe::finish(one.source, table);
    if (!table.system.empty()) table.material.axes = names_.axes(one.source, table.system);
    named_materials_[name] = table.material;
  }
}

/// Of each region; of layers that of the first one.
std::vector<fe::Material> Resolver::materials(const recipe::File& file) const {
  const std::vector<std::string>& regions = names_.mesh.regions;
  std::vector<bool> found(regions.size(), false);
  std::vector<fe::Material> materials(regions.size());
  const auto give = [&](const keys::Source& table, const std::string& region,
                        const fe::Material& material) {
    const int32_t index = names_.region(table, "regions", region);
    if (found[index])
      table.fail("regions", fmt::format("found \"{}\" in two materials, expected one", region));
    found[index] = true;
    materials[index] = material;
  };
  for (const auto& [name, one] : file.materials)
    for (const std::string& region : one.regions)
      give(one.source, region, named_materials_.at(name));
  for (const recipe::Shell& shell : file.shells)
    for (const std::string& region : shell.regions)
      if (!shell.layers.empty())
        give(shell.source, region,
             named_material(shell.layers[0].source, "material", shell.layers[0].material));
  for (size_t r = 0; r < found.size(); ++r)
    if (!found[r])
      file.source.fail("material",
                       fmt::format("found none for region \"{}\", expected one for each of: {}",
                                   regions[r], fmt::join(regions, ", ")));
  return materials;
}

/// What needs the cells of a part, which a reduced one no longer has.
void Resolver::check_loads_of_parts(const recipe::File& file) const {
  for (const recipe::Heat& heat : file.heats)
    heat.source.fail("name",
                     "found a temperature field beside a reduced part, expected none: "
                     "compute it on the part's own mesh");
  for (const recipe::Load& load : file.loads)
    if (load.kind == recipe::Load::Kind::kCentrifugal ||
        load.kind == recipe::Load::Kind::kTemperature ||
        (load.kind == recipe::Load::Kind::kAcceleration && !load.field.empty()))
      load.source.fail("kind",
                       "found a load on all cells beside a reduced part, which has none, expected "
                       "it among the loads of the part's own model");
}

/// Mid-side nodes without a cell of their own need straight edges.
void Resolver::check_hanging(const recipe::File& file) const {
  const bool named = std::ranges::any_of(file.straight_edges, [](const auto& edges) {
    return edges.node_set == mesh::kHangingMidSideNodes;
  });
  if (!named && names_.mesh.node_sets.contains(mesh::kHangingMidSideNodes))
    file.source.fail("straight_edges",
                     fmt::format("found none, the mesh has the node set \"{0}\": expected "
                                 "[[straight_edges]] with node_set = \"{0}\"",
                                 mesh::kHangingMidSideNodes));
}

fe::Prestress Resolver::prestress(const recipe::Prestress& prestress, bool with_parts) {
  if (with_parts)
    prestress.source.fail("file",
                          "found it beside a reduced part, which has no cells, expected "
                          "[prestress] in the fe.toml of the part");
  files_.push_back(prestress.file);
  fe::Prestress out = fe::read_prestress(prestress.file, prestress.of_case, names_.mesh.nodes);
  out.factor = prestress.factor;
  return out;
}

namespace {

template <class T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

/// Sets and loads of reduced parts have names as those of tables.
void Resolver::name_parts(const std::vector<PartSpec>& parts) {
  for (const PartSpec& part : parts) {
    for (const auto& [name, set] : part.model.sets)
      if (part.has(name)) names_.add_set(part.source, part.named(name));
    for (const auto& [name, load] : part.model.loads)
      if (!names_.loads.insert(part.named(name)).second)
        part.source.fail(
            "name",
            fmt::format("found the load \"{}\" twice, expected different names", part.named(name)));
  }
}

Recipe Resolver::resolve(const recipe::File& file, std::vector<PartSpec> parts) {
  metre_ = file.metre;
  name_parts(parts);
  for (const auto& [name, table] : file.systems) names_.systems[name] = table.axes;
  name_materials(file);
  materials_ = materials(file);
  // In this order: later tables name earlier ones.
  Recipe out;
  out.materials = materials_;
  out.sections = sections_ = sections(file);
  out.mass = file.mass.form;
  out.damping = file.damping;
  if (!parts.empty() && file.damping.source.where().empty()) {
    out.damping.alpha = parts.front().model.alpha;
    out.damping.beta = parts.front().model.beta;
  }
  if (file.prestress) out.prestress = prestress(*file.prestress, !parts.empty());
  out.points = each(file.points, &Resolver::point);
  out.supports = each(file.supports, &Resolver::support);
  out.couplings = each(file.couplings, &Resolver::coupling);
  out.equations = each(file.equations, &Resolver::equation);
  out.springs = each(file.springs, &Resolver::spring);
  out.matrices = each(file.matrices, &Resolver::matrix);
  for (size_t k = 0; k < file.beams.size(); ++k) beam(file.beams[k], k + 1, out);
  out.straight_edges = each(file.straight_edges, &Resolver::straight_edges);
  out.ties = each(file.ties, &Resolver::tie);
  out.ties = joined(std::move(out.ties), each(file.bolts, &Resolver::bolt));
  out.gaskets = each(file.gaskets, &Resolver::gasket);
  out.contacts = each(file.contacts, &Resolver::contact);
  out.means = each(file.means, &Resolver::mean);
  out.nodes = each(file.sensors, &Resolver::sensor);
  out.nodes = joined(std::move(out.nodes), each(file.nodes, &Resolver::nodes));
  out.point_masses = each(file.point_masses, &Resolver::point_mass);
  out.surface_masses = each(file.surface_masses, &Resolver::surface_mass);
  out.heats = each(file.heats, &Resolver::heat);
  out.loads = each(file.loads, &Resolver::load);
  for (const recipe::Case& one : file.cases) out.cases[one.name] = factors(one);
  check_hanging(file);
  if (!parts.empty()) check_loads_of_parts(file);
  out.files = std::move(files_);
  for (const PartSpec& part : parts) out.files.push_back(part.file);
  out.parts = std::move(parts);
  return out;
}

Recipe read_recipe(recipe::File file, const mesh::Mesh& mesh) {
  recipe::file_keys().check_ranges(file);
  for (auto& [name, system] : file.systems) fe::finish(system);
  return Resolver(mesh).resolve(file, {});
}

Recipe read_recipe(const Config& config, mesh::Mesh& mesh) {
  recipe::file_keys().table().check_known(config);
  // A file without any material is refused with the names of the regions.
  recipe::File empty;
  empty.source = keys::Source(config);
  if (!config.has("material") && !config.has("matrices")) Resolver(mesh).materials(empty);
  const recipe::File file = recipe::file_keys().read(config);
  std::vector<PartSpec> parts = attach_parts(file, mesh);
  return Resolver(mesh).resolve(file, std::move(parts));
}

}  // namespace clatter::assembly
