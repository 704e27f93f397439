// SPDX-License-Identifier: GPL-3.0-or-later
// From static results to a shape, and its file, schema "clatter/shape/1".
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/mesh/mesh_file.hpp"
#include "modal/certificates.hpp"
#include "modal/shape.hpp"
#include "modal/statics.hpp"

namespace clatter::modal {
namespace {

constexpr double kSameRadius = 0.01;  // of a grid and the surface that it lies on
constexpr double kUnit = 1e-6;        // of unit vectors and right angles

Eigen::Vector3d vector_in(const H5File& file, const std::string& dataset) {
  const Eigen::VectorXd values = file.read_vector(dataset);
  if (values.size() != 3 || !values.allFinite())
    throw InputError(fmt::format("{}: {}: found {} numbers, expected 3, all finite",
                                 file.path().string(), dataset, values.size()));
  return values;
}

/// The axes of a contact grid.
CylinderAxes axes_in(const H5File& file, const std::string& grid) {
  const std::string at = "grids/" + grid;
  CylinderAxes axes{vector_in(file, at + "/axis_point"), vector_in(file, at + "/axis"),
                    vector_in(file, at + "/zero_angle")};
  if (std::abs(axes.axis.norm() - 1.0) > kUnit || std::abs(axes.zero_angle.norm() - 1.0) > kUnit ||
      std::abs(axes.axis.dot(axes.zero_angle)) > kUnit)
    throw InputError(
        fmt::format("{}: {}: found axis and zero_angle that are not orthogonal unit "
                    "vectors, expected such",
                    file.path().string(), at));
  return axes;
}

/// The axes of the only contact grid on whose cylinder all nodes of the surface lie.
CylinderAxes axes_on(const H5File& file, const RowMatrix& nodes, const mesh::Surface& surface,
                     const std::string& where) {
  std::vector<std::string> on;
  const std::vector<std::string> grids = file.list("grids");
  for (const std::string& grid : grids) {
    const CylinderExtent extent = extent_of(nodes, surface, axes_in(file, grid));
    const double radius = file.get_double("grids/" + grid, "radius");
    if (std::abs(extent.radius - radius) + extent.spread < kSameRadius * radius) on.push_back(grid);
  }
  if (on.size() == 1) return axes_in(file, on[0]);
  throw InputError(
      fmt::format("{}: found {} contact grids on this surface ({}), expected one; give "
                  "--axis-point, --axis and "
                  "--zero-angle",
                  where, on.size(), fmt::join(on.empty() ? grids : on, ", ")));
}

}  // namespace

Shape shape_from_file(const std::filesystem::path& path, const ShapeOptions& given) {
  const H5File file = open_artefact(path, fe::kStaticSchema);
  ShapeOptions options = given;
  const RowMatrix nodes = file.read_rows("nodes");
  const auto surfaces = mesh::read_surfaces(file, nodes.rows(), path.string());
  const auto surface = surfaces.find(options.surface);
  if (surface == surfaces.end()) {
    std::vector<std::string> names;
    for (const auto& entry : surfaces) names.push_back(entry.first);
    throw InputError(fmt::format("{}: --surface: found \"{}\", expected one of: {}", path.string(),
                                 options.surface, fmt::join(names, ", ")));
  }
  const std::string where = fmt::format("{}: surface {}", path.string(), options.surface);
  if (surface->second.face_count() == 0)
    throw InputError(fmt::format("{}: found no faces, expected some", where));
  if (!options.axes) options.axes = axes_on(file, nodes, surface->second, where);
  const std::vector<std::string> cases = file.list("cases");
  if (options.cases.empty()) options.cases = cases;
  std::vector<Eigen::VectorXd> displacement;
  for (const std::string& name : options.cases) {
    if (std::find(cases.begin(), cases.end(), name) == cases.end())
      throw InputError(fmt::format("{}: --case: found \"{}\", expected one of: {}", path.string(),
                                   name, fmt::join(cases, ", ")));
    const std::string dataset = "cases/" + name + "/displacement";
    const RowMatrix u = file.read_rows(dataset);
    if (u.rows() != nodes.rows() || u.cols() != 3 || !u.allFinite())
      throw InputError(fmt::format("{}: {}: found {} x {} numbers, expected {} x 3, all finite",
                                   path.string(), dataset, u.rows(), u.cols(), nodes.rows()));
    displacement.emplace_back(Eigen::Map<const Eigen::VectorXd>(u.data(), u.size()));
  }
  Shape shape = shape_of(nodes, surface->second, displacement, options, where);
  shape.name = file.get_string("/", "name");
  return shape;
}

void write_shape(H5File& file, const Shape& shape) {
  file.set("/", "name", shape.name);
  file.set("/", "surface", shape.surface);
  file.set("/", "radius", shape.extent.radius);
  file.set("/", "rigid_kept", shape.rigid_kept ? 1 : 0);
  file.write(kShapeAxisPoint, Eigen::VectorXd(shape.axes.axis_point));
  file.write(kShapeAxis, Eigen::VectorXd(shape.axes.axis));
  file.write(kShapeZeroAngle, Eigen::VectorXd(shape.axes.zero_angle));
  file.write(kShapeHeight, shape.height);
  file.write(kShapeAngle, shape.angle);
  file.write("covered", IndexMatrix(shape.covered));
  for (const ShapeCase& one : shape.cases) {
    const std::string group = "cases/" + one.name;
    file.write(group + "/deviation", RowMatrix(one.deviation));
    file.write(group + "/rigid", Eigen::VectorXd(one.rigid));
    file.write(group + "/order_re", RowMatrix(one.order_re));
    file.write(group + "/order_im", RowMatrix(one.order_im));
  }
  write_certificate(file, ShapeCertificate{.cases = static_cast<double>(shape.cases.size()),
                                           .covered = shape.covered.cast<double>().mean(),
                                           .radius_spread = shape.extent.spread});
}

std::string csv_of(const Shape& shape) {
  std::string text = "height_m,angle_deg,covered";
  for (const ShapeCase& one : shape.cases) text += fmt::format(",{}_um", one.name);
  for (Eigen::Index i = 0; i < shape.height.size(); ++i)
    for (Eigen::Index j = 0; j < shape.angle.size(); ++j) {
      text += fmt::format("\n{:.9g},{:.6g},{}", shape.height(i),
                          360.0 * static_cast<double>(j) / static_cast<double>(shape.angle.size()),
                          shape.covered(i, j));
      for (const ShapeCase& one : shape.cases)
        text += fmt::format(",{:.6g}", 1e6 * one.deviation(i, j));
    }
  return text + "\n";
}

}  // namespace clatter::modal
