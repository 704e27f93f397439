// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/force/joint.hpp"
#include "dynamics/force/mount.hpp"
#include "dynamics/run/model_loads.hpp"

namespace clatter::dynamics {
namespace {

/// Builds one model; holds the data shared by its steps.
class Builder {
 public:
  Builder(const Scene& scene, const LoadedBodies& bodies)
      : scene_(scene), bodies_(bodies), model_(std::make_unique<Model>()) {}

  std::unique_ptr<Model> build() {
    add_bodies();
    if (scene_.engine) {
      find_pin();
      add_joints();
      add_guide();
      if (scene_.contact) add_contact();
    }
    for (const auto& mount : scene_.mounts) add_mount(mount);
    add_loads(scene_, bodies_, index_, *model_);
    list_effects();
    return std::move(model_);
  }

 private:
  const LoadedBody* piston() const { return find_body(bodies_, "piston"); }
  const LoadedBody* block() const { return scene_.block ? find_body(bodies_, "block") : nullptr; }
  int y(const std::string& body, const std::string& set, int axis, bool rotation) {
    const LoadedBody& loaded = *find_body(bodies_, body);
    return model_->system.coordinate(index_.at(body), set_dof(loaded.model, set, axis, rotation));
  }

  void add_bodies() {
    for (const auto& body : bodies_) index_[body.spec.name] = model_->system.add_body(body.modal);
    if (!scene_.engine) return;
    const EngineSpec& engine = *scene_.engine;
    model_->crank.emplace(0.5 * engine.stroke, engine.rod.length, engine.pin_offset, engine.speed);
    index_["rod"] = model_->system.add_body(make_rigid_rod("rod", engine.rod));
  }

  void find_pin() {
    const std::string& set = scene_.piston->pin;
    for (int axis = 0; axis < 3; ++axis) pin_.push_back(y("piston", set, axis, false));
    for (int axis = 0; axis < 3; ++axis) pin_.push_back(y("piston", set, axis, true));
    model_->pin_y = pin_[1];
    model_->pin_rx = pin_[3];
  }

  void add_joints() {
    const RodProperties& rod = scene_.engine->rod;
    const int b = index_.at("rod");
    auto& system = model_->system;
    const std::vector<int> rod_y{system.coordinate(b, 0), system.coordinate(b, 1),
                                 system.coordinate(b, 2)};
    const auto end = [&](double arm) {
      return std::make_unique<RodAnchor>(rod_y, *model_->crank, arm);
    };
    using Nodes = std::vector<std::pair<int, int>>;
    system.add_element(
        std::make_unique<Joint>("pin", std::make_unique<NodesAnchor>(Nodes{{pin_[1], pin_[2]}}),
                                end(rod.small_arm()), scene_.small_end));
    Nodes bearings;
    if (block() != nullptr) {
      for (const auto& set : scene_.block->bearings) {
        bearings.emplace_back(y("block", set, 1, false), y("block", set, 2, false));
      }
    }
    system.add_element(std::make_unique<Joint>(
        "crank_pin", end(rod.big_arm()), std::make_unique<NodesAnchor>(bearings), scene_.big_end));
  }

  void add_guide() {
    const GuideSpec& guide = scene_.guide;
    model_->system.add_element(std::make_unique<Mount>(
        "pin_guide",
        std::vector<GroundSpring>{{pin_[0], guide.axial_stiffness, guide.axial_damping},
                                  {pin_[4], guide.tilt_stiffness, guide.tilt_damping},
                                  {pin_[5], guide.tilt_stiffness, guide.tilt_damping}}));
  }

  /// The grid's surface, and its patches' coordinates appended to `coordinates`.
  film::ElasticSurface surface(const std::string& body, const std::string& grid,
                               std::vector<int>& coordinates) {
    const LoadedBody& loaded = *find_body(bodies_, body);
    const rom::DofSet& set = loaded.model.set(grid);
    film::ElasticSurface surface{loaded.model.grid(grid), {}};
    surface.rigid.resize(static_cast<Eigen::Index>(set.dofs.size()), 6);
    for (size_t i = 0; i < set.dofs.size(); ++i) {
      surface.rigid.row(static_cast<Eigen::Index>(i)) =
          loaded.model.row_of(set.dofs[i]) * loaded.model.rigid;
      coordinates.push_back(model_->system.coordinate(index_.at(body), set.dofs[i]));
    }
    return surface;
  }

  void add_contact() {
    film::PistonLinerBodies contact_bodies;
    std::vector<int> coordinates;
    if (scene_.piston->elastic) {
      contact_bodies.piston = surface("piston", scene_.piston->skirt, coordinates);
    }
    if (block() != nullptr) {
      std::vector<int> patches;
      contact_bodies.liner = surface("block", scene_.block->liner, patches);
      fit_liner(*contact_bodies.liner, patches);
      coordinates.insert(coordinates.end(), patches.begin(), patches.end());
    }
    coordinates.insert(coordinates.end(), pin_.begin(), pin_.end());
    if (block() != nullptr && !scene_.block->liner_axial.empty()) {
      contact_bodies.liner_axial = true;
      coordinates.push_back(y("block", scene_.block->liner_axial, 2, false));
    }
    contact_bodies.stroke = [crank = *model_->crank](double time) {
      const auto pin = crank.piston_pin(time);
      return film::StrokeState{pin.position, pin.velocity};
    };
    check_axes(contact_bodies);
    auto contact =
        std::make_unique<film::PistonLiner>(*scene_.contact, contact_bodies, coordinates);
    model_->contact = contact.get();
    model_->system.add_element(std::move(contact));
  }

  void fit_liner(const film::ElasticSurface& liner, const std::vector<int>& patches) {
    // Radial means depend only on x, y and the tilts; a least squares fit of the four gives (y,
    // rx).
    Eigen::MatrixXd seen(liner.rigid.rows(), 4);
    seen << liner.rigid.leftCols<2>(), liner.rigid.col(3), liner.rigid.col(4);
    const Eigen::MatrixXd inverse = seen.completeOrthogonalDecomposition().pseudoInverse();
    Eigen::MatrixXd rows(2, inverse.cols());
    rows << inverse.row(1), inverse.row(2);
    model_->liner = LinerFit{patches, rows};
  }

  void check_axes(const film::PistonLinerBodies& contact_bodies) const {
    if (!contact_bodies.piston || !contact_bodies.liner) return;
    const double skirt = contact_bodies.piston->grid.axis_point.y() + scene_.engine->pin_offset;
    const double bore = contact_bodies.liner->grid.axis_point.y();
    if (std::abs(skirt - bore) > 1e-6) {
      throw InputError(
          fmt::format("{}: engine.pin_offset_mm: skirt axis at y = {:.4g} mm in the piston plus "
                      "pin offset {:.4g} "
                      "mm, expected the bore's axis at {:.4g} mm",
                      scene_.file.string(), 1e3 * contact_bodies.piston->grid.axis_point.y(),
                      1e3 * scene_.engine->pin_offset, 1e3 * bore));
    }
  }

  void add_mount(const MountSpec& mount) {
    if (mount.body == "block" && scene_.block && !scene_.block->elastic) return;  // not simulated
    if (find_body(bodies_, mount.body) == nullptr) {
      throw InputError(
          fmt::format("{}: mount.body: no body \"{}\" in the scene", mount.where, mount.body));
    }
    std::vector<GroundSpring> springs;
    for (const auto& set : mount.sets) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<size_t>(axis);
        if (mount.stiffness[a] == 0.0 && mount.damping[a] == 0.0) continue;
        springs.push_back({y(mount.body, set, axis, false), mount.stiffness[a], mount.damping[a]});
      }
    }
    model_->system.add_element(
        std::make_unique<Mount>(fmt::format("mount {}", ++mounts_), springs));
  }

  void list_effects();

  const Scene& scene_;
  const LoadedBodies& bodies_;
  std::unique_ptr<Model> model_;
  BodyIndex index_;
  std::vector<int> pin_;  // y indices of the pin's node: x, y, z, rx, ry, rz
  int mounts_ = 0;
};

std::string body_size(const LoadedBody& body) {
  return fmt::format("{} coordinates, {} rigid modes, highest {:.4g} Hz", body.model.size(),
                     body.modal.rigid_modes,
                     std::sqrt(body.modal.omega_squared.maxCoeff()) / 6.283185307179586);
}

void Builder::list_effects() {
  EffectTable& table = model_->effects;
  for (const auto& body : bodies_) {
    table.add(fmt::format("elastic {}", body.spec.name), body.spec.elastic,
              body.spec.elastic ? body_size(body) : body.spec.name + ".model = \"rigid\": 6 modes");
  }
  if (scene_.block && !scene_.block->elastic) {
    table.add("elastic block", false,
              "block.model = \"rigid\": liner and bearings at rest, no body");
  }
  if (!scene_.engine) {
    table.add("mounts", mounts_ > 0, mounts_ > 0 ? "[[mount]]" : "no [[mount]]", "mount 1");
    table.add("gravity", scene_.gravity > 0.0, "gravity_m_s2");
    return;
  }
  table.add("inertia of the piston", true, "eq. (10): frame moves with z_B(t), does not turn");
  table.add("inertia of the rod", true, "moving and turning frame, exact in the plane");
  table.add("inertia of the block", false, "p* = 0: its frame is at rest");
  const bool balanced = scene_.engine->balanced && block() != nullptr;
  table.add("balance by other cylinders", balanced,
            !balanced && scene_.engine->balanced ? "no elastic block"
                                                 : "engine.balanced, on the block's rigid modes");
  table.add("gas pressure", scene_.gas.has_value(), scene_.gas ? "[gas]" : "no [gas]");
  table.add("rod joint at the pin", true, "[small_end]", "pin");
  table.add("rod joint at the crank", true, "[big_end]", "crank_pin");
  table.add("pin guide", true, "[pin_guide]: along the pin and about y, z", "pin_guide");
  const bool contact = scene_.contact.has_value();
  const auto effects = contact ? scene_.contact->effects : film::ContactEffects{};
  const std::string absent = "no [contact]";
  const std::string name = contact ? scene_.contact->name : "";
  table.add("oil film", contact && effects.film,
            !contact       ? absent
            : effects.film ? "contact.lubrication = \"film\" (all of the contact)"
                           : "contact.lubrication = \"none\"",
            contact && effects.film ? name : "");
  table.add("cavitation", contact && effects.film && effects.cavitation,
            contact && !effects.film ? "no film" : "contact.cavitation");
  table.add("asperity contact", contact && effects.asperities, "contact.asperities",
            contact && !effects.film ? name : "");
  table.add("friction", contact && effects.friction, "contact.friction");
  table.add("mounts", mounts_ > 0, mounts_ > 0 ? "[[mount]]" : "no mounted body", "mount 1");
  table.add("gravity", scene_.gravity > 0.0, "gravity_m_s2");
}

}  // namespace

std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& bodies) {
  return Builder(scene, bodies).build();
}

Eigen::Vector2d Model::secondary_motion(double time, const Eigen::VectorXd& y) const {
  Eigen::Vector2d motion(y(pin_y), y(pin_rx));
  if (liner) {
    const Eigen::Vector2d fit = liner->rigid_motion * gather(y, liner->coordinates);
    motion -= Eigen::Vector2d(fit.x() - fit.y() * crank->piston_pin(time).position, fit.y());
  }
  return motion;
}

void Model::record(const StageState& state, History& history) const {
  if (pin_y >= 0) {
    const Eigen::Vector2d motion = secondary_motion(state.time, state.y);
    history.put("piston_lateral", "m", motion.x());
    history.put("piston_tilt", "rad", motion.y());
  }
  if (gas) history.put("gas_pressure", "Pa", (*gas)(crank->angle(state.time)));
  for (int e = 0; e < system.elements(); ++e) system.element(e).record(history);
}

}  // namespace clatter::dynamics
