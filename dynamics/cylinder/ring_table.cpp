// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/ring_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/units.hpp"
#include "dynamics/cylinder/cylinder_loads.hpp"
#include "dynamics/cylinder/real_crank_element.hpp"

namespace clatter::dynamics {
namespace {

/// W' of the ring's own tension: given, or by the force in the closed ring.
double read_load(const Config& ring, double bore_radius) {
  const bool by_tension = ring.has("tangential_force_n");
  if (by_tension && ring.has("load_n_mm"))
    ring.fail("tangential_force_n", "found beside load_n_mm, expected one of the two");
  if (by_tension) return ring.number("tangential_force_n", Range::between(1e-3, 1e5)) / bore_radius;
  return ring.number("load_n_mm", Range::between(1e-4, 1e4)) / kMilli;
}

RingSpec read_ring(const Config& table, const film::PistonLinerOptions& contact) {
  RingSpec ring;
  ring.height = table.number("height_mm", Range::between(-1e4, 1e4)) * kMilli;
  if (!(ring.height > contact.skirt_top))
    table.fail("height_mm", fmt::format("found {:g}, expected above skirt_top_mm, {:g}",
                                        ring.height / kMilli, contact.skirt_top / kMilli));
  ring.face_radius = table.number("face_radius_mm", Range::between(1e-2, 1e4)) * kMilli;
  ring.load = read_load(table, contact.bore_radius);
  ring.least = table.number_or("least_um", 0.0, Range::between(0.0, 1e3)) * kMicro;
  ring.gas_share = table.number_or("gas_share", 0.0, Range::between(0.0, 1.0));
  const Range size = Range::between(1e-3, 1e3);
  if (ring.gas_share > 0.0 || table.has("width_mm"))
    ring.width = table.number("width_mm", size) * kMilli;
  if (table.has("thickness_mm")) ring.thickness = table.number("thickness_mm", size) * kMilli;
  if (!(ring.thickness < contact.bore_radius))
    table.fail("thickness_mm", fmt::format("found {:g}, expected below the bore's radius, {:g}",
                                           ring.thickness / kMilli, contact.bore_radius / kMilli));
  ring.mass = table.number_or("mass_g", 0.0, Range::between(0.0, 1e6)) * kMilli;
  const Range coefficient = Range::between(0.0, 10.0);
  ring.boundary = table.number_or("friction_coefficient", ring.boundary, coefficient);
  ring.roughness =
      table.number_or("roughness_um", ring.roughness / kMicro, Range::between(1e-3, 1e3)) * kMicro;
  ring.groove = table.number_or("groove_coefficient", ring.groove, coefficient);
  return ring;
}

}  // namespace

std::vector<RingSpec> read_rings(const Config& contact, film::PistonLinerOptions& options) {
  std::vector<RingSpec> rings;
  for (const Config& table : contact.tables("ring")) {
    rings.push_back(read_ring(table, options));
    const RingSpec& ring = rings.back();
    if (rings.size() < 2) continue;
    const RingSpec& above = rings[rings.size() - 2];
    if (!(ring.height < above.height))
      table.fail("height_mm",
                 fmt::format("found {:g} after {:g}, expected the rings from the highest to the "
                             "lowest",
                             ring.height / kMilli, above.height / kMilli));
    if (ring.gas_share > above.gas_share)
      table.fail("gas_share", fmt::format("found {:g} below a ring with {:g}, expected no more",
                                          ring.gas_share, above.gas_share));
  }
  if (options.liner_layer)
    for (const RingSpec& ring : rings)
      options.liner_layer->rings.push_back({ring.height, ring.face_radius, ring.load, ring.least});
  return rings;
}

void load_layer_rings(const std::vector<RingSpec>& rings, const TimeFunction& gas,
                      film::LinerLayerOptions& layer) {
  if (!gas) return;
  for (size_t k = 0; k < rings.size(); ++k) {
    const double area = rings[k].gas_share * rings[k].width;  // of a unit length
    if (area > 0.0)
      layer.rings[k].gas_load = [gas, area](double time) {
        return area * std::max(gas(time), 0.0);
      };
  }
}

std::unique_ptr<ForceElement> ring_pack(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, const std::optional<Spline>& gas) {
  const CylinderSpec& spec = bodies.spec;
  const auto acts = [](const RingSpec& ring) { return ring.acts(); };
  if (std::none_of(spec.rings.begin(), spec.rings.end(), acts)) return nullptr;
  RingPackOptions options;
  options.name = spec.name_of(options.name);
  options.rings = spec.rings;
  options.bore_radius = spec.contact->bore_radius;
  options.viscosity = spec.contact->viscosity;
  options.oil = spec.contact->oil;
  options.reversal_speed = spec.contact->friction.reversal_speed;
  const CylinderAxes cylinder = bodies.axes();
  RingPackBodies parts;
  parts.bore_axis = cylinder.bore - cylinder.pin;
  parts.liner_axial = parts.bore_axis;
  const CrankView view(bodies, crank);
  parts.stroke = view.motion().stroke;
  parts.gas = gauge_pressure(bodies, view.motion(), gas);
  std::vector<int> coordinates;
  const auto liner = bodies.block() != nullptr ? std::optional(liner_side(bodies)) : std::nullopt;
  if (liner) {
    parts.liner = liner->surface;
    parts.liner_axial = liner->axial_at - cylinder.pin;
    coordinates = liner->coordinates;
  }
  coordinates.insert(coordinates.end(), pin.begin(), pin.end());
  if (liner) coordinates.push_back(liner->axial);
  return view.follow(
      std::make_unique<RingPack>(std::move(options), std::move(parts), std::move(coordinates)),
      along_stroke(pin[2]));
}

}  // namespace clatter::dynamics
