// SPDX-License-Identifier: GPL-3.0-or-later
// CFAST with PFAST and CWELD with PWELD: springs along three axes and about them at the middle
// between two points of the joined sheets. An end moves as the four corners of a square with the
// area of the fastener do on its sheet, in the mean (MSC Nastran Quick Reference Guide, CFAST and
// CWELD).
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include "core/mesh/shape.hpp"
#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/nearest_face.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using End = RawFastener::End;

constexpr double kNoLength = 1e-9;  // of the diameter
constexpr double kReach = 10.0;     // diameters from GS to the sheets

/// A sum of coefficients times displacements and rotations.
using Form = std::map<std::pair<NodeIndex, int>, double>;

void add(double factor, const Form& of, Form& to) {
  if (factor == 0.0) return;
  for (const auto& [dof, coefficient] : of) to[dof] += factor * coefficient;
}

/// The motion of one end.
struct EndMotion {
  Vector3d at, normal = Vector3d::Zero();
  std::array<Form, 3> u, theta;
  std::map<NodeIndex, double> shares;  // of a mass there
  double thickness = 0.0;              // of the sheet
};

class Fasteners {
 public:
  explicit Fasteners(Model& model) : model_(model), search_(model.deck.mesh) {
    for (const RawSkin& shell : model.raw.shell_cells) property_[shell.id] = shell.property;
    const std::vector<ShellBlock>& blocks = model.deck.mesh.shells;
    for (size_t b = 0; b < blocks.size(); ++b)
      for (size_t row = 0; row < blocks[b].ids.size(); ++row)
        shells_[blocks[b].ids[row]] = {b, static_cast<Eigen::Index>(row)};
  }

  void add(const RawFastener& raw) {
    raw_ = &raw;
    const auto found = model_.raw.fastener_properties.find(raw.property);
    const char* card = raw.card == "CFAST" ? "PFAST" : "PWELD";
    if (found == model_.raw.fastener_properties.end() || found->second.card != card)
      fail(fmt::format("found no {} {}", card, raw.property));
    const RawFastenerProperty& property = found->second;
    std::array<EndMotion, 2> ends;
    for (size_t end = 0; end < 2; ++end) ends[end] = motion_of(end, property.diameter);
    const bool is_weld = raw.card == "CWELD";
    const Matrix3d axes = axes_of(property, ends);
    const double length = (ends[1].at - ends[0].at).norm();
    add_springs(ends, axes, is_weld ? stiffness_of(property, ends, length) : property.stiffness,
                is_weld ? 0.0 : property.loss_factor);
    add_mass(ends, is_weld ? weld_mass(property, length) : property.mass);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    model_.source.fail(raw_->origin, fmt::format("{} {}: {}", raw_->card, raw_->id, message));
  }

  Vector3d grid_at(int32_t grid) const {
    const int32_t row = model_.grids.find(grid);
    if (row < 0) fail(fmt::format("found no GRID {}", grid));
    return vector(model_.raw.grids.at[static_cast<size_t>(row)]);
  }

  /// What is projected on an end's sheet.
  Vector3d place_of(size_t end) const {
    if (raw_->piercing[end] != 0) return grid_at(raw_->piercing[end]);
    if (raw_->place != 0) return grid_at(raw_->place);
    if (raw_->at) return vector(*raw_->at);
    return grid_at(raw_->piercing[0]);
  }

  EndMotion motion_of(size_t end, double diameter) {
    if (raw_->kinds[end] == End::kGrid) return of_grid(raw_->numbers[end]);
    return of_sheet(end, diameter);
  }

  EndMotion of_grid(int32_t grid) {
    EndMotion out;
    const NodeIndex node = model_.require(grid, raw_->origin);
    out.at = model_.node_map.position(node);
    const bool turns = model_.node_map.turns(node);
    for (int d = 0; d < 3; ++d) {
      out.u[static_cast<size_t>(d)][{node, d}] = 1.0;
      if (turns) out.theta[static_cast<size_t>(d)][{node, 3 + d}] = 1.0;
    }
    out.shares[node] = 1.0;
    return out;
  }

  /// The nearest point of what the card names on this side.
  std::optional<FacePoint> nearest(size_t end, const Vector3d& point, double reach) const {
    const Mesh& mesh = model_.deck.mesh;
    if (raw_->kinds[end] == End::kGrids) {
      NodeFace face;
      const std::vector<int32_t>& grids = raw_->grids[end];
      for (const FaceType type :
           {FaceType::kTri3, FaceType::kQuad4, FaceType::kTri6, FaceType::kQuad8})
        if (static_cast<size_t>(traits(type).nodes) == grids.size()) face.type = type;
      for (size_t i = 0; i < grids.size(); ++i) {
        face.nodes[i] = model_.find(grids[i], raw_->origin);
        if (face.nodes[i] < 0 || face.nodes[i] >= mesh.nodes.rows())
          fail(fmt::format("GRID {} belongs to no cell, expected those of a patch", grids[i]));
      }
      return nearest_point(face, mesh.nodes, point);
    }
    const int32_t number = raw_->numbers[end];
    if (raw_->kinds[end] == End::kProperty)
      return search_.nearest(point, reach, [&](size_t block, Eigen::Index row) {
        const auto of = property_.find(mesh.shells[block].ids[static_cast<size_t>(row)]);
        return of != property_.end() && of->second == number;
      });
    // The shell and those around it: another sheet may have the same property.
    const auto named = shells_.find(number);
    if (named == shells_.end()) fail(fmt::format("found no shell {}", number));
    const auto own = mesh.shells[named->second.first].nodes.row(named->second.second);
    return search_.nearest(point, reach, [&](size_t block, Eigen::Index row) {
      const auto nodes = mesh.shells[block].nodes.row(row);
      return std::find_first_of(own.begin(), own.end(), nodes.begin(), nodes.end()) != own.end();
    });
  }

  EndMotion of_sheet(size_t end, double diameter) {
    const double reach = kReach * diameter + search_.size();
    model_.spend(1000, raw_->origin);
    const auto centre = nearest(end, place_of(end), reach);
    if (!centre) {
      const Vector3d at = place_of(end);
      fail(fmt::format("found no shell of {} {} within {:.4g} of ({:.6g}, {:.6g}, {:.6g})",
                       raw_->kinds[end] == End::kShell ? "the sheet of shell" : "property",
                       raw_->numbers[end], reach, at.x(), at.y(), at.z()));
    }
    // A square of the fastener's area about the centre, on the sheet.
    const double half = 0.25 * std::sqrt(std::numbers::pi) * diameter;
    const Vector3d first = centre->normal.unitOrthogonal(), second = centre->normal.cross(first);
    std::vector<FacePoint> corners;
    for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
      const auto corner = nearest(end, centre->x + half * (a * first + b * second), reach);
      if (corner) corners.push_back(*corner);
    }
    return mean_motion(*centre, corners);
  }

  /// The motion of the corners as those of a rigid body in the mean of squares, at the centre.
  EndMotion mean_motion(const FacePoint& centre, const std::vector<FacePoint>& corners) const {
    EndMotion out;
    out.at = centre.x;
    out.normal = centre.normal;
    out.thickness = thickness_at(centre);
    Vector3d middle = Vector3d::Zero();
    const double share = 1.0 / static_cast<double>(corners.size());
    for (const FacePoint& corner : corners) middle += share * corner.x;
    Matrix3d inertia = Matrix3d::Zero();
    for (const FacePoint& corner : corners) {
      const Vector3d arm = corner.x - middle;
      inertia += arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose();
    }
    const Matrix3d inverse = inertia.inverse();
    if (!inverse.allFinite()) fail("its patch is a line, expected a face of some width");
    for (const FacePoint& corner : corners) {
      const FaceShape shape = face_shape(corner.face.type, corner.at);
      const Vector3d arm = corner.x - middle;
      for (Eigen::Index i = 0; i < shape.value.size(); ++i) {
        const NodeIndex node = corner.face.nodes[static_cast<size_t>(i)];
        for (int d = 0; d < 3; ++d) {
          // theta = I^-1 sum of arm x u.
          const Vector3d turn = inverse * arm.cross(shape.value(i) * Vector3d::Unit(d));
          for (int e = 0; e < 3; ++e) out.theta[static_cast<size_t>(e)][{node, d}] += turn(e);
          out.u[static_cast<size_t>(d)][{node, d}] += share * shape.value(i);
        }
      }
      spread(corner, share, out.shares);
    }
    const Vector3d beside = centre.x - middle;  // u = mean + theta x beside
    for (int d = 0; d < 3; ++d) {
      const size_t next = static_cast<size_t>((d + 1) % 3), last = static_cast<size_t>((d + 2) % 3);
      nastran::add(beside[static_cast<Eigen::Index>(last)], out.theta[next],
                   out.u[static_cast<size_t>(d)]);
      nastran::add(-beside[static_cast<Eigen::Index>(next)], out.theta[last],
                   out.u[static_cast<size_t>(d)]);
    }
    return out;
  }

  /// Linear between the corners of the face, none below 0.
  static void spread(const FacePoint& point, double share, std::map<NodeIndex, double>& shares) {
    const FaceType linear =
        traits(point.face.type).corners == 3 ? FaceType::kTri3 : FaceType::kQuad4;
    const FaceShape shape = face_shape(linear, point.at);
    for (Eigen::Index i = 0; i < shape.value.size(); ++i)
      shares[point.face.nodes[static_cast<size_t>(i)]] += share * std::max(shape.value(i), 0.0);
  }

  /// 0 of a face that is no shell.
  double thickness_at(const FacePoint& point) const {
    if (point.row < 0) return 0.0;
    const ShellBlock& block = model_.deck.mesh.shells[point.block];
    if (block.thickness.size() > 0) return block.thickness.row(point.row).mean();
    const std::string& region = model_.deck.mesh.regions[static_cast<size_t>(block.region)];
    for (const recipe::Shell& shell : model_.deck.shells)
      if (std::ranges::find(shell.regions, region) != shell.regions.end()) return shell.thickness();
    return 0.0;
  }

  /// 1 along the fastener; 2 along the basic axis that is most across it, projected, or with 1 in
  /// the plane of axis 2 of MCID; or the axes of MCID.
  Matrix3d axes_of(const RawFastenerProperty& property, const std::array<EndMotion, 2>& ends) {
    const Vector3d between = ends[1].at - ends[0].at;
    const bool has_length = between.norm() > kNoLength * property.diameter;
    const Matrix3d given =
        property.system < 0 ? Matrix3d::Identity()
                            : model_.systems.directions(property.system, ends[0].at, raw_->origin);
    if (property.system >= 0 && property.is_absolute) return given;
    Matrix3d axes;
    axes.col(0) = has_length ? between.normalized() : ends[0].normal;
    if (axes.col(0).isZero(0.0)) fail("its ends are at one point and have no sheet");
    Vector3d second = given.col(1);
    if (property.system < 0) {
      Eigen::Index across = 0;
      axes.col(0).cwiseAbs().minCoeff(&across);
      second = Vector3d::Unit(across);
    }
    const Vector3d third = axes.col(0).cross(second);
    if (!(third.norm() > 1e-6)) fail("axis 2 of its MCID is along it, expected one across");
    axes.col(2) = third.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }

  /// Of a round bar with its shear (factor 0.9), about its middle.
  std::array<double, 6> stiffness_of(const RawFastenerProperty& property,
                                     const std::array<EndMotion, 2>& ends, double length) {
    use_material(model_, fmt::format("PWELD {}", raw_->property), property.material,
                 property.origin);
    const Material material = material_of(model_, property.material);
    if (material.kind != Material::Kind::kIsotropic) fail("its material is no MAT1");
    const double E = material.constants[0], G = E / (2.0 * (1.0 + material.constants[1]));
    const double D = property.diameter, area = std::numbers::pi * D * D / 4.0;
    const double I = area * D * D / 16.0;
    const double measured =
        property.is_spot ? 0.5 * (ends[0].thickness + ends[1].thickness) : length;
    const double L = std::clamp(measured, property.shortest * D, property.longest * D);
    const double shear = 0.9 * G * area, bending = 12.0 * E * I;
    const double across = shear * bending / (L * (shear * length * length + bending));
    return {E * area / L, across, across, 2.0 * G * I / L, E * I / L, E * I / L};
  }

  double weld_mass(const RawFastenerProperty& property, double length) const {
    const double D = property.diameter;
    return material_of(model_, property.material).density * std::numbers::pi / 4.0 * D * D * length;
  }

  void add_springs(const std::array<EndMotion, 2>& ends, const Matrix3d& axes,
                   const std::array<double, 6>& stiffness, double loss) {
    const Vector3d centre = 0.5 * (ends[0].at + ends[1].at);
    for (int k = 0; k < 6; ++k) {
      const double value = stiffness[static_cast<size_t>(k)];
      if (!(value > 0.0)) continue;
      const Vector3d t = axes.col(k % 3);
      Form form;
      for (size_t end = 0; end < 2; ++end) {
        const double sign = end == 0 ? -1.0 : 1.0;
        const Vector3d lever = (centre - ends[end].at).cross(t);
        for (int d = 0; d < 3; ++d) {
          const auto i = static_cast<size_t>(d);
          nastran::add(sign * t(d), k < 3 ? ends[end].u[i] : ends[end].theta[i], form);
          if (k < 3) nastran::add(sign * lever(d), ends[end].theta[i], form);
        }
      }
      Spring spring{model_.source.where(raw_->origin), value, {}, loss};
      for (const auto& [dof, coefficient] : form)
        add_term(spring.terms, dof.first, dof.second, coefficient);
      if (!spring.terms.empty()) model_.deck.springs.push_back(std::move(spring));
    }
  }

  void add_mass(const std::array<EndMotion, 2>& ends, double mass) {
    if (!(mass > 0.0)) return;
    std::map<NodeIndex, double> all;
    for (const EndMotion& end : ends)
      for (const auto& [node, share] : end.shares) all[node] += 0.5 * share;
    for (const auto& [node, share] : all)
      if (share > 0.0)
        model_.deck.masses.push_back({model_.source.where(raw_->origin), node,
                                      model_.raw.control.mass_factor * share * mass});
  }

  Model& model_;
  ShellSearch search_;
  // By the number of each shell.
  std::unordered_map<int32_t, int32_t> property_;
  std::unordered_map<int32_t, std::pair<size_t, Eigen::Index>> shells_;  // block and row
  const RawFastener* raw_ = nullptr;
};

}  // namespace

void build_fasteners(Model& model) {
  if (model.raw.fasteners.empty()) return;
  Fasteners fasteners(model);
  for (const RawFastener& raw : model.raw.fasteners)
    model.refusals.attempt([&] { fasteners.add(raw); });
}

}  // namespace clatter::mesh::deck::nastran
