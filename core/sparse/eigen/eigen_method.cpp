// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/eigen_method.hpp"

namespace clatter::sparse {

std::string name_of(EigenMethod method) {
  if (method == EigenMethod::kArpack) return "arpack";
  return method == EigenMethod::kAmls ? "amls" : "block-lanczos";
}

EigenChoice read_eigen_choice(const Config& config) {
  EigenChoice out;
  const std::string solver = config.choice("eigen_solver", {"block-lanczos", "arpack", "amls"});
  for (const EigenMethod method : {EigenMethod::kArpack, EigenMethod::kAmls})
    if (solver == name_of(method)) out.method = method;
  out.accuracy = config.number_or("accuracy", out.accuracy, {1e-6, 0.1});
  return out;
}

}  // namespace clatter::sparse
