#include "modal/eigen/eigen_method.hpp"

namespace clatter::modal {

EigenMethod eigen_method_of(const std::string& name) {
  if (name == "arpack") return EigenMethod::kArpack;
  return name == "amls" ? EigenMethod::kAmls : EigenMethod::kBlockLanczos;
}

std::string name_of(EigenMethod method) {
  if (method == EigenMethod::kArpack) return "arpack";
  return method == EigenMethod::kAmls ? "amls" : "block-lanczos";
}

}  // namespace clatter::modal
