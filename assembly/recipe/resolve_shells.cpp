// SPDX-License-Identifier: GPL-3.0-or-later
// [[shell]].
#include <fmt/format.h>

#include <algorithm>

#include "assembly/recipe/resolve.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {

const fe::Material& Resolver::named_material(const Source& table, std::string_view key,
                                             const std::string& name) const {
  check_known(table, key, name, names_of(named_materials_));
  const fe::Material& material = named_materials_.at(name);
  if (material.axes)
    table.fail(key, fmt::format("found \"{}\", which has a system: that of [[shell]] turns the "
                                "materials of sheets",
                                name));
  if (!fe::is_sheet_material(material))
    table.fail(key, fmt::format("found \"{}\", which joins transverse shear to what happens in "
                                "the plane of its directions 1 and 2, expected an orthotropic "
                                "material",
                                name));
  return material;
}

fe::ShellSection Resolver::section(const recipe::Shell& shell) const {
  fe::ShellSection section = shell.section;
  const auto other = [&](const char* key, const std::string& name, auto& material) {
    if (!name.empty()) material = named_material(shell.source, key, name);
  };
  other("bending_material", shell.bending_material, section.bending_material);
  other("shear_material", shell.shear_material, section.shear_material);
  if (!shell.system.empty()) section.axes = names_.axes(shell.source, shell.system);
  section.thickness = shell.thickness();
  for (const recipe::ShellLayer& layer : shell.layers)
    section.layers.push_back(
        {named_material(layer.source, "material", layer.material), layer.thickness, layer.angle});
  return section;
}

void Resolver::check_sheet(const recipe::File& file, const mesh::ShellBlock& block,
                           const fe::ShellSection& section) const {
  const std::string& region = names_.mesh.regions[block.region];
  const fe::Material& material = materials_[block.region];
  if (block.thickness.size() == 0 && !(section.thickness > 0.0))
    file.source.fail("shell", fmt::format("found no thickness of region \"{}\", expected "
                                          "[[shell]] with regions = [\"{}\"] and thickness",
                                          region, region));
  constexpr double kSame = 1e-6;
  const bool own = block.thickness.size() > 0 && !section.layers.empty();
  if (own &&
      ((block.thickness.array() - section.thickness).abs() > kSame * section.thickness).any())
    warn(fmt::format(
        "region {}: its layers are {:.6g} m thick, the mesh has {:.6g} to {:.6g} m: the "
        "layers are scaled to it",
        region, section.thickness, block.thickness.minCoeff(), block.thickness.maxCoeff()));
  for (const auto& [name, one] : file.materials)
    if (std::ranges::find(one.regions, region) != one.regions.end())
      (void)named_material(one.source, "regions", name);
  if (section.has_directions(material) && block.axis.size() == 0 && !section.axes)
    file.source.fail("shell", fmt::format("found no direction 1 of the sheet of region \"{}\", "
                                          "whose material has directions, expected system of its "
                                          "[[shell]]",
                                          region));
}

/// Of regions with shells.
std::vector<fe::ShellSection> Resolver::sections(const recipe::File& file) const {
  const mesh::Mesh& mesh = names_.mesh;
  std::vector<bool> shells(mesh.regions.size(), false), given = shells;
  for (const mesh::ShellBlock& block : mesh.shells) shells[block.region] = true;
  std::vector<fe::ShellSection> sections(mesh.regions.size());
  for (const recipe::Shell& shell : file.shells)
    for (const std::string& name : shell.regions) {
      const int32_t region = names_.region(shell.source, "regions", name);
      if (!shells[region])
        shell.source.fail("regions",
                          fmt::format("found \"{}\", a region of solids, expected shells", name));
      if (given[region])
        shell.source.fail("regions",
                          fmt::format("found \"{}\" in two [[shell]], expected one", name));
      given[region] = true;
      sections[region] = section(shell);
    }
  for (const mesh::ShellBlock& block : mesh.shells)
    check_sheet(file, block, sections[block.region]);
  return sections;
}

}  // namespace clatter::assembly
