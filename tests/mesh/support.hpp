// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small meshes and folders that the tests share.
#include <unistd.h>

#include <Eigen/LU>
#include <filesystem>
#include <string>

#include "core/mesh/boundary.hpp"
#include "core/mesh/mesh.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh::testing {

/// The reference tetrahedron: corners at the origin and on the axes, straight edges.
inline Tet10Nodes reference_tet10() {
  Tet10Nodes x = Tet10Nodes::Zero();
  x.row(1) << 1, 0, 0;
  x.row(2) << 0, 1, 0;
  x.row(3) << 0, 0, 1;
  for (int e = 0; e < 6; ++e) {
    x.row(4 + e) = 0.5 * (x.row(kTetEdges[e][0]) + x.row(kTetEdges[e][1]));
  }
  return x;
}

/// det J of x = sum N_i x_i at barycentric coordinates l, from shape function derivatives.
inline double det_at(const Tet10Nodes& x, const Eigen::Vector4d& l) {
  Eigen::Matrix<double, 10, 4> d = Eigen::Matrix<double, 10, 4>::Zero();  // dN/dl
  for (int i = 0; i < 4; ++i) d(i, i) = 4 * l[i] - 1;
  for (int e = 0; e < 6; ++e) {
    d(4 + e, kTetEdges[e][0]) = 4 * l[kTetEdges[e][1]];
    d(4 + e, kTetEdges[e][1]) = 4 * l[kTetEdges[e][0]];
  }
  const Eigen::Matrix<double, 3, 4> g = x.transpose() * d;
  Eigen::Matrix3d J;
  for (int k = 0; k < 3; ++k) J.col(k) = g.col(k + 1) - g.col(0);
  return J.determinant();
}

/// A mesh of that one cell.
inline Mesh one_cell(const Tet10Nodes& x = reference_tet10()) {
  Mesh mesh;
  mesh.name = "one";
  mesh.nodes = x;
  mesh.regions = {"steel"};
  CellBlock block;
  block.nodes.resize(1, 10);
  block.nodes << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9;
  mesh.cells = {block};
  mesh.surfaces["skin"] = skin_of(boundary_faces(mesh));
  mesh.node_sets["tip"] = {3};
  return mesh;
}

/// A folder of its own that goes when the test ends.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / ("clatter_mesh_" + unique())) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  static std::string unique() {
    static int count = 0;
    return std::to_string(::getpid()) + "_" + std::to_string(count++);
  }
  std::filesystem::path path_;
};

}  // namespace clatter::mesh::testing
