#pragma once
// The eigen-solvers by name.
#include <string>

namespace clatter::modal {

/// kAmls: many modes at engineering accuracy, frequencies from above.
enum class EigenMethod { kBlockLanczos, kArpack, kAmls };

/// "block-lanczos", "arpack", "amls"; block Lanczos for any other text.
EigenMethod eigen_method_of(const std::string& name);
std::string name_of(EigenMethod method);

}  // namespace clatter::modal
