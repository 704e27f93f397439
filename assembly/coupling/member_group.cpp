// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/member_group.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "assembly/coupling/cluster.hpp"

namespace clatter::assembly {
namespace {

constexpr double kRounding = 1e-14;  // of a row's largest entry: weights that are zero in theory

int mask_of(const Member& member) {
  int mask = 0;
  for (int d = 0; d < 6; ++d) mask |= member.has(d) ? 1 << d : 0;
  return mask;
}

MemberGroup make_group(const std::vector<Member>& members, std::vector<size_t> chosen) {
  MemberGroup group;
  for (const size_t m : chosen) group.weight += members[m].weight;
  for (const size_t m : chosen) group.shares.push_back(members[m].weight / group.weight);
  group.members = std::move(chosen);
  return group;
}

}  // namespace

std::vector<MemberGroup> group_members(const std::vector<Member>& members) {
  std::vector<MemberGroup> groups;
  std::map<int, std::vector<int32_t>> alike;
  for (size_t m = 0; m < members.size(); ++m) {
    const int mask = mask_of(members[m]);
    if (members.size() > kLargeFace && mask < 8)
      alike[mask].push_back(static_cast<int32_t>(m));
    else
      groups.push_back(make_group(members, {m}));
  }
  RowMatrix positions(static_cast<Eigen::Index>(members.size()), 3);
  for (size_t m = 0; m < members.size(); ++m)
    positions.row(static_cast<Eigen::Index>(m)) = members[m].position.transpose();
  for (const auto& [mask, list] : alike)
    for (const std::vector<int32_t>& cluster : cluster_nodes(positions, list, kGroupNodes))
      groups.push_back(make_group(members, {cluster.begin(), cluster.end()}));
  return groups;
}

std::vector<Member> members_of(const RowMatrix& coordinates, const SurfaceIntegrals& surface) {
  std::vector<Member> members;
  const double largest = surface.weight.maxCoeff();
  for (size_t k = 0; k < surface.nodes.size(); ++k) {
    const double weight = surface.weight(static_cast<Eigen::Index>(k));
    if (weight <= kRounding * largest) continue;
    const int32_t node = surface.nodes[k];
    members.push_back({{3 * node, 3 * node + 1, 3 * node + 2, -1, -1, -1},
                       coordinates.row(node).transpose(),
                       weight});
  }
  return members;
}

void set_rows(const Eigen::MatrixXd& C, const std::vector<MemberGroup>& groups,
              const std::vector<Member>& members, Coupling& coupling) {
  const bool direct = std::all_of(groups.begin(), groups.end(), [](const MemberGroup& group) {
    return group.members.size() == 1;
  });
  std::vector<int32_t> id(static_cast<size_t>(C.cols()), -1);
  for (Eigen::Index c = 0; c < C.cols(); ++c) {
    const MemberGroup& group = groups[c / 6];
    const auto d = static_cast<size_t>(c % 6);
    if (C.col(c).isZero(0.0)) continue;  // a direction that no row uses
    id[c] =
        direct ? members[group.members[0]].dofs[d] : static_cast<int32_t>(coupling.means.size());
    if (direct) continue;
    Functional mean;
    for (const size_t m : group.members) mean.dofs.push_back(members[m].dofs[d]);
    mean.values = group.shares;
    coupling.means.push_back(std::move(mean));
  }
  for (Eigen::Index r = 0; r < C.rows(); ++r) {
    const double least = kRounding * C.row(r).cwiseAbs().maxCoeff();
    Functional row;
    for (Eigen::Index c = 0; c < C.cols(); ++c) {
      if (std::abs(C(r, c)) <= least) continue;
      row.dofs.push_back(id[c]);
      row.values.push_back(C(r, c));
    }
    coupling.rows.push_back(std::move(row));
  }
}

}  // namespace clatter::assembly
