// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face/select.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "core/base/error.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

// Distance of x outside the box; negative inside: its depth.
double outside_by(const BoxFilter& box, const Vector3d& x) {
  return std::max((box.min - x).maxCoeff(), (x - box.max).maxCoeff());
}

// Of the edges: the underlying surface may extend beyond the face, only the edges bound it.
double outside_by(const BoxFilter& box, const FaceFacts& face) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& x : face.edge_points) largest = std::max(largest, outside_by(box, x));
  return largest;
}

template <class Distance>
double largest(const FaceFacts& face, const Distance& distance) {
  double result = 0.0;
  for (const auto* points : {&face.edge_points, &face.surface_points})
    for (const Vector3d& x : *points) result = std::max(result, std::abs(distance(x)));
  return result;
}

std::string describe_names(const std::vector<FaceFacts>& faces) {
  constexpr size_t kListed = 12;
  std::set<std::string> names;
  for (const FaceFacts& face : faces)
    if (!face.name.empty()) names.insert(face.name);
  if (names.empty())
    return "no face has a name: STEP files alone have them, where the CAD program wrote any";
  const std::vector<std::string> some(names.begin(),
                                      std::next(names.begin(), std::min(kListed, names.size())));
  return fmt::format("its faces have the names {}{}", fmt::join(some, ", "),
                     names.size() > kListed ? fmt::format(", ... ({})", names.size()) : "");
}

/// A face and its nearest filter.
struct Candidate {
  const FaceFacts* face;
  const SurfaceFilter* filter;
  double distance;
  bool like;  // of the kind of the filter
};

bool is_like(const FaceFacts& face, const SurfaceFilter& filter) {
  return (!filter.cylinder || face.shape.kind == ShapeKind::kCylinder) &&
         (!filter.plane || face.shape.kind == ShapeKind::kPlane);
}

// Nearest first; among those too far to be selected, the right kind first.
std::vector<Candidate> candidates(const std::vector<FaceFacts>& faces, const NamedSurface& surface,
                                  double exact) {
  std::vector<Candidate> found;
  for (const FaceFacts& face : faces) {
    Candidate best{&face, nullptr, std::numeric_limits<double>::infinity(), false};
    for (const SurfaceFilter& filter : surface.filters) {
      const double distance = distance_from(face, filter, exact);
      if (distance < best.distance) best = {&face, &filter, distance, is_like(face, filter)};
    }
    if (best.filter != nullptr) found.push_back(best);
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  return found;
}

double degrees_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) * 180.0 / std::numbers::pi;
}

// "radius 0.5 mm more, axis 0.005 mm away, turned by 2 deg", without matching values.
std::string cylinder_offsets(const FaceFacts& face, const CylinderFilter& wanted,
                             const std::string& unit) {
  constexpr double kShown = 1e-9, kShownDegrees = 1e-4;
  const SurfaceShape& shape = face.shape;
  std::vector<std::string> parts;
  const double more = shape.radius - wanted.radius;
  if (std::abs(more) > kShown * wanted.radius)
    parts.push_back(
        fmt::format("radius {:.3g} {} {}", std::abs(more), unit, more > 0 ? "more" : "less"));
  const Vector3d beside =
      shape.point + (face.centre - shape.point).dot(shape.direction) * shape.direction;
  const double away = (beside - wanted.point).cross(wanted.axis).norm();
  if (away > kShown * wanted.radius)
    parts.push_back(fmt::format("axis {:.3g} {} away", away, unit));
  const double turned = degrees_between(shape.direction, wanted.axis);
  if (turned > kShownDegrees) parts.push_back(fmt::format("axis turned by {:.3g} deg", turned));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string plane_offsets(const FaceFacts& face, const PlaneFilter& wanted,
                          const std::string& unit) {
  constexpr double kShownDegrees = 1e-4;
  const double turned = degrees_between(face.shape.direction, wanted.normal);
  if (turned > kShownDegrees) return fmt::format("turned by {:.3g} deg", turned);
  const double height = wanted.normal.dot(face.centre);
  return fmt::format("at height {:.9g}, {:.3g} {} away", height, std::abs(height - wanted.height),
                     unit);
}

// "face 17, cylinder of radius 46.5 mm, axis 0.005 mm away".
std::string describe_candidate(const Candidate& candidate, const std::string& unit) {
  const FaceFacts& face = *candidate.face;
  const SurfaceFilter& filter = *candidate.filter;
  std::vector<std::string> parts = {fmt::format("face {}", face.tag), describe(face.shape, unit)};
  std::string offsets;
  if (filter.cylinder && face.shape.kind == ShapeKind::kCylinder)
    offsets = cylinder_offsets(face, *filter.cylinder, unit);
  if (filter.plane && face.shape.kind == ShapeKind::kPlane)
    offsets = plane_offsets(face, *filter.plane, unit);
  if (!offsets.empty()) parts.push_back(offsets);
  const double out = filter.box ? outside_by(*filter.box, face) : 0.0;
  if (out >= candidate.distance && out > 0.0)
    parts.push_back(fmt::format("extends {:.3g} {} out of the box", out, unit));
  else if (offsets.empty())
    parts.push_back(fmt::format("up to {:.3g} {} off", candidate.distance, unit));
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string describe_nearest(std::vector<Candidate> found, const std::string& unit) {
  constexpr size_t kNamed = 3;
  if (found.empty()) return "";
  std::stable_partition(found.begin(), found.end(), [](const Candidate& c) { return c.like; });
  std::vector<std::string> named;
  for (size_t i = 0; i < std::min(kNamed, found.size()); ++i)
    named.push_back(describe_candidate(found[i], unit));
  return fmt::format("nearest: {}; ", fmt::join(named, "; "));
}

const keys::Keys<BoxFilter>& box_keys() {
  static const keys::Keys<BoxFilter> keys(
      "box", "a box along the axes", [](auto& key, BoxFilter& box) {
        key.vector("min", box.min, {}, "lower corner").required().shown_in("length_unit");
        key.vector("max", box.max, {}, "upper corner").required().shown_in("length_unit");
        key.check([](const Config& table, BoxFilter& b) {
          if ((b.min.array() > b.max.array()).any()) table.fail("min", "expected min <= max");
        });
      });
  return keys;
}

const keys::Keys<CylinderFilter>& cylinder_keys() {
  static const keys::Keys<CylinderFilter> keys(
      "cylinder", "faces on a cylinder", [](auto& key, CylinderFilter& cylinder) {
        key.number("radius", cylinder.radius, Range::positive(), "radius of the cylinder")
            .required()
            .shown_in("length_unit");
        key.vector("point", cylinder.point, {}, "a point of its axis")
            .required()
            .shown_in("length_unit");
        key.direction("axis", cylinder.axis, "direction of its axis").required();
      });
  return keys;
}

const keys::Keys<PlaneFilter>& plane_keys() {
  static const keys::Keys<PlaneFilter> keys(
      "plane", "faces in a plane", [](auto& key, PlaneFilter& plane) {
        key.direction("normal", plane.normal, "normal of the plane").required();
        key.number("height", plane.height, {},
                   "distance of the plane from the origin along the normal")
            .required()
            .shown_in("length_unit");
      });
  return keys;
}

}  // namespace

double distance_from(const FaceFacts& face, const SurfaceFilter& filter, double exact) {
  double distance = 0.0;
  if (!filter.named.empty() && face.name != filter.named)
    return std::numeric_limits<double>::infinity();
  if (const auto& c = filter.cylinder)
    distance = largest(
        face, [&](const Vector3d& x) { return (x - c->point).cross(c->axis).norm() - c->radius; });
  if (const auto& p = filter.plane)
    distance = std::max(
        distance, largest(face, [&](const Vector3d& x) { return p->normal.dot(x) - p->height; }));
  if (filter.box) distance = std::max(distance, outside_by(*filter.box, face));
  for (const BoxFilter& box : filter.outside)
    if (outside_by(box, face) <= exact) return std::numeric_limits<double>::infinity();
  return distance;
}

bool matches(const FaceFacts& face, const SurfaceFilter& filter, double tolerance) {
  return distance_from(face, filter, tolerance) <= tolerance;
}

Selection select_faces(const std::vector<FaceFacts>& faces, const NamedSurface& surface,
                       const SelectionScale& scale, const std::string& where) {
  const bool own = surface.tolerance > 0.0;
  const double exact = own ? surface.tolerance : kExactSelection * scale.size;
  const double near = own ? surface.tolerance : kNearSelection * scale.size;
  const std::vector<Candidate> found = candidates(faces, surface, exact);
  const bool any_exact = !found.empty() && found.front().distance <= exact;
  const auto is_near = [&](const Candidate& c) { return c.distance > exact && c.distance <= near; };
  Selection selection;
  for (const Candidate& c : found)
    if (c.distance <= (any_exact ? exact : near)) selection.tags.push_back(c.face->tag);
  if (selection.tags.empty()) {
    const auto by_name = std::ranges::find_if(
        surface.filters, [](const SurfaceFilter& filter) { return !filter.named.empty(); });
    const bool unknown = found.empty() && by_name != surface.filters.end();
    throw InputError(unknown ? fmt::format("{}: surface '{}': found no face named '{}'; {}", where,
                                           surface.name, by_name->named, describe_names(faces))
                             : fmt::format("{}: surface '{}' selects no face; {}the part has {}",
                                           where, surface.name, describe_nearest(found, scale.unit),
                                           describe_faces(faces)));
  }
  for (const Candidate& c : found) {
    if (!is_near(c)) continue;
    auto& lines = any_exact ? selection.remarks : selection.warnings;
    lines.push_back(fmt::format(
        "{}: surface '{}': {}, is {}: tolerance = {:.2g} in [surface.{}] {}", where, surface.name,
        describe_candidate(c, scale.unit), any_exact ? "left out" : "taken as none is closer",
        1.1 * c.distance, surface.name, any_exact ? "includes it" : "confirms it"));
  }
  std::sort(selection.tags.begin(), selection.tags.end());
  return selection;
}

const keys::Keys<SurfaceTable>& surface_keys() {
  static const keys::Keys<SurfaceTable> keys(
      "surface",
      "faces that are found by their position or name; all filters that are given must match",
      [](auto& key, SurfaceTable& surface) {
        key.text("named", surface.filter.named, "name of the faces in the STEP file");
        key.table("cylinder", surface.filter.cylinder, cylinder_keys());
        key.table("plane", surface.filter.plane, plane_keys());
        key.table("box", surface.filter.box, box_keys(), "faces inside a box along the axes");
        key.table("outside", surface.outside, box_keys(), "no faces inside a box along the axes");
        key.number("tolerance", surface.tolerance, Range::positive(),
                   "largest distance of a face from the filters; without it 1e-6 of the part's "
                   "size, or 1e-4 with a warning")
            .shown_in("length_unit");
        key.check([](const Config& table, SurfaceTable& s) {
          if (s.outside) s.filter.outside.push_back(*s.outside);
          if (!s.filter.cylinder && !s.filter.plane && !s.filter.box && !s.outside &&
              s.filter.named.empty())
            table.fail("cylinder", "give cylinder, plane, box, outside or named");
        });
      });
  return keys;
}

std::vector<NamedSurface> named_surfaces(const Config& config,
                                         const std::map<std::string, SurfaceTable>& tables) {
  std::vector<NamedSurface> surfaces;
  for (const auto& [name, table] : tables) {
    if (name == "skin")
      config.table("surface").fail(name, "the name 'skin' is reserved for the entire boundary");
    surfaces.push_back({name, {table.filter}, table.tolerance});
  }
  return surfaces;
}

double size_of_part(const std::vector<FaceFacts>& faces) {
  Vector3d low = Vector3d::Constant(1e300), high = -low;
  for (const FaceFacts& face : faces)
    for (const Vector3d& x : face.edge_points) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
  return (high - low).norm();
}

std::string describe_faces(const std::vector<FaceFacts>& faces) {
  std::map<std::string, int> radii;  // text of the radius -> count
  int planes = 0, others = 0;
  for (const FaceFacts& face : faces) {
    if (face.kind == "Plane") {
      ++planes;
    } else if (face.radius > 0.0) {
      ++radii[fmt::format("{:.6g}", face.radius)];
    } else {
      ++others;
    }
  }
  std::vector<std::string> cylinders;
  for (const auto& [radius, count] : radii) {
    cylinders.push_back(fmt::format("{} ({})", radius, count));
  }
  return fmt::format("{} planes, cylinders of radius {}, {} other faces", planes,
                     cylinders.empty() ? "- (0)" : fmt::format("{}", fmt::join(cylinders, ", ")),
                     others);
}

}  // namespace clatter::mesh
