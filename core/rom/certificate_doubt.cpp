#include "core/rom/certificate_doubt.hpp"

namespace clatter::rom {

std::string certificate_doubt(const ReducedModel& model) {
  const auto& found = model.certificate;
  if (found.empty()) return "no certificate: nothing is known of its modes and its mass";
  const auto certified = found.find("certified");
  if (certified == found.end() || certified->second != 0.0) return {};
  return "not certified: condensed with --no-certificate, missing modes would not have been "
         "noticed";
}

}  // namespace clatter::rom
