// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/shared_pencil.hpp"

#include "core/base/error.hpp"
#include "core/ranks/parpack.hpp"

namespace clatter::ranks {

using Eigen::Index;
using Eigen::MatrixXd;

SharedPencil::SharedPencil(const SharedMatrices& own, Extent extent)
    : own_(own),
      extent_(extent),
      K_(std::make_shared<SharedMatrix>(own.ranks, own.shares, own.K, extent == Extent::kWhole)),
      M_(std::make_shared<SharedMatrix>(own.ranks, own.shares, own.M, extent == Extent::kWhole)) {}

int64_t SharedPencil::size() const {
  return extent_ == Extent::kWhole ? own_.shares.size() : own_.shares.interior();
}

std::unique_ptr<sparse::Factor> SharedPencil::probed(double sigma, Extent extent,
                                                     const sparse::FactorOptions& options) const {
  auto made = std::make_unique<MumpsFactor>(own_.ranks, own_.shares,
                                            ShiftedEntries{own_.K, own_.M, sigma}, extent, options);
  made->probe([&](const MatrixXd& x) -> MatrixXd { return *K_ * x - sigma * (*M_ * x); }, options);
  return made;
}

std::unique_ptr<sparse::Factor> SharedPencil::factor(double sigma,
                                                     const sparse::FactorOptions& options) const {
  return probed(sigma, extent_, options);
}

std::unique_ptr<sparse::Factor> SharedPencil::factor_with_boundary() const {
  return probed(0.0, Extent::kInteriorToBoundary, {});
}

sparse::InertiaCount SharedPencil::count_below(double limit,
                                               const std::vector<int64_t>& /*order*/) const {
  return ranks::count_below(own_.ranks, own_.shares, own_.K, own_.M, limit, extent_);
}

std::unique_ptr<sparse::ArpackRoutines> SharedPencil::arpack() const {
  return std::make_unique<ParpackRoutines>(own_.ranks);
}

const std::vector<int32_t>& SharedPencil::places() const {
  const Numbering& numbering = own_.numbering;
  return extent_ == Extent::kWhole ? numbering.dof : numbering.stored.permutation;
}

std::vector<int32_t> SharedPencil::own_places() const {
  std::vector<int32_t> own;
  for (const int64_t row : own_.shares.rows_of(own_.ranks.rank(), extent_ == Extent::kWhole))
    own.push_back(places()[row]);
  return own;
}

std::vector<int> SharedPencil::bodies() const {
  const Ranks& ranks = own_.ranks;
  const auto n = static_cast<Index>(places().size());
  fe::DofUnion own(n);
  for (const Entries* part : {&own_.K, &own_.M})
    for (const Entry& entry : *part)
      if (entry.value != 0.0 && entry.row < n && entry.column < n)
        own.join(places()[entry.row], places()[entry.column]);
  std::vector<std::vector<int32_t>> out(static_cast<size_t>(ranks.size()));
  out[0] = own.roots();
  fe::DofUnion all(n);
  for (const std::vector<int32_t>& roots : ranks.exchange(out))
    if (!roots.empty()) all.join_all(roots);
  std::vector<int32_t> body;
  if (ranks.rank() == 0) {
    const std::vector<int> numbered = fe::numbered_sets(all);
    body.assign(numbered.begin(), numbered.end());
  }
  ranks.share(body);
  return {body.begin(), body.end()};
}

fe::FreeMotions SharedPencil::free_motions(const MatrixXd& rigid) const {
  const std::vector<int32_t> own = own_places();
  const auto with = [&](const auto& product) {
    return [&, product](const MatrixXd& x) {
      MatrixXd all = MatrixXd::Zero(x.rows(), x.cols());
      all(own, Eigen::all) = product(MatrixXd(x(own, Eigen::all)));
      return own_.ranks.sum(std::move(all));
    };
  };
  return fe::free_motions(
      fe::RigidProducts{bodies(), with([&](const MatrixXd& x) { return mass_times(x); }),
                        with([&](const MatrixXd& x) { return stiffness_times(x); }),
                        with([&](const MatrixXd& x) { return magnitude_times(x); })},
      rigid);
}

}  // namespace clatter::ranks
