// SPDX-License-Identifier: GPL-3.0-or-later
// Faces that are meshed as shells.
#include <algorithm>
#include <set>

#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_elements.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/cad/gmsh_sizes.hpp"

namespace clatter::mesh {
namespace {

namespace occ = gmsh::model::occ;

constexpr double kBlossom = 1;  // of Mesh.RecombinationAlgorithm; 3 crashes

std::vector<int> tags_of(const gmsh::vectorpair& pairs, int dim) {
  std::vector<int> tags;
  for (const auto& [d, tag] : pairs)
    if (d == dim) tags.push_back(tag);
  return tags;
}

}  // namespace

Solid GmshSession::rounded_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max,
                               double radius) {
  synchronized_ = false;
  return gmsh_call("rounded box", [&] {
    const Eigen::Vector3d d = max - min;
    const int face = occ::addRectangle(min.x(), min.y(), min.z(), d.x(), d.y(), -1, radius);
    gmsh::vectorpair out;
    occ::extrude({{2, face}}, 0.0, 0.0, d.z(), out);
    return tags_of(out, 3).at(0);
  });
}

Solids GmshSession::fillet(const Solids& solids, const BoxFilter& edges, double radius) {
  const std::string what = fmt::format("fillet of radius {:g}", radius);
  return gmsh_call(what, [&] {
    synchronize();
    std::vector<int> inside;
    SurfaceFilter filter;
    filter.box = edges;
    for (const FaceFacts& edge : this->edges())
      if (matches(edge, filter, kNearSelection * radius)) inside.push_back(edge.tag);
    if (inside.empty()) throw NumericsError(what + ": found no edge");
    gmsh::vectorpair out;
    occ::fillet(solids, inside, {radius}, out);
    synchronized_ = false;
    return tags_of(out, 3);
  });
}

std::vector<int> GmshSession::all_faces() const {
  gmsh::vectorpair faces;
  gmsh_call("faces", [&] { occ::getEntities(faces, 2); });
  return tags_of(faces, 2);
}

std::vector<int> GmshSession::curves_of(int face) {
  return gmsh_call("edges", [&] {
    synchronize();
    std::vector<int> up, down;
    gmsh::model::getAdjacencies(2, face, up, down);
    return down;
  });
}

void GmshSession::join_faces() {
  gmsh_call("joining faces", [&] {
    gmsh::vectorpair faces, out;
    std::vector<gmsh::vectorpair> map;
    occ::getEntities(faces, 2);
    occ::fragment(faces, {}, out, map);
    synchronized_ = false;
    synchronize();
  });
}

void GmshSession::keep_faces(const std::vector<int>& faces) {
  gmsh_call("choosing faces", [&] {
    const std::set<int> kept(faces.begin(), faces.end());
    gmsh::vectorpair solids, others;
    occ::getEntities(solids, 3);
    occ::remove(solids, false);
    for (const int face : all_faces())
      if (!kept.contains(face)) others.emplace_back(2, face);
    occ::remove(others, true);
    synchronized_ = false;
    synchronize();
  });
}

RawSheet GmshSession::generate_sheet(const SizeSettings& settings, bool triangles, int order) {
  return gmsh_call("gmsh: meshing the sheet", [&] {
    synchronize();
    gmsh::model::mesh::clear();
    set_sizes(settings);
    gmsh::option::setNumber("Mesh.RecombineAll", triangles ? 0 : 1);
    gmsh::option::setNumber("Mesh.RecombinationAlgorithm", kBlossom);
    gmsh::model::mesh::generate(2);
    gmsh::option::setNumber("Mesh.RecombineAll", 0);
    const bool is_quadratic = order == 2;
    if (is_quadratic) {
      gmsh::option::setNumber("Mesh.SecondOrderIncomplete", 1);
      gmsh::model::mesh::setOrder(2);
    }
    const int triangle = is_quadratic ? kTri6 : kTri3, quad = is_quadratic ? kQuad8 : kQuad4,
              line = is_quadratic ? kLine3 : kLine2;
    RawSheet sheet;
    NodeNumbers numbers;
    const std::vector<int> faces = all_faces();
    for (const int face : faces)
      for (const int type : {triangle, quad}) numbers.use(element_nodes(type, face));
    numbers.close();
    for (const int face : faces)
      sheet.faces[face] = {table_of(element_nodes(triangle, face), 3 * order, numbers),
                           table_of(element_nodes(quad, face), 4 * order, numbers)};
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    for (const int curve : tags_of(curves, 1))
      sheet.edges[curve] = table_of(element_nodes(line, curve), order + 1, numbers);
    sheet.nodes = coordinates_of(numbers);
    return sheet;
  });
}

}  // namespace clatter::mesh
