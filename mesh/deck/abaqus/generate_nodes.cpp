// SPDX-License-Identifier: GPL-3.0-or-later
// *NGEN, *NFILL, *NCOPY.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "mesh/deck/abaqus/generator.hpp"
#include "mesh/deck/abaqus/placement.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr double kSamePlace = 1e-9;   // of a node's distance from the origin: rounding
constexpr double kSameRadius = 1e-2;  // of a radius: both ends of an arc, in few digits

// The shape of a line of *NGEN.
struct Arc {
  Eigen::Vector3d a, b, extra, normal;
  char kind;  // S straight, P parabola, C circle

  Eigen::Vector3d at(double t) const {
    if (kind == 'S') return (1.0 - t) * a + t * b;
    if (kind == 'P') {
      return (1.0 - t) * (1.0 - 2.0 * t) * a + 4.0 * t * (1.0 - t) * extra +
             t * (2.0 * t - 1.0) * b;
    }
    const Eigen::Vector3d from = a - extra, to = b - extra;
    double angle = std::atan2(from.cross(to).dot(normal), from.dot(to));
    if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
    const double radius = (1.0 - t) * from.norm() + t * to.norm();
    return extra + radius * (Eigen::AngleAxisd(t * angle, normal) * from.normalized());
  }
};

class NodeGenerator : Generator {
 public:
  NodeGenerator(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
                Ignore& ignore)
      : Generator(card, scope, source, ignore), system_(system), index_(scope.nodes.ids) {}

  void run() {
    if (keyword_.key == "NGEN") return lines();
    if (keyword_.key == "NFILL") return fill();
    copy_nodes();
  }

 private:
  Eigen::Vector3d at(int32_t id, Origin origin) const {
    const int32_t row = index_.find(id);
    if (row < 0) {
      source_.fail(origin, fmt::format("{}: found no node {} before it", keyword_.name, id));
    }
    return Eigen::Vector3d(scope_.nodes.xyz.data() + 3 * int64_t{row});
  }

  void add_node(int64_t id, const Eigen::Vector3d& x, Origin origin) {
    if (scope_.nodes.ids.size() >= kMostMade) {
      source_.fail(origin, fmt::format("{}: makes too many nodes", keyword_.name));
    }
    const int32_t row = id >= 1 && id <= kMostNumber ? index_.find(static_cast<int32_t>(id)) : -1;
    if (row >= 0 && (at(static_cast<int32_t>(id), origin) - x).norm() <= kSamePlace * x.norm()) {
      made_.push_back(static_cast<int32_t>(id));  // the node is there already
      return;
    }
    scope_.nodes.ids.push_back(number(id, origin));
    scope_.nodes.origins.push_back(origin);
    scope_.nodes.xyz.insert(scope_.nodes.xyz.end(), x.begin(), x.end());
    made_.push_back(scope_.nodes.ids.back());
  }

  // First, last, step, extra node or point, normal of a circle.
  void lines() {
    keyword_.allow({"NSET", "LINE", "SYSTEM"}, source_, ignore_);
    const std::string kind = keyword_.choice("LINE", "S");
    if (kind != "S" && kind != "P" && kind != "C") {
      source_.fail(card_.origin(), fmt::format("*NGEN: found LINE={}, expected P or C", kind));
    }
    std::vector<int32_t> ends;
    for (size_t i = 0; i < card_.size(); ++i) {
      const Fields fields = card_.line(i, source_);
      fields.at_most(10, "first, last, step, extra node, extra point, normal");
      const int32_t first = fields.integer(0, "first node", 1, kMostNumber);
      const int32_t last = fields.integer(1, "last node", 1, kMostNumber);
      const int32_t step = fields.blank(2) ? 1 : fields.integer(2, "step", 1, kMostNumber);
      const int64_t intervals = std::abs(int64_t{last} - first) / step;
      if (intervals == 0 || (int64_t{last} - first) % step != 0) {
        fields.fail(fmt::format("found {} to {} by {}, expected a multiple of the step", first,
                                last, step));
      }
      const Arc arc = arc_of(fields, first, last, kind.front());
      for (int64_t k = 1; k < intervals; ++k) {
        add_node(int64_t{first} + (last < first ? -k : k) * step,
                 arc.at(static_cast<double>(k) / static_cast<double>(intervals)), fields.origin());
      }
      ends.insert(ends.end(), {first, last});
    }
    name_set("NSET", scope_.node_sets, std::move(ends));
  }

  Arc arc_of(const Fields& fields, int32_t first, int32_t last, char kind) const {
    Arc arc{at(first, fields.origin()), at(last, fields.origin()), {}, {}, kind};
    if (kind == 'S') return arc;
    if (!fields.blank(3) && fields.text(3) != "0") {
      arc.extra = at(fields.integer(3, "extra node", 1, kMostNumber), fields.origin());
    } else {
      Eigen::Vector3d x;
      for (size_t k = 0; k < 3; ++k) {
        x[static_cast<int>(k)] = fields.number_or(4 + k, "extra point", 0.0);
      }
      arc.extra = system_.global(cartesian(coordinates_of(keyword_, source_), x));
    }
    if (kind == 'P') return arc;
    const Eigen::Vector3d from = arc.a - arc.extra, to = arc.b - arc.extra;
    if (fields.size() > 7) {
      Eigen::Vector3d normal;
      for (size_t k = 0; k < 3; ++k) {
        normal[static_cast<int>(k)] = fields.number_or(7 + k, "normal", 0.0);
      }
      arc.normal = (system_.axes * normal).normalized();
    } else {
      arc.normal = from.cross(to).normalized();
    }
    if (std::abs(from.norm() - to.norm()) > kSameRadius * from.norm() ||
        !(std::abs(arc.normal.norm() - 1.0) < 1e-9)) {
      fields.fail(
          "expected two ends at the same distance of the centre, and the normal of the "
          "circle where they and the centre lie on a line");
    }
    return arc;
  }

  // Set, set, intervals, step: between the nodes of both, in ascending order of their numbers.
  void fill() {
    keyword_.allow({"NSET", "BIAS", "TWOSTEP"}, source_, ignore_);
    const double bias = bias_of();
    std::vector<int32_t> bounds;
    for (size_t i = 0; i < card_.size(); ++i) {
      const Fields fields = card_.line(i, source_);
      fields.at_most(4, "two node sets, intervals, step");
      const std::vector<int32_t> a = set(scope_.node_sets, fields.word(0, "a node set"));
      const std::vector<int32_t> b = set(scope_.node_sets, fields.word(1, "a node set"));
      if (a.size() != b.size()) {
        fields.fail(fmt::format("found {} nodes in {} and {} in {}, expected as many", a.size(),
                                fields.text(0), b.size(), fields.text(1)));
      }
      const int32_t intervals = fields.integer(2, "intervals", 1, kMostNumber);
      const int32_t step = fields.blank(3) ? 1 : fields.integer(3, "step", 1, kMostNumber);
      if (keyword_.has("TWOSTEP") && intervals % 2 != 0)
        fields.fail(
            fmt::format("found {} intervals with TWO STEP, expected an even number", intervals));
      for (size_t n = 0; n < a.size(); ++n) {
        const Arc line{at(a[n], fields.origin()), at(b[n], fields.origin()), {}, {}, 'S'};
        for (int32_t k = 1; k < intervals; ++k)
          add_node(a[n] + int64_t{k} * step, line.at(share(k, intervals, bias)), fields.origin());
      }
      bounds.insert(bounds.end(), a.begin(), a.end());
      bounds.insert(bounds.end(), b.begin(), b.end());
    }
    name_set("NSET", scope_.node_sets, std::move(bounds));
  }

  // The ratio of each distance to the next one, from the first set to the second.
  double bias_of() const {
    const std::string* text = keyword_.find("BIAS");
    if (text == nullptr) return 1.0;
    const double bias = Fields(*text, source_, card_.origin()).number(0, "BIAS");
    if (!(bias > 0.0))
      source_.fail(card_.origin(),
                   fmt::format("*NFILL: found BIAS={}, expected a ratio above 0", *text));
    return bias;
  }

  // Position of node k on its line, 0 to 1. With TWO STEP the ratio is that of every second
  // distance, whose halves are equal: of mid-side nodes.
  double share(int32_t k, int32_t intervals, double bias) const {
    const bool two = keyword_.has("TWOSTEP");
    if (two && k % 2 != 0)
      return 0.5 * (share(k - 1, intervals, bias) + share(k + 1, intervals, bias));
    const double at = two ? k / 2 : k, all = two ? intervals / 2 : intervals;
    if (bias == 1.0) return at / all;
    // Distances 1, 1/b, 1/b^2, ...: powers below 1 do not overflow.
    if (bias > 1.0) return (1.0 - std::pow(bias, -at)) / (1.0 - std::pow(bias, -all));
    const double rest = (1.0 - std::pow(bias, all - at)) / (1.0 - std::pow(bias, all));
    return 1.0 - rest;
  }

  // Copies of a set: moved (SHIFT, several times with MULTIPLE) or reflected.
  void copy_nodes() {
    keyword_.allow({"CHANGENUMBER", "OLDSET", "NEWSET", "SHIFT", "MULTIPLE", "REFLECT"}, source_,
                   ignore_);
    const int64_t change = parameter("CHANGENUMBER");
    const std::vector<int32_t> old = set(scope_.node_sets, keyword_.required("OLDSET", source_));
    const int32_t times = keyword_.has("MULTIPLE") ? parameter("MULTIPLE") : 1;
    const Eigen::Affine3d move = keyword_.has("SHIFT") ? shift() : reflection();
    Eigen::Affine3d total = Eigen::Affine3d::Identity();
    for (int32_t k = 1; k <= times && !old.empty(); ++k) {
      total = move * total;
      for (const int32_t id : old) {
        add_node(id + k * change, total * at(id, card_.origin()), card_.origin());
      }
    }
    name_set("NEWSET", scope_.node_sets, {});
  }

  Eigen::Affine3d shift() const {
    Placement placement;
    for (size_t i = 0; i < card_.size(); ++i) {
      placement.read(card_.line(i, source_), static_cast<int>(i));
    }
    return placement.affine();
  }

  // POINT: a point. LINE: two points. MIRROR: two points, and a third one of the plane.
  Eigen::Affine3d reflection() const {
    const std::string kind = keyword_.choice("REFLECT", "");
    std::vector<double> x;
    for (size_t i = 0; i < card_.size(); ++i) {
      const Fields fields = card_.line(i, source_);
      for (size_t k = 0; k < fields.size(); ++k) x.push_back(fields.number(k, "coordinate"));
    }
    const size_t points = kind == "POINT" ? 1 : kind == "LINE" ? 2 : kind == "MIRROR" ? 3 : 0;
    if (points == 0 || x.size() != 3 * points) {
      source_.fail(card_.origin(),
                   "*NCOPY: expected SHIFT, or REFLECT=POINT, LINE or MIRROR with "
                   "one, two or three points");
    }
    const auto point = [&](size_t i) { return Eigen::Vector3d(x.data() + 3 * i); };
    Eigen::Matrix3d R = -Eigen::Matrix3d::Identity();
    if (points > 1) {
      Eigen::Vector3d d = point(1) - point(0);
      if (points == 3) d = d.cross(point(2) - point(0));
      if (!(d.norm() > 0.0)) source_.fail(card_.origin(), "*NCOPY: its points lie on a line");
      d.normalize();
      R = 2.0 * d * d.transpose() - Eigen::Matrix3d::Identity();
      if (points == 3) R = -R;
    }
    Eigen::Affine3d out = Eigen::Affine3d::Identity();
    out.linear() = R;
    out.translation() = point(0) - R * point(0);
    return out;
  }

  const LocalSystem& system_;
  IdIndex index_;  // of the nodes before the card
};

}  // namespace

void generate_nodes(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
                    Ignore& ignore) {
  NodeGenerator(card, scope, system, source, ignore).run();
}

}  // namespace clatter::mesh::deck::abaqus
