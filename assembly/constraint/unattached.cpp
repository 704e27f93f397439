// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/unattached.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "assembly/constraint/coupling_members.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::assembly {
namespace {

/// By id of nodes, points and own reference nodes.
struct IdFlags {
  std::vector<bool> moves;    // nodes or springs
  std::vector<bool> massive;  // has a [[point_mass]]
};

/// Ids that nodes or springs depend on.
std::vector<bool> moving_ids(const PartData& part, const Relations& relations,
                             Eliminator& eliminator) {
  std::vector<bool> moves = eliminator.moves_nodes(part.numbers.nodal());
  for (const Functional& spring : relations.springs) {
    for (const int32_t id : spring.dofs) moves[static_cast<size_t>(id)] = true;
    for (const int32_t id : eliminator.express(spring).dofs) moves[static_cast<size_t>(id)] = true;
  }
  return moves;
}

/// Ids with mass of a [[point_mass]] on a point or on the reference of a rigid coupling.
std::vector<bool> massive_ids(const PartData& part, const Relations& relations,
                              Eliminator& eliminator) {
  const Recipe& recipe = part.recipe;
  std::vector<bool> massive(static_cast<size_t>(part.numbers.count()) +
                            6 * relations.references.size());
  for (const PointMassSpec& spec : recipe.point_masses) {
    const auto own = relations.references.find(spec.on);
    const bool is_point = std::any_of(recipe.points.begin(), recipe.points.end(),
                                      [&](const PointSpec& p) { return p.point.name == spec.on; });
    if (own == relations.references.end() && !is_point) continue;
    const ReferenceDofs reference =
        is_point ? point_dofs(part.numbers, point_named(part, spec.on)) : own->second;
    const bool turns = !spec.inertia.isZero(0.0) || !spec.offset.isZero(0.0);
    for (size_t d = 0; d < (turns ? 6 : 3); ++d)
      for (const int32_t id : eliminator.express({{reference.ids[d]}, {1.0}}).dofs)
        if (static_cast<size_t>(id) < massive.size()) massive[static_cast<size_t>(id)] = true;
  }
  return massive;
}

/// Drops the unattached DoFs of one reference node; `where` is its entry in the recipe.
void drop_loose(const std::string& name, const std::string& where, const ReferenceDofs& reference,
                const IdFlags& flags, Eliminator& eliminator) {
  std::vector<const char*> loose;
  bool attached = false;
  for (size_t d = 0; d < 6; ++d) {
    const int32_t id = reference.ids[d];
    const bool moves = flags.moves[static_cast<size_t>(id)];
    attached = attached || moves || eliminator.is_eliminated(id);
    if (!eliminator.is_coordinate(id) || moves) continue;
    loose.push_back(kDofNames[d]);
    if (flags.massive[static_cast<size_t>(id)])
      throw InputError(
          fmt::format("{}: found a mass on {} with nothing attached, expected a "
                      "coupling, an equation or a support",
                      where, kDofNames[d]));
    eliminator.drop(id);
  }
  if (!attached)
    throw InputError(
        fmt::format("{}: found nothing attached to it, expected a coupling or an equation", where));
  if (!loose.empty())
    say(fmt::format("{}: {} omitted: nothing is attached", name, fmt::join(loose, " ")));
}

}  // namespace

void drop_unattached(const PartData& part, const Relations& relations, Eliminator& eliminator) {
  const IdFlags flags{moving_ids(part, relations, eliminator),
                      massive_ids(part, relations, eliminator)};
  const std::vector<PointSpec>& points = part.recipe.points;
  for (size_t p = 0; p < points.size(); ++p)
    drop_loose(points[p].point.name, points[p].where,
               point_dofs(part.numbers, static_cast<int32_t>(p)), flags, eliminator);
  for (const CouplingSpec& spec : part.recipe.couplings)
    if (const auto own = relations.references.find(spec.name); own != relations.references.end())
      drop_loose(spec.name, spec.where, own->second, flags, eliminator);
}

}  // namespace clatter::assembly
