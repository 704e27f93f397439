// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face/face_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

// Rounding errors of zero are printed as 0; six digits suffice.
std::string short_number(double value, double size) {
  if (std::abs(value) < 1e-9 * size) value = 0.0;
  return fmt::format("{:.6g}", value);
}

std::string triple(const Vector3d& x, double size) {
  return fmt::format("({}, {}, {})", short_number(x[0], size), short_number(x[1], size),
                     short_number(x[2], size));
}

// The same in TOML and JSON syntax.
std::string list_of(const Vector3d& x, double size) {
  std::vector<std::string> parts;
  for (const double value : x)
    parts.push_back(fmt::format("{:.9g}", std::abs(value) < 1e-9 * size ? 0.0 : value));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

std::string digits(double value) { return fmt::format("{:.9g}", value); }

BoxFilter box_of(const FaceFacts& face) {
  BoxFilter box{Vector3d::Constant(1e300), Vector3d::Constant(-1e300)};
  for (const Vector3d& x : face.edge_points) {
    box.min = box.min.cwiseMin(x);
    box.max = box.max.cwiseMax(x);
  }
  if (face.edge_points.empty()) box.min = box.max = face.centre;  // a full sphere has no edges
  return box;
}

double size_of(const FaceFacts& face) {
  const BoxFilter box = box_of(face);
  return std::max({1e-300, box.max.cwiseAbs().maxCoeff(), box.min.cwiseAbs().maxCoeff()});
}

std::string kind_text(const SurfaceShape& shape) {
  return name_of(shape.kind) + (shape.is_spline ? " (spline)" : "") +
         (shape.is_concave ? ", concave" : "");
}

std::string radius_text(const SurfaceShape& shape) {
  switch (shape.kind) {
    case ShapeKind::kCylinder:
    case ShapeKind::kSphere:
      return fmt::format("{:.6g}", shape.radius);
    case ShapeKind::kTorus:
      return fmt::format("{:.6g}, {:.6g}", shape.radius, shape.minor_radius);
    case ShapeKind::kCone:
      return fmt::format("{:.4g} deg", shape.half_angle_deg);
    default:
      return "-";
  }
}

using Corners = std::array<Vector3d, 3>;

std::vector<Corners> corners_of(const FaceTriangles& drawn) {
  std::vector<Corners> corners;
  for (Eigen::Index t = 0; t < drawn.triangles.rows(); ++t) {
    Corners& c = corners.emplace_back();
    for (int i = 0; i < 3; ++i) c[i] = drawn.nodes.row(drawn.triangles(t, i));
  }
  return corners;
}

Vector3d normal_of(const Corners& c) { return (c[1] - c[0]).cross(c[2] - c[0]); }

// Moeller and Trumbore, J. Graphics Tools 2, 1997.
bool meets(const Vector3d& from, const Vector3d& along, const Corners& c) {
  const Vector3d a = c[1] - c[0], b = c[2] - c[0], p = along.cross(b), s = from - c[0];
  const double det = a.dot(p);
  if (det == 0.0) return false;
  const double u = s.dot(p) / det;
  if (u < 0.0 || u > 1.0) return false;
  const Vector3d q = s.cross(a);
  const double v = along.dot(q) / det;
  return v >= 0.0 && u + v <= 1.0 && b.dot(q) / det > 0.0;
}

/// The outward normal of triangle `own` of a closed skin.
Vector3d outward_normal(const std::vector<Corners>& skin, size_t own) {
  const std::array<Vector3d, 5> directions = {{{0.83, 0.31, 0.47},
                                               {-0.29, 0.88, 0.37},
                                               {0.41, -0.26, 0.87},
                                               {-0.7, -0.5, 0.51},
                                               {0.12, 0.67, -0.73}}};
  const Vector3d middle = (skin[own][0] + skin[own][1] + skin[own][2]) / 3.0;
  const Vector3d normal = normal_of(skin[own]).normalized();
  int votes = 0;  // for the present sign of the normal
  for (const Vector3d& along : directions) {
    int met = 0;
    for (size_t t = 0; t < skin.size(); ++t) met += t != own && meets(middle, along, skin[t]);
    const bool starts_inside = met % 2 == 1;
    votes += starts_inside == (normal.dot(along) < 0.0) ? 1 : -1;
  }
  return votes > 0 ? normal : Vector3d(-normal);
}

std::vector<std::string> surface_names(const FaceList& list, int tag) {
  std::vector<std::string> names;
  if (const auto at = list.surfaces.find(tag); at != list.surfaces.end()) names = at->second;
  return names;
}

std::string json_list(const std::vector<std::string>& texts) {
  std::vector<std::string> quoted;
  for (const std::string& text : texts) quoted.push_back(json_text(text));
  return fmt::format("[{}]", fmt::join(quoted, ", "));
}

std::string json_of(const FaceList& list, const FaceFacts& face, double margin) {
  const SurfaceShape& shape = face.shape;
  const BoxFilter box = box_of(face);
  const double size = size_of(face);
  return fmt::format(
      "{{\"number\": {}, \"named\": {}, \"kind\": \"{}\", \"spline\": {}, \"concave\": {}, "
      "\"radius\": {}, "
      "\"minor_radius\": {}, \"half_angle_deg\": {}, \"direction\": {}, \"place\": {}, "
      "\"centre\": {}, \"area\": {}, \"box\": [{}, {}], \"surfaces\": {}, \"toml\": {}}}",
      face.tag, json_text(face.name), name_of(shape.kind), shape.is_spline,
      list.oriented && is_round(shape.kind) ? fmt::format("{}", shape.is_concave) : "null",
      digits(shape.radius), digits(shape.minor_radius), digits(shape.half_angle_deg),
      list_of(shape.direction, 1.0), list_of(position_of(face), size), list_of(face.centre, size),
      digits(face.area), list_of(box.min, size), list_of(box.max, size),
      json_list(surface_names(list, face.tag)),
      json_text(fmt::format("{}", fmt::join(filter_lines(face, margin), "\n"))));
}

}  // namespace

Vector3d position_of(const FaceFacts& face) {
  const SurfaceShape& shape = face.shape;
  switch (shape.kind) {
    case ShapeKind::kCylinder:
      return shape.point + (face.centre - shape.point).dot(shape.direction) * shape.direction;
    case ShapeKind::kCone:
    case ShapeKind::kSphere:
    case ShapeKind::kTorus:
      return shape.point;
    default:
      return face.centre;
  }
}

std::vector<std::string> filter_lines(const FaceFacts& face, double margin) {
  const SurfaceShape& shape = face.shape;
  const double size = size_of(face);
  std::vector<std::string> lines;
  if (shape.kind == ShapeKind::kCylinder)
    lines.push_back(fmt::format("cylinder = {{ radius = {:.9g}, point = {}, axis = {} }}",
                                shape.radius, list_of(position_of(face), size),
                                list_of(shape.direction, 1.0)));
  if (shape.kind == ShapeKind::kPlane)
    lines.push_back(fmt::format("plane = {{ normal = {}, height = {:.9g} }}",
                                list_of(shape.direction, 1.0),
                                shape.direction.dot(face.centre) + 0.0));
  const BoxFilter box = box_of(face);
  lines.push_back(fmt::format("box = {{ min = {}, max = {} }}",
                              list_of(box.min.array() - margin, size),
                              list_of(box.max.array() + margin, size)));
  return lines;
}

std::vector<std::string> table_of(const FaceList& list) {
  const bool named =
      std::ranges::any_of(list.faces, [](const FaceFacts& face) { return !face.name.empty(); });
  std::vector<std::array<std::string, 8>> rows = {
      {"face", "kind", fmt::format("radius [{}]", list.unit), "axis or normal",
       fmt::format("position [{}]", list.unit), fmt::format("area [{}2]", list.unit),
       named ? "name" : "", "surfaces"}};
  for (const FaceFacts& face : list.faces) {
    const bool directed = face.shape.direction.norm() > 0.0;
    rows.push_back({fmt::format("{}", face.tag), kind_text(face.shape), radius_text(face.shape),
                    directed ? triple(face.shape.direction, 1.0) : "-",
                    triple(position_of(face), size_of(face)), fmt::format("{:.6g}", face.area),
                    face.name, fmt::format("{}", fmt::join(surface_names(list, face.tag), " "))});
  }
  std::array<size_t, 8> width{};
  for (const auto& row : rows)
    for (size_t c = 0; c < row.size(); ++c) width[c] = std::max(width[c], row[c].size());
  std::vector<std::string> lines;
  for (const auto& row : rows) {
    std::string line = fmt::format("{:>{}}  {:<{}}  {:>{}}  {:<{}}  {:<{}}  {:>{}}  ", row[0],
                                   width[0], row[1], width[1], row[2], width[2], row[3], width[3],
                                   row[4], width[4], row[5], width[5]);
    if (named) line += fmt::format("{:<{}}  ", row[6], width[6]);
    line += row[7];
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

JsonMembers json_of(const FaceList& list) {
  const double margin = kNearSelection * size_of_part(list.faces);
  std::vector<std::string> objects;
  for (const FaceFacts& face : list.faces) objects.push_back(json_of(list, face, margin));
  return {{"name", json_text(list.name)},
          {"unit", json_text(list.unit)},
          {"faces", fmt::format("[{}]", fmt::join(objects, ", "))}};
}

void orient_faces(FaceList& list, const FaceTriangles& drawn) {
  const std::vector<Corners> skin = corners_of(drawn);
  std::map<int, size_t> largest;  // triangle by face
  for (size_t t = 0; t < skin.size(); ++t) {
    const auto [at, is_new] = largest.emplace(drawn.faces[t], t);
    if (normal_of(skin[t]).norm() > normal_of(skin[at->second]).norm()) at->second = t;
  }
  for (FaceFacts& face : list.faces) {
    const auto at = largest.find(face.tag);
    if (at == largest.end()) continue;
    const Vector3d middle = (skin[at->second][0] + skin[at->second][1] + skin[at->second][2]) / 3.0;
    orient(face.shape, middle, outward_normal(skin, at->second));
  }
  list.oriented = true;
}

void write_faces(H5File& file, const FaceList& list, const FaceTriangles& drawn,
                 double metres_per_unit) {
  const auto count = static_cast<Eigen::Index>(list.faces.size());
  std::vector<int32_t> numbers;
  std::vector<std::string> kinds, named, names;
  std::vector<double> radii, areas;
  RowMatrix direction(count, 3), position(count, 3);
  for (Eigen::Index f = 0; f < count; ++f) {
    const FaceFacts& face = list.faces[f];
    numbers.push_back(face.tag);
    kinds.push_back(kind_text(face.shape));
    named.push_back(face.name);
    names.push_back(fmt::format("{}", fmt::join(surface_names(list, face.tag), " ")));
    radii.push_back(metres_per_unit * face.shape.radius);
    areas.push_back(metres_per_unit * metres_per_unit * face.area);
    direction.row(f) = face.shape.direction.transpose();
    position.row(f) = metres_per_unit * position_of(face).transpose();
  }
  file.set("/", "name", list.name);
  file.write("number", numbers);
  file.write("kind", kinds);
  file.write("named", named);
  file.write("radius", radii);
  file.write("direction", direction);
  file.write("place", position);
  file.write("area", areas);
  file.write("surfaces", names);
  file.write("nodes", RowMatrix(metres_per_unit * drawn.nodes));
  file.write("triangles", drawn.triangles);
  file.write("triangle_face", std::vector<int32_t>(drawn.faces.begin(), drawn.faces.end()));
}

}  // namespace clatter::mesh
