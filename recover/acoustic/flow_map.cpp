// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/flow_map.hpp"

#include "core/base/threads.hpp"

namespace clatter::recover {

void FlowMapBuilder::add(int32_t face, int32_t node, const Shape6& shape,
                         const Eigen::Vector3d& area_vector) {
  const auto [at, is_new] = entries_.try_emplace({face, node});
  if (is_new) at->second.setZero();
  for (int a = 0; a < 6; ++a) at->second.segment<3>(3 * a) += shape[a] * area_vector;
}

FlowMap FlowMapBuilder::finish() const {
  FlowMap out;
  out.weight.resize(static_cast<Eigen::Index>(entries_.size()), 18);
  for (const auto& [key, weight] : entries_) {
    out.weight.row(static_cast<Eigen::Index>(out.face.size())) = weight.transpose();
    out.face.push_back(key.first);
    out.node.push_back(key.second);
  }
  return out;
}

std::vector<RowMatrix> group_flows(const FlowMap& flow, const IndexMatrix& triangles,
                                   const rom::SkinRows& T,
                                   const std::vector<int32_t>& group_of_face, int groups,
                                   Eigen::Index n_v) {
  std::vector<int32_t> place(static_cast<size_t>(T.rows() / 3), -1), nodes;
  for (const int32_t face : flow.face)
    for (int a = 0; a < 6; ++a) place[triangles(face, a)] = 0;
  for (size_t node = 0; node < place.size(); ++node) {
    if (place[node] < 0) continue;
    place[node] = static_cast<int32_t>(nodes.size());
    nodes.push_back(static_cast<int32_t>(node));
  }
  const RowMatrix rows = T.of_nodes(nodes);
  std::vector<RowMatrix> out(static_cast<size_t>(groups), RowMatrix::Zero(n_v, T.cols()));
  // Each thread has columns of its own, so sums do not depend on their number.
  parallel_pieces(T.cols(), [&](int64_t begin, int64_t end) {
    for (size_t k = 0; k < flow.face.size(); ++k) {
      const int32_t group = group_of_face[flow.face[k]];
      if (group < 0) continue;
      auto sum = out[group].row(flow.node[k]).segment(begin, end - begin);
      const auto weight = flow.weight.row(static_cast<Eigen::Index>(k));
      for (int a = 0; a < 6; ++a) {
        const int32_t node = place[triangles(flow.face[k], a)];
        for (int d = 0; d < 3; ++d)
          sum += weight[3 * a + d] * rows.row(3 * node + d).segment(begin, end - begin);
      }
    }
  });
  return out;
}

}  // namespace clatter::recover
