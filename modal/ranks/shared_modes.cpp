// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/ranks/shared_modes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/log.hpp"
#include "core/ranks/rank_share.hpp"
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
  const ranks::SharedMatrices matrices(all, path, left, others(left, model.size()), {});
  const ranks::SharedPencil pencil(matrices, ranks::Extent::kInterior);
  const std::vector<int32_t> own = pencil.own_places();
  // Matrices imported without positions have no known rigid-body motions.
  if ((model.rigid.colwise().squaredNorm().array() > 0.0).all())
    options.rigid =
        Eigen::MatrixXd(pencil.free_motions(model.rigid(left, Eigen::all)).q(own, Eigen::all));
  sparse::ModeSet modes = sparse::solve_modes(pencil, options);
  Eigen::MatrixXd vectors =
      all.gather_at(own, modes.vectors, static_cast<Eigen::Index>(left.size()));
  if (all.rank() > 0) modes = {};
  modes.vectors = std::move(vectors);
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
