// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/list_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/wire.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/part/gmsh_in_child.hpp"

namespace clatter::mesh {

template <class Archive, SelfOf<SurfaceShape> Self>
void wire(Archive& archive, Self& s) {
  auto& [kind, is_spline, is_concave, radius, minor_radius, half_angle, direction, point] = s;
  archive(kind, is_spline, is_concave, radius, minor_radius, half_angle, direction, point);
}

template <class Archive, SelfOf<FaceFacts> Self>
void wire(Archive& archive, Self& s) {
  auto& [tag, kind, name, area, radius, shape, centre, edge_points, surface_points] = s;
  archive(tag, kind, name, area, radius, shape, centre, edge_points, surface_points);
}

template <class Archive, SelfOf<FaceList> Self>
void wire(Archive& archive, Self& s) {
  auto& [name, unit, volume, oriented, faces, surfaces] = s;
  archive(name, unit, volume, oriented, faces, surfaces);
}

template <class Archive, SelfOf<FaceTriangles> Self>
void wire(Archive& archive, Self& s) {
  auto& [nodes, triangles, faces] = s;
  archive(nodes, triangles, faces);
}

template <class Archive, SelfOf<ListedFaces> Self>
void wire(Archive& archive, Self& s) {
  auto& [list, drawn, metres] = s;
  archive(list, drawn, metres);
}

namespace {

void name_faces(const PartGeometry& part, const std::string& where, FaceList& list) {
  const SelectionScale scale{size_of_part(list.faces), part.unit};
  for (const NamedSurface& surface : part.surfaces) {
    try {
      const Selection selection = select_faces(list.faces, surface, scale, where);
      for (const std::string& warning : selection.warnings) warn(warning);
      for (const std::string& remark : selection.remarks) say(remark);
      for (const int tag : selection.tags) list.surfaces[tag].push_back(surface.name);
    } catch (const InputError& nothing) {
      warn(nothing.what());
    }
  }
}

FaceTriangles triangles_of(GmshSession& session, const FaceList& list) {
  const double size = size_of_part(list.faces);
  SizeSettings sizes;
  sizes.size = size / 30;
  sizes.min_size = size / 120;  // long narrow bores would make most of the triangles
  sizes.per_turn = 24;
  const RawMesh skin = session.generate_skin(sizes, 1);
  FaceTriangles drawn;
  drawn.nodes = skin.nodes;
  Eigen::Index count = 0;
  for (const FaceFacts& face : list.faces) count += skin.face_cells.at(face.tag).rows();
  drawn.triangles.resize(count, 3);
  count = 0;
  for (const FaceFacts& face : list.faces) {
    const IndexMatrix& cells = skin.face_cells.at(face.tag);
    drawn.triangles.middleRows(count, cells.rows()) = cells;
    count += cells.rows();
    drawn.faces.insert(drawn.faces.end(), static_cast<size_t>(cells.rows()), face.tag);
  }
  return drawn;
}

}  // namespace

ListedFaces list_faces(const PartFile& file, const std::string& where, bool triangles) {
  const LengthUnit& unit = file.shape.unit;
  ListedFaces result;
  result.list.name = file.name;
  result.list.unit = unit.name;
  result.metres = unit.metres;
  GmshSession session(result.list.name);
  const PartGeometry part = build_part(session, file.shape);
  result.list.volume = session.volume(session.all_solids());
  result.list.faces = session.boundary_faces();
  name_faces(part, where, result.list);
  if (!triangles) return result;
  try {
    result.drawn = triangles_of(session, result.list);
    if (!part.sheet) orient_faces(result.list, result.drawn);  // a sheet encloses nothing
  } catch (const NumericsError& failed) {
    warn(fmt::format("{}: the faces cannot be drawn, and their outer side is unknown: {}", where,
                     failed.what()));
  }
  return result;
}

ListedFaces list_faces_in_child(const PartFile& file, const std::string& where, bool triangles,
                                const ChildLimits& limits) {
  const auto attempt = [&](bool with_triangles) {
    return run_in_child(with_news(limits),
                        [&] { return to_wire(list_faces(file, where, with_triangles)); });
  };
  ChildEnd end = attempt(triangles);
  const bool fell = !end.done() && end.kind != ChildEnd::Kind::kTimeLimit &&
                    end.kind != ChildEnd::Kind::kMemoryLimit;
  if (triangles && fell) {
    warn(fmt::format(
        "{}: {}: the faces are listed without triangles, and their outer side is unknown", where,
        describe_end(end, limits)));
    end = attempt(false);
  }
  if (!end.done()) throw NumericsError(fmt::format("{}: {}", where, describe_end(end, limits)));
  return from_wire<ListedFaces>(end.result);
}

double default_element_size(const FaceList& list) {
  constexpr double kCells = 30000.0, kOfSize = 0.1;
  const double of_volume = std::cbrt(6.0 * std::sqrt(2.0) * list.volume / kCells);
  const double size = std::min(of_volume, kOfSize * size_of_part(list.faces));
  const double digit = std::pow(10.0, std::floor(std::log10(size)) - 1.0);
  return digit * std::round(size / digit);
}

}  // namespace clatter::mesh
