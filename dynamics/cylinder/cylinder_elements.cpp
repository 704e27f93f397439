// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_elements.hpp"

#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "dynamics/cylinder/clearance.hpp"
#include "dynamics/cylinder/cylinder_loads.hpp"
#include "dynamics/cylinder/ring_table.hpp"
#include "dynamics/cylinder/shape_scale.hpp"
#include "dynamics/element/pin_guide.hpp"

namespace clatter::dynamics {
namespace {

/// A contact grid with the y indices of its patches and of the rigid motion that fits them.
struct GridOfBody {
  film::ElasticSurface surface;
  std::vector<int> coordinates, fit;
};

GridOfBody grid_of(const LoadedBody& loaded, int body, const std::string& grid, System& system) {
  const rom::DofSet& set = loaded.model.set(grid);
  GridOfBody found{{loaded.model.grid(grid), {}}, {}, {}};
  found.surface.rigid.resize(static_cast<Eigen::Index>(set.dofs.size()), 6);
  for (size_t i = 0; i < set.dofs.size(); ++i) {
    found.surface.rigid.row(static_cast<Eigen::Index>(i)) =
        loaded.model.row_of(set.dofs[i]) * loaded.model.rigid;
    found.coordinates.push_back(system.coordinate(body, set.dofs[i]));
  }
  const Eigen::MatrixXd fit = film::rigid_fit(found.surface);
  for (int k = 0; k < film::kFits; ++k) {
    WeightedDofs sum{{set.dofs.begin(), set.dofs.end()}, {}, k >= 2};
    for (Eigen::Index i = 0; i < fit.cols(); ++i) sum.weights.push_back(fit(k, i));
    found.fit.push_back(system.combined_coordinate(body, sum));
  }
  return found;
}

/// The coordinate that takes axial forces on the liner, and (x, y) of their line of action [m].
struct AxialCoordinate {
  int coordinate;
  Eigen::Vector2d at;
};

AxialCoordinate liner_axial(const CylinderBodies& bodies, const CylinderAxes& cylinder) {
  System& system = bodies.model.system;
  const std::string& set = bodies.spec.bore->liner_axial;
  const int block = bodies.block_index();
  if (set.empty()) {
    const Eigen::Vector3d on_axis(cylinder.bore.x(), cylinder.bore.y(), 0.0);
    return {system.frame_coordinate(block, 2, on_axis), cylinder.bore};
  }
  const rom::ReducedModel& model = bodies.block()->model;
  const int dof = set_dof(model, set, 2, false);
  const Eigen::RowVectorXd motion = model.row_of(dof) * model.rigid;
  return {system.coordinate(block, dof), {-motion(4), motion(3)}};
}

}  // namespace

PinNode pin_node(const CylinderBodies& bodies) {
  const CylinderSpec& spec = bodies.spec;
  PinNode pin{};
  for (size_t d = 0; d < 6; ++d)
    pin[d] =
        bodies.model.y(spec.name_of("piston"), spec.piston.pin, static_cast<int>(d % 3), d >= 3);
  return pin;
}

std::unique_ptr<ForceElement> pin_guide(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin) {
  std::optional<std::array<int, 3>> block;
  if (bodies.block() != nullptr) {
    System& system = bodies.model.system;
    const int b = bodies.block_index();
    block = {system.frame_coordinate(b, 0), system.frame_coordinate(b, 4),
             system.frame_coordinate(b, 5)};
  }
  return std::make_unique<PinGuide>(bodies.spec.name_of("pin_guide"), bodies.spec.guide,
                                    path_of_pin(crank), std::array{pin[0], pin[4], pin[5]}, block,
                                    bodies.crank_angle(crank));
}

void set_layer_range(const SliderCrank& crank, film::PistonLinerOptions& options) {
  film::LinerLayerOptions& layer = *options.liner_layer;
  constexpr double kBeyond = 10e-3;  // [m]
  const double e = crank.pin_offset(), l = crank.rod_length(), r = crank.radius();
  double reach = options.skirt_top;
  for (const film::RingOptions& ring : layer.rings) reach = std::max(reach, ring.height);
  layer.bottom = std::sqrt((l - r) * (l - r) - e * e) + options.skirt_bottom - kBeyond;
  layer.top = std::sqrt((l + r) * (l + r) - e * e) + reach + kBeyond;
}

LinerSide liner_side(const CylinderBodies& bodies) {
  GridOfBody grid =
      grid_of(*bodies.block(), bodies.block_index(), bodies.spec.bore->liner, bodies.model.system);
  const AxialCoordinate axial = liner_axial(bodies, bodies.axes());
  std::vector<int> coordinates = std::move(grid.coordinates);
  coordinates.insert(coordinates.end(), grid.fit.begin(), grid.fit.end());
  return {std::move(grid.surface),
          std::move(coordinates),
          {grid.fit[1], grid.fit[2]},
          axial.coordinate,
          axial.at};
}

LinerContact liner_contact(const CylinderBodies& bodies, const SliderCrank& crank,
                           const PinNode& pin, const std::optional<Spline>& gas) {
  System& system = bodies.model.system;
  const CylinderSpec& spec = bodies.spec;
  film::PistonLinerBodies surfaces;
  std::optional<LinerFit> fit;
  std::vector<int> coordinates;
  const auto append = [&](const auto& more) {
    coordinates.insert(coordinates.end(), more.begin(), more.end());
  };
  if (spec.piston.elastic) {
    const GridOfBody skirt =
        grid_of(bodies.piston(), bodies.piston_index(), spec.piston.skirt, system);
    surfaces.piston = skirt.surface;
    append(skirt.coordinates);
    append(skirt.fit);
  }
  if (bodies.block() != nullptr) {
    const GridOfBody liner =
        grid_of(*bodies.block(), bodies.block_index(), spec.bore->liner, system);
    surfaces.liner = liner.surface;
    fit = LinerFit{liner.fit[1], liner.fit[2]};
    append(liner.coordinates);
    append(liner.fit);
  }
  append(pin);
  const CylinderAxes cylinder = bodies.axes();
  surfaces.bore_axis = cylinder.bore - cylinder.pin;
  if (bodies.block() != nullptr) {
    const AxialCoordinate axial = liner_axial(bodies, cylinder);
    surfaces.liner_axial = axial.at - cylinder.pin;
    coordinates.push_back(axial.coordinate);
  }
  surfaces.crank = bodies.crank_angle(crank);
  surfaces.stroke = [crank](double time) {
    const Motion<double> motion = crank.piston_pin(time);
    return film::StrokeState{motion.position, motion.velocity, motion.acceleration};
  };
  film::PistonLinerOptions options = *spec.contact;
  options.name = spec.name_of(options.name);
  if (options.liner_layer) {
    set_layer_range(crank, options);
    load_layer_rings(spec.rings, gauge_pressure(bodies, crank, gas), *options.liner_layer);
  }
  if (options.warm_clearance) set_stroke(crank, *options.warm_clearance);
  for (const auto& [specs, shapes] : {std::pair{&spec.scaled_bore, &options.scaled_bore},
                                      {&spec.scaled_skirt, &options.scaled_skirt}})
    for (const ScaledShapeSpec& shape : *specs)
      shapes->push_back(scaled_shape(shape, spec, crank, gas));
  auto contact = with_context(spec.contact_where, [&] {
    return std::make_unique<film::PistonLiner>(options, surfaces, coordinates);
  });
  return {std::move(contact), fit};
}

}  // namespace clatter::dynamics
