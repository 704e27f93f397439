// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/sheet_mesher.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/base/child_process.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/free_edges.hpp"
#include "core/mesh/orient_shells.hpp"
#include "core/mesh/quadrature.hpp"
#include "core/mesh/shape.hpp"
#include "core/mesh/shell_shape.hpp"
#include "mesh/part/mesh_sizes.hpp"
#include "mesh/part/predict_cells.hpp"
#include "mesh/repair/certify_mesh.hpp"

namespace clatter::mesh {
namespace {

// Of ShellShape: a quadrilateral beyond them becomes two triangles. With a corner of less than 0.1,
// or a normal of one more than 60 degrees off, it is no shell (core/fe/shell_quad.cpp).
constexpr double kMostWarp = 0.25, kLeastJacobian = 0.15, kLeastCorner = 0.2, kUpright = 0.75;
constexpr double kGrowth = 0.3;         // of the size per distance from finer edges
constexpr double kNearlyAll = 0.9;      // of the size: edges that are hardly finer
constexpr double kMostPoints = 2000.0;  // of the distance from a curve

/// Cells of one type, and the CAD face of each.
struct SheetRows {
  std::vector<int32_t> nodes;
  std::vector<int> faces;
};

std::array<Eigen::Vector3d, 4> corners_of(const RowMatrix& nodes, const int32_t* quad) {
  std::array<Eigen::Vector3d, 4> x;
  for (size_t i = 0; i < 4; ++i) x[i] = nodes.row(quad[i]);
  return x;
}

/// Along the shorter diagonal. @param centre of a quad8: the node in the middle, else -1.
void split(const std::array<Eigen::Vector3d, 4>& x, const int32_t* quad, int32_t centre, int face,
           SheetRows& triangles) {
  const bool by_02 = (x[2] - x[0]).norm() <= (x[3] - x[1]).norm();
  using Half = std::array<int, 6>;  // corners, then nodes of the sides; 8: the centre
  const std::array<Half, 2> halves =
      by_02 ? std::array<Half, 2>{{{0, 1, 2, 4, 5, 8}, {0, 2, 3, 8, 6, 7}}}
            : std::array<Half, 2>{{{0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 6, 8}}};
  for (const Half& half : halves)
    for (size_t i = 0; i < (centre < 0 ? 3u : 6u); ++i)
      triangles.nodes.push_back(half[i] == 8 ? centre : quad[half[i]]);
  triangles.faces.insert(triangles.faces.end(), 2, face);
}

/// A new node in the middle of a quad8, by its shape functions.
int32_t add_centre(const int32_t* quad, RowMatrix& nodes) {
  Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
  for (int i = 0; i < 8; ++i) at += (i < 4 ? -0.25 : 0.5) * nodes.row(quad[i]);
  nodes.conservativeResize(nodes.rows() + 1, Eigen::NoChange);
  nodes.bottomRows<1>() = at;
  return static_cast<int32_t>(nodes.rows()) - 1;
}

ShellBlock block_of(FaceType type, const SheetRows& rows, const SheetFaces& sheet, double metres) {
  ShellBlock block;
  block.type = type;
  const auto cells = static_cast<Eigen::Index>(rows.faces.size());
  const Eigen::Index columns = traits(type).nodes;
  block.nodes = Eigen::Map<const IndexMatrix>(rows.nodes.data(), cells, columns);
  block.thickness = RowMatrix::Constant(cells, columns, metres * sheet.thickness);
  if (sheet.offset != 0.0) block.offset = Eigen::VectorXd::Constant(cells, metres * sheet.offset);
  return block;
}

/// The cells of a sheet, with the face of each by block.
struct SheetCellsOfFaces {
  std::vector<ShellBlock> blocks;
  std::vector<std::vector<int>> faces;
};

/// Adds nodes to `raw` where quadratic cells are split.
SheetCellsOfFaces cells_of(RawSheet& raw, const SheetFaces& sheet, double metres) {
  SheetRows quads, triangles;
  for (const auto& [face, cells] : raw.faces) {
    triangles.nodes.insert(triangles.nodes.end(), cells.triangles.data(),
                           cells.triangles.data() + cells.triangles.size());
    triangles.faces.insert(triangles.faces.end(), static_cast<size_t>(cells.triangles.rows()),
                           face);
    const Eigen::Index each = cells.quads.cols();
    for (Eigen::Index c = 0; c < cells.quads.rows(); ++c) {
      const int32_t* quad = cells.quads.data() + each * c;
      const auto x = corners_of(raw.nodes, quad);
      const ShellShape shape = shape_of_shell(x);
      if (shape.warp > kMostWarp || shape.jacobian < kLeastJacobian ||
          shape.corner < kLeastCorner || shape.upright < kUpright) {
        split(x, quad, each == 8 ? add_centre(quad, raw.nodes) : -1, face, triangles);
        continue;
      }
      quads.nodes.insert(quads.nodes.end(), quad, quad + each);
      quads.faces.push_back(face);
    }
  }
  SheetCellsOfFaces out;
  const bool is_quadratic = sheet.cells == SheetCells::kQuadratic;
  for (auto& [type, rows] :
       {std::pair(is_quadratic ? FaceType::kQuad8 : FaceType::kQuad4, &quads),
        std::pair(is_quadratic ? FaceType::kTri6 : FaceType::kTri3, &triangles)}) {
    if (rows->faces.empty()) continue;
    out.blocks.push_back(block_of(type, *rows, sheet, metres));
    out.faces.push_back(rows->faces);
  }
  if (out.blocks.empty()) throw NumericsError("gmsh: the sheet got no cells");
  return out;
}

/// Whether a normal of a quadratic cell is far off that at its centre: too curved, or folded.
bool is_folded(const Mesh& mesh, const ShellBlock& block, Eigen::Index row) {
  constexpr double kCosine = 0.6;
  const RowMatrix x = mesh.nodes(block.nodes.row(row), Eigen::all);
  const auto normal_at = [&](const Eigen::Vector2d& at) {
    const Eigen::Matrix<double, 3, 2> tangent = x.transpose() * face_shape(block.type, at).gradient;
    return Eigen::Vector3d(tangent.col(0).cross(tangent.col(1)).normalized());
  };
  const bool is_triangle = traits(block.type).corners == 3;
  const Eigen::Vector3d middle =
      normal_at(is_triangle ? Eigen::Vector2d::Constant(1.0 / 3.0) : Eigen::Vector2d::Zero());
  const auto is_far = [&](const Eigen::MatrixX2d& points) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      if (!(normal_at(points.row(i).transpose()).dot(middle) > kCosine)) return true;
    return false;
  };
  return is_far(reference_nodes(block.type)) ||
         is_far(is_triangle ? triangle_rule_6().points : quad_rule_9().points);
}

/// Halves the sides of quadratic cells that are folded, and so of their neighbours: on coarse cells
/// beside small curves a node of the CAD lies too far off.
void straighten_folded(Mesh& mesh) {
  int64_t straight = 0;
  for (bool found = true; found;) {
    found = false;
    for (const ShellBlock& block : mesh.shells) {
      const int corners = traits(block.type).corners;
      for (Eigen::Index c = 0; c < block.nodes.rows() && traits(block.type).order == 2; ++c) {
        if (!is_folded(mesh, block, c)) continue;
        bool moved = false;
        for (int i = 0; i < corners; ++i) {
          const Eigen::RowVector3d half = 0.5 * (mesh.nodes.row(block.nodes(c, i)) +
                                                 mesh.nodes.row(block.nodes(c, (i + 1) % corners)));
          moved = moved || mesh.nodes.row(block.nodes(c, corners + i)) != half;
          mesh.nodes.row(block.nodes(c, corners + i)) = half;
        }
        straight += moved ? 1 : 0;
        found = found || moved;
      }
    }
  }
  if (straight > 0)
    warn(
        fmt::format("mesh: {} quadratic shells have straight sides, where those of the CAD would "
                    "fold them: smaller cells there follow it",
                    straight));
}

/// Turns the cells of each face to its outward side, where the points on it tell which.
void turn_outward(const SheetFaces& sheet, double metres,
                  const std::vector<std::vector<int>>& faces, Mesh& mesh) {
  struct CellAt {
    size_t block;
    Eigen::Index row;
    Eigen::Vector3d centre, normal;
  };
  std::map<int, std::vector<CellAt>> cells;
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    const IndexMatrix& nodes = mesh.shells[b].nodes;
    for (Eigen::Index c = 0; c < nodes.rows(); ++c) {
      const auto at = [&](Eigen::Index i) -> Eigen::Vector3d {
        return mesh.nodes.row(nodes(c, i));
      };
      const Eigen::Vector3d x = at(0), y = at(1), z = at(traits(mesh.shells[b].type).corners - 1);
      cells[faces[b][static_cast<size_t>(c)]].push_back(
          {b, c, (x + y + z) / 3.0, (y - x).cross(z - x)});
    }
  }
  std::map<int, int> votes;
  for (const OutwardPoint& point : sheet.outward) {
    if (!cells.contains(point.face)) continue;
    const auto nearest = std::ranges::min_element(
        cells.at(point.face), {},
        [&](const CellAt& cell) { return (cell.centre - metres * point.at).squaredNorm(); });
    votes[point.face] += nearest->normal.dot(point.normal) > 0.0 ? 1 : -1;
  }
  for (const auto& [face, vote] : votes) {
    if (vote >= 0) continue;
    for (const CellAt& cell : cells.at(face)) {
      ShellBlock& block = mesh.shells[cell.block];
      turn_over(block.type, block.nodes.row(cell.row));
    }
  }
}

std::vector<int32_t> sorted(std::set<int32_t> nodes) { return {nodes.begin(), nodes.end()}; }

std::vector<int32_t> nodes_of_free_edges(const Mesh& mesh) {
  std::set<int32_t> nodes;
  for (const ShellSide& edge : free_edges(mesh.shells)) {
    nodes.insert({edge.a, edge.b});
    const ShellBlock& block = mesh.shells[edge.block];
    if (traits(block.type).order == 2)
      nodes.insert(block.nodes(edge.cell, traits(block.type).corners + edge.from));
  }
  return sorted(std::move(nodes));
}

void name_surfaces(const FaceTags& tags, const std::vector<std::vector<int>>& faces, Mesh& mesh) {
  mesh.surfaces["skin"] = shell_surface(mesh);
  for (const auto& [name, selected] : tags) {
    SurfaceBuilder surface;
    for (size_t b = 0; b < mesh.shells.size(); ++b)
      for (Eigen::Index c = 0; c < mesh.shells[b].nodes.rows(); ++c)
        if (std::ranges::find(selected, faces[b][static_cast<size_t>(c)]) != selected.end()) {
          const Eigen::VectorXi cell = mesh.shells[b].nodes.row(c).transpose();
          surface.add(mesh.shells[b].type,
                      std::span(cell.data(), static_cast<size_t>(cell.size())));
        }
    mesh.surfaces[name] = surface.finish();
    mesh.node_sets[name] = nodes_of(mesh.surfaces[name]);
  }
}

void name_edges(GmshSession& session, const PartGeometry& part, const RawSheet& raw,
                const std::string& where, Mesh& mesh) {
  mesh.node_sets["free_edges"] = nodes_of_free_edges(mesh);
  const FaceTags tags = find_surfaces(session.edges(), part.edges, part.unit, where);
  for (const auto& [name, curves] : tags) {
    if (mesh.node_sets.contains(name))
      throw InputError(
          fmt::format("{}: edge.{}: found a surface or a set of this name, expected "
                      "another one",
                      where, name));
    std::set<int32_t> nodes;
    for (const int curve : curves) {
      const IndexMatrix& lines = raw.edges.at(curve);
      nodes.insert(lines.data(), lines.data() + lines.size());
    }
    mesh.node_sets[name] = sorted(std::move(nodes));
  }
}

/// Gmsh extends small sizes on the edges of a face over all of it. Here they grow from the curves
/// where the curvature, or a local size, asks for them.
void grade_from_curves(GmshSession& session, const std::vector<FaceFacts>& faces,
                       SizeSettings& sizes) {
  std::map<int, FaceSizes::Edge> curves;
  for (FaceFacts& curve : session.edges()) {
    curve.kind = "Plane";  // its own curvature alone
    const FaceSizes own = sizes_on(session, curve, sizes);
    if (!own.edges.empty()) curves[curve.tag] = own.edges.front();
  }
  for (const FaceFacts& face : faces) {
    const FaceSizes own = sizes_on(session, face, sizes);
    const double least = *std::ranges::min_element(own.at_samples);
    for (const int curve : session.curves_of(face.tag))
      if (const auto at = curves.find(curve); at != curves.end())
        at->second.size = std::min(at->second.size, least);
  }
  for (const auto& [tag, curve] : curves) {
    if (curve.size >= kNearlyAll * sizes.size) continue;
    const double points = std::clamp(std::ceil(curve.length / curve.size), 2.0, kMostPoints);
    sizes.curves.push_back({tag, curve.size, kGrowth, static_cast<int>(points)});
  }
}

double area_of(const std::vector<FaceFacts>& faces) {
  double area = 0.0;
  for (const FaceFacts& face : faces) area += face.area;
  return area;
}

}  // namespace

PartMesh mesh_sheet(GmshSession& session, const PartGeometry& part, const MeshSettings& settings,
                    double metres, const std::string& name, const std::string& where) {
  const SheetFaces& sheet = *part.sheet;
  const std::vector<FaceFacts> faces = session.boundary_faces();
  const FaceTags tags = find_surfaces(faces, part.surfaces, part.unit, where);
  SizeSettings sizes = size_settings(session, settings, faces, tags, metres, where);
  grade_from_curves(session, faces, sizes);
  const bool triangles = sheet.cells == SheetCells::kTriangles;
  const double predicted = require_few_shells(session, sizes, triangles, settings, metres, where);
  PartMesh result;
  RawSheet raw =
      session.generate_sheet(sizes, triangles, sheet.cells == SheetCells::kQuadratic ? 2 : 1);
  enter_step("proving the mesh");
  Mesh& mesh = result.mesh;
  mesh.name = name;
  mesh.regions = {sheet.region};
  SheetCellsOfFaces cells = cells_of(raw, sheet, metres);
  mesh.nodes = metres * raw.nodes;
  mesh.shells = std::move(cells.blocks);
  straighten_folded(mesh);
  turn_outward(sheet, metres, cells.faces, mesh);
  orient_shells(mesh.shells);
  for (ShellBlock& block : mesh.shells)
    if (block.offset.size() > 0) block.offset.setConstant(metres * sheet.offset);
  name_surfaces(tags, cells.faces, mesh);
  name_edges(session, part, raw, where, mesh);
  if (sheet.outward.empty() && mesh.node_set("free_edges").empty())
    warn(fmt::format(
        "{}: the faces enclose a volume, of which each is taken for sheet: of a solid of "
        "sheet (STEP, BREP) one side would be",
        where));
  check_structure(mesh, "mesh");
  result.certificate = certify_mesh(mesh, result.quality);
  result.certificate.predicted_cells = predicted;
  result.certificate.shell_area_against_cad =
      *result.certificate.shell_area_m2 / (metres * metres * area_of(faces)) - 1.0;
  return result;
}

}  // namespace clatter::mesh
