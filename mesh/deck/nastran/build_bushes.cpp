// SPDX-License-Identifier: GPL-3.0-or-later
// CBUSH and PBUSH: springs along three axes and about them, between two points of the bush that
// move with its grids. CGAP and PGAP: springs along three axes between its grids, of the state in
// which the gap begins, as in a linear solution of Nastran.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kCoincident = 1e-12;  // of the coordinates

class Bush {
 public:
  Bush(Model& model, const RawBush& raw, const RawBushProperty& property)
      : model_(model), raw_(raw), stiffness_(property.stiffness), loss_(property.loss_factors) {
    ends_ = {model.require(raw.grids[0], raw.origin)};
    if (raw.grids[1] != 0) ends_.push_back(model.require(raw.grids[1], raw.origin));
    for (const NodeIndex end : ends_) at_.push_back(model.node_map.position(end));
  }

  void build() {
    const Matrix3d axes = axes_of();
    const Vector3d centre = centre_of();
    const bool turns = std::all_of(ends_.begin(), ends_.end(),
                                   [&](NodeIndex end) { return model_.node_map.turns(end); });
    bool left_out = false;
    for (int k = 0; k < 6; ++k) {
      const double stiffness = stiffness_[k];
      if (!(stiffness > 0.0)) continue;
      if (k >= 3 && !turns) {
        left_out = true;
        continue;
      }
      Spring spring{model_.source.where(raw_.origin), stiffness, {}, loss_[k]};
      for (size_t end = 0; end < ends_.size(); ++end)
        add_end(end, k, axes.col(k % 3), centre, spring);
      model_.deck.springs.push_back(std::move(spring));
    }
    if (left_out)
      model_.deck.notes.push_back(
          fmt::format("{}: CBUSH {}: K4 to K6 are left out: nodes of solids turn freely",
                      model_.source.where(raw_.origin), raw_.id));
  }

 private:
  bool coincident() const {
    return ends_.size() < 2 ||
           (at_[1] - at_[0]).norm() <= kCoincident * std::max(at_[0].norm(), at_[1].norm());
  }

  // CID; else x along GA to GB with the orientation in the plane x y; without one, K1 and K4 alone.
  // A gap is the same along y and z.
  Matrix3d axes_of() const {
    if (raw_.system >= 0) return model_.systems.directions(raw_.system, at_[0], raw_.origin);
    if (coincident())
      fail("found no CID, expected one: its grids lie at one point or it has one alone");
    Matrix3d axes;
    axes.col(0) = (at_[1] - at_[0]).normalized();
    Vector3d in_plane = Vector3d::Zero();
    if (raw_.orientation_grid != 0) {
      const int32_t row = model_.grids.find(raw_.orientation_grid);
      if (row < 0) fail(fmt::format("found no GRID {}", raw_.orientation_grid));
      in_plane = vector(model_.raw.grids.at[row]) - at_[0];
    } else {
      const int32_t system = model_.node_map.displacement_system(ends_[0]);
      in_plane = model_.systems.directions(system, at_[0], raw_.origin) * vector(raw_.orientation);
    }
    Vector3d z = axes.col(0).cross(in_plane);
    if (!(z.norm() > 1e-6 * in_plane.norm())) {
      if (!raw_.is_gap && std::any_of(stiffness_.begin(), stiffness_.end(), [&](const double& k) {
            return k > 0.0 && (&k - stiffness_.data()) % 3 != 0;
          }))
        fail("found no orientation beside its axis, expected X1 X2 X3, GO or CID");
      z = axes.col(0).unitOrthogonal();
    }
    axes.col(2) = z.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
  }

  Vector3d centre_of() const {
    if (raw_.offset_system >= 0)
      return at_[0] + model_.systems.directions(raw_.offset_system, at_[0], raw_.origin) *
                          vector(raw_.offset);
    return ends_.size() < 2 ? at_[0] : Vector3d(at_[0] + raw_.share * (at_[1] - at_[0]));
  }

  // t . (u + theta x arm), or t . theta, of the second end less that of the first.
  void add_end(size_t end, int k, const Vector3d& t, const Vector3d& centre, Spring& spring) const {
    const double sign = ends_.size() == 2 && end == 0 ? -1.0 : 1.0;
    const int base = k < 3 ? 0 : 3;
    for (int d = 0; d < 3; ++d) add_term(spring.terms, ends_[end], base + d, sign * t[d]);
    if (k >= 3 || raw_.is_gap || !model_.node_map.turns(ends_[end])) return;
    const Vector3d lever = (centre - at_[end]).cross(t);
    for (int d = 0; d < 3; ++d) add_term(spring.terms, ends_[end], 3 + d, sign * lever[d]);
  }

  [[noreturn]] void fail(const std::string& message) const {
    model_.source.fail(raw_.origin,
                       fmt::format("{} {}: {}", raw_.is_gap ? "CGAP" : "CBUSH", raw_.id, message));
  }

  Model& model_;
  const RawBush& raw_;
  const std::array<double, 6>&stiffness_, &loss_;
  std::vector<NodeIndex> ends_;
  std::vector<Vector3d> at_;
};

// The property of a bush or gap; InputError when there is none.
template <class Property>
const Property& property_of(const Model& model, const RawBush& raw,
                            const std::map<int32_t, Property>& all) {
  if (const auto found = all.find(raw.property); found != all.end()) return found->second;
  const char* kind = raw.is_gap ? "GAP" : "BUSH";
  model.source.fail(raw.origin,
                    fmt::format("C{0} {1}: found no P{0} {2}", kind, raw.id, raw.property));
}

struct GapCount {
  Origin origin = 0;
  int64_t closed = 0, open = 0;
};

void add_gap(Model& model, const RawBush& raw, GapCount& count) {
  const RawGapProperty& gap = property_of(model, raw, model.raw.gap_properties);
  Bush(model, raw, {raw.origin, {gap.along, gap.across, gap.across}, {}}).build();
  if (count.closed + count.open == 0) count.origin = raw.origin;
  ++(gap.is_open ? count.open : count.closed);
}

}  // namespace

// MSC Nastran Quick Reference Guide, PBUSH, remark 5: where all cards give GE1 alone, it counts for
// all six.
void spread_single_losses(RawDeck& raw) {
  for (const auto& [id, property] : raw.bush_properties)
    if (std::any_of(property.loss_factors.begin() + 1, property.loss_factors.end(),
                    [](double loss) { return loss != 0.0; }))
      return;
  for (auto& [id, property] : raw.bush_properties)
    property.loss_factors.fill(property.loss_factors[0]);
}

void build_bushes(Model& model) {
  spread_single_losses(model.raw);
  GapCount gaps;
  for (const RawBush& raw : model.raw.bushes) {
    model.refusals.attempt([&] {
      if (raw.is_gap) return add_gap(model, raw, gaps);
      Bush(model, raw, property_of(model, raw, model.raw.bush_properties)).build();
    });
  }
  if (gaps.closed + gaps.open > 0)
    model.deck.notes.push_back(
        fmt::format("{}: CGAP stay as they begin, as in a linear solution: {} closed (KA, KT), {} "
                    "open (KB); preloads F0 are left out",
                    model.source.where(gaps.origin), gaps.closed, gaps.open));
}

}  // namespace clatter::mesh::deck::nastran
