// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/cgal_wrap.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/alpha_wrap_3.h>

#include <array>
#include <vector>

namespace clatter::recover {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using WrapMesh = CGAL::Surface_mesh<Point>;

std::vector<Point> points_of(const RowMatrix& nodes) {
  std::vector<Point> points;
  for (Eigen::Index n = 0; n < nodes.rows(); ++n)
    points.emplace_back(nodes(n, 0), nodes(n, 1), nodes(n, 2));
  return points;
}

FlatTriangles triangles_of(const WrapMesh& mesh) {
  FlatTriangles out{RowMatrix(mesh.number_of_vertices(), 3),
                    IndexMatrix(mesh.number_of_faces(), 3)};
  for (const auto vertex : mesh.vertices()) {
    const Point& at = mesh.point(vertex);
    out.nodes.row(static_cast<Eigen::Index>(vertex.idx())) << at.x(), at.y(), at.z();
  }
  Eigen::Index row = 0;
  for (const auto face : mesh.faces()) {
    int corner = 0;
    for (const auto vertex : mesh.vertices_around_face(mesh.halfedge(face)))
      out.triangles(row, corner++) = static_cast<int32_t>(vertex.idx());
    ++row;
  }
  return out;
}

WrapMesh mesh_of(const FlatTriangles& surface) {
  WrapMesh mesh;
  std::vector<WrapMesh::Vertex_index> vertices;
  for (const Point& point : points_of(surface.nodes)) vertices.push_back(mesh.add_vertex(point));
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
    mesh.add_face(vertices[surface.triangles(f, 0)], vertices[surface.triangles(f, 1)],
                  vertices[surface.triangles(f, 2)]);
  return mesh;
}

}  // namespace

FlatTriangles alpha_wrap(const FlatTriangles& body, double opening, double offset) {
  std::vector<std::array<std::size_t, 3>> faces;
  for (Eigen::Index f = 0; f < body.triangles.rows(); ++f)
    faces.push_back({static_cast<std::size_t>(body.triangles(f, 0)),
                     static_cast<std::size_t>(body.triangles(f, 1)),
                     static_cast<std::size_t>(body.triangles(f, 2))});
  WrapMesh mesh;
  CGAL::alpha_wrap_3(points_of(body.nodes), faces, 0.5 * opening, offset, mesh);
  return triangles_of(mesh);
}

FlatTriangles remeshed(const FlatTriangles& surface, double edge) {
  namespace processing = CGAL::Polygon_mesh_processing;
  constexpr double kSharpDegrees = 45.0;
  constexpr unsigned kIterations = 5, kRelaxations = 3;
  WrapMesh mesh = mesh_of(surface);
  const auto sharp = mesh.add_property_map<WrapMesh::Edge_index, bool>("e:sharp", false).first;
  processing::detect_sharp_edges(mesh, kSharpDegrees, sharp);
  processing::isotropic_remeshing(mesh.faces(), edge, mesh,
                                  CGAL::parameters::number_of_iterations(kIterations)
                                      .number_of_relaxation_steps(kRelaxations)
                                      .edge_is_constrained_map(sharp));
  mesh.collect_garbage();
  return triangles_of(mesh);
}

}  // namespace clatter::recover
