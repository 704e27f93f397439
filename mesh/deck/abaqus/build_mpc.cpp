// SPDX-License-Identifier: GPL-3.0-or-later
// *MPC, to first order in the displacements.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/deck/abaqus/build_equations.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Rows of the nodes of a *MPC, after its type; zeros are skipped.
std::vector<int32_t> mpc_rows(Model& model, size_t use, const MpcLines& lines) {
  std::vector<int32_t> rows;
  std::vector<bool> known(static_cast<size_t>(model.numbering.nodes()), false);
  for (const Fields& fields : lines) {
    for (size_t i = 1; i < fields.size(); ++i) {
      if (fields.blank(i) || fields.text(i) == "0") continue;
      for (const int32_t row : model.sets.nodes_at(fields, i, use)) {
        if (!known[row]) rows.push_back(row);
        known[row] = true;
      }
    }
  }
  const Fields& fields = lines.front();
  for (const int32_t row : rows) {
    if (!model.node_map.displacement_system(row).empty()) {
      fields.fail(fmt::format("*MPC {}: node {} has *TRANSFORM, which is not supported here",
                              fields.text(0), model.numbering.node_ids()[row]));
    }
  }
  return rows;
}

// weights . (u_row - sum share u_of) = 0, its largest weight first.
RawEquation follow(Origin origin, int32_t row, const Eigen::Vector3d& weights,
                   const std::vector<std::pair<int32_t, double>>& shares) {
  RawEquation out{origin, {}};
  Eigen::Index first = 0;
  weights.cwiseAbs().maxCoeff(&first);
  for (int i = 0; i < 3; ++i) {
    const int k = static_cast<int>((first + i) % 3);
    if (weights[k] == 0.0) continue;
    out.terms.push_back({row, k, weights[k]});
    for (const auto& [of, share] : shares) out.terms.push_back({of, k, -share * weights[k]});
  }
  return out;
}

constexpr double kInLine =
    1e-6;  // sine of an angle, or distance over length: coordinates have few digits

// PLANE: the nodes stay in the plane of the first three. To first order in u, with
// x_p = (1 - s - t) x_a + s x_b + t x_c and the normal n: n . (u_p - (1 - s - t) u_a - s u_b - t
// u_c) = 0.
void add_plane(Model& model, size_t use, const MpcLines& lines,
               std::vector<RawEquation>& equations) {
  const Fields& fields = lines.front();
  const std::vector<int32_t> rows = mpc_rows(model, use, lines);
  if (rows.size() < 4) {
    fields.fail(fmt::format("*MPC PLANE: found {} nodes, expected 4 or more", rows.size()));
  }
  const auto at = [&](size_t i) { return model.numbering.at(rows[i]); };
  // For a set, three well-spread nodes: the first, the farthest, the farthest from both.
  size_t b = 1, c = 0;
  for (size_t i = 2; i < rows.size(); ++i) {
    if ((at(i) - at(0)).norm() > (at(b) - at(0)).norm()) b = i;
  }
  const Eigen::Vector3d e = at(b) - at(0);
  for (size_t i = 1; i < rows.size(); ++i) {
    if (e.cross(at(i) - at(0)).norm() > e.cross(at(c) - at(0)).norm()) c = i;
  }
  const Eigen::Vector3d g = at(c) - at(0), normal = e.cross(g);
  if (!(normal.norm() > kInLine * e.squaredNorm())) {
    fields.fail("*MPC PLANE: its nodes lie on a line, expected a plane");
  }
  const Eigen::Vector3d n = normal.normalized();
  for (size_t i = 1; i < rows.size(); ++i) {
    if (i == b || i == c) continue;
    const Eigen::Vector3d r = at(i) - at(0);
    if (std::abs(n.dot(r)) > kInLine * e.norm()) {
      fields.fail(fmt::format("*MPC PLANE: node {} is not in the plane of the others",
                              model.numbering.node_ids()[rows[i]]));
    }
    const double s = r.cross(g).dot(n) / normal.norm(), t = e.cross(r).dot(n) / normal.norm();
    equations.push_back(
        follow(fields.origin(), rows[i], n, {{rows[0], 1.0 - s - t}, {rows[b], s}, {rows[c], t}}));
  }
}

// STRAIGHT: the nodes stay on the line through the ends. With x_p = (1 - s) x_a + s x_b, the
// components normal to the line are u_p = (1 - s) u_a + s u_b: two equations.
void add_straight(Model& model, size_t use, const MpcLines& lines,
                  std::vector<RawEquation>& equations) {
  const Fields& fields = lines.front();
  const std::vector<int32_t> rows = mpc_rows(model, use, lines);
  if (rows.size() < 3) {
    fields.fail(fmt::format("*MPC STRAIGHT: found {} nodes, expected 3 or more", rows.size()));
  }
  const auto at = [&](size_t i) { return model.numbering.at(rows[i]); };
  size_t b = 1;
  for (size_t i = 2; i < rows.size(); ++i) {
    if ((at(i) - at(0)).norm() > (at(b) - at(0)).norm()) b = i;
  }
  const Eigen::Vector3d e = at(b) - at(0);
  if (!(e.norm() > 0.0)) fields.fail("*MPC STRAIGHT: its end nodes coincide");
  Eigen::Index along = 0;
  e.cwiseAbs().maxCoeff(&along);
  for (size_t i = 1; i < rows.size(); ++i) {
    if (i == b) continue;
    const Eigen::Vector3d r = at(i) - at(0);
    const double s = r.dot(e) / e.squaredNorm();
    if ((r - s * e).norm() > kInLine * e.norm()) {
      fields.fail(fmt::format("*MPC STRAIGHT: node {} is not on the line of the others",
                              model.numbering.node_ids()[rows[i]]));
    }
    for (int k = 0; k < 3; ++k) {
      if (k == along) continue;
      Eigen::Vector3d square = Eigen::Vector3d::Unit(k);
      square[along] = -e[k] / e[along];
      RawEquation equation =
          follow(fields.origin(), rows[i], square, {{rows[0], 1.0 - s}, {rows[b], s}});
      // Direction k is the dependent; the other equation has the other one.
      const auto own =
          std::find_if(equation.terms.begin(), equation.terms.end(),
                       [&](const Term& t) { return t.row == rows[i] && t.direction == k; });
      std::iter_swap(equation.terms.begin(), own);
      equations.push_back(std::move(equation));
    }
  }
}

// LINEAR: p follows the line from a to b. With s its share of the way, u_p = (1 - s) u_a + s u_b.
void add_linear(Model& model, size_t use, const MpcLines& lines,
                std::vector<RawEquation>& equations) {
  const Fields& fields = lines.front();
  const std::vector<int32_t> rows = mpc_rows(model, use, lines);
  if (rows.size() != 3) {
    fields.fail(fmt::format("*MPC LINEAR: found {} nodes, expected 3", rows.size()));
  }
  const auto at = [&](size_t i) { return model.numbering.at(rows[i]); };
  const Eigen::Vector3d e = at(2) - at(1);
  if (!(e.norm() > 0.0)) fields.fail("*MPC LINEAR: its second and third node coincide");
  const double s = (at(0) - at(1)).dot(e) / e.squaredNorm();
  for (int k = 0; k < 3; ++k)
    equations.push_back(follow(fields.origin(), rows[0], Eigen::Vector3d::Unit(k),
                               {{rows[1], 1.0 - s}, {rows[2], s}}));
}

// MEANROT: the mean rotation of nodes about an axis is DoF 1 of the last node, whose coordinates
// are the direction of the axis (Dhondt, CalculiX manual, "Mean rotation MPC"). To first order,
// with the arms p_i from the nodes' centre, normal to the axis a, and m nodes,
//   theta = 1/m sum a . (p_i x (u_i - u_mean)) / |p_i|^2.
void add_mean_rotation(Model& model, size_t use, const MpcLines& lines,
                       std::vector<RawEquation>& equations) {
  const Fields& fields = lines.front();
  std::vector<int32_t> rows = mpc_rows(model, use, lines);
  if (rows.size() < 3) {
    fields.fail(
        fmt::format("*MPC MEANROT: found {} nodes, expected two or more and the one that "
                    "turns",
                    rows.size()));
  }
  const int32_t pilot = rows.back();
  rows.pop_back();
  NodeMap& node_map = model.node_map;
  const Eigen::Vector3d axis = model.numbering.at(pilot);
  const int32_t id = model.numbering.node_ids()[pilot];
  if (node_map.mesh_node(pilot) != NodeMap::kNone || !(axis.norm() > 0.0)) {
    fields.fail(
        fmt::format("*MPC MEANROT: found node {}, expected one of its own whose coordinates "
                    "are the direction of the axis",
                    id));
  }
  const Eigen::Vector3d a = axis.normalized();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int32_t row : rows)
    centre += model.numbering.at(row) / static_cast<double>(rows.size());
  std::vector<Eigen::Vector3d> weights;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int32_t row : rows) {
    const Eigen::Vector3d arm = model.numbering.at(row) - centre;
    const Eigen::Vector3d p = arm - arm.dot(a) * a;
    if (!(p.norm() > kInLine * arm.norm())) {
      fields.fail(fmt::format("*MPC MEANROT: node {} lies on the axis through the nodes' centre",
                              model.numbering.node_ids()[row]));
    }
    weights.push_back(a.cross(p) / (p.squaredNorm() * static_cast<double>(rows.size())));
    mean += weights.back() / static_cast<double>(rows.size());
  }
  RawEquation equation{fields.origin(), {}};
  for (size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Vector3d weight = weights[i] - mean;
    for (int k = 0; k < 3; ++k) {
      if (std::abs(weight[k]) > 1e-14 * weight.norm())
        equation.terms.push_back({rows[i], k, weight[k]});
    }
  }
  std::iter_swap(equation.terms.begin(),
                 std::max_element(equation.terms.begin(), equation.terms.end(),
                                  [](const Term& one, const Term& other) {
                                    return std::abs(one.coefficient) < std::abs(other.coefficient);
                                  }));
  node_map.set_rotation_node(pilot, node_map.require(pilot));
  equation.terms.push_back({pilot, 0, -1.0});
  equations.push_back(std::move(equation));
}

// PIN and TIE: equal translations. BEAM: a rigid rod from the first to the second node.
void add_pair(Model& model, const std::string& type, const Fields& fields, int32_t a, int32_t b,
              std::vector<RawEquation>& equations) {
  NodeMap& node_map = model.node_map;
  if (type == "BEAM") {
    Rigid rigid;
    rigid.name = fmt::format("beam_{}", model.deck.rigid.size() + 1);
    rigid.where = model.source.where(fields.origin());
    const bool in_mesh = node_map.is_of_solids(b);
    rigid.reference = in_mesh ? node_map.point_upon(b) : node_map.require(b);
    node_map.require(a);
    std::vector<int32_t> rows = {a};
    if (in_mesh) rows.push_back(b);
    model.dependents.emplace_back(model.deck.rigid.size(), std::move(rows));
    model.deck.rigid.push_back(std::move(rigid));
    return;
  }
  for (const int32_t row : {a, b})
    if (!node_map.displacement_system(row).empty())
      fields.fail(
          fmt::format("*MPC {}: node {} has *TRANSFORM, which is not supported here, expected "
                      "*EQUATION",
                      type, model.numbering.node_ids()[row]));
  const bool rotations = node_map.turns(node_map.require(a)) && node_map.turns(node_map.require(b));
  for (int k = 0; k < (type == "TIE" && rotations ? 6 : 3); ++k) {
    equations.push_back({fields.origin(), {{a, k, 1.0}, {b, k, -1.0}}});
  }
}

}  // namespace

// Of two sets the nodes in pairs, of a set and a node each with that node.
void add_mpc(Model& model, size_t use, const MpcLines& lines, std::vector<RawEquation>& equations) {
  const Fields& fields = lines.front();
  const std::string type = folded(fields.text(0));
  if (type == "LINEAR") return add_linear(model, use, lines, equations);
  if (type == "PLANE") return add_plane(model, use, lines, equations);
  if (type == "STRAIGHT") return add_straight(model, use, lines, equations);
  if (type == "MEANROT") return add_mean_rotation(model, use, lines, equations);
  if (type != "PIN" && type != "TIE" && type != "BEAM") {
    fields.fail(
        fmt::format("*MPC of type {} is not supported, expected PIN, TIE, BEAM, LINEAR, "
                    "PLANE, STRAIGHT or MEANROT; [[equation]] of the recipe replaces others",
                    type));
  }
  fields.at_most(3, "type and two nodes or node sets");
  if (lines.size() > 1) lines[1].fail(fmt::format("expected one line of *MPC {}", type));
  const std::vector<int32_t> a = model.sets.nodes_in_order(fields, 1, use);
  const std::vector<int32_t> b = model.sets.nodes_in_order(fields, 2, use);
  if (b.size() != 1 && a.size() != b.size()) {
    fields.fail(
        fmt::format("*MPC {}: found {} and {} nodes, expected as many, or one as the second", type,
                    a.size(), b.size()));
  }
  // A rod from each node of a set to one node is one rigid body.
  const size_t first_body = model.deck.rigid.size(), first_rows = model.dependents.size();
  for (size_t i = 0; i < a.size(); ++i) {
    add_pair(model, type, fields, a[i], b[b.size() == 1 ? 0 : i], equations);
    if (type != "BEAM" || i == 0 || b.size() != 1) continue;
    auto& rows = model.dependents[first_rows].second;
    rows.push_back(a[i]);
    model.dependents.pop_back();
    model.deck.rigid.pop_back();
  }
  if (first_body < model.deck.rigid.size()) sort_unique(model.dependents[first_rows].second);
}

}  // namespace clatter::mesh::deck::abaqus
