// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/ranks/shared_modes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/log.hpp"
#include "core/ranks/rank_share.hpp"
#include "core/ranks/shared_fe_model.hpp"
#include "core/ranks/shared_pencil.hpp"

namespace clatter::modal {
namespace {

std::vector<int32_t> others(const std::vector<int32_t>& left, int size) {
  std::vector<int32_t> held;
  for (int32_t dof = 0; dof < size; ++dof)
    if (!std::binary_search(left.begin(), left.end(), dof)) held.push_back(dof);
  return held;
}

/// Modes of the rows `left` of the part, complete on rank 0, none elsewhere.
sparse::ModeSet solve_shared(const ranks::Ranks& all, const std::filesystem::path& path,
                             const fe::FeModel& model, const std::vector<int32_t>& left,
                             sparse::EigenOptions options) {
  const ranks::Numbering numbering =
      ranks::number_dofs(all, path, left, others(left, model.size()), {});
  const ranks::RowShares shares(static_cast<int64_t>(left.size()), numbering.boundary, all.size());
  const ranks::SharedMatrices matrices = ranks::read_matrices(all, path, numbering, shares);
  const ranks::SharedPencil pencil(all, shares, matrices.K, matrices.M, ranks::Extent::kInterior);
  std::vector<int32_t> own;  // places in `left` of the own rows
  for (const int64_t row : shares.rows_of(all.rank(), false))
    own.push_back(numbering.stored.permutation[row]);
  // Matrices imported without positions have no known rigid-body motions.
  if ((model.rigid.colwise().squaredNorm().array() > 0.0).all()) {
    const fe::FreeMotions free =
        ranks::free_motions(all, matrices, shares, {ranks::Extent::kInterior, numbering}, pencil,
                            model.rigid(left, Eigen::all));
    options.rigid = Eigen::MatrixXd(free.q(own, Eigen::all));
  }
  sparse::ModeSet modes = sparse::solve_modes(pencil, options);
  const std::vector<int32_t> places = all.gather(own);
  const RowMatrix rows = all.gather(RowMatrix(modes.vectors));
  if (all.rank() > 0) {
    modes = {};
    modes.vectors.resize(static_cast<Eigen::Index>(left.size()), 0);
    return modes;
  }
  modes.vectors.resize(rows.rows(), rows.cols());
  modes.vectors(places, Eigen::all) = rows;
  return modes;
}

}  // namespace

ModeFinder shared_finder(const ranks::Ranks& all) {
  ModeFinder finder;
  finder.writes = all.rank() == 0;
  finder.begin = [&all](const CommonOptions& common) { ranks::set_rank_share(all, common); };
  finder.of_fe_model = [&all](const std::filesystem::path& path, const modes::ModesOptions& options,
                              fe::FeModel& model, StepClock& clock) {
    model = fe::read_fe_model(path, fe::FeMatrices::kLeftOut);
    if (model.size() < kFewestShared) {
      if (all.rank() > 0) return modes::PartModes{};
      say(fmt::format("{} DoF: rank 0 computes alone", model.size()));
      return one_process_finder().of_fe_model(path, options, model, clock);
    }
    clock.lap(fmt::format("read {} DoF", model.size()));
    return modes::analyse(model, options,
                          [&](const std::vector<int32_t>& left, const sparse::EigenOptions& eigen) {
                            return solve_shared(all, path, model, left, eigen);
                          });
  };
  return finder;
}

}  // namespace clatter::modal
