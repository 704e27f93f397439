// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Comparison of the modes of a reduced model with those of the full model.
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/fe/fe_model.hpp"
#include "core/modes/analysis.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::modes {

/// Both zero: all modes below accurate_to_hz of the reduced model's certificate; if absent, below
/// its valid_to_hz; without either, the 20 lowest.
struct CompareOptions {
  double fmax_hz = 0.0;  // compare all modes below
  int count = 0;         // or the lowest ones, rigid included
};

/// One elastic mode of the full model and its partner.
struct ComparedMode {
  double full_hz = 0.0;
  double reduced_hz = 0.0;
  double error = 0.0;  // reduced / full - 1
  double mac = 0.0;    // modal assurance criterion
};

struct Comparison {
  std::vector<ComparedMode> modes;
  int rigid_full = 0;
  int rigid_reduced = 0;
  int rows = 0;                 // displacements used to compare shapes
  double accurate_to_hz = 0.0;  // the reduced model's certificate states an error up to here; 0: no
  /// MAC of each elastic mode of the full model (rows, all modes compared) with each of the as many
  /// lowest elastic ones of the reduced model, whose frequencies are `column_hz`.
  Eigen::MatrixXd mac_matrix{};
  Eigen::VectorXd column_hz{};

  double largest_error() const;
  double smallest_mac() const;
  /// The modes up to accurate_to_hz, and those above, for which no error is certified.
  Comparison with_stated_error() const;
  Comparison without_stated_error() const;
};

/// No elastic mode lies in the requested range: an error, since "largest error 0" would prove
/// nothing.
struct NothingCompared : NumericsError {
  using NumericsError::NumericsError;
};

/// Pairs each elastic mode with the most similar one within 5 % of its frequency (by order when
/// none has a MAC over 0.5). Shapes are compared at the boundary coordinates and the skin nodes
/// that both models have (found by their coordinates) by
///   MAC = |P phi|^2 / |phi|^2,
/// P the projector on the reduced modes within 0.5 % of the frequency: for a single mode this is
/// Allemang's criterion (Allemang and Brown, 1982), for near-multiple modes, which mix freely, it
/// compares subspaces (hard case B8). InputError when the models share no position, NumericsError
/// when their modes differ in number, NothingCompared naming the first elastic frequency.
Comparison compare(const fe::FeModel& full, const rom::ReducedModel& reduced,
                   const CompareOptions& options);

/// The same with modes of the full model by another solver, whose K and M may be left out. Where
/// another process receives their vectors nothing is compared: no modes, and `reduced` may lack
/// rows.
Comparison compare(const fe::FeModel& full, const rom::ReducedModel& reduced,
                   const CompareOptions& options, const ModeSolver& solve);

/// The comparison as an aligned table; the last line summarises the modes up to accurate_to_hz, a
/// line before it those above.
std::vector<std::string> table_of(const Comparison& comparison);

/// The matrix of MAC as CSV: after one line that begins with # a row with the frequencies of the
/// reduced model, then a row per mode of the full model, its frequency first [Hz].
std::string matrix_text(const Comparison& comparison);

/// For --json: modes (full_hz, reduced_hz, error, mac of each), rigid, largest_error, smallest_mac,
/// accurate_to_hz, and the figures of the modes up to it: modes_up_to_it, largest_error_up_to_it,
/// smallest_mac_up_to_it (null without such modes).
JsonMembers json_of(const Comparison& comparison);

}  // namespace clatter::modes
