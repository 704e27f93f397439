// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/systems.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <deque>

#include "core/base/units.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Sine of the smallest angle between the z axis and the point of the xz plane.
constexpr double kLeastSine = 1e-10;

Vector3d cartesian(System::Kind kind, const Vector3d& p) {
  switch (kind) {
    case System::Kind::kCylindrical: {
      const double theta = p[1] * kDegree;
      return {p[0] * std::cos(theta), p[0] * std::sin(theta), p[2]};
    }
    case System::Kind::kSpherical: {
      const double theta = p[1] * kDegree, phi = p[2] * kDegree;
      return {p[0] * std::sin(theta) * std::cos(phi), p[0] * std::sin(theta) * std::sin(phi),
              p[0] * std::cos(theta)};
    }
    default:
      return p;
  }
}

}  // namespace

Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

// Resolves systems whose references are known, until none is left.
class SystemsBuilder {
 public:
  SystemsBuilder(const RawDeck& raw, const IdIndex& grids, Systems& out)
      : raw_(raw), grids_(grids), out_(out) {}

  void run() {
    std::map<int32_t, std::vector<int32_t>> users;
    std::map<int32_t, size_t> open;  // unresolved references
    std::deque<int32_t> ready;
    for (const auto& [id, raw] : raw_.systems) {
      for (int32_t reference : references(id, raw)) {
        if (reference == 0) continue;
        users[reference].push_back(id);
        ++open[id];
      }
      if (!open.contains(id)) ready.push_back(id);
    }
    for (; !ready.empty(); ready.pop_front()) {
      const int32_t id = ready.front();
      out_.systems_[id] = resolve(id, raw_.systems.at(id));
      for (int32_t user : users[id]) {
        if (--open[user] == 0) ready.push_back(user);
      }
    }
    for (const auto& [id, raw] : raw_.systems) {
      if (out_.systems_.contains(id)) continue;
      fail(raw, fmt::format("coordinate system {} refers to itself through others", id));
    }
  }

 private:
  [[noreturn]] void fail(const RawSystem& raw, const std::string& message) const {
    out_.source_.fail(raw.origin, message);
  }

  size_t grid_row(int32_t grid, const RawSystem& raw, int32_t id) const {
    const int32_t row = grids_.find(grid);
    if (row < 0) {
      fail(raw, fmt::format("coordinate system {}: found no GRID {}", id, grid));
    }
    return static_cast<size_t>(row);
  }

  std::vector<int32_t> references(int32_t id, const RawSystem& raw) const {
    std::vector<int32_t> out;
    if (raw.by_grids) {
      for (int32_t grid : raw.grids) {
        out.push_back(column_at(raw_.grids.cp, grid_row(grid, raw, id)));
      }
    } else {
      out.push_back(raw.reference);
    }
    for (int32_t reference : out) {
      if (reference == 0 || raw_.systems.contains(reference)) continue;
      fail(raw, fmt::format("coordinate system {}: found no system {}", id, reference));
    }
    return out;
  }

  System resolve(int32_t id, const RawSystem& raw) const {
    Matrix3d abc;  // columns
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<size_t>(k);
      if (raw.by_grids) {
        const size_t row = grid_row(raw.grids[i], raw, id);
        abc.col(k) =
            out_.to_basic(column_at(raw_.grids.cp, row), vector(raw_.grids.at[row]), raw.origin);
      } else {
        const Vector3d local(raw.points[3 * i], raw.points[3 * i + 1], raw.points[3 * i + 2]);
        abc.col(k) = out_.to_basic(raw.reference, local, raw.origin);
      }
    }
    System system;
    system.name = fmt::format("cord_{}", id);
    system.where = out_.source_.where(raw.origin);
    system.kind = raw.kind;
    system.origin = abc.col(0);
    const Vector3d z = abc.col(1) - abc.col(0), xz = abc.col(2) - abc.col(0);
    const double z_length = z.stableNorm(), xz_length = xz.stableNorm();
    const Vector3d unit = z / z_length;
    const Vector3d x = xz / xz_length - unit * unit.dot(xz / xz_length);
    const double sine = x.norm();
    if (!(z_length > 0.0) || !(sine > kLeastSine) || !std::isfinite(z_length + xz_length)) {
      fail(raw, fmt::format("coordinate system {}: its three points define no axes", id));
    }
    system.axes << x / sine, unit.cross(x / sine), unit;
    return system;
  }

  const RawDeck& raw_;
  const IdIndex& grids_;
  Systems& out_;
};

Systems::Systems(const RawDeck& raw, const IdIndex& grids, const Source& source) : source_(source) {
  systems_.emplace(0, System{});
  SystemsBuilder(raw, grids, *this).run();
}

const System& Systems::get(int32_t system, Origin origin) const {
  const auto at = systems_.find(system);
  if (at == systems_.end()) {
    source_.fail(origin, fmt::format("found no coordinate system {}", system));
  }
  return at->second;
}

Vector3d Systems::to_basic(int32_t system, const Vector3d& local, Origin origin) const {
  if (system == 0) return local;
  const System& s = get(system, origin);
  const Vector3d basic = s.origin + s.axes * cartesian(s.kind, local);
  if (!basic.allFinite()) source_.fail(origin, "the coordinates are too large");
  return basic;
}

Matrix3d Systems::directions(int32_t system, const Vector3d& at, Origin origin) const {
  return axes_at(get(system, origin), at);
}

}  // namespace clatter::mesh::deck::nastran
