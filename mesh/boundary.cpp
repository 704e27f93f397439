#include "mesh/boundary.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/error.hpp"
#include "mesh/validity.hpp"

namespace clatter::mesh {
namespace {

struct Face {
  FaceKey key;
  std::array<int32_t, 6> nodes;
};

std::vector<Face> all_faces(const Mesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(static_cast<size_t>(4 * mesh.cell_count()));
  for (const CellBlock& block : mesh.cells) {
    const int per_face = traits(block.type).face_nodes;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      for (const auto& local : kTetFaces) {
        Face face{{}, {-1, -1, -1, -1, -1, -1}};
        for (int i = 0; i < per_face; ++i) face.nodes[i] = block.nodes(c, local[i]);
        face.key = face_key(face.nodes[0], face.nodes[1], face.nodes[2]);
        faces.push_back(face);
      }
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  return faces;
}

// Quadrature exact to degree 4 on the triangle: n is of degree 2 and so is x; x . n needs 4.
// Source: Dunavant, Int. J. Numer. Meth. Engng 21 (1985), table II, p = 4.
struct TrianglePoint {
  double l1, l2, weight;  // weights sum to 1/2
};
constexpr double kA = 0.445948490915965, kB = 0.091576213509771;
constexpr double kWa = 0.111690794839005, kWb = 0.054975871827661;
constexpr std::array<TrianglePoint, 6> kTrianglePoints = {{{kA, kA, kWa},
                                                           {1 - 2 * kA, kA, kWa},
                                                           {kA, 1 - 2 * kA, kWa},
                                                           {kB, kB, kWb},
                                                           {1 - 2 * kB, kB, kWb},
                                                           {kB, 1 - 2 * kB, kWb}}};

using TriangleNodes = Eigen::Matrix<double, 6, 3>;

TriangleNodes triangle_nodes(const Mesh& mesh, const Surface& surface, Eigen::Index f) {
  TriangleNodes x;
  const auto columns = surface.triangles.cols();
  for (Eigen::Index i = 0; i < columns; ++i) x.row(i) = mesh.nodes.row(surface.triangles(f, i));
  if (columns == 3) {
    for (int e = 0; e < 3; ++e) {
      const auto [a, b] = kTriangleEdges[e];
      x.row(3 + e) = 0.5 * (x.row(a) + x.row(b));
    }
  }
  return x;
}

struct PointOnTriangle {
  Eigen::Vector3d x, normal;  // normal = dx/dl1 x dx/dl2, not scaled
};

PointOnTriangle evaluate(const TriangleNodes& nodes, double l1, double l2) {
  const double l0 = 1.0 - l1 - l2;
  Eigen::Matrix<double, 1, 6> n, d1, d2;
  n << l0 * (2 * l0 - 1), l1 * (2 * l1 - 1), l2 * (2 * l2 - 1), 4 * l0 * l1, 4 * l1 * l2,
      4 * l2 * l0;
  d1 << 1 - 4 * l0, 4 * l1 - 1, 0, 4 * (l0 - l1), 4 * l2, -4 * l2;
  d2 << 1 - 4 * l0, 0, 4 * l2 - 1, -4 * l1, 4 * l1, 4 * (l0 - l2);
  const Eigen::Vector3d t1 = (d1 * nodes).transpose(), t2 = (d2 * nodes).transpose();
  return {(n * nodes).transpose(), t1.cross(t2)};
}

}  // namespace

FaceKey face_key(int32_t a, int32_t b, int32_t c) {
  FaceKey key = {a, b, c};
  std::sort(key.begin(), key.end());
  return key;
}

BoundaryFaces boundary_faces(const Mesh& mesh) {
  const std::vector<Face> faces = all_faces(mesh);
  BoundaryFaces boundary;
  for (size_t i = 0; i < faces.size();) {
    size_t end = i + 1;
    while (end < faces.size() && faces[end].key == faces[i].key) ++end;
    if (end - i > 2) {
      throw NumericsError(fmt::format("face with corners {}, {}, {} belongs to {} cells",
                                      faces[i].key[0], faces[i].key[1], faces[i].key[2], end - i));
    }
    if (end - i == 1) boundary.emplace_hint(boundary.end(), faces[i].key, faces[i].nodes);
    i = end;
  }
  return boundary;
}

Surface skin_of(const Mesh& mesh, const BoundaryFaces& faces) {
  const int columns = mesh.cells.empty() ? 6 : traits(mesh.cells.front().type).face_nodes;
  Surface skin;
  skin.triangles.resize(static_cast<Eigen::Index>(faces.size()), columns);
  Eigen::Index row = 0;
  for (const auto& entry : faces) {
    for (int i = 0; i < columns; ++i) skin.triangles(row, i) = entry.second[i];
    ++row;
  }
  return skin;
}

SurfaceIntegrals integrate(const Mesh& mesh, const Surface& surface) {
  SurfaceIntegrals sum;
  for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
    const TriangleNodes nodes = triangle_nodes(mesh, surface, f);
    for (const TrianglePoint& q : kTrianglePoints) {
      const PointOnTriangle p = evaluate(nodes, q.l1, q.l2);
      const double dS = q.weight * p.normal.norm();
      sum.area += dS;
      sum.centre += dS * p.x;
      sum.normal += q.weight * p.normal;
      sum.enclosed += q.weight * p.x.dot(p.normal) / 3.0;
    }
  }
  if (sum.area > 0.0) sum.centre /= sum.area;
  return sum;
}

double cell_volume(const Mesh& mesh, int32_t region) {
  double volume = 0.0;
  for (const CellBlock& block : mesh.cells) {
    if (region >= 0 && block.region != region) continue;
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      volume += volume_of(cell_nodes(mesh, block, c));
    }
  }
  return volume;
}

int64_t count_inward(const Mesh& mesh, const Surface& skin) {
  std::map<FaceKey, int32_t> opposite;  // skin face -> corner of its cell that is not on it
  for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f) {
    opposite[face_key(skin.triangles(f, 0), skin.triangles(f, 1), skin.triangles(f, 2))] = -1;
  }
  for (const CellBlock& block : mesh.cells) {
    for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
      for (const auto& local : kTetFaces) {
        const auto found = opposite.find(
            face_key(block.nodes(c, local[0]), block.nodes(c, local[1]), block.nodes(c, local[2])));
        if (found == opposite.end()) continue;
        const int corner = 6 - local[0] - local[1] - local[2];
        found->second = block.nodes(c, corner);
      }
    }
  }
  int64_t inward = 0;
  for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f) {
    const TriangleNodes nodes = triangle_nodes(mesh, skin, f);
    const int32_t corner =
        opposite.at(face_key(skin.triangles(f, 0), skin.triangles(f, 1), skin.triangles(f, 2)));
    const PointOnTriangle middle = evaluate(nodes, 1.0 / 3.0, 1.0 / 3.0);
    const bool outward =
        corner >= 0 && middle.normal.dot(middle.x - mesh.nodes.row(corner).transpose()) > 0.0;
    if (!outward) ++inward;
  }
  return inward;
}

}  // namespace clatter::mesh
