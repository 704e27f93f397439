// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/cyclic.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck {
namespace {

constexpr double kApart = 1e-4;              // of the sides' extent: coordinates have six digits
constexpr double kAlong = 1e-9;              // sine of the angle between an axis and the ring's
constexpr int64_t kMost = int64_t{1} << 27;  // nodes, cells, faces, members of sets, loads

Eigen::Matrix3d turn(const CyclicSector& sector, double sectors) {
  const double angle = 2.0 * std::numbers::pi * sectors / sector.count;
  return Eigen::AngleAxisd(angle, sector.axis).toRotationMatrix();
}

Eigen::Vector3d turned(const CyclicSector& sector, const Eigen::Matrix3d& Q,
                       const Eigen::Vector3d& x) {
  return sector.point + Q * (x - sector.point);
}

// The node of `other` nearest to each rotated node of `one`, and the largest distance.
struct Match {
  std::vector<int32_t> partner;  // of each node of `one`
  double apart = 0.0;
  int32_t worst = -1;  // node of `one`
};

// Nodes are sorted along a direction in which hardly two coincide.
Match match(const Mesh& mesh, const CyclicSector& sector, const Eigen::Matrix3d& Q) {
  const Eigen::Vector3d along = Eigen::Vector3d(1.0, 0.618, 0.414).normalized();
  std::vector<std::pair<double, int32_t>> sorted;
  for (const int32_t node : sector.other)
    sorted.emplace_back(along.dot(mesh.nodes.row(node)), node);
  std::sort(sorted.begin(), sorted.end());
  Match out;
  for (const int32_t node : sector.one) {
    const Eigen::Vector3d x = turned(sector, Q, mesh.nodes.row(node).transpose());
    const double height = along.dot(x);
    const auto middle =
        std::lower_bound(sorted.begin(), sorted.end(), std::pair(height, int32_t{-1}));
    double least = std::numeric_limits<double>::infinity();
    int32_t nearest = -1;
    const auto look = [&](const std::pair<double, int32_t>& entry) {
      if (std::abs(entry.first - height) >= least) return false;
      const double distance = (mesh.nodes.row(entry.second).transpose() - x).norm();
      if (distance < least) least = distance, nearest = entry.second;
      return true;
    };
    for (auto at = middle; at != sorted.end() && look(*at);) ++at;
    for (auto at = middle; at != sorted.begin() && look(*(at - 1));) --at;
    out.partner.push_back(nearest);
    if (least > out.apart || out.worst < 0) out.apart = least, out.worst = node;
  }
  return out;
}

int32_t label(const std::vector<int32_t>& ids, int32_t at) {
  return ids.empty() ? at + 1 : ids[at];
}

// The ring's node of each node of each sector.
class Ring {
 public:
  Ring(const Mesh& mesh, const CyclicSector& sector) : sector_(sector), n_(mesh.nodes.rows()) {
    join(mesh);
    int32_t next = static_cast<int32_t>(n_);
    node_.resize(sector.count);
    for (int32_t k = 0; k < sector.count; ++k) {
      auto& row = node_[k];
      for (int32_t i = 0; i < n_; ++i) {
        const int32_t before = before_[i];
        const int32_t after = after_[i];
        if (k == 0 || before == i)
          row.push_back(i);
        else if (before >= 0)
          row.push_back(node_[k - 1][before]);
        else if (after >= 0 && k == sector.count - 1)
          row.push_back(after);
        else
          row.push_back(next++);
      }
    }
    size_ = next;
  }

  int32_t at(int32_t k, int32_t node) const { return node_[k][node]; }
  int32_t size() const { return size_; }
  Eigen::Matrix3d rotation(int32_t k) const { return turn(sector_, sign_ * k); }
  bool on_side(int32_t node) const { return before_[node] >= 0 || after_[node] >= 0; }

 private:
  // before_: the coincident node of the previous sector; after_: that of the next sector.
  void join(const Mesh& mesh) {
    Eigen::Matrix<double, 2, 3> box;
    box.row(0) = box.row(1) = mesh.nodes.row(sector_.one.front());
    for (const int32_t node : sector_.one) {
      box.row(0) = box.row(0).cwiseMin(mesh.nodes.row(node));
      box.row(1) = box.row(1).cwiseMax(mesh.nodes.row(node));
    }
    const double limit = kApart * (box.row(1) - box.row(0)).norm();
    Match found = match(mesh, sector_, turn(sector_, 1.0));
    const Match back = match(mesh, sector_, turn(sector_, -1.0));
    if (back.apart < found.apart) found = back, sign_ = -1.0;
    if (found.apart > limit || sector_.one.size() != sector_.other.size())
      throw InputError(fmt::format(
          "{}: found {} and {} nodes on the sides; rotated by {:g} degrees node {} has its nearest "
          "node at a distance of {:.3g}, expected matching meshes on both sides",
          sector_.where, sector_.one.size(), sector_.other.size(), 360.0 / sector_.count,
          label(mesh.node_ids, found.worst), found.apart));
    before_.assign(n_, -1);
    after_ = before_;
    for (size_t i = 0; i < sector_.one.size(); ++i) {
      before_[sector_.one[i]] = found.partner[i];
      after_[found.partner[i]] = sector_.one[i];
    }
    for (size_t i = 0; i < sector_.one.size(); ++i) {
      const int32_t node = sector_.one[i], partner = found.partner[i];
      const bool once = after_[partner] == node;
      const bool axial = node == partner || after_[node] < 0;
      if (!once || !axial)
        throw InputError(fmt::format("{}: node {} matches two nodes of the other side",
                                     sector_.where, label(mesh.node_ids, partner)));
    }
  }

  const CyclicSector& sector_;
  Eigen::Index n_;
  double sign_ = 1.0;
  std::vector<int32_t> before_, after_;
  std::vector<std::vector<int32_t>> node_;
  int32_t size_ = 0;
};

// The content of one sector, for copying.
int64_t size_of(const Deck& deck) {
  const Mesh& mesh = deck.mesh;
  auto size = static_cast<int64_t>(mesh.nodes.rows()) + mesh.cell_count();
  for (const auto& [name, surface] : mesh.surfaces) size += surface.face_count();
  for (const auto& [name, nodes] : mesh.node_sets) size += static_cast<int64_t>(nodes.size());
  for (const auto& [name, field] : mesh.fields) size += field.size();
  const auto add = [&](const std::vector<Support>& supports) {
    for (const Support& support : supports)
      size += static_cast<int64_t>(support.node_indices.size());
  };
  add(deck.supports);
  add(deck.retained);
  for (const Step& step : deck.steps) {
    add(step.supports);
    size += static_cast<int64_t>(step.forces.size());
  }
  return size;
}

class Unfolding {
 public:
  Unfolding(Deck& deck, const CyclicSector& sector)
      : deck_(deck), mesh_(deck.mesh), sector_(sector), ring_(mesh_, sector) {}

  void run() {
    refuse_others();
    surfaces();
    for (auto& [name, nodes] : mesh_.node_sets) nodes = all_of(nodes);
    for (auto& [name, node_indices] : deck_.sets) node_indices = all_of(node_indices);
    supports(&deck_.supports);
    supports(&deck_.retained);
    for (Step& step : deck_.steps) {
      check_loads(step);
      supports(&step.supports);
      forces(&step);
    }
    fields();
    cells();
    nodes();
  }

 private:
  [[noreturn]] void fail(const std::string& where, const std::string& what) const {
    throw InputError(
        fmt::format("{}: found {} in a sector of *CYCLIC SYMMETRY MODEL ({}), which is "
                    "not supported, expected only cells, supports and loads",
                    where, what, sector_.where));
  }

  void refuse_others() const {
    if (!deck_.rigid.empty()) fail(deck_.rigid[0].where, "a rigid coupling");
    if (!deck_.distributing.empty()) fail(deck_.distributing[0].where, "a distributing coupling");
    if (!deck_.equations.empty()) fail(deck_.equations[0].where, "an equation");
    if (!deck_.ties.empty()) fail(deck_.ties[0].where, "a tie");
    if (!deck_.bolts.empty()) fail(deck_.bolts[0].where, "a bolt");
    if (!deck_.springs.empty()) fail(deck_.springs[0].where, "a spring");
    if (!deck_.masses.empty()) fail(deck_.masses[0].where, "a mass");
    if (!deck_.mesh.shells.empty())
      fail(deck_.regions[static_cast<size_t>(deck_.mesh.shells[0].region)].where, "shells");
    for (const Region& region : deck_.regions)
      if (!region.system.empty() && !repeats(deck_.systems.at(region.system)))
        fail(region.where, "material axes that do not rotate with it");
  }

  bool is_axis(const Eigen::Vector3d& point, const Eigen::Vector3d& direction) const {
    const Eigen::Vector3d arm = point - sector_.point;
    return direction.cross(sector_.axis).norm() <= kAlong * direction.norm() &&
           arm.cross(sector_.axis).norm() <= kAlong * (1.0 + arm.norm());
  }
  /// True for directions that rotate with the sector.
  bool repeats(const System& system) const {
    return system.kind == System::Kind::kCylindrical && is_axis(system.origin, system.axes.col(2));
  }

  void check_loads(const Step& step) const {
    if (step.acceleration.cross(sector_.axis).norm() > kAlong * step.acceleration.norm())
      fail(step.where, "gravity across the axis");
    for (const Step::Rotation& one : step.rotations)
      if (!is_axis(one.point, one.axis)) fail(step.where, "a rotation about another axis");
  }

  std::vector<int32_t> all_of(const std::vector<int32_t>& nodes) const {
    std::vector<int32_t> all;
    for (int32_t k = 0; k < sector_.count; ++k)
      for (const int32_t node : nodes) all.push_back(ring_.at(k, node));
    sort_unique(all);
    return all;
  }

  /// The name of a system rotated with sector k; empty for basic directions of the first sector.
  std::string system_of(const std::string& name, int32_t k) {
    if (k == 0 || (!name.empty() && repeats(deck_.systems.at(name)))) return name;
    System system;
    if (!name.empty()) system = deck_.systems.at(name);
    const Eigen::Matrix3d Q = ring_.rotation(k);
    system.name = fmt::format("{}sector_{}", name.empty() ? "" : name + "_", k + 1);
    system.where = sector_.where;
    system.axes = (Q * system.axes).eval();
    system.origin = turned(sector_, Q, system.origin);
    deck_.systems[system.name] = system;
    return system.name;
  }

  void supports(std::vector<Support>* supports) {
    std::vector<Support> turned;
    for (Support& support : *supports) {
      const bool all_fixed =
          (support.dofs & kTranslations) == kTranslations && support.value == 0.0;
      if (all_fixed || (!support.system.empty() && repeats(deck_.systems.at(support.system)))) {
        support.node_indices = all_of(support.node_indices);
        continue;
      }
      for (int32_t k = 1; k < sector_.count; ++k) {
        Support copy = support;
        copy.system = system_of(support.system, k);
        for (NodeIndex& node_index : copy.node_indices) node_index = ring_.at(k, node_index);
        turned.push_back(std::move(copy));
      }
    }
    supports->insert(supports->end(), turned.begin(), turned.end());
  }

  void forces(Step* step) {
    const size_t own = step->forces.size();
    for (int32_t k = 1; k < sector_.count; ++k)
      for (size_t i = 0; i < own; ++i) {
        Step::NodalForce force = step->forces[i];
        force.system = system_of(force.system, k);
        force.node_index = ring_.at(k, force.node_index);
        step->forces.push_back(std::move(force));
      }
  }

  /// Removes faces of the sides from surfaces.
  void surfaces() {
    for (auto at = mesh_.surfaces.begin(); at != mesh_.surfaces.end();) {
      const std::vector<int32_t> own = nodes_of(at->second);
      if (std::all_of(own.begin(), own.end(), [&](int32_t n) { return ring_.on_side(n); })) {
        at = mesh_.surfaces.erase(at);
        continue;
      }
      for (FaceBlock& block : at->second.faces) block.nodes = round(block.nodes);
      ++at;
    }
  }

  IndexMatrix round(const IndexMatrix& nodes) const {
    IndexMatrix all(nodes.rows() * sector_.count, nodes.cols());
    for (int32_t k = 0; k < sector_.count; ++k)
      for (Eigen::Index row = 0; row < nodes.rows(); ++row)
        for (Eigen::Index col = 0; col < nodes.cols(); ++col)
          all(k * nodes.rows() + row, col) = ring_.at(k, nodes(row, col));
    return all;
  }

  void fields() {
    for (auto& [name, field] : mesh_.fields) {
      RowMatrix all(ring_.size(), field.cols());
      for (int32_t k = sector_.count - 1; k >= 0; --k)  // the sector's own values have priority
        for (int32_t i = 0; i < field.rows(); ++i) all.row(ring_.at(k, i)) = field.row(i);
      field = std::move(all);
    }
  }

  /// Numbers of the copies: 0 if they do not fit into 32 bits.
  int64_t offset_of(int32_t highest) const {
    int64_t power = 10;
    while (power <= highest) power *= 10;
    const bool fits = power * (sector_.count - 1) + highest <= std::numeric_limits<int32_t>::max();
    return fits ? power : 0;
  }

  void cells() {
    int32_t highest = 0;
    for (const CellBlock& block : mesh_.cells)
      for (const int32_t id : block.ids) highest = std::max(highest, id);
    const int64_t offset = offset_of(highest);
    for (CellBlock& block : mesh_.cells) {
      block.nodes = round(block.nodes);
      const std::vector<int32_t> own = std::move(block.ids);
      block.ids.clear();
      for (int32_t k = 0; offset > 0 && k < sector_.count; ++k)
        for (const int32_t id : own) block.ids.push_back(static_cast<int32_t>(id + k * offset));
    }
  }

  /// Nodes that two sectors share are at the mean of both positions.
  void nodes() {
    const RowMatrix own = mesh_.nodes;
    const std::vector<int32_t> ids = mesh_.node_ids;
    RowMatrix sum = RowMatrix::Zero(ring_.size(), 3);
    Eigen::VectorXd times = Eigen::VectorXd::Zero(ring_.size());
    std::vector<int32_t> all_ids(static_cast<size_t>(ring_.size()), 0);
    const int64_t offset = ids.empty() ? 0 : offset_of(*std::max_element(ids.begin(), ids.end()));
    for (int32_t k = 0; k < sector_.count; ++k) {
      const Eigen::Matrix3d Q = ring_.rotation(k);
      for (int32_t i = 0; i < own.rows(); ++i) {
        const int32_t node = ring_.at(k, i);
        sum.row(node) += turned(sector_, Q, own.row(i).transpose()).transpose();
        times[node] += 1.0;
        int32_t& id = all_ids[node];
        if (offset > 0 && id == 0) id = static_cast<int32_t>(ids[i] + k * offset);
      }
    }
    mesh_.nodes = times.cwiseInverse().asDiagonal() * sum;
    mesh_.node_ids = offset > 0 ? std::move(all_ids) : std::vector<int32_t>();
  }

  Deck& deck_;
  Mesh& mesh_;
  const CyclicSector& sector_;
  Ring ring_;
};

}  // namespace

void unfold(Deck& deck, const CyclicSector& sector) {
  if (!deck.points.empty())
    throw InputError(fmt::format("{}: found node {}, which belongs to no cell, expected cells only",
                                 sector.where, deck.points.front().id));
  const int64_t size = size_of(deck);
  if (size > kMost / sector.count)
    throw InputError(
        fmt::format("{}: found {} sectors of {} nodes, cells, faces, members of sets and "
                    "loads, expected at most {} of the ring",
                    sector.where, sector.count, size, kMost));
  Unfolding(deck, sector).run();
}

}  // namespace clatter::mesh::deck
