// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/ring_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/cylinder/cylinder_loads.hpp"

namespace clatter::dynamics {
namespace {

void check_ring(const Config& table, RingTable& ring) {
  if (ring.gas_share > 0.0 && ring.width == 0.0)
    table.fail("width_mm", "is missing, gas_share above 0 needs it");
}

}  // namespace

const Keys<RingTable>& ring_keys() {
  static const Keys<RingTable> keys(
      "ring", "a piston ring: the oil that it leaves on the liner, and its friction",
      [](auto& key, RingTable& ring) {
        const Range size = Range::between(1e-3, 1e3), coefficient = Range::between(0.0, 10.0);
        key.number("height_mm", ring.height, Range::between(-1e4, 1e4),
                   "of its middle above the pin, above the skirt")
            .required();
        key.number("face_radius_mm", ring.face_radius, Range::between(1e-2, 1e4),
                   "radius of its face along the stroke")
            .required();
        key.number("load_n_mm", ring.load, Range::between(1e-4, 1e4),
                   "radial load of its own tension on a length of the circumference");
        key.number("tangential_force_n", ring.tangential, Range::between(1e-3, 1e5),
                   "force in the closed ring, which makes that load");
        key.one_of({"load_n_mm", "tangential_force_n"});
        key.number("least_um", ring.least, Range::between(0.0, 1e3),
                   "least layer of oil that it leaves: that in the valleys of the honing");
        key.number("gas_share", ring.gas_share, Range::between(0.0, 1.0),
                   "pressure behind it over that of the gas, at most that of the ring above");
        key.number("width_mm", ring.width, size, "along the stroke");
        key.number("thickness_mm", ring.thickness, size, "radial, in its groove");
        key.number("mass_g", ring.mass, Range::between(0.0, 1e6), "mass");
        key.number("friction_coefficient", ring.boundary, coefficient,
                   "of the rubbing face; 0: no friction on the liner");
        key.number("roughness_um", ring.roughness, Range::between(1e-3, 1e3),
                   "rms height of face and liner together");
        key.number("groove_coefficient", ring.groove, coefficient,
                   "friction of its sides; 0: the piston slides freely in it");
        key.check(check_ring);
      });
  return keys;
}

std::vector<RingSpec> checked_rings(const Config& contact, const std::vector<RingTable>& found,
                                    const film::PistonLinerOptions& options) {
  const std::vector<Config> tables = contact.tables("ring");
  std::vector<RingSpec> rings;
  for (size_t k = 0; k < found.size(); ++k) {
    const Config& table = tables[k];
    RingSpec ring = found[k];
    if (found[k].tangential) ring.load = *found[k].tangential / options.bore_radius;
    if (!(ring.height > options.skirt_top))
      table.fail("height_mm", fmt::format("found {:g}, expected above skirt_top_mm, {:g}",
                                          ring.height / kMilli, options.skirt_top / kMilli));
    if (!(ring.thickness < options.bore_radius))
      table.fail("thickness_mm",
                 fmt::format("found {:g}, expected below the bore's radius, {:g}",
                             ring.thickness / kMilli, options.bore_radius / kMilli));
    if (k > 0 && !(ring.height < rings.back().height))
      table.fail("height_mm",
                 fmt::format("found {:g} after {:g}, expected the rings from the highest to the "
                             "lowest",
                             ring.height / kMilli, rings.back().height / kMilli));
    if (k > 0 && ring.gas_share > rings.back().gas_share)
      table.fail("gas_share", fmt::format("found {:g} below a ring with {:g}, expected no more",
                                          ring.gas_share, rings.back().gas_share));
    rings.push_back(ring);
  }
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
  parts.crank = bodies.crank_angle(crank);
  parts.stroke = [crank](double time) { return crank.piston_pin(time); };
  parts.gas = gauge_pressure(bodies, crank, gas);
  std::vector<int> coordinates;
  const auto liner = bodies.block() != nullptr ? std::optional(liner_side(bodies)) : std::nullopt;
  if (liner) {
    parts.liner = liner->surface;
    parts.liner_axial = liner->axial_at - cylinder.pin;
    coordinates = liner->coordinates;
  }
  coordinates.insert(coordinates.end(), pin.begin(), pin.end());
  if (liner) coordinates.push_back(liner->axial);
  return std::make_unique<RingPack>(std::move(options), std::move(parts), std::move(coordinates));
}

}  // namespace clatter::dynamics
