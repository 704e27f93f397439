// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The [contact] table of a scene.
#include <optional>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/cylinder/oil_table.hpp"
#include "dynamics/cylinder/recess_table.hpp"
#include "dynamics/cylinder/ring_table.hpp"
#include "dynamics/cylinder/shape_table.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::dynamics {

/// [contact]. Heights are z from the pin's centre.
struct ContactTable {
  film::PistonLinerOptions options;
  std::vector<RingSpec> rings;
  std::vector<ShapeTable> bore_shapes, skirt_shapes;

  // As given; the options follow from them.
  std::optional<double> clearance, minimum_warm_clearance;  // [m]
  std::optional<int> cells_around;
  std::vector<double> bore_height, bore_widening;  // [m]
  OilTable oil;
  std::vector<RecessTable> recesses;
  std::vector<RingTable> described_rings;
  std::optional<film::AsperityOptions::Law> law;
  std::optional<double> summit_density, summit_radius;  // [1/m2], [m]
};
/// Every key but `bore_mm` and the clearance has a default. `lubrication = "none"` switches the
/// film off.
const keys::Keys<ContactTable>& contact_keys();

}  // namespace clatter::dynamics
