// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Volume flow through the nodes of the acoustic skin, by faces of the body: what panels send.
#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "core/base/matrix.hpp"
#include "core/rom/skin_rows.hpp"
#include "recover/skin/triangle6.hpp"

namespace clatter::recover {

/// q_n = int N_n v_n dS at node n of the acoustic skin [m3/s], a sum over entries:
///
///   q(node_k) += sum_a weight_k,a . v(node a of face_k)
///
/// Entries are ascending by face, then node. Their sum over all faces is the flow of the map
/// (VelocityMap), so that the flows of any groups of faces add up to it.
struct FlowMap {
  std::vector<int32_t> face{};  // n_k, of the body's skin
  std::vector<int32_t> node{};  // n_k, of the acoustic skin
  RowMatrix weight{};           // n_k x 18 [m2], column 3 a + d: node a of the face, direction d
};

/// Collects what sample points of the body contribute.
class FlowMapBuilder {
 public:
  /// @param shape shape functions of the face at the sample
  /// @param area_vector the part of its n dS that goes to the node [m2]
  void add(int32_t face, int32_t node, const Shape6& shape, const Eigen::Vector3d& area_vector);
  FlowMap finish() const;

 private:
  std::map<std::pair<int32_t, int32_t>, Eigen::Matrix<double, 18, 1>> entries_{};
};

/// Flow per coordinate of each group of faces.
/// @param triangles n_f x 6, of the body's skin; @param T its rows, 3 n_s x r
/// @param group_of_face n_f, -1: in no group
/// @return a matrix n_v x r for each group [m2, for translations]
std::vector<RowMatrix> group_flows(const FlowMap& flow, const IndexMatrix& triangles,
                                   const rom::SkinRows& T,
                                   const std::vector<int32_t>& group_of_face, int groups,
                                   Eigen::Index n_v);

}  // namespace clatter::recover
