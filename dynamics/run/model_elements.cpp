// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model_elements.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/force/joint.hpp"
#include "dynamics/force/mount.hpp"
#include "dynamics/force/pin_guide.hpp"
#include "dynamics/run/crank_centre.hpp"

namespace clatter::dynamics {
namespace {

/// An end of the rod at `arm` from its centre of mass.
std::unique_ptr<RodAnchor> rod_end(const SceneBodies& bodies, const SliderCrank& crank, double arm,
                                   System& system) {
  const int rod = bodies.index.at("rod");
  const std::vector<int> y{system.coordinate(rod, 0), system.coordinate(rod, 1),
                           system.coordinate(rod, 2)};
  return std::make_unique<RodAnchor>(y, crank, arm);
}

/// A contact grid with the y indices of its patches and of the rigid motion that fits them.
struct GridOfBody {
  film::ElasticSurface surface;
  std::vector<int> coordinates, fit;
};

GridOfBody grid_of(const SceneBodies& bodies, const std::string& body, const std::string& grid,
                   System& system) {
  const LoadedBody& loaded = *find_body(bodies.loaded, body);
  const rom::DofSet& set = loaded.model.set(grid);
  const int index = bodies.index.at(body);
  GridOfBody found{{loaded.model.grid(grid), {}}, {}, {}};
  found.surface.rigid.resize(static_cast<Eigen::Index>(set.dofs.size()), 6);
  for (size_t i = 0; i < set.dofs.size(); ++i) {
    found.surface.rigid.row(static_cast<Eigen::Index>(i)) =
        loaded.model.row_of(set.dofs[i]) * loaded.model.rigid;
    found.coordinates.push_back(system.coordinate(index, set.dofs[i]));
  }
  const Eigen::MatrixXd fit = film::rigid_fit(found.surface);
  for (int k = 0; k < film::kFits; ++k) {
    WeightedDofs sum{{set.dofs.begin(), set.dofs.end()}, {}, k >= 2};
    for (Eigen::Index i = 0; i < fit.cols(); ++i) sum.weights.push_back(fit(k, i));
    found.fit.push_back(system.combined_coordinate(index, sum));
  }
  return found;
}

/// The coordinate that takes axial forces on the liner, and (x, y) of their line of action [m].
struct AxialCoordinate {
  int coordinate;
  Eigen::Vector2d at;
};

AxialCoordinate liner_axial(const SceneBodies& bodies, const Cylinder& cylinder, System& system) {
  const std::string& set = bodies.scene.block->liner_axial;
  const int block = bodies.index.at("block");
  if (set.empty()) {
    const Eigen::Vector3d on_axis(cylinder.bore.x(), cylinder.bore.y(), 0.0);
    return {system.frame_coordinate(block, 2, on_axis), cylinder.bore};
  }
  const rom::ReducedModel& model = bodies.block()->model;
  const int dof = set_dof(model, set, 2, false);
  const Eigen::RowVectorXd motion = model.row_of(dof) * model.rigid;
  return {system.coordinate(block, dof), {-motion(4), motion(3)}};
}

/// Springs to the ground at the nodes of a mount.
std::vector<GroundSpring> springs_of(const SceneBodies& bodies, const MountSpec& mount,
                                     System& system) {
  std::vector<GroundSpring> springs;
  for (const auto& set : mount.sets) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<size_t>(axis);
      if (mount.stiffness[a] == 0.0 && mount.damping[a] == 0.0) continue;
      springs.push_back(
          {bodies.y(system, mount.body, set, axis, false), mount.stiffness[a], mount.damping[a]});
    }
  }
  return springs;
}

}  // namespace

PinNode pin_node(const SceneBodies& bodies, System& system) {
  const std::string& set = bodies.scene.piston->pin;
  PinNode pin{};
  for (size_t d = 0; d < 6; ++d)
    pin[d] = bodies.y(system, "piston", set, static_cast<int>(d % 3), d >= 3);
  return pin;
}

std::unique_ptr<ForceElement> pin_joint(const SceneBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, System& system) {
  PointWeights centre;
  centre.add(pin[1], 1.0, 0.0);
  centre.add(pin[2], 0.0, 1.0);
  return std::make_unique<Joint>(
      "pin", std::make_unique<LinearAnchor>(std::move(centre)),
      rod_end(bodies, crank, bodies.scene.engine->rod.small_arm(), system), bodies.scene.small_end);
}

std::unique_ptr<ForceElement> crank_joint(const SceneBodies& bodies, const SliderCrank& crank,
                                          System& system) {
  auto rod = rod_end(bodies, crank, bodies.scene.engine->rod.big_arm(), system);
  PointWeights centre = bodies.block() != nullptr ? crank_centre(bodies, system) : PointWeights{};
  return std::make_unique<Joint>("crank_pin", std::move(rod),
                                 std::make_unique<LinearAnchor>(std::move(centre)),
                                 bodies.scene.big_end);
}

std::unique_ptr<ForceElement> pin_guide(const SceneBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, System& system) {
  std::optional<std::array<int, 3>> block;
  if (bodies.block() != nullptr) {
    const int b = bodies.index.at("block");
    block = {system.frame_coordinate(b, 0), system.frame_coordinate(b, 4),
             system.frame_coordinate(b, 5)};
  }
  return std::make_unique<PinGuide>(bodies.scene.guide, crank, std::array{pin[0], pin[4], pin[5]},
                                    block);
}

LinerContact liner_contact(const SceneBodies& bodies, const SliderCrank& crank, const PinNode& pin,
                           System& system) {
  const Scene& scene = bodies.scene;
  film::PistonLinerBodies surfaces;
  std::optional<LinerFit> fit;
  std::vector<int> coordinates;
  const auto append = [&](const auto& more) {
    coordinates.insert(coordinates.end(), more.begin(), more.end());
  };
  if (scene.piston->elastic) {
    const GridOfBody skirt = grid_of(bodies, "piston", scene.piston->skirt, system);
    surfaces.piston = skirt.surface;
    append(skirt.coordinates);
    append(skirt.fit);
  }
  if (bodies.block() != nullptr) {
    const GridOfBody liner = grid_of(bodies, "block", scene.block->liner, system);
    surfaces.liner = liner.surface;
    fit = LinerFit{liner.fit[1], liner.fit[2]};
    append(liner.coordinates);
    append(liner.fit);
  }
  append(pin);
  const Cylinder cylinder = bodies.cylinder();
  surfaces.bore_axis = cylinder.bore - cylinder.pin;
  if (bodies.block() != nullptr) {
    const AxialCoordinate axial = liner_axial(bodies, cylinder, system);
    surfaces.liner_axial = axial.at - cylinder.pin;
    coordinates.push_back(axial.coordinate);
  }
  surfaces.stroke = [crank](double time) {
    const auto motion = crank.piston_pin(time);
    return film::StrokeState{motion.position, motion.velocity};
  };
  auto element = with_context(scene.contact_where, [&] {
    return std::make_unique<film::PistonLiner>(*scene.contact, surfaces, coordinates);
  });
  return {std::move(element), fit};
}

std::vector<std::unique_ptr<ForceElement>> mounts_of(const SceneBodies& bodies, System& system) {
  const Scene& scene = bodies.scene;
  std::vector<std::unique_ptr<ForceElement>> mounts;
  for (const MountSpec& mount : scene.mounts) {
    if (mount.body == "block" && scene.block && !scene.block->elastic) continue;  // not simulated
    if (find_body(bodies.loaded, mount.body) == nullptr) {
      throw InputError(
          fmt::format("{}: mount.body: no body \"{}\" in the scene", mount.where, mount.body));
    }
    mounts.push_back(std::make_unique<Mount>(fmt::format("mount {}", mounts.size() + 1),
                                             springs_of(bodies, mount, system)));
  }
  return mounts;
}

}  // namespace clatter::dynamics
