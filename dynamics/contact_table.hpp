#pragma once
// The [contact] table of a scene.
#include "core/base/config.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::dynamics {

/// Reads [contact]; every key has a default but `bore_mm` and `clearance_um`. `lubrication =
/// "none"` turns the film off. Heights are z from the pin's centre.
film::PistonLinerOptions read_contact(const Config& table);

}  // namespace clatter::dynamics
