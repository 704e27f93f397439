// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/exudyn.hpp"

#include "condense/export/floating_frame.hpp"
#include "condense/export/npy.hpp"
#include "core/base/matrix.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;

/// Positions (3 n) and modes (3 n x m) of the nodes, and triangles of them.
struct Mesh {
  Eigen::VectorXd position;
  MatrixXd modes;
  std::vector<int64_t> triangles;  // three nodes each
};

Mesh mesh_of(const ExportedPart& part, const PencilModes& modes) {
  const std::vector<NodeShape> nodes = node_shapes(part, modes);
  const rom::Skin& skin = part.model.skin;
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Mesh mesh;
  mesh.position.resize(3 * (n + skin.nodes.rows()));
  mesh.modes.resize(mesh.position.size(), modes.Phi.cols());
  for (Eigen::Index a = 0; a < n; ++a) {
    mesh.position.segment<3>(3 * a) = nodes[a].position;
    mesh.modes.middleRows<3>(3 * a) = nodes[a].shape.topRows<3>();
  }
  if (skin.nodes.rows() == 0) return mesh;
  mesh.position.tail(skin.nodes.size()) =
      Eigen::Map<const Eigen::VectorXd>(skin.nodes.data(), skin.nodes.size());
  mesh.modes.bottomRows(skin.T.rows()) = skin.T * modes.Phi;
  for (Eigen::Index f = 0; f < skin.triangles.rows(); ++f)
    for (int corner = 0; corner < 3; ++corner)
      mesh.triangles.push_back(n + skin.triangles(f, corner));
  return mesh;
}

/// Of the mass: rho tilde(y)^T psi from the integrals S of y_l psi_m.
Eigen::Vector3d tilde_vector(const Matrix3d& S) { return -axial(S).transpose(); }

/// Of the mass: rho tilde(y)^T tilde(psi).
Matrix3d tilde_tilde(const Matrix3d& S) { return S.trace() * Matrix3d::Identity() - S.transpose(); }

void put_integrals(NpyWriter& npy, const FloatingFrame& frame) {
  const Eigen::Index m = frame.modes();
  MatrixXd psi_psi(3 * m, m), psi_tilde(3 * m, 3 * m), first_tilde(3, 3 * m), x_psi(3, m),
      x_tilde(3, 3 * m);
  for (Eigen::Index k = 0; k < m; ++k) {
    first_tilde.middleCols<3>(3 * k) = tilde(frame.first.col(k));
    x_psi.col(k) = tilde_vector(frame.moment(k));
    x_tilde.middleCols<3>(3 * k) = tilde_tilde(frame.moment(k));
    for (Eigen::Index j = 0; j < m; ++j) {
      const Matrix3d P = frame.product(j, k);
      psi_psi.block<3, 1>(3 * j, k) = tilde_vector(P);
      psi_tilde.block<3, 3>(3 * j, 3 * k) = tilde_tilde(P);
    }
  }
  npy.put(psi_psi);
  npy.put(psi_tilde);
  npy.put(frame.first);
  npy.put(first_tilde);
  npy.put(x_psi);
  npy.put(x_tilde);
}

}  // namespace

void export_exudyn(const ExportedPart& part, const std::filesystem::path& path) {
  const PencilModes modes = elastic_modes_of(part.model);
  const FloatingFrame frame = floating_frame(part, modes, "Exudyn");
  const Mesh mesh = mesh_of(part, modes);
  const int64_t m = frame.modes(), rotation = 4, rigid = 3 + rotation;  // Euler parameters
  WholeFile file(path);
  NpyWriter npy(file.stream());
  npy.put(std::vector<int64_t>{1}, {1});  // version
  npy.put(mesh.modes);
  npy.put(mesh.triangles, {static_cast<int64_t>(mesh.triangles.size() / 3), 3});
  npy.put_no_text();  // modes of stresses
  npy.put(MatrixXd(MatrixXd::Identity(m, m)));
  npy.put(MatrixXd(modes.Lambda.asDiagonal()));
  npy.put(std::vector<int64_t>{m, mesh.position.size() / 3, 3, rotation, rigid, rigid + m}, {6});
  npy.put("NodeType.RotationEulerParameters");
  npy.put(mesh.position);
  npy.put(MatrixXd(frame.inertia));
  npy.put(MatrixXd(frame.mass * Matrix3d::Identity()));
  npy.put(frame.mass);
  npy.put(Eigen::VectorXd(frame.centre));
  npy.put(MatrixXd(tilde(frame.centre)));
  put_integrals(npy, frame);
  file.commit();
}

}  // namespace clatter::condense
