// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The eigen-solvers by name, and the options that select one.
#include <string>

#include "core/keys/keys.hpp"

namespace clatter::sparse {

/// kAmls: many modes at engineering accuracy, frequencies are upper bounds.
enum class EigenMethod { kBlockLanczos, kArpack, kAmls };

/// "block-lanczos", "arpack", "amls".
std::string name_of(EigenMethod method);

/// Solver and accuracy, with their defaults.
struct EigenChoice {
  EigenMethod method = EigenMethod::kBlockLanczos;
  double accuracy = 5e-3;  // of kAmls: largest estimated relative error of a frequency
};

/// The keys `eigen_solver` and `accuracy`.
const keys::Keys<EigenChoice>& eigen_choice_keys();

}  // namespace clatter::sparse
