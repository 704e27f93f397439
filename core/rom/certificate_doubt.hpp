#pragma once
// What a reader of a reduced model must tell its user.
#include <string>

#include "core/rom/reduced_model.hpp"

namespace clatter::rom {

/// What a user should know before trusting a reduced model, from its certificate: "" when it is
/// certified, else why not: it has none, or it was condensed with --no-certificate.
std::string certificate_doubt(const ReducedModel& model);

}  // namespace clatter::rom
