// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/fe_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/base/error.hpp"
#include "core/mesh/mesh_file.hpp"

namespace clatter::fe {
namespace {

template <typename Value, size_t N>
using Names = std::array<std::pair<std::string_view, Value>, N>;

constexpr Names<Integration, 4> kIntegrations = {{{"full", Integration::kFull},
                                                  {"reduced", Integration::kReduced},
                                                  {"incompatible", Integration::kIncompatible},
                                                  {"fine", Integration::kFine}}};
constexpr Names<Axes::Kind, 3> kAxes = {{{"rectangular", Axes::Kind::kRectangular},
                                         {"cylindrical", Axes::Kind::kCylindrical},
                                         {"spherical", Axes::Kind::kSpherical}}};

using Choice = Integration IntegrationChoice::*;
constexpr std::array<std::pair<const char*, Choice>, 4> kChoices = {
    {{"hex8", &IntegrationChoice::hex8},
     {"hex20", &IntegrationChoice::hex20},
     {"wedge6", &IntegrationChoice::wedge6},
     {"wedge15", &IntegrationChoice::wedge15}}};

constexpr std::array<std::pair<const char*, double ShellSection::*>, 5> kSection = {
    {{"thickness", &ShellSection::thickness},
     {"offset", &ShellSection::offset},
     {"bending", &ShellSection::bending},
     {"shear", &ShellSection::shear},
     {"area_mass", &ShellSection::area_mass}}};

constexpr std::array<std::pair<const char*, std::optional<Material> ShellSection::*>, 2>
    kOtherMaterials = {{{"bending_material", &ShellSection::bending_material},
                        {"shear_material", &ShellSection::shear_material}}};

template <typename Value, size_t N>
std::string name_of(const Names<Value, N>& names, Value value) {
  for (const auto& [name, known] : names)
    if (known == value) return std::string(name);
  return {};
}

template <typename Value, size_t N>
Value value_of(const H5File& file, const std::string& group, const std::string& key,
               const Names<Value, N>& names) {
  const std::string found = file.get_string(group, key);
  for (const auto& [name, value] : names)
    if (name == found) return value;
  throw InputError(fmt::format("{}: {}: found {} = \"{}\", expected {}, {} or {}",
                               file.path().string(), group, key, found, names[0].first,
                               names[1].first, names[2].first));
}

/// A finite dataset of the given shape.
Eigen::MatrixXd read_matrix(const H5File& file, const std::string& dataset, Eigen::Index rows,
                            Eigen::Index cols) {
  const Eigen::MatrixXd values =
      cols == 1 ? Eigen::MatrixXd(file.read_vector(dataset)) : file.read_matrix(dataset);
  if (values.rows() != rows || values.cols() != cols || !values.allFinite())
    throw InputError(fmt::format("{}: {}: found {} x {} numbers, expected {} x {}, all finite",
                                 file.path().string(), dataset, values.rows(), values.cols(), rows,
                                 cols));
  return values;
}

void write_axes(H5File& file, const std::string& group, const Axes& axes) {
  file.set(group + "/axes", "kind", name_of(kAxes, axes.kind));
  file.write(group + "/axes/origin", Eigen::VectorXd(axes.origin));
  file.write(group + "/axes/frame", Eigen::MatrixXd(axes.frame));
}

std::optional<Axes> read_axes(const H5File& file, const std::string& group) {
  if (!file.has(group + "/axes")) return {};
  return Axes{value_of(file, group + "/axes", "kind", kAxes),
              read_matrix(file, group + "/axes/origin", 3, 1),
              read_matrix(file, group + "/axes/frame", 3, 3)};
}

void write_material(H5File& file, const std::string& group, const Material& material) {
  file.set(group, "rho", material.density);
  if (material.is_isotropic()) {
    file.set(group, "E", material.youngs);
    file.set(group, "nu", material.poisson);
  } else {
    file.write(group + "/elasticity", Eigen::MatrixXd(*material.elasticity));
  }
  file.write(group + "/expansion", Eigen::VectorXd(material.expansion));
  if (!material.conductivity.isZero(0.0))
    file.write(group + "/conductivity", Eigen::VectorXd(material.conductivity));
  if (material.axes) write_axes(file, group, *material.axes);
  for (const auto& [key, member] : kChoices)
    file.set(group, key, name_of(kIntegrations, material.integration.*member));
}

Material read_material(const H5File& file, const std::string& group) {
  Material material;
  material.density = file.get_double(group, "rho");
  if (file.has(group + "/elasticity")) {
    material.elasticity = read_matrix(file, group + "/elasticity", 6, 6);
  } else {
    material.youngs = file.get_double(group, "E");
    material.poisson = file.get_double(group, "nu");
    if (!(material.youngs > 0.0 && std::isfinite(material.youngs) && material.poisson > -1.0 &&
          material.poisson < 0.5))
      throw InputError(
          fmt::format("{}: {}: found E = {:g}, nu = {:g}, expected E > 0 and -1 < nu "
                      "< 0.5",
                      file.path().string(), group, material.youngs, material.poisson));
  }
  material.expansion = read_matrix(file, group + "/expansion", 6, 1);
  if (file.has(group + "/conductivity"))
    material.conductivity = read_matrix(file, group + "/conductivity", 3, 1);
  material.axes = read_axes(file, group);
  for (const auto& [key, member] : kChoices)
    material.integration.*member = value_of(file, group, key, kIntegrations);
  return material;
}

void write_sections(H5File& file, const FeCells& cells) {
  mesh::write_shells(file, cells.shells);
  std::set<int32_t> written;  // quadrilaterals and triangles of a region share its section
  for (const mesh::ShellBlock& block : cells.shells) {
    if (!written.insert(block.region).second) continue;
    const ShellSection& section = cells.sections[block.region];
    const std::string group = fmt::format("sections/{}", block.region);
    for (const auto& [key, member] : kSection) file.set(group, key, section.*member);
    if (section.axes) write_axes(file, group, *section.axes);
    for (const auto& [name, other] : kOtherMaterials)
      if (section.*other) write_material(file, group + "/" + name, *(section.*other));
    for (size_t k = 0; k < section.layers.size(); ++k) {
      const std::string layer = fmt::format("{}/layers/{}", group, k);
      write_material(file, layer, section.layers[k].material);
      file.set(layer, "thickness", section.layers[k].thickness);
      file.set(layer, "angle", section.layers[k].angle);
    }
  }
}

ShellSection read_section(const H5File& file, const std::string& group) {
  ShellSection section;
  for (const auto& [key, member] : kSection) section.*member = file.get_double(group, key);
  section.axes = read_axes(file, group);
  for (const auto& [name, other] : kOtherMaterials)
    if (file.has(group + "/" + name)) section.*other = read_material(file, group + "/" + name);
  const size_t layers = file.has(group + "/layers") ? file.list(group + "/layers").size() : 0;
  for (size_t k = 0; k < layers; ++k) {
    const std::string layer = fmt::format("{}/layers/{}", group, k);
    section.layers.push_back({read_material(file, layer), file.get_double(layer, "thickness"),
                              file.get_double(layer, "angle")});
    if (!(section.layers.back().thickness > 0.0))
      throw InputError(fmt::format("{}: {}: found thickness = {:g}, expected more than 0",
                                   file.path().string(), layer, section.layers.back().thickness));
  }
  if (layers > 0) section.thickness = 0.0;
  for (const ShellLayer& layer : section.layers) section.thickness += layer.thickness;
  return section;
}

std::vector<ShellSection> read_sections(const H5File& file, size_t regions) {
  std::vector<ShellSection> sections(regions);
  for (size_t r = 0; r < regions; ++r) {
    const std::string group = fmt::format("sections/{}", r);
    if (file.has(group)) sections[r] = read_section(file, group);
  }
  return sections;
}

/// Nodes up to the last one of a cell; those of reduced parts come after it.
Eigen::Index last_of_cells(const mesh::Mesh& mesh) {
  Eigen::Index count = 0;
  const auto take = [&](const IndexMatrix& nodes) {
    if (nodes.size() > 0) count = std::max<Eigen::Index>(count, nodes.maxCoeff() + 1);
  };
  for (const mesh::CellBlock& block : mesh.cells) take(block.nodes);
  for (const mesh::ShellBlock& block : mesh.shells) take(block.nodes);
  return std::min(count, mesh.nodes.rows());
}

}  // namespace

void write_cells(H5File& file, const FeCells& cells) {
  if (cells.blocks.empty() && cells.shells.empty()) return;
  file.write("regions", cells.regions);
  for (size_t r = 0; r < cells.materials.size(); ++r)
    write_material(file, fmt::format("materials/{}", r), cells.materials[r]);
  mesh::write_cells(file, cells.blocks);
  write_sections(file, cells);
  if (!cells.node_ids.empty()) file.write("node_ids", cells.node_ids);
}

FeCells read_cells(const H5File& file, const RowMatrix& nodes) {
  if (!file.has("cells") && !file.has("shells")) return {};
  mesh::Mesh mesh;
  mesh.nodes = nodes;
  mesh.regions = file.read_strings("regions");
  mesh.cells = mesh::read_cells(file);
  mesh.shells = mesh::read_shells(file);
  FeCells cells;
  if (file.has("node_ids")) cells.node_ids = file.read_ints("node_ids");
  mesh.node_ids = cells.node_ids;
  if (!file.list("parts").empty()) {
    mesh.nodes.conservativeResize(last_of_cells(mesh), 3);
    if (cells.node_ids.size() == static_cast<size_t>(nodes.rows()))
      mesh.node_ids.resize(static_cast<size_t>(mesh.nodes.rows()));
  }
  mesh.surfaces["skin"];  // required by the check; surfaces are checked separately
  mesh::check_structure(mesh, file.path().string());
  for (size_t r = 0; r < mesh.regions.size(); ++r)
    cells.materials.push_back(read_material(file, fmt::format("materials/{}", r)));
  cells.sections = read_sections(file, mesh.regions.size());
  cells.regions = std::move(mesh.regions);
  cells.shells = std::move(mesh.shells);
  cells.blocks = std::move(mesh.cells);
  return cells;
}

}  // namespace clatter::fe
