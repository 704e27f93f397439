// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/unattached.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <unordered_map>

#include "assembly/constraint/coupling_members.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::assembly {
namespace {

constexpr double kStill = 1e-12;  // of squared sines: directions equal to 1e-6

/// By id of nodes, points and own reference nodes.
struct IdFlags {
  std::vector<bool> moves;    // nodes or springs
  std::vector<bool> massive;  // has a [[point_mass]]
};

/// Calls body(functional) for each row of the matrices of stiffness, or of mass, divided by its
/// largest entry.
template <class Body>
void for_each_row(const PartData& part, const Relations& relations, bool of_mass,
                  const Body& body) {
  for (size_t m = 0; m < relations.matrix_dofs.size(); ++m) {
    const MatrixSpec& matrix = part.recipe.matrices[m];
    if (matrix.is_mass != of_mass) continue;
    for (const auto& row : matrix.values.rowwise()) {
      Functional one;
      const double largest = row.cwiseAbs().maxCoeff();
      for (Eigen::Index i = 0; i < row.size(); ++i) {
        if (row(i) == 0.0) continue;
        one.dofs.push_back(relations.matrix_dofs[m].dofs[i]);
        one.values.push_back(row(i) / largest);
      }
      body(one);
    }
  }
}

/// Calls body(functional) for each spring and each row of a stiffness matrix.
template <class Body>
void for_each_elastic(const PartData& part, const Relations& relations, const Body& body) {
  for (const Functional& spring : relations.springs) body(spring);
  for_each_row(part, relations, false, body);
}

/// Ids that nodes, springs or stiffness matrices depend on.
std::vector<bool> moving_ids(const PartData& part, const Relations& relations,
                             Eliminator& eliminator) {
  std::vector<bool> moves = eliminator.moves_any(part.numbers.of_nodes());
  for_each_elastic(part, relations, [&](const Functional& one) {
    for (const int32_t id : one.dofs) moves[id] = true;
    for (const int32_t id : eliminator.express(one).dofs) moves[id] = true;
  });
  return moves;
}

/// DoFs that a [[point_mass]] on a point or on the reference of a rigid coupling moves.
std::vector<Functional> masses_of(const PartData& part, const Relations& relations) {
  const Recipe& recipe = part.recipe;
  std::vector<Functional> masses;
  for (const PointMassSpec& spec : recipe.point_masses) {
    const auto own = relations.references.find(spec.on);
    const bool is_point = std::any_of(recipe.points.begin(), recipe.points.end(),
                                      [&](const PointSpec& p) { return p.point.name == spec.on; });
    if (own == relations.references.end() && !is_point) continue;
    const ReferenceDofs reference =
        is_point ? point_dofs(part.numbers, point_named(part, spec.on)) : own->second;
    const bool turns = !spec.inertia.isZero(0.0) || !spec.offset.isZero(0.0);
    for (size_t d = 0; d < (turns ? 6 : 3); ++d) masses.push_back({{reference.ids[d]}, {1.0}});
  }
  return masses;
}

/// Ids of `masses`, and of mass matrices.
std::vector<bool> massive_ids(const PartData& part, const Relations& relations,
                              const std::vector<Functional>& masses, Eliminator& eliminator) {
  std::vector<bool> massive(static_cast<size_t>(part.numbers.count()) +
                            6 * relations.references.size());
  const auto add = [&](const Functional& one) {
    for (const int32_t id : eliminator.express(one).dofs)
      if (static_cast<size_t>(id) < massive.size()) massive[id] = true;
  };
  for (const Functional& one : masses) add(one);
  for_each_row(part, relations, true, add);
  return massive;
}

/// A reference node; `where` is its entry in the recipe.
struct Reference {
  std::string name, where;
  ReferenceDofs dofs;
};

std::vector<Reference> references_of(const PartData& part, const Relations& relations) {
  std::vector<Reference> all;
  const std::vector<PointSpec>& points = part.recipe.points;
  for (size_t p = 0; p < points.size(); ++p)
    all.push_back(
        {points[p].point.name, points[p].where, point_dofs(part.numbers, static_cast<int32_t>(p))});
  for (const CouplingSpec& spec : part.recipe.couplings)
    if (const auto own = relations.references.find(spec.name); own != relations.references.end())
      all.push_back({spec.name, spec.where, own->second});
  return all;
}

[[noreturn]] void refuse_mass(const Reference& reference, const std::string& direction) {
  throw InputError(
      fmt::format("{}: found a mass on {} with nothing attached, expected a "
                  "coupling, an equation or a support",
                  reference.where, direction));
}

/// Drops the unattached DoFs of one reference node.
void drop_loose(const Reference& reference, const IdFlags& flags, Eliminator& eliminator) {
  std::vector<const char*> loose;
  bool attached = false;
  for (size_t d = 0; d < 6; ++d) {
    const int32_t id = reference.dofs.ids[d];
    const bool moves = flags.moves[id];
    attached = attached || moves || eliminator.is_eliminated(id);
    if (!eliminator.is_coordinate(id) || moves) continue;
    loose.push_back(kDofNames[d]);
    if (flags.massive[id]) refuse_mass(reference, kDofNames[d]);
    eliminator.drop(id);
  }
  if (!attached)
    throw InputError(fmt::format(
        "{}: found nothing attached to it, expected a coupling or an equation", reference.where));
  if (!loose.empty())
    say(fmt::format("{}: {} omitted: nothing is attached", reference.name, fmt::join(loose, " ")));
}

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// G = sum r r^T over functionals, r their entries for the six DoFs of each reference: G n = 0 when
/// the motion n changes none of them. @param for_each calls its argument with each functional.
template <class ForEach>
std::vector<Matrix6> motion_grams(const std::vector<Reference>& references, Eliminator& eliminator,
                                  const ForEach& for_each) {
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  std::unordered_multimap<int32_t, std::pair<size_t, Eigen::Index>> place;  // of their ids
  std::vector<Matrix6> grams(references.size(), Matrix6::Zero());
  for (size_t k = 0; k < references.size(); ++k)
    for (Eigen::Index d = 0; d < 6; ++d)
      if (const int32_t id = references[k].dofs.ids[d]; eliminator.is_coordinate(id))
        place.emplace(id, std::pair(k, d));
  if (place.empty()) return grams;
  for_each([&](const Functional& one) {
    std::map<size_t, Vector6> rows;  // by reference
    const Functional row = eliminator.express(one);
    for (size_t k = 0; k < row.dofs.size(); ++k) {
      const auto [first, last] = place.equal_range(row.dofs[k]);
      for (auto at = first; at != last; ++at)
        rows.try_emplace(at->second.first, Vector6::Zero()).first->second(at->second.second) =
            row.values[k];
    }
    for (const auto& [k, r] : rows) grams[k] += r * r.transpose();
  });
  return grams;
}

/// How many independent motions of those that move something alone move nothing together.
int still_motions(const Eigen::MatrixXd& gram) {
  std::vector<Eigen::Index> moving;
  for (Eigen::Index d = 0; d < gram.rows(); ++d)
    if (gram(d, d) > 0.0) moving.push_back(d);
  if (moving.empty()) return 0;
  const Eigen::VectorXd scale = gram.diagonal()(moving).cwiseSqrt().cwiseInverse();
  const dense::Eigenpairs eigen = dense::symmetric_eigen(
      scale.asDiagonal() * gram(moving, moving) * scale.asDiagonal(), dense::EigenParts::kValues);
  return static_cast<int>((eigen.values.array() <= kStill).count());
}

std::string axis_text(const Eigen::Vector3d& axis) {
  return fmt::format("rotation about ({:.4g}, {:.4g}, {:.4g})", axis(0), axis(1), axis(2));
}

/// Replaces the three rotations of a reference by those about the axes `kept`.
void replace_rotations(const Reference& reference, const Eigen::Matrix3Xd& kept,
                       Eliminator& eliminator, Motions& motions) {
  const auto count = static_cast<int>(kept.cols());
  const int32_t first = eliminator.add_coordinates(count);
  for (int d = 0; d < 3; ++d) {
    Functional theta;
    for (int k = 0; k < count; ++k) {
      theta.dofs.push_back(first + k);
      theta.values.push_back(kept(d, k));
    }
    eliminator.depend(reference.dofs.ids[static_cast<size_t>(d) + 3], theta);
  }
  for (const auto& axis : kept.colwise()) {
    Eigen::RowVectorXd motion = Eigen::RowVectorXd::Zero(6);
    motion.tail<3>() = axis.transpose();
    motions.push_back(motion);
  }
}

/// Omits the rotations of a reference that move nothing, unless displacements take part in such a
/// motion: that is refused later. @param moved, mass of motion_grams(): of nodes, springs and
/// stiffness matrices; of masses.
void omit_still_rotations(const Reference& reference, const Matrix6& moved, const Matrix6& mass,
                          Eliminator& eliminator, Motions& motions) {
  const auto& ids = reference.dofs.ids;
  if (!std::all_of(ids.begin() + 3, ids.end(),
                   [&](int32_t id) { return eliminator.is_coordinate(id); }))
    return;
  const Eigen::Matrix3d rotations = moved.bottomRightCorner<3, 3>();
  const Eigen::Matrix3d inertia = mass.bottomRightCorner<3, 3>();
  const int still = still_motions(rotations);
  if (still == 0 || still != still_motions(moved)) return;
  const Eigen::Matrix3d axes = dense::symmetric_eigen(rotations).vectors;
  for (int k = 0; k < still; ++k) {
    const Eigen::Vector3d axis = axes.col(k);
    if (axis.dot(inertia * axis) > kStill * inertia.trace())
      refuse_mass(reference, axis_text(axis));
    say(fmt::format("{}: {} omitted: nothing is attached", reference.name, axis_text(axis)));
  }
  replace_rotations(reference, axes.rightCols(3 - still), eliminator, motions);
}

}  // namespace

Motions drop_unattached(const PartData& part, const Relations& relations, Eliminator& eliminator) {
  const std::vector<Functional> masses = masses_of(part, relations);
  const IdFlags flags{moving_ids(part, relations, eliminator),
                      massive_ids(part, relations, masses, eliminator)};
  const std::vector<Reference> references = references_of(part, relations);
  for (const Reference& reference : references) drop_loose(reference, flags, eliminator);
  const std::vector<Matrix6> moved = motion_grams(references, eliminator, [&](const auto& add) {
    for (const auto& [first, last] : part.numbers.of_nodes())
      for (int64_t dof = first; dof < last; ++dof) add({{static_cast<int32_t>(dof)}, {1.0}});
    for_each_elastic(part, relations, add);
  });
  const std::vector<Matrix6> mass = motion_grams(references, eliminator, [&](const auto& add) {
    for (const Functional& one : masses) add(one);
    for_each_row(part, relations, true, add);
  });
  Motions motions;
  for (size_t k = 0; k < references.size(); ++k)
    omit_still_rotations(references[k], moved[k], mass[k], eliminator, motions);
  return motions;
}

}  // namespace clatter::assembly
