#include "mesh/select.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace clatter::mesh {
namespace {

bool inside(const BoxFilter& box, const Eigen::Vector3d& x, double tolerance) {
  return (x.array() >= box.min.array() - tolerance).all() &&
         (x.array() <= box.max.array() + tolerance).all();
}

bool on_cylinder(const CylinderFilter& cylinder, const Eigen::Vector3d& x, double tolerance) {
  const double distance = (x - cylinder.point).cross(cylinder.axis).norm();
  return std::abs(distance - cylinder.radius) <= tolerance;
}

bool on_plane(const PlaneFilter& plane, const Eigen::Vector3d& x, double tolerance) {
  return std::abs(plane.normal.dot(x) - plane.height) <= tolerance;
}

template <class Test>
bool everywhere(const FaceFacts& face, const Test& test) {
  return std::all_of(face.edge_points.begin(), face.edge_points.end(), test) &&
         std::all_of(face.surface_points.begin(), face.surface_points.end(), test);
}

// The carrying surface may reach beyond the face: only the edges bound it.
bool wholly_inside(const FaceFacts& face, const BoxFilter& box, double tolerance) {
  return std::all_of(face.edge_points.begin(), face.edge_points.end(),
                     [&](const Eigen::Vector3d& x) { return inside(box, x, tolerance); });
}

Eigen::Vector3d vector_of(const Config& config, std::string_view key) {
  const std::vector<double> v = config.numbers(key, 3);
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d direction_of(const Config& config, std::string_view key) {
  const Eigen::Vector3d v = vector_of(config, key);
  if (v.norm() == 0.0) config.fail(key, "found a zero vector, expected a direction");
  return v.normalized();
}

BoxFilter read_box(const Config& config) {
  const BoxFilter box{vector_of(config, "min"), vector_of(config, "max")};
  if ((box.min.array() > box.max.array()).any()) config.fail("min", "expected min <= max");
  return box;
}

SurfaceFilter read_filter(const Config& table, const std::string& name) {
  SurfaceFilter filter;
  if (const auto c = table.find_table("cylinder")) {
    filter.cylinder = CylinderFilter{c->number("radius", Range::positive()), vector_of(*c, "point"),
                                     direction_of(*c, "axis")};
  }
  if (const auto p = table.find_table("plane")) {
    filter.plane = PlaneFilter{direction_of(*p, "normal"), p->number("height")};
  }
  if (const auto b = table.find_table("box")) filter.box = read_box(*b);
  if (const auto b = table.find_table("outside")) filter.outside.push_back(read_box(*b));
  if (!filter.cylinder && !filter.plane && !filter.box && filter.outside.empty()) {
    throw InputError(
        fmt::format("{}: surface.{}: found no filter, expected cylinder, plane, box or outside",
                    table.where(), name));
  }
  return filter;
}

}  // namespace

bool matches(const FaceFacts& face, const SurfaceFilter& filter, double tolerance) {
  using Point = const Eigen::Vector3d&;
  if (filter.cylinder &&
      !everywhere(face, [&](Point x) { return on_cylinder(*filter.cylinder, x, tolerance); })) {
    return false;
  }
  if (filter.plane &&
      !everywhere(face, [&](Point x) { return on_plane(*filter.plane, x, tolerance); })) {
    return false;
  }
  if (filter.box && !wholly_inside(face, *filter.box, tolerance)) return false;
  return std::none_of(filter.outside.begin(), filter.outside.end(),
                      [&](const BoxFilter& box) { return wholly_inside(face, box, tolerance); });
}

std::vector<int> select_faces(const std::vector<FaceFacts>& faces, const NamedSurface& surface,
                              double tolerance, const std::string& where) {
  std::vector<int> tags;
  for (const FaceFacts& face : faces) {
    const bool found =
        std::any_of(surface.filters.begin(), surface.filters.end(),
                    [&](const SurfaceFilter& f) { return matches(face, f, tolerance); });
    if (found) tags.push_back(face.tag);
  }
  if (tags.empty()) {
    throw InputError(fmt::format("{}: surface '{}' selects no face; the part has {}", where,
                                 surface.name, describe_faces(faces)));
  }
  std::sort(tags.begin(), tags.end());
  return tags;
}

std::vector<NamedSurface> read_named_surfaces(const Config& config) {
  std::vector<NamedSurface> surfaces;
  const auto tables = config.find_table("surface");
  if (!tables) return surfaces;
  for (const std::string& name : tables->keys()) {
    if (name == "skin") tables->fail(name, "the name 'skin' is taken: it is the whole boundary");
    surfaces.push_back({name, {read_filter(tables->table(name), name)}});
  }
  return surfaces;
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
