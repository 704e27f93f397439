// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Oil content of one film under the integrator's tableau.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// Content m [m] of each cell: m_i = m_n + sum_{j<i} w_j m'_j + kappa m'_i at stage i, as all
/// states (dynamics/element/element.hpp).
///
/// The two methods of second order are not positive: at Courant numbers above 2.4 the earlier
/// stages of SDIRK2 drag more oil out of a cell than it held. `before` reduces such outflow face by
/// face (PadFaces::limit_outflow), so that no cell of any stage holds less than nothing and what
/// leaves one cell still enters the next.
class OilContent {
 public:
  /// `by_flows`: the content changes by exactly the flows, to be accounted for, instead of being
  /// that of the solution, from which it differs by the residual of the linear solver (1e-13).
  explicit OilContent(const Reynolds& film, bool by_flows = false);

  /// The run begins with `content` [m], n, and no rates.
  void start(const Eigen::ArrayXd& content);
  /// m~ [m], n, of the stage with these weights [s]: m_n + sum w_j m'_j, limited.
  const Eigen::ArrayXd& before(const Reynolds& film, const std::vector<double>& weights);
  /// Keeps the solution of stage `index` with storage s `space` [m], n, and `kappa` [s].
  void finish_stage(const Reynolds& film, const Eigen::ArrayXd& space, int index, double kappa);
  /// Volumes that the step moved up to the solved stage, as Reynolds::flows() [m3]; before
  /// finish_stage(). They are what its content changed by.
  void volumes(const Reynolds& film, const std::vector<double>& weights, double kappa,
               Eigen::ArrayXd& moved) const;
  /// Discards the stages of a rejected step.
  void begin_step() { last_ = 0; }
  /// The last stage becomes the state.
  void accept_step();

  /// Content [m] and Reynolds::profile() of the last accepted step, n each.
  const Eigen::ArrayXd& content() const { return content_; }
  const Eigen::ArrayXd& profile() const { return profile_; }

  /// The state as numbers: content, profile, rates and flows of the last step.
  void save(std::vector<double>& state) const;
  size_t saved_size() const;
  /// Takes `saved_size()` numbers from `next` on; returns where they end.
  std::vector<double>::const_iterator restore(std::vector<double>::const_iterator next);

 private:
  Eigen::ArrayXd content_, profile_, before_, stage_content_, stage_profile_, sent_;
  std::array<Eigen::ArrayXd, 4> rates_;  // m' of the stages [m/s]; [0]: of the last accepted step
  std::array<Eigen::ArrayXd, 4> flows_;  // Reynolds::flows() of the same [m3/s]
  int last_ = 0;
  bool limited_ = false;  // `before_` follows from `sent_`
  bool by_flows_ = false;
};

}  // namespace clatter::film
