// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Verifies an assembled model before it is written.
#include <Eigen/Core>

#include "assembly/constraint/constrain.hpp"
#include "assembly/model/fe_certificate.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/fe_model.hpp"

namespace clatter::assembly {

/// Checks M, K, T and `rigid` of `model` against each other and against the integrals over the
/// elements (model.mass); returns the certificate. Supported coordinates enter with their own
/// blocks, so that a supported model is checked too; rigid motions that an equation constrains are
/// excluded.
/// NumericsError when mass, centre or inertia differ by more than 1e-9 (hard case B5), or when
/// rigid motions cause forces or are not recovered to 1e-9.
/// A lumped mass preserves only the total: centre and inertia are measured, not required.
FeCertificate certify(const fe::FeModel& model, const Constrained& constrained,
                      const Recipe& recipe);

}  // namespace clatter::assembly
