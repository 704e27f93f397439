// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_rod.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/body/elastic_rod.hpp"
#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/cylinder/cylinder_catalogue.hpp"
#include "dynamics/element/massless_rod.hpp"
#include "dynamics/element/pin_guide.hpp"
#include "dynamics/element/rod_frame.hpp"

namespace clatter::dynamics {
namespace {

const LoadedBody& loaded_rod(const CylinderBodies& bodies) {
  return *find_body(bodies.model.loaded, bodies.spec.name_of("rod"));
}

Node end_of(const LoadedBody& rod, const RodSpec& spec, bool small) {
  return with_context(spec.body.where,
                      [&] { return node_of(rod.model, small ? spec.small_end : spec.big_end); });
}

}  // namespace

RodProperties rod_of(const CylinderSpec& spec, const LoadedBodies& loaded) {
  const RodProperties& described = spec.engine.rod;
  if (spec.rod.model != RodModel::kElastic) return described;
  const LoadedBody& rod = *find_body(loaded, spec.name_of("rod"));
  const Eigen::Vector3d big = end_of(rod, spec.rod, false).position;
  const Eigen::Vector3d small = end_of(rod, spec.rod, true).position, along = small - big;
  constexpr double kSame = 1e-6;  // [m]: a tenth of a joint's clearance
  if (!((along - Eigen::Vector3d(0.0, 0.0, described.length)).cwiseAbs().maxCoeff() <= kSame))
    throw InputError(fmt::format(
        "{}: found {:.6g}, but in {} the small end \"{}\" is at ({:.6g}, {:.6g}, {:.6g}) mm from "
        "the "
        "big end \"{}\", expected (0, 0, {:.6g}): z is along the rod, x along the crankshaft",
        spec.rod.length_where, described.length / kMilli, rod.spec.rom.string(), spec.rod.small_end,
        along.x() / kMilli, along.y() / kMilli, along.z() / kMilli, spec.rod.big_end,
        described.length / kMilli));
  RodProperties found = rod_properties(*rod.rod, big, small);
  found.length = described.length;
  return found;
}

void add_rod_body(const CylinderSpec& spec, ModelBuilder& model) {
  if (spec.rod.model == RodModel::kMassless) return;
  const std::string name = spec.name_of("rod");
  if (spec.rod.model == RodModel::kElastic) {
    model.set_moving_frame(name);
  } else {
    model.add_body(make_rigid_rod(name, spec.engine.rod), spec.piston.where);
  }
}

Motion<Eigen::Vector2d> rod_centre(const RodProperties& rod, const SliderCrank& crank,
                                   double time) {
  Motion<Eigen::Vector2d> centre = crank.rod_point(time, rod.centre);
  if (rod.offset == 0.0) return centre;
  const Motion<double> phi = crank.rod_angle(time);
  const Eigen::Vector2d along = rod_direction(phi.position), side(along.y(), -along.x());
  const double w = phi.velocity;
  centre.position += rod.offset * side;
  centre.velocity += rod.offset * w * along;
  centre.acceleration += rod.offset * (phi.acceleration * along - w * w * side);
  return centre;
}

std::unique_ptr<Port> rod_end(const CylinderBodies& bodies, const SliderCrank& crank, bool small) {
  const CylinderSpec& spec = bodies.spec;
  const RodProperties& rod = spec.engine.rod;
  const double arm = small ? rod.small_arm() : rod.big_arm();
  if (spec.rod.model == RodModel::kMassless)
    return std::make_unique<RodPort>(std::vector<int>{0, 1, 2}, crank, Eigen::Vector2d(0.0, arm));
  System& system = bodies.model.system;
  const int body = bodies.rod_index();
  std::vector<int> y;
  for (int k = 0; k < kRodPlanar; ++k) y.push_back(system.coordinate(body, k));
  if (spec.rod.model != RodModel::kElastic)
    return std::make_unique<RodPort>(y, crank, Eigen::Vector2d(0.0, arm));
  const Node node = end_of(loaded_rod(bodies), spec.rod, small);
  for (const size_t axis : {1U, 2U})
    y.push_back(system.coordinate(body, kRodPlanar + node.dofs[axis]));
  const Eigen::Vector3d from_centre = node.position - loaded_rod(bodies).rod->centre;
  return std::make_unique<RodPort>(y, crank, from_centre.tail<2>());
}

std::unique_ptr<ForceElement> massless_rod(const CylinderBodies& bodies,
                                           std::unique_ptr<ForceElement> pin,
                                           std::unique_ptr<ForceElement> crank_pin) {
  return std::make_unique<MasslessRod>(bodies.spec.name_of("rod"), std::move(pin),
                                       std::move(crank_pin));
}

std::vector<std::unique_ptr<ForceElement>> elastic_rod_elements(const CylinderBodies& bodies,
                                                                const SliderCrank& crank) {
  std::vector<std::unique_ptr<ForceElement>> elements;
  const CylinderSpec& spec = bodies.spec;
  if (spec.rod.model != RodModel::kElastic) return elements;
  System& system = bodies.model.system;
  const int body = bodies.rod_index();
  std::vector<int> y;
  for (int k = kRodPlanar - 1; k < loaded_rod(bodies).modal.modes(); ++k)
    y.push_back(system.modal_coordinate(body, k));
  const RodCoupling& coupling = loaded_rod(bodies).rod->coupling;
  TimeFunction stretch;  // with a free crank at its own speed; else a load of rod_inertia()
  if (spec.has_free_crank()) stretch = ramped(bodies.model.time, [](double) { return 1.0; });
  const CrankAngle angle = bodies.crank_angle(crank);
  elements.push_back(std::make_unique<RodFrame>(spec.name_of("rod frame"), y, coupling, crank,
                                                std::move(stretch), angle));
  const auto out_of_plane = [&](int of) {
    return std::array{system.frame_coordinate(of, 0), system.frame_coordinate(of, 4),
                      system.frame_coordinate(of, 5)};
  };
  std::optional<std::array<int, 3>> block;
  if (bodies.block() != nullptr) block = out_of_plane(bodies.block_index());
  GuidePath path;
  path.point = [rod = spec.engine.rod, crank](double time) { return rod_centre(rod, crank, time); };
  path.turn = [crank](double time) { return crank.rod_angle(time); };
  elements.push_back(std::make_unique<PinGuide>(spec.name_of("rod_guide"), spec.guide,
                                                std::move(path), out_of_plane(body), block, angle));
  return elements;
}

std::vector<Load> rod_inertia(const CylinderBodies& bodies, const SliderCrank& crank,
                              const std::string& term) {
  const CylinderSpec& spec = bodies.spec;
  if (spec.rod.model == RodModel::kMassless) return {};
  const int body = bodies.rod_index();
  const auto load = [&](const Eigen::VectorXd& direction, TimeFunction value) {
    return Load{term, body, direction, ramped(bodies.model.time, std::move(value))};
  };
  const auto frame = [&](int k) { return frame_force(bodies.model.system, body, k); };
  const auto centre = [crank, rod = spec.engine.rod](double t) {
    return rod_centre(rod, crank, t).acceleration;
  };
  std::vector<Load> loads{
      load(frame(1), [centre](double t) { return centre(t).x(); }),
      load(frame(2), [centre](double t) { return centre(t).y(); }),
      load(frame(3), [crank](double t) { return crank.rod_angle(t).acceleration; })};
  if (spec.rod.model == RodModel::kElastic && !spec.has_free_crank()) {
    Eigen::VectorXd stretch = Eigen::VectorXd::Zero(loaded_rod(bodies).modal.modes());
    const Eigen::VectorXd& g = loaded_rod(bodies).rod->coupling.stretch;
    stretch.tail(g.size()) = g;
    loads.push_back(
        load(stretch, [crank](double t) { return std::pow(crank.rod_angle(t).velocity, 2); }));
  }
  return loads;
}

std::vector<RodEffect> rod_effects(const CylinderSpec& spec) {
  const RodProperties& rod = spec.engine.rod;
  const EffectEntry* inertia = find_effect(kCylinderEffects, "inertia of the rod");
  std::vector<RodEffect> rows;
  switch (spec.rod.model) {
    case RodModel::kRigid:
      rows = {{inertia, true, "moving and turning frame, exact in the plane", ""}};
      break;
    case RodModel::kTwoMass: {
      std::string why =
          fmt::format("rod.model = \"two-mass\": masses at its ends, {:.4g} kg m2", rod.inertia);
      if (spec.rod.given_inertia > 0.0)
        why += fmt::format(", {:+.1f} % of rod.inertia_kg_m2",
                           100.0 * (rod.inertia / spec.rod.given_inertia - 1.0));
      rows = {{inertia, true, why, ""}};
      break;
    }
    case RodModel::kMassless:
      rows = {{inertia, false,
               "rod.model = \"massless\": a bar between its joints; mass_kg, inertia_kg_m2, "
               "centre_mm are not used",
               ""}};
      break;
    case RodModel::kElastic:
      rows = {{inertia, true,
               fmt::format("rod.model = \"elastic\": eq. (9), turning frame; {:.4g} kg, {:.4g} kg "
                           "m2, centre at {:.4g} mm by rod.rom, not by mass_kg, inertia_kg_m2, "
                           "centre_mm",
                           rod.mass, rod.inertia, rod.centre / kMilli),
               "rod frame"},
              {find_effect(kCylinderEffects, "rod guide"), true,
               "[pin_guide]: an elastic rod along and about y, z", "rod_guide"}};
      break;
  }
  return rows;
}

}  // namespace clatter::dynamics
