// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/synthetic.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/artefact.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::dynamics::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Collects coordinates, each a displacement along (rotation about) a direction at a position.
struct Assembly {
  rom::ReducedModel model;
  std::vector<Vector3d> position, direction;
  std::vector<int32_t> rotation;
  std::vector<double> mass, stiffness;

  void add(const std::string& set, const std::string& kind, const std::string& label,
           const Vector3d& at, const Vector3d& along, bool turns, double m, double hz) {
    rom::DofSet& dofs = model.sets[set];
    dofs.kind = kind;
    dofs.dofs.push_back(static_cast<int32_t>(position.size()));
    dofs.labels.push_back(label);
    position.push_back(at);
    direction.push_back(along);
    rotation.push_back(turns ? 1 : 0);
    mass.push_back(m);
    stiffness.push_back(m * std::pow(2.0 * std::numbers::pi * hz, 2));
  }
  void node(const std::string& set, const std::string& kind, const Vector3d& at, double m,
            double hz) {
    for (int axis = 0; axis < 3; ++axis) {
      add(set, kind, set + "." + "xyz"[axis], at, Vector3d::Unit(axis), false, m, hz);
    }
  }

  /// M diagonal; K = N^T S N with N the projection off the rigid motions: K r = 0 to rounding.
  rom::ReducedModel finish(const std::string& name) {
    const auto n = static_cast<Eigen::Index>(position.size());
    model.name = name;
    model.method = "guyan";
    model.n_boundary = static_cast<int>(n);
    model.rigid.resize(n, 6);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<size_t>(i);
      const bool turns = rotation[k] != 0;
      model.rigid.row(i).head<3>() = turns ? Vector3d::Zero().eval() : direction[k];
      model.rigid.row(i).tail<3>() = turns ? direction[k] : position[k].cross(direction[k]);
    }
    model.M_rr = Eigen::Map<VectorXd>(mass.data(), n).asDiagonal();
    const MatrixXd& R = model.rigid;
    const MatrixXd N =
        MatrixXd::Identity(n, n) - R * dense::solve_symmetric(R.transpose() * R, R.transpose());
    const MatrixXd K = N.transpose() * Eigen::Map<VectorXd>(stiffness.data(), n).asDiagonal() * N;
    model.K_rr = 0.5 * (K + K.transpose());
    for (auto& [set_name, set] : model.sets) {
      const auto m = static_cast<Eigen::Index>(set.dofs.size());
      set.position.resize(m, 3);
      set.direction.resize(m, 3);
      set.is_rotation.clear();
      for (Eigen::Index i = 0; i < m; ++i) {
        const auto k = static_cast<size_t>(set.dofs[i]);
        set.position.row(i) = position[k];
        set.direction.row(i) = direction[k];
        set.is_rotation.push_back(rotation[k]);
      }
    }
    const MatrixXd G = R.transpose() * model.M_rr * R;
    model.mass.mass = G(1, 1);
    model.mass.inertia = G.bottomRightCorner(3, 3);
    model.valid_to_hz = 3000.0;
    model.fixed_interface_hz.resize(0);
    model.certificate.rigid_stiffness_residue = 0.0;
    return model;
  }

  void grid(const std::string& set, double radius, const std::vector<double>& strip_edges,
            const VectorXd& axial_edges, const Vector3d& axis_point, double m, double hz) {
    rom::ContactGrid grid;
    grid.axis_point = axis_point;
    grid.zero_angle = Vector3d::UnitY();
    grid.radius = radius;
    const auto strips = static_cast<Eigen::Index>(strip_edges.size() / 2);
    grid.angle_edges = Eigen::Map<const VectorXd>(strip_edges.data(), 2 * strips);
    grid.angle.resize(strips);
    for (Eigen::Index i = 0; i < strips; ++i) {
      grid.angle(i) = 0.5 * (strip_edges[2 * static_cast<size_t>(i)] +
                             strip_edges[2 * static_cast<size_t>(i) + 1]);
    }
    grid.axial_edges = axial_edges;
    const auto rows = axial_edges.size() - 1;
    grid.axial = 0.5 * (axial_edges.head(rows) + axial_edges.tail(rows));
    for (Eigen::Index i = 0; i < strips; ++i) {
      const Vector3d normal(-std::sin(grid.angle(i)), std::cos(grid.angle(i)), 0.0);
      for (Eigen::Index j = 0; j < rows; ++j) {
        add(set, "contact_grid", fmt::format("{}[{},{}]", set, i, j),
            axis_point + radius * normal + grid.axial(j) * Vector3d::UnitZ(), normal, false, m, hz);
      }
    }
    model.grids[set] = grid;
  }
};

std::vector<double> equal_strips(double begin, double end, int count) {
  std::vector<double> edges;
  for (int i = 0; i < count; ++i) {
    edges.push_back(begin + (end - begin) * i / count);
    edges.push_back(begin + (end - begin) * (i + 1) / count);
  }
  return edges;
}

}  // namespace

rom::ReducedModel rigid_piston(double mass, double inertia, double area) {
  Assembly parts;
  parts.node("pin", "bearing", Vector3d::Zero(), mass, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    parts.add("pin", "bearing", std::string("pin.r") + "xyz"[axis], Vector3d::Zero(),
              Vector3d::Unit(axis), true, inertia, 1.0);
  }
  rom::ReducedModel model = parts.finish("piston");
  model.K_rr.setZero();
  model.mass.mass = mass;
  model.loads["gas"] = VectorXd::Zero(6);
  model.loads["gas"](2) = -area;
  return model;
}

rom::ReducedModel clamped_bar(double length, int elements, int modes) {
  const double area = 1e-4, E = 210e9, rho = 7850.0, h = length / elements;
  MatrixXd K = MatrixXd::Zero(elements, elements), M = K;
  for (int e = 0; e < elements; ++e) {
    for (int a = 0; a < 2; ++a) {
      for (int b = 0; b < 2; ++b) {
        const int i = e - 1 + a, j = e - 1 + b;  // node 0 is clamped
        if (i < 0 || j < 0) continue;
        K(i, j) += E * area / h * (a == b ? 1.0 : -1.0);
        M(i, j) += rho * area * h / 6.0 * (a == b ? 2.0 : 1.0);
      }
    }
  }
  const int n_i = elements - 1;
  const MatrixXd K_ii = K.topLeftCorner(n_i, n_i), M_ii = M.topLeftCorner(n_i, n_i);
  const dense::Eigenpairs fixed = dense::symmetric_eigen(K_ii, M_ii);
  MatrixXd T = MatrixXd::Zero(elements, 1 + modes);
  T.col(0).head(n_i) = -dense::solve_symmetric(K_ii, K.col(elements - 1).head(n_i));
  T(elements - 1, 0) = 1.0;
  T.topRightCorner(n_i, modes) = fixed.vectors.leftCols(modes);
  rom::ReducedModel model;
  model.name = "bar";
  model.method = "craig-bampton";
  model.n_boundary = 1;
  model.M_rr = T.transpose() * M * T;
  model.K_rr = T.transpose() * K * T;
  model.M_rr = (0.5 * (model.M_rr + model.M_rr.transpose())).eval();
  model.K_rr = (0.5 * (model.K_rr + model.K_rr.transpose())).eval();
  model.rigid = MatrixXd::Zero(1 + modes, 6);
  model.rigid(0, 0) = 1.0;
  model.sets["tip"] = {
      "node", {0}, {"tip.x"}, Eigen::RowVector3d(length, 0, 0), Eigen::RowVector3d(1, 0, 0), {0}};
  model.mass.mass = rho * area * length;
  model.fixed_interface_hz = fixed.values.head(modes).cwiseSqrt() / (2.0 * std::numbers::pi);
  model.valid_to_hz = modes > 0 ? 0.5 * model.fixed_interface_hz(modes - 1) : 1.0;
  return model;
}

rom::ReducedModel elastic_piston(double radius, int strips, int rows, double axis) {
  Assembly parts;
  parts.node("pin", "bearing", Vector3d::Zero(), 0.5, 6000.0);
  for (int axis = 0; axis < 3; ++axis) {
    parts.add("pin", "bearing", std::string("pin.r") + "xyz"[axis], Vector3d::Zero(),
              Vector3d::Unit(axis), true, 5e-4, 6000.0);
  }
  parts.node("crown", "sensor", Vector3d(0.0, 0.0, 0.05), 1.0, 5000.0);
  const double half = 40.0 * std::numbers::pi / 180.0;
  auto edges = equal_strips(-half, half, strips);
  const auto other = equal_strips(std::numbers::pi - half, std::numbers::pi + half, strips);
  edges.insert(edges.end(), other.begin(), other.end());
  parts.grid("skirt", radius, edges, VectorXd::LinSpaced(rows + 1, -0.045, 0.025),
             Vector3d(0.0, axis, 0.0), 0.3 / (2 * strips * rows), 9000.0);
  rom::ReducedModel model = parts.finish("piston");
  model.alpha = 1e-7;
  model.loads["gas"] = VectorXd::Zero(model.size());
  model.loads["gas"](model.set("crown").dofs[2]) = -std::numbers::pi * radius * radius;
  return model;
}

namespace {

/// Adds what the block has for one cylinder: liner, mean axial displacement, node of the head.
void add_bore(Assembly& parts, const std::string& number, double x, double radius, int strips,
              int rows, const Eigen::Vector2d& off, const std::string& head) {
  const Vector3d axis(x, 0.0, 0.0);
  const std::string liner = "liner_" + number;
  parts.grid(liner, radius, equal_strips(0.0, 2.0 * std::numbers::pi, strips),
             VectorXd::LinSpaced(rows + 1, 0.115, 0.345), axis, 4.0 / (strips * rows), 5000.0);
  parts.add(liner + "_axial", "mean", liner + "_axial", axis + Vector3d(off.x(), off.y(), 0.23),
            Vector3d::UnitZ(), false, 4.0, 4000.0);
  if (!head.empty()) parts.node(head, "sensor", Vector3d(x, 0.0, 0.345), 15.0, 2000.0);
}

void add_bearings_and_mounts(Assembly& parts) {
  parts.node("main_4", "bearing", Vector3d(0.13, 0.0, 0.0), 8.0, 2500.0);
  parts.node("main_5", "bearing", Vector3d(0.26, 0.0, 0.0), 8.0, 2200.0);
  parts.node("head", "sensor", Vector3d(0.195, 0.0, 0.345), 15.0, 2000.0);
  parts.node("sensor", "sensor", Vector3d(0.195, 0.09, 0.2), 4.0, 3000.0);
  for (const double x : {-0.25, 0.25}) {
    for (const double y : {-0.15, 0.15}) {
      parts.node("mounts", "mount", Vector3d(x, y, 0.05), 20.0, 900.0);
    }
  }
}

rom::ReducedModel finished_block(Assembly& parts, double radius) {
  rom::ReducedModel model = parts.finish("block");
  model.alpha = 2e-6;
  model.loads["head_4_gas"] = VectorXd::Zero(model.size());
  model.loads["head_4_gas"](model.set("head").dofs[2]) = std::numbers::pi * radius * radius;
  return model;
}

}  // namespace

rom::ReducedModel elastic_block(double radius, int strips, int rows, const Eigen::Vector2d& off) {
  Assembly parts;
  add_bore(parts, "4", 0.195, radius, strips, rows, off, "");
  add_bearings_and_mounts(parts);
  return finished_block(parts, radius);
}

rom::ReducedModel two_bore_block(double radius, int strips, int rows) {
  Assembly parts;
  add_bore(parts, "4", 0.195, radius, strips, rows, Eigen::Vector2d::Zero(), "");
  add_bearings_and_mounts(parts);
  add_bore(parts, "3", 0.065, radius, strips, rows, Eigen::Vector2d::Zero(), "head_3");
  parts.node("main_3", "bearing", Vector3d(0.0, 0.0, 0.0), 8.0, 2300.0);
  rom::ReducedModel model = finished_block(parts, radius);
  model.loads["head_3_gas"] = VectorXd::Zero(model.size());
  model.loads["head_3_gas"](model.set("head_3").dofs[2]) = std::numbers::pi * radius * radius;
  return model;
}

rom::ReducedModel four_bore_block(double radius, int strips, int rows) {
  Assembly parts;
  for (int k = 1; k <= 4; ++k)
    add_bore(parts, std::to_string(k), 0.13 * (k - 2.5), radius, strips, rows,
             Eigen::Vector2d::Zero(), fmt::format("head_{}", k));
  for (int k = 1; k <= 5; ++k)
    parts.node(fmt::format("main_{}", k), "bearing", Vector3d(0.13 * (k - 3), 0.0, 0.0), 8.0,
               2100.0 + 80.0 * k);
  for (const double x : {-0.25, 0.25})
    for (const double y : {-0.15, 0.15})
      parts.node("mounts", "mount", Vector3d(x, y, 0.05), 20.0, 900.0);
  rom::ReducedModel model = parts.finish("block");
  model.alpha = 2e-6;
  for (int k = 1; k <= 4; ++k) {
    VectorXd& load = model.loads[fmt::format("head_{}_gas", k)];
    load = VectorXd::Zero(model.size());
    load(model.set(fmt::format("head_{}", k)).dofs[2]) = std::numbers::pi * radius * radius;
  }
  return model;
}

void write_rom(const std::filesystem::path& path, const rom::ReducedModel& model) {
  H5File file = H5File::create(path);
  write_provenance(file, {"clatter/rom/1", "", {}});
  rom::write_reduced_model(file, model);
  file.commit();
}

}  // namespace clatter::dynamics::testing
