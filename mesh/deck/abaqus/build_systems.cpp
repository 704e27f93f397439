// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

Eigen::Vector3d point_at(const Fields& fields, size_t i) {
  Eigen::Vector3d x;
  for (size_t k = 0; k < 3; ++k) x[static_cast<int>(k)] = fields.number(i + k, "coordinate");
  return x;
}

// Axes with that x, and y in the plane of x and `b`.
Eigen::Matrix3d axes_of(const Fields& fields, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d z = a.cross(b);
  if (!(z.norm() > 1e-12 * a.norm() * b.norm())) {
    fields.fail("expected two points a, b that are not on a line with the origin");
  }
  Eigen::Matrix3d axes;
  axes.col(0) = a.normalized();
  axes.col(2) = z.normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// z along the axis; the zero angle is at the basic axis farthest from it.
Eigen::Matrix3d axes_about(const Fields& fields, const Eigen::Vector3d& axis) {
  if (!(axis.norm() > 0.0)) fields.fail("expected two different points of the axis");
  const Eigen::Vector3d z = axis.normalized();
  int far = 0;
  z.cwiseAbs().minCoeff(&far);
  Eigen::Matrix3d axes;
  axes.col(2) = z;
  axes.col(0) = (Eigen::Vector3d::Unit(far) - z[far] * z).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// Six coordinates of a and b; `with_origin`: three more of the origin c.
System system_of(const Fields& fields, System::Kind kind, bool with_origin) {
  System system;
  system.kind = kind;
  system.where = fields.source().where(fields.origin());
  const Eigen::Vector3d a = point_at(fields, 0), b = point_at(fields, 3);
  if (kind == System::Kind::kCylindrical) {
    fields.at_most(6, "two points of the axis");
    system.origin = a;
    system.axes = axes_about(fields, b - a);
    return system;
  }
  fields.at_most(with_origin ? 9 : 6, "points a, b of the axes");
  if (with_origin && fields.size() > 6) system.origin = point_at(fields, 6);
  system.axes = axes_of(fields, a - system.origin, b - system.origin);
  return system;
}

// The second line of *ORIENTATION: a local axis and the angle about it in degrees. Returns the
// axis.
int turn(const Fields& fields, System& system) {
  const int axis = fields.integer(0, "local axis", 1, 3);
  const double angle = fields.number_or(1, "angle in degrees", 0.0) * std::numbers::pi / 180.0;
  fields.at_most(2, "local axis and angle");
  if (angle == 0.0) return axis;
  if (system.kind != System::Kind::kRectangular) {
    fields.fail(
        "found an additional rotation of a cylindrical orientation, which is not supported");
  }
  const Eigen::Vector3d about = system.axes.col(axis - 1);
  system.axes = Eigen::AngleAxisd(angle, about).toRotationMatrix() * system.axes;
  return axis;
}

void move(const Use& use, System& system) {
  system.origin = use.rotation * system.origin + use.shift;
  system.axes = use.rotation * system.axes;
}

System::Kind kind_of(const Card& card, const Source& source, std::string_view parameter,
                     const std::string& type) {
  if (type == "R" || type == "RECTANGULAR") return System::Kind::kRectangular;
  if (type == "C" || type == "CYLINDRICAL") return System::Kind::kCylindrical;
  source.fail(card.origin(), fmt::format("{}: found {}={}, expected rectangular or cylindrical",
                                         card.keyword().name, parameter, type));
}

}  // namespace

void build_systems(Model& model) {
  for_each_card(model, {"ORIENTATION"}, [&](size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"NAME", "SYSTEM", "DEFINITION"}, model.source, model.ignore);
    if (keyword.choice("DEFINITION", "COORDINATES") != "COORDINATES" || card.size() == 0 ||
        card.size() > 2) {
      model.source.fail(card.origin(),
                        "*ORIENTATION: expected DEFINITION=COORDINATES and one or "
                        "two data lines");
    }
    const System::Kind kind =
        kind_of(card, model.source, "SYSTEM", keyword.choice("SYSTEM", "RECTANGULAR"));
    System system = system_of(card.line(0, model.source), kind, true);
    const int axis = card.size() == 2 ? turn(card.line(1, model.source), system) : 0;
    move(model.numbering.uses()[use], system);
    system.name = model.numbering.public_name(use, keyword.required("NAME", model.source));
    const bool is_new = model.system_names.emplace(folded(system.name), system.name).second;
    if (!is_new || !model.deck.systems.emplace(system.name, system).second) {
      model.source.fail(card.origin(), fmt::format("found a second orientation {}", system.name));
    }
    model.turned_axis[system.name] = axis;
  });
}

std::string system_named(const Model& model, size_t use, const std::string& name, Origin origin) {
  for (const std::string& wanted : {model.numbering.public_name(use, name), name}) {
    const auto known = model.system_names.find(folded(wanted));
    if (known != model.system_names.end()) return known->second;
  }
  if (model.refusals.has_lost(folded(name))) throw FollowUp();
  model.source.fail(origin, fmt::format("found no orientation {}", shown(name)));
}

void build_transforms(Model& model) {
  int count = 0;
  for_each_card(model, {"TRANSFORM"}, [&](size_t use, const Card& card) {
    const Keyword& keyword = card.keyword();
    keyword.allow({"NSET", "TYPE"}, model.source, model.ignore);
    if (card.size() != 1) {
      model.source.fail(card.origin(),
                        fmt::format("*TRANSFORM: found {} data lines, expected one", card.size()));
    }
    const System::Kind kind = kind_of(card, model.source, "TYPE", keyword.choice("TYPE", "R"));
    System system = system_of(card.line(0, model.source), kind, false);
    move(model.numbering.uses()[use], system);
    do {
      system.name = fmt::format("transform_{}", ++count);
    } while (model.deck.systems.contains(system.name));
    model.deck.systems[system.name] = system;
    const std::string& set = keyword.required("NSET", model.source);
    model.node_map.set_displacement_system(model.sets.nodes(use, set, card.origin()), system.name);
  });
}

}  // namespace clatter::mesh::deck::abaqus
