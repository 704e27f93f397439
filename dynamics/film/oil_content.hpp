// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Oil content of one film under the integrator's tableau.
#include <Eigen/Core>
#include <array>
#include <vector>

#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// Content m [m] of each cell: m_i = m_n - (sum_{j<i} w_j F_j + kappa F_i) / A at stage i, with
/// what the flows F_j of the stages take out of the cell, as all states
/// (dynamics/element/element.hpp). So it changes by exactly the flows, which are accounted for.
///
/// The two methods of second order are not positive: at Courant numbers above 2.4 the earlier
/// stages of SDIRK2 drag more oil out of a cell than it held. `before` reduces such outflow face by
/// face (PadFaces::limit_outflow), so that no cell of any stage holds less than nothing and what
/// leaves one cell still enters the next.
class OilContent {
 public:
  explicit OilContent(const Reynolds& film);

  /// The run begins with `content` [m], n, and no flows.
  void start(const Eigen::ArrayXd& content);
  /// m~ [m], n, of the stage with these weights [s]: m_n - sum w_j F_j / A, limited. What the wall
  /// carries over a face of `known` is the volume from there instead; null: there are none.
  const Eigen::ArrayXd& before(const Reynolds& film, const std::vector<double>& weights,
                               const KnownFlows* known = nullptr);
  /// Keeps the solution of stage `index` with `kappa` [s] and what was given to before().
  void finish_stage(const Reynolds& film, int index, double kappa,
                    const std::vector<double>& weights, const KnownFlows* known = nullptr);
  /// Volumes that the step moved up to the last finished stage, as Reynolds::flows() [m3]. They are
  /// what its content changed by.
  const Eigen::ArrayXd& moved() const { return moved_; }
  /// The same carried by the sliding wall over faces and rims.
  const Eigen::ArrayXd& carried() const { return carried_moved_; }
  /// Discards the stages of a rejected step.
  void begin_step() { last_ = 0; }
  /// The last stage becomes the state.
  void accept_step();

  /// Content [m] and Reynolds::profile() of the last accepted step, n each.
  const Eigen::ArrayXd& content() const { return content_; }
  const Eigen::ArrayXd& profile() const { return profile_; }
  /// What lies in cells may be moved between them after an accepted step.
  Eigen::ArrayXd& content() { return content_; }

  /// The state as numbers: content, profile, and flows of the last step.
  void save(std::vector<double>& state) const;
  size_t saved_size() const;
  /// Takes `saved_size()` numbers from `next` on; returns where they end.
  std::vector<double>::const_iterator restore(std::vector<double>::const_iterator next);

 private:
  Eigen::ArrayXd content_, profile_, before_, stage_content_, stage_profile_, sent_, moved_,
      carried_moved_;
  // Reynolds::flows() and carried() of the stages [m3/s]; [0]: of the last accepted step.
  std::array<Eigen::ArrayXd, 4> flows_, carried_;
  int last_ = 0;
};

}  // namespace clatter::film
