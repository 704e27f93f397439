// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/law/impact_law.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Rounds until the contacts that are left are closed without restitution.
constexpr int kMostRounds = 1000;
/// Part of the first round's velocities below which a contact does not close.
constexpr double kNegligible = 1e-13;
constexpr int kMostIterations = 100000;    // of a quadratic problem
constexpr int kMostSlipCorrections = 200;  // of the friction law

/// Contacts of one round.
class Round {
 public:
  /// @param velocity u of these contacts, 3 m.
  Round(const MatrixXd& mobility, const VectorXd& velocity, std::vector<ImpactLaw> laws)
      : laws_(std::move(laws)), u_(velocity) {
    // One scale a contact keeps its cone, and light and heavy bodies alike.
    scale_.resize(u_.size());
    for (Eigen::Index i = 0; i < count(); ++i) {
      const double largest = mobility.diagonal().segment<3>(3 * i).maxCoeff();
      scale_.segment<3>(3 * i).setConstant(largest > 0.0 ? 1.0 / std::sqrt(largest) : 0.0);
    }
    g_ = scale_.asDiagonal() * mobility * scale_.asDiagonal();
    for (Eigen::Index i = 0; i < count(); ++i) {
      if (laws_[i].friction > 0.0) continue;
      g_.middleRows<2>(3 * i + 1).setZero();
      g_.middleCols<2>(3 * i + 1).setZero();
    }
    if (count() > 0)
      steepest_ = Eigen::SelfAdjointEigenSolver<MatrixXd>(g_, Eigen::EigenvaluesOnly)
                      .eigenvalues()
                      .maxCoeff();
  }

  VectorXd impulses() const {
    const VectorXd bouncing = solve(1.0);
    if (!(gain(bouncing) > 0.0)) return scale_.cwiseProduct(bouncing);
    const VectorXd plastic = solve(0.0);
    return scale_.cwiseProduct(blend(plastic, bouncing));
  }

 private:
  Eigen::Index count() const { return std::ssize(laws_); }
  VectorXd own(const VectorXd& velocity) const {
    VectorXd scaled = scale_.cwiseProduct(velocity);
    for (Eigen::Index i = 0; i < count(); ++i)
      if (laws_[i].friction == 0.0) scaled.segment<2>(3 * i + 1).setZero();
    return scaled;
  }

  /// The energy that scaled impulses x add.
  double gain(const VectorXd& x) const { return x.dot(own(u_) + 0.5 * (g_ * x)); }

  /// The point of the way from `from`, which gains nothing, to `to` where the energy is the old
  /// one.
  VectorXd blend(const VectorXd& from, const VectorXd& to) const {
    const VectorXd way = to - from;
    // gain(from + s way) = c + b s + a s^2 with c <= 0 < c + b + a.
    const double a = 0.5 * way.dot(g_ * way), b = way.dot(own(u_) + g_ * from),
                 c = std::min(gain(from), 0.0);
    const double root = std::sqrt(std::max(b * b - 4.0 * a * c, 0.0));
    const double s = b > 0.0 ? -2.0 * c / (b + root) : (root - b) / (2.0 * a);
    return from + std::clamp(s, 0.0, 1.0) * way;
  }

  /// Scaled impulses with `share` of the restitutions. The friction law is that of a quadratic
  /// problem whose normal velocities are larger by mu |u+_t| (De Saxce and Feng 1998).
  VectorXd solve(double share) const {
    VectorXd b = own(u_);
    for (Eigen::Index i = 0; i < count(); ++i) b(3 * i) *= 1.0 + share * laws_[i].restitution;
    const VectorXd without = b;
    VectorXd x = VectorXd::Zero(b.size());
    double weight = 1.0;
    for (int k = 0; k < kMostSlipCorrections; ++k) {
      x = least(b, x);
      const VectorXd after = own(u_) + g_ * x;
      double change = 0.0;
      for (Eigen::Index i = 0; i < count(); ++i) {
        const double slip = laws_[i].friction * after.segment<2>(3 * i + 1).norm();
        const double next = b(3 * i) + weight * (without(3 * i) + slip - b(3 * i));
        change = std::max(change, std::abs(next - b(3 * i)));
        b(3 * i) = next;
      }
      if (change <= kNegligible * without.lpNorm<Eigen::Infinity>()) break;
      if (k >= 20) weight = 0.5;
    }
    return x;
  }

  /// Nearest point of the cones |x_t| <= mu x_n.
  void project(VectorXd& x) const {
    for (Eigen::Index i = 0; i < count(); ++i) {
      auto at = x.segment<3>(3 * i);
      const double mu = laws_[i].friction, slip = at.tail<2>().norm();
      if (mu == 0.0) {
        at << std::max(at(0), 0.0), 0.0, 0.0;
      } else if (mu * slip <= -at(0)) {
        at.setZero();
      } else if (slip > mu * at(0)) {
        const double normal = (at(0) + mu * slip) / (1.0 + mu * mu);
        at.tail<2>() *= mu * normal / slip;
        at(0) = normal;
      }
    }
  }

  /// The x in the cones with the least x (g x / 2 + b): accelerated projected gradient that starts
  /// again where it overshoots (O'Donoghue and Candes 2015). From 0 it stays among the smallest x.
  VectorXd least(const VectorXd& b, VectorXd x) const {
    if (!(steepest_ > 0.0)) return x;
    VectorXd y = x, next;
    double t = 1.0;
    const double enough = 1e-16 * b.lpNorm<Eigen::Infinity>() / steepest_;
    for (int k = 0; k < kMostIterations; ++k) {
      next = y - (g_ * y + b) / steepest_;
      project(next);
      const VectorXd moved = next - x;
      const bool overshoots = (y - next).dot(moved) > 0.0;
      const double left = (next - y).lpNorm<Eigen::Infinity>();
      const double t_next = 0.5 * (1.0 + std::sqrt(1.0 + 4.0 * t * t));
      y = overshoots ? next : VectorXd(next + (t - 1.0) / t_next * moved);
      t = overshoots ? 1.0 : t_next;
      x = next;
      if (left <= std::max(enough, 2e-16 * x.lpNorm<Eigen::Infinity>())) break;
    }
    return x;
  }

  std::vector<ImpactLaw> laws_;
  VectorXd u_, scale_;
  MatrixXd g_;  // scaled; without tangents of contacts without friction
  double steepest_ = 0.0;
};

/// The 3 rows of each contact.
std::vector<int> rows_of(const std::vector<int>& contacts) {
  std::vector<int> rows;
  for (const int i : contacts)
    for (int k = 0; k < 3; ++k) rows.push_back(3 * i + k);
  return rows;
}

}  // namespace

VectorXd impact_impulses(const MatrixXd& mobility, const VectorXd& velocity,
                         const std::vector<ImpactLaw>& laws) {
  VectorXd total = VectorXd::Zero(velocity.size()), u = velocity;
  double fastest = 0.0;
  for (Eigen::Index i = 0; i < std::ssize(laws); ++i) fastest = std::max(fastest, -velocity(3 * i));
  const auto closes = [&](int i) {
    const double before = laws[i].held ? std::min(velocity(3 * i), 0.0) : 0.0;
    return u(3 * i) < before - kNegligible * fastest;
  };
  for (int round = 0; round <= kMostRounds; ++round) {
    const bool last = round == kMostRounds;
    std::vector<int> contacts;
    std::vector<ImpactLaw> taken;
    bool any = false;
    for (int i = 0; i < std::ssize(laws); ++i) {
      any = any || closes(i);
      if (!closes(i) && !last && (laws[i].held || laws[i].restitution > 0.0)) continue;
      contacts.push_back(i);
      taken.push_back(laws[i]);
      if (last) taken.back().restitution = 0.0;
    }
    if (!any) break;
    const std::vector<int> rows = rows_of(contacts);
    const VectorXd impulses = Round(mobility(rows, rows), u(rows), taken).impulses();
    total(rows) += impulses;
    u += mobility(Eigen::all, rows) * impulses;
  }
  return total;
}

}  // namespace clatter::dynamics
