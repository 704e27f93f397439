#pragma once
// Proves an assembled model before it is written.
#include <Eigen/Core>
#include <map>
#include <string>

#include "assembly/constrain.hpp"
#include "core/fe/assemble.hpp"
#include "core/fe/fe_model.hpp"

namespace clatter::assembly {

/// Checks M, K, T and `rigid` of `model` against each other and against the integrals over the
/// elements (model.mass); returns the numbers. Supported coordinates count with their own blocks,
/// so that a supported model is checked too; rigid motions that an equation holds are left out.
/// NumericsError when mass, centre or inertia are off by more than 1e-9 (hard case B5), or when
/// rigid motions are not free of force or not recovered to 1e-9.
/// A lumped mass keeps the total only: centre and inertia are measured, not required.
std::map<std::string, double> certify(const fe::FeModel& model, const Constrained& constrained,
                                      fe::MassForm mass);

}  // namespace clatter::assembly
