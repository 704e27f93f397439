#include "condense/recovery_rows.hpp"

#include "condense/skin_faces.hpp"
#include "core/threads.hpp"

namespace clatter::condense {
namespace {

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
                          const ReducedBasis& basis, const std::vector<SkinPoint>& points) {
  const BasisRows rows(partition, basis);
  const Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t> by_row = model.T;
  RowMatrix out = RowMatrix::Zero(3 * static_cast<Eigen::Index>(points.size()), basis.size());
  parallel_pieces(out.rows(), [&](int64_t begin, int64_t end) {
    for (int64_t row = begin; row < end; ++row) {
      using Iterator = Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t>::InnerIterator;
      for (const auto& [node, weight] : points[static_cast<size_t>(row / 3)])
        for (Iterator it(by_row, 3 * int64_t{node} + row % 3); it; ++it)
          rows.add(it.col(), weight * it.value(), out.row(row));
    }
  });
  return out;
}

}  // namespace

Skin recover_skin(const assembly::FeModel& model, const DofPartition& partition,
                  const ReducedBasis& basis, const std::vector<std::string>& surfaces) {
  Skin skin;
  if (surfaces.empty()) return skin;
  SkinFaces faces = skin_faces(model, surfaces);
  skin.triangles.swap(faces.triangles);
  skin.nodes = RowMatrix::Zero(static_cast<Eigen::Index>(faces.points.size()), 3);
  for (size_t p = 0; p < faces.points.size(); ++p)
    for (const auto& [node, weight] : faces.points[p])
      skin.nodes.row(static_cast<Eigen::Index>(p)) += weight * model.nodes.row(node);
  skin.T = recovery_matrix(model, partition, basis, faces.points);
  return skin;
}

}  // namespace clatter::condense
