// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/contact_patch.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace clatter::assembly {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kRoundness = 0.1;   // largest deviation from the mean radius, as a share of it
constexpr double kOnEdge = 1e-9;     // a node on the edge between two strips belongs to the first
constexpr double kLeastArea = 1e-6;  // of the mean patch area: less is rounding

/// A position in cylindrical coordinates.
struct Cylindrical {
  double radius, angle, axial;
  Eigen::Vector3d radial;  // unit vector away from the axis
};

Cylindrical to_cylindrical(const PatchGridSpec& spec, const Eigen::Vector3d& x) {
  const Eigen::Vector3d r = x - spec.axis_point;
  Cylindrical at{};
  at.axial = r.dot(spec.axis);
  const Eigen::Vector3d across = r - at.axial * spec.axis;
  at.radius = across.norm();
  at.radial = across / at.radius;
  at.angle = std::atan2(across.dot(spec.axis.cross(spec.zero_angle)), across.dot(spec.zero_angle));
  return at;
}

Eigen::Vector3d from_cylindrical(const PatchGridSpec& spec, double radius, double angle,
                                 double axial) {
  const Eigen::Vector3d side = spec.axis.cross(spec.zero_angle);
  return spec.axis_point + axial * spec.axis +
         radius * (std::cos(angle) * spec.zero_angle + std::sin(angle) * side);
}

/// Strips of all sectors; the grid's radius is the area-weighted mean distance from the axis.
rom::ContactGrid make_grid(const PatchGridSpec& spec, double radius) {
  rom::ContactGrid grid;
  grid.axis_point = spec.axis_point;
  grid.axis = spec.axis;
  grid.zero_angle = spec.zero_angle;
  grid.radius = radius;
  std::vector<double> centre, edges;
  for (const Sector& sector : spec.sectors) {
    const double width = (sector.end - sector.begin) / sector.strips;
    for (int i = 0; i < sector.strips; ++i) {
      edges.push_back(sector.begin + i * width);
      edges.push_back(sector.begin + (i + 1) * width);
      centre.push_back(sector.begin + (i + 0.5) * width);
    }
  }
  const auto as_vector = [](const std::vector<double>& values) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  grid.angle = as_vector(centre);
  grid.angle_edges = as_vector(edges);
  grid.axial_edges = spec.axial_edges;
  const Eigen::Index rows = spec.axial_edges.size() - 1;
  grid.axial = 0.5 * (spec.axial_edges.head(rows) + spec.axial_edges.tail(rows));
  return grid;
}

/// The patch that contains a position, or -1.
Eigen::Index patch_at(const rom::ContactGrid& grid, const Cylindrical& at) {
  const Eigen::VectorXd& edges = grid.axial_edges;
  if (at.axial < edges(0) || at.axial > edges(edges.size() - 1)) return -1;
  const auto upper = std::upper_bound(edges.begin(), edges.end() - 1, at.axial);
  const Eigen::Index row = std::max<Eigen::Index>(upper - edges.begin() - 1, 0);
  for (Eigen::Index strip = 0; strip < grid.angle.size(); ++strip) {
    const double begin = grid.angle_edges(2 * strip);
    const double ahead = std::remainder(at.angle - grid.angle(strip), kTurn);
    const double half_width = (1.0 + kOnEdge) * (grid.angle(strip) - begin);
    if (std::abs(ahead) <= half_width) return strip * grid.axial.size() + row;
  }
  return -1;
}

double mean_radius(const SurfaceIntegrals& surface, const std::vector<Cylindrical>& positions,
                   const std::string& where) {
  double radius = 0.0;
  for (size_t k = 0; k < positions.size(); ++k)
    radius += surface.weight(static_cast<Eigen::Index>(k)) * positions[k].radius;
  radius /= surface.area;
  for (const Cylindrical& at : positions) {
    if (std::abs(at.radius - radius) <= kRoundness * radius) continue;
    throw InputError(fmt::format(
        "{}: found a node {:.6g} m from the axis, expected a cylinder about it (mean radius "
        "{:.6g} m)",
        where, at.radius, radius));
  }
  return radius;
}

/// Reports the first patch with too little area, and its range.
void require_area(const rom::ContactGrid& grid, const Eigen::VectorXd& area,
                  const std::string& where) {
  const double least = kLeastArea * area.cwiseAbs().mean();
  for (Eigen::Index p = 0; p < area.size(); ++p) {
    if (area(p) > least) continue;
    const Eigen::Index strip = p / grid.axial.size(), row = p % grid.axial.size();
    throw InputError(fmt::format(
        "{}: patch [{},{}] (angle {:.4g} to {:.4g} deg, axial {:.6g} to {:.6g} m) caught no node "
        "of the surface; expected fewer strips or rows, a finer mesh, or another range",
        where, strip, row, grid.angle_edges(2 * strip) / kDegree,
        grid.angle_edges(2 * strip + 1) / kDegree, grid.axial_edges(row),
        grid.axial_edges(row + 1)));
  }
}

void describe_set(const std::string& name, const PatchGridSpec& spec, const rom::ContactGrid& grid,
                  rom::DofSet& set) {
  const Eigen::Index patches = grid.angle.size() * grid.axial.size();
  set.kind = "contact_grid";
  set.position.resize(patches, 3);
  set.direction.resize(patches, 3);
  set.is_rotation.assign(patches, 0);
  for (Eigen::Index i = 0; i < grid.angle.size(); ++i) {
    for (Eigen::Index j = 0; j < grid.axial.size(); ++j) {
      const Eigen::Index p = i * grid.axial.size() + j;
      const Eigen::Vector3d on = from_cylindrical(spec, grid.radius, grid.angle(i), grid.axial(j));
      set.labels.push_back(fmt::format("{}[{},{}]", name, i, j));
      set.position.row(p) = on;
      set.direction.row(p) = to_cylindrical(spec, on).radial;
    }
  }
}

}  // namespace

PatchCoupling contact_patches(const std::string& name, const RowMatrix& coordinates,
                              const SurfaceIntegrals& surface, const PatchGridSpec& spec,
                              const std::string& where) {
  std::vector<Cylindrical> positions;
  for (const int32_t node : surface.nodes)
    positions.push_back(to_cylindrical(spec, coordinates.row(node).transpose()));
  PatchCoupling out;
  out.grid = make_grid(spec, mean_radius(surface, positions, where));
  describe_set(name, spec, out.grid, out.coupling.set);

  const auto patches = static_cast<Eigen::Index>(out.coupling.set.labels.size());
  Eigen::VectorXd area = Eigen::VectorXd::Zero(patches);
  out.nodes_per_patch = Eigen::VectorXi::Zero(patches);
  out.coupling.disjoint = true;
  out.coupling.rows.resize(patches);
  const double dust = 1e-12 * surface.weight.cwiseAbs().maxCoeff();
  for (size_t k = 0; k < positions.size(); ++k) {
    const double weight = surface.weight(static_cast<Eigen::Index>(k));
    const Eigen::Index patch = patch_at(out.grid, positions[k]);
    // Corner nodes of flat quadratic faces have no weight and are skipped.
    if (patch < 0 || std::abs(weight) <= dust) continue;
    Functional& row = out.coupling.rows[patch];
    for (int d = 0; d < 3; ++d) {
      const double value = weight * positions[k].radial(d);
      if (value == 0.0) continue;
      row.dofs.push_back(3 * surface.nodes[k] + d);
      row.values.push_back(value);
    }
    area(patch) += weight;
    ++out.nodes_per_patch(patch);
  }
  require_area(out.grid, area, where);
  for (Eigen::Index p = 0; p < patches; ++p)
    for (double& value : out.coupling.rows[p].values) value /= area(p);
  return out;
}

}  // namespace clatter::assembly
