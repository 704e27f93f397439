#include "condense/recovery_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <set>

#include "core/error.hpp"
#include "core/threads.hpp"

namespace clatter::condense {
namespace {

const IndexMatrix& quadratic_surface(const assembly::FeModel& model, const std::string& name) {
  const auto found = model.surfaces.find(name);
  if (found == model.surfaces.end()) {
    std::vector<std::string> present;
    for (const auto& [key, value] : model.surfaces) present.push_back(key);
    throw InputError(fmt::format("{}: skin: found surface \"{}\", expected one of: {}", model.name,
                                 name, fmt::join(present, ", ")));
  }
  if (found->second.cols() != 6) {
    throw InputError(
        fmt::format("{}: skin: surface \"{}\" has linear triangles, expected quadratic "
                    "ones (tet10)",
                    model.name, name));
  }
  return found->second;
}

/// Triangles of all surfaces in model node numbers, each face once.
IndexMatrix join_surfaces(const assembly::FeModel& model, const std::vector<std::string>& names) {
  std::set<std::array<int32_t, 3>> seen;
  std::vector<Eigen::Matrix<int32_t, 1, 6>> rows;
  for (const std::string& name : names) {
    for (const auto& triangle : quadratic_surface(model, name).rowwise()) {
      std::array<int32_t, 3> corners = {triangle[0], triangle[1], triangle[2]};
      std::sort(corners.begin(), corners.end());
      if (seen.insert(corners).second) rows.emplace_back(triangle);
    }
  }
  IndexMatrix joined(static_cast<Eigen::Index>(rows.size()), 6);
  for (size_t f = 0; f < rows.size(); ++f) joined.row(static_cast<Eigen::Index>(f)) = rows[f];
  return joined;
}

/// Replaces model node numbers by places in the returned ascending list.
std::vector<int32_t> renumber(IndexMatrix& triangles) {
  std::vector<int32_t> nodes(triangles.data(), triangles.data() + triangles.size());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (int32_t& node : triangles.reshaped()) {
    node = static_cast<int32_t>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  }
  return nodes;
}

/// V(dof, :) for each model DoF without forming V: where the row stands, and in which block.
class BasisRows {
 public:
  BasisRows(const DofPartition& partition, const ReducedBasis& basis)
      : basis_(basis), place_(partition.interior.size() + partition.boundary.size()) {
    for (size_t k = 0; k < partition.interior.size(); ++k)
      place_[static_cast<size_t>(partition.interior[k])] = {false, static_cast<int32_t>(k)};
    for (size_t k = 0; k < partition.boundary.size(); ++k)
      place_[static_cast<size_t>(partition.boundary[k])] = {true, static_cast<int32_t>(k)};
  }

  template <typename Row>
  void add(Eigen::Index dof, double factor, Row&& row) const {
    const auto [boundary, k] = place_[static_cast<size_t>(dof)];
    row += factor * (boundary ? basis_.V_b.row(k) : basis_.V_i.row(k));
  }

 private:
  const ReducedBasis& basis_;
  std::vector<std::pair<bool, int32_t>> place_;
};

RowMatrix recovery_matrix(const assembly::FeModel& model, const DofPartition& partition,
                          const ReducedBasis& basis, const std::vector<int32_t>& nodes) {
  const BasisRows rows(partition, basis);
  const Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t> by_row = model.T;
  RowMatrix out = RowMatrix::Zero(3 * static_cast<Eigen::Index>(nodes.size()), basis.size());
  parallel_pieces(out.rows(), [&](int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; ++row) {
      const int64_t source = 3 * int64_t{nodes[static_cast<size_t>(row / 3)]} + row % 3;
      using Iterator = Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t>::InnerIterator;
      for (Iterator it(by_row, source); it; ++it) rows.add(it.col(), it.value(), out.row(row));
    }
  });
  return out;
}

}  // namespace

Skin recover_skin(const assembly::FeModel& model, const DofPartition& partition,
                  const ReducedBasis& basis, const std::vector<std::string>& surfaces) {
  Skin skin;
  if (surfaces.empty()) return skin;
  skin.triangles = join_surfaces(model, surfaces);
  const std::vector<int32_t> nodes = renumber(skin.triangles);
  skin.nodes = model.nodes(nodes, Eigen::all);
  skin.T = recovery_matrix(model, partition, basis, nodes);
  return skin;
}

}  // namespace clatter::condense
