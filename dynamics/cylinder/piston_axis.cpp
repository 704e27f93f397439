// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/piston_axis.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kSkirtTolerance = 1e-6;  // [m]
constexpr double kSameBore = 0.02;        // of the radius
constexpr double kGasTolerance = 1e-5;    // [m]: at 4 MPa on a bore of 107 mm under 0.4 N m

bool has_grid(const LoadedBody& body, const std::string& grid) {
  return body.model.grids.find(grid) != body.model.grids.end();
}

/// y of the bore's axis in the engine's frame [m].
double bore_axis(const CylinderBodies& bodies) {
  const LoadedBody* block = bodies.block();
  const std::string& liner = block != nullptr ? bodies.spec.bore->liner : "";
  return block != nullptr && has_grid(*block, liner) ? block->model.grid(liner).axis_point.y()
                                                     : 0.0;
}

/// y of the gas load's line of action from the pin [m].
std::optional<double> gas_line(const CylinderBodies& bodies, const LoadedBody& piston) {
  const std::string& load = bodies.spec.piston.gas_load;
  if (!bodies.spec.gas || load.empty()) return std::nullopt;
  const Eigen::VectorXd wrench = piston.model.rigid.transpose() * unit_load(piston.model, load);
  if (wrench(2) == 0.0) return std::nullopt;
  return wrench(3) / wrench(2);
}

}  // namespace

void check_piston_axis(const CylinderBodies& bodies) {
  const CylinderSpec& spec = bodies.spec;
  const LoadedBody& piston = bodies.piston();
  const double offset = spec.engine.pin_offset, bore = bore_axis(bodies);
  const auto check = [&](const char* what, double found, double tolerance) {
    if (std::abs(found + offset - bore) <= tolerance) return;
    throw InputError(
        fmt::format("{}: found {:.4g}, but {} of {} is {:.4g} mm from the pin, expected {:.4g} mm, "
                    "on the bore's "
                    "axis: make the reduced piston with this offset",
                    spec.engine.pin_offset_where, 1e3 * offset, what, piston.spec.rom.string(),
                    1e3 * found + 0.0, 1e3 * (bore - offset)));
  };
  if (has_grid(piston, spec.piston.skirt)) {
    const double radius = piston.model.grid(spec.piston.skirt).radius;
    if (spec.contact && std::abs(radius / spec.contact->bore_radius - 1.0) > kSameBore)
      throw InputError(
          fmt::format("{}: bore_mm: found {:.4g}, but the skirt of {} is {:.4g} mm wide, expected "
                      "the bore of this piston",
                      spec.contact_where, 2e3 * spec.contact->bore_radius, piston.spec.rom.string(),
                      2e3 * radius));
    check("the skirt's axis", piston.model.grid(spec.piston.skirt).axis_point.y(), kSkirtTolerance);
  } else if (const auto line = offset != 0.0 ? gas_line(bodies, piston) : std::nullopt) {
    check("the gas load", *line, kGasTolerance);
  }
}

}  // namespace clatter::dynamics
