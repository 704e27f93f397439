#pragma once
// The eigen-solvers by name, and what a request says of them.
#include <string>

#include "core/base/config.hpp"

namespace clatter::sparse {

/// kAmls: many modes at engineering accuracy, frequencies from above.
enum class EigenMethod { kBlockLanczos, kArpack, kAmls };

/// "block-lanczos", "arpack", "amls".
std::string name_of(EigenMethod method);

/// Which solver, and how good; defaults stand here.
struct EigenChoice {
  EigenMethod method = EigenMethod::kBlockLanczos;
  double accuracy = 5e-3;  // of kAmls: largest estimated relative error of a frequency
};

/// The keys `eigen_solver` and `accuracy`; InputError for another solver and beyond [1e-6, 0.1].
EigenChoice read_eigen_choice(const Config& config);

}  // namespace clatter::sparse
