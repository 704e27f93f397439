// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/eigen_method.hpp"

namespace clatter::sparse {

std::string name_of(EigenMethod method) {
  if (method == EigenMethod::kArpack) return "arpack";
  return method == EigenMethod::kAmls ? "amls" : "block-lanczos";
}

const keys::Keys<EigenChoice>& eigen_choice_keys() {
  static const keys::Keys<EigenChoice> keys(
      "eigen-solver", "how modes are computed", [](auto& key, EigenChoice& choice) {
        key.choice("eigen_solver", choice.method,
                   {{"block-lanczos", EigenMethod::kBlockLanczos},
                    {"arpack", EigenMethod::kArpack},
                    {"amls", EigenMethod::kAmls}},
                   "exact by Lanczos' method, in blocks or of ARPACK, or approximate by automated "
                   "multilevel substructuring, which suits many modes");
        key.number("accuracy", choice.accuracy, Range::between(1e-6, 0.1),
                   "of amls: largest estimated relative error of a frequency");
      });
  return keys;
}

}  // namespace clatter::sparse
