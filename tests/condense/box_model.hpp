// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A free elastic box of springs as an assembled model, with sets on its faces; a chain for sums by
// hand.
#include "core/fe/fe_model.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::test {

/// A set of all three displacements of some nodes.
inline rom::DofSet node_set(const fe::FeModel& model, const std::string& name,
                            const std::vector<int>& nodes) {
  rom::DofSet set;
  set.kind = "node";
  const auto count = static_cast<Eigen::Index>(3 * nodes.size());
  set.position.resize(count, 3);
  set.direction = Eigen::MatrixXd::Zero(count, 3);
  set.is_rotation.assign(count, 0);
  Eigen::Index k = 0;
  for (const int node : nodes) {
    for (int d = 0; d < 3; ++d, ++k) {
      set.dofs.push_back(3 * node + d);
      set.labels.push_back(name + std::to_string(node) + "." + "xyz"[d]);
      set.position.row(k) = model.nodes.row(node);
      set.direction(k, d) = 1.0;
    }
  }
  return set;
}

/// Four masses 2, 2, 2, 1 on unit springs, the first held to the ground; set "end" is the last
/// mass.
inline fe::FeModel held_chain() {
  fe::FeModel model;
  model.K = from_triplets(4, {{0, 0, 2.0},
                              {1, 1, 2.0},
                              {2, 2, 2.0},
                              {3, 3, 1.0},
                              {1, 0, -1.0},
                              {2, 1, -1.0},
                              {3, 2, -1.0}});
  model.M = diagonal(Eigen::Vector4d(2.0, 2.0, 2.0, 1.0));
  model.nodes = test::random_matrix<RowMatrix>(4, 3);
  model.rigid = Eigen::MatrixXd::Zero(4, 6);
  model.rigid.col(0).setOnes();  // not free: the chain is held
  model.sets["end"].dofs = {3};
  return model;
}

/// Mass properties directly from point masses, as an independent reference.
inline rom::MassProperties point_mass_properties(const SpringBox& box) {
  rom::MassProperties out;
  const Eigen::VectorXd m = box.M.diagonal();
  for (Eigen::Index a = 0; a < box.nodes.rows(); ++a) {
    out.mass += m[3 * a];
    out.centre += m[3 * a] * box.nodes.row(a).transpose();
  }
  out.centre /= out.mass;
  for (Eigen::Index a = 0; a < box.nodes.rows(); ++a) {
    const Eigen::Vector3d r = box.nodes.row(a).transpose() - out.centre;
    out.inertia += m[3 * a] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return out;
}

/// Box of nx x ny x nz nodes. Sets: "left" (three corners of the face x = 0), "right" (two corners
/// of the far face), "point" (one node), "same_point" (that node again). Load "pull" on the far
/// face, surface "skin" of a few quadratic triangles.
inline fe::FeModel box_model(int nx = 8, int ny = 6, int nz = 6) {
  const SpringBox box = spring_box(nx, ny, nz);
  fe::FeModel model;
  model.name = "box";
  model.M = box.M;
  model.K = box.K;
  const int n = static_cast<int>(box.K.rows());
  model.T.resize(n, n);
  model.T.setIdentity();
  model.nodes = box.nodes;
  model.rigid = box.rigid;
  model.alpha = 1e-6;
  model.beta = 2.0;
  model.mass = point_mass_properties(box);
  const auto id = [&](int x, int y, int z) { return (z * ny + y) * nx + x; };
  model.sets["left"] = node_set(model, "left", {id(0, 0, 0), id(0, ny - 1, 0), id(0, 0, nz - 1)});
  model.sets["right"] = node_set(model, "right", {id(nx - 1, 0, 0), id(nx - 1, ny - 1, nz - 1)});
  model.sets["point"] = node_set(model, "point", {id(nx / 2, ny - 1, nz / 2)});
  model.sets["same_point"] = node_set(model, "same_point", {id(nx / 2, ny - 1, nz / 2)});
  Eigen::VectorXd pull = Eigen::VectorXd::Zero(n);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y) pull[3 * id(nx - 1, y, z)] = 1.0;
  model.loads["pull"] = pull;
  model.load_units["pull"] = "N";
  IndexMatrix skin(nx / 2, 6);
  for (int f = 0; f < nx / 2; ++f)
    skin.row(f) << id(f, 0, 0), id(f + 2, 0, 0), id(f, 2, 0), id(f + 1, 0, 0), id(f + 1, 1, 0),
        id(f, 1, 0);
  model.surfaces["skin"].faces = {{mesh::FaceType::kTri6, skin}};
  return model;
}

}  // namespace clatter::test
