// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The energy balance, updated during the integration.
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/law/archive.hpp"

namespace clatter::dynamics {

/// Energies in the bodies' reference frames [J].
struct EnergyState {
  double time = 0.0;
  double kinetic = 0.0;       // 1/2 v^T v of modes with inertia
  double strain = 0.0;        // 1/2 omega^2 eta^2
  double element = 0.0;       // stored in elements
  double lost = 0.0;          // since the start: dampers, friction, film, modal damping
  double input = 0.0;         // since the start: loads and prescribed motion
  double exchanged = 0.0;     // since the start: sum of |power| over all terms
  std::vector<double> terms;  // each input (>0 in) and loss (<0), as EnergyBalance::terms()

  double stored() const { return kinetic + strain + element; }
};

/// Accumulates  stored(t) - stored(0) = input - lost + imbalance.
///
/// Powers are summed with the scheme's own weights, dt b_i over the three stages, so the balance
/// measures the integrator and not a quadrature. The inertia forces of accelerated frames are
/// ordinary loads; their work is the term "inertia frame".
class EnergyBalance : public StageObserver {
 public:
  explicit EnergyBalance(const System& system, const Tableau& method = tr_bdf2());

  void stage(int index, const StageState& state) override;
  void accept(double dt) override;
  const EnergyState& now() const { return now_; }
  /// Names of the terms.
  const std::vector<std::string>& terms() const { return names_; }
  /// Restarts the sums from the current state.
  void reset();
  /// Powers and energies of the current state, for checkpoints; restore() restarts the sums from
  /// them.
  std::vector<double> save() const;
  void restore(const std::vector<double>& state, double time);
  /// The sums, for a checkpoint at which they do not restart.
  void archive(Archive& archive);
  /// |imbalance()| over exchanged(), at least over `least` [J]: of what hardly moves the imbalance
  /// is rounding of what little is exchanged. 0 when nothing moved.
  double residue(double least = 0.0) const;
  /// The sum of |work| of all terms, at least the largest change of a stored energy: without losses
  /// and loads energy only passes between bodies and elements (hard case S1) [J].
  double exchanged() const;
  /// stored(now) - stored(start) - input + lost, since reset [J].
  double imbalance() const;

 private:
  struct Flow {
    double kinetic = 0.0, strain = 0.0, element = 0.0;
    std::vector<double> powers;  // per term; losses negative
    double stored() const { return kinetic + strain + element; }
  };
  Flow flow(const StageState& state) const;
  void count_event(double change);
  void follow_stores();
  size_t term(const std::string& name);
  void start_from(const Flow& flow);

  const System& system_;
  const Tableau& method_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, size_t> index_;  // of a name
  std::vector<size_t> load_term_, input_term_, lost_term_;
  std::optional<size_t> events_term_;
  std::vector<char> is_loss_;  // per term
  Flow stages_[3];
  struct Span {
    double low = 0.0, high = 0.0;
  };
  Span spans_[3];  // of kinetic, strain and element energy since reset [J]
  double time_ = 0.0;
  double stored_at_start_ = 0.0;
  bool started_ = false;
  EnergyState now_;
};

}  // namespace clatter::dynamics
