// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/abaqus/generate.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <unordered_map>

#include "mesh/deck/abaqus/placement.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr int32_t kMostNumber = std::numeric_limits<int32_t>::max();
constexpr size_t kMostMade = size_t{1} << 24;  // of one keyword: half a gigabyte
constexpr double kSamePlace = 1e-9;            // of a node's distance from the origin: rounding
constexpr double kSameRadius = 1e-2;           // of a radius: both ends of an arc, in few digits

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

class Generator {
 public:
  Generator(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
            Ignore& ignore)
      : card_(card),
        keyword_(card.keyword()),
        scope_(scope),
        system_(system),
        source_(source),
        ignore_(ignore),
        index_(scope.nodes.ids) {}

  void run() {
    const std::string& key = keyword_.key;
    if (key == "NGEN") return lines();
    if (key == "NFILL") return fill();
    if (key == "NCOPY") return copy_nodes();
    index_elements();
    if (key == "ELGEN") return rows_of_elements();
    copy_elements();
  }

 private:
  Eigen::Vector3d at(int32_t id, Origin origin) const {
    const int32_t row = index_.find(id);
    if (row < 0) {
      source_.fail(origin, fmt::format("{}: found no node {} before it", keyword_.name, id));
    }
    return Eigen::Vector3d(scope_.nodes.xyz.data() + 3 * int64_t{row});
  }

  int32_t number(int64_t id, Origin origin) const {
    if (id >= 1 && id <= kMostNumber) return static_cast<int32_t>(id);
    source_.fail(origin, fmt::format("{}: makes the number {}, expected 1 to {}", keyword_.name, id,
                                     kMostNumber));
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

  // The set that the parameter names gets what was made and `more`.
  void name_set(std::string_view parameter, IdSets& sets, std::vector<int32_t> more) {
    if (!keyword_.has(parameter)) return;
    SetChunk& chunk = new_chunk(sets, keyword_.required(parameter, source_), card_.origin());
    chunk.id_lines.emplace_back(0, card_.origin());
    chunk.ids = std::move(more);
    chunk.ids.insert(chunk.ids.end(), made_.begin(), made_.end());
  }

  std::vector<int32_t> set(const IdSets& sets, const std::string& name) const {
    return numbers_of_set(scope_, sets, name, source_, card_.origin());
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
    keyword_.allow({"NSET", "BIAS"}, source_, ignore_);
    if (const std::string* bias = keyword_.find("BIAS");
        bias != nullptr && to_number(*bias) != 1.0) {
      source_.fail(card_.origin(), fmt::format("*NFILL: BIAS={} is not supported, expected 1 or "
                                               "the nodes themselves (*NODE)",
                                               *bias));
    }
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
      for (size_t n = 0; n < a.size(); ++n) {
        const Arc line{at(a[n], fields.origin()), at(b[n], fields.origin()), {}, {}, 'S'};
        for (int32_t k = 1; k < intervals; ++k) {
          add_node(a[n] + int64_t{k} * step, line.at(static_cast<double>(k) / intervals),
                   fields.origin());
        }
      }
      bounds.insert(bounds.end(), a.begin(), a.end());
      bounds.insert(bounds.end(), b.begin(), b.end());
    }
    name_set("NSET", scope_.node_sets, std::move(bounds));
  }

  int32_t parameter(std::string_view name) const {
    const std::string& text = keyword_.required(name, source_);
    return Fields(text, source_, card_.origin()).integer(0, name, -kMostNumber, kMostNumber);
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

  // Where the elements before the card are, by number: a table of cells and a row, or one of the
  // other elements.
  struct Place {
    CellTable* table = nullptr;
    size_t row = 0;
    bool thin = false;
  };

  void index_elements() {
    for (CellTable& table : scope_.cells) {
      for (size_t row = 0; row < table.ids.size(); ++row) places_[table.ids[row]] = {&table, row};
    }
    for (size_t t = 0; t < scope_.thin.size(); ++t) places_[scope_.thin[t].id] = {nullptr, t, true};
    for (size_t p = 0; p < scope_.points.size(); ++p) places_[scope_.points[p].id] = {nullptr, p};
  }

  // Copies element `id`, numbers of nodes and of the element raised by those.
  void copy_element(int32_t id, int64_t node, int64_t element, Origin origin) {
    if (made_.size() >= kMostMade) {
      source_.fail(origin, fmt::format("{}: makes too many elements", keyword_.name));
    }
    const auto found = places_.find(id);
    if (found == places_.end()) {
      source_.fail(origin, fmt::format("{}: found no element {} before it", keyword_.name, id));
    }
    const auto [table, row, is_thin] = found->second;
    const int32_t new_id = number(id + element, origin);
    made_.push_back(new_id);
    if (table != nullptr) {
      const auto columns = static_cast<size_t>(traits(table->type).nodes);
      table->ids.push_back(new_id);
      table->origins.push_back(origin);
      for (size_t i = 0; i < columns; ++i) {
        table->nodes.push_back(number(table->nodes[columns * row + i] + node, origin));
      }
    } else if (is_thin) {
      ThinElement copy = scope_.thin[row];
      copy.id = new_id;
      copy.origin = origin;
      for (int32_t i = 0; i < copy.count; ++i) {
        int32_t& at = copy.nodes[static_cast<size_t>(i)];
        at = number(at + node, origin);
      }
      scope_.thin.push_back(std::move(copy));
    } else {
      PointElement copy = scope_.points[row];
      copy.id = new_id;
      copy.origin = origin;
      copy.node = number(copy.node + node, origin);
      if (copy.second != 0) copy.second = number(copy.second + node, origin);
      scope_.points.push_back(std::move(copy));
    }
  }

  // Master, then for rows, columns, layers: how many, step of the nodes, step of the elements.
  void rows_of_elements() {
    keyword_.allow({"ELSET", "ALLNODES"}, source_, ignore_);
    std::vector<int32_t> masters;
    for (size_t i = 0; i < card_.size(); ++i) {
      const Fields fields = card_.line(i, source_);
      fields.at_most(10, "master element, three times: how many, step of nodes, step of elements");
      masters.push_back(fields.integer(0, "master element", 1, kMostNumber));
      int64_t count[3], node[3], element[3];
      for (size_t d = 0; d < 3; ++d) {
        const auto number_at = [&](size_t f, const char* what) {
          return fields.blank(f) ? 1 : fields.integer(f, what, -kMostNumber, kMostNumber);
        };
        count[d] = number_at(1 + 3 * d, "how many");
        node[d] = number_at(2 + 3 * d, "step of nodes");
        element[d] = number_at(3 + 3 * d, "step of elements");
        if (count[d] < 1)
          fields.fail(fmt::format("found {} elements, expected 1 or more", count[d]));
      }
      for (int64_t c = 0; c < count[2]; ++c) {
        for (int64_t b = 0; b < count[1]; ++b) {
          for (int64_t a = 0; a < count[0]; ++a) {
            if (a == 0 && b == 0 && c == 0) continue;
            copy_element(masters.back(), a * node[0] + b * node[1] + c * node[2],
                         a * element[0] + b * element[1] + c * element[2], fields.origin());
          }
        }
      }
    }
    name_set("ELSET", scope_.element_sets, std::move(masters));
  }

  void copy_elements() {
    keyword_.allow({"ELEMENTSHIFT", "OLDSET", "SHIFTNODES", "NEWSET", "REFLECT"}, source_, ignore_);
    const int64_t element = parameter("ELEMENTSHIFT"), node = parameter("SHIFTNODES");
    for (const int32_t id : set(scope_.element_sets, keyword_.required("OLDSET", source_))) {
      copy_element(id, node, element, card_.origin());
    }
    name_set("NEWSET", scope_.element_sets, {});
  }

  const Card& card_;
  const Keyword& keyword_;
  Scope& scope_;
  const LocalSystem& system_;
  const Source& source_;
  Ignore& ignore_;
  IdIndex index_;              // of the nodes before the card
  std::vector<int32_t> made_;  // numbers
  std::unordered_map<int32_t, Place> places_;
};

// Collects the numbers of a set and of those in it, each set once.
class SetNumbers {
 public:
  SetNumbers(const Scope& scope, const IdSets& sets, const Source& source)
      : scope_(scope), sets_(sets), source_(source) {}

  const std::vector<int32_t>& of(const std::string& name, Origin origin) {
    const auto [at, is_new] = done_.try_emplace(folded(name));
    Entry& entry = at->second;
    if (entry.done) return entry.numbers;
    const auto found = sets_.find(folded(name));
    if (found == sets_.end()) source_.fail(origin, fmt::format("found no set {}", shown(name)));
    if (!is_new || ++depth_ > kDeepest) {
      source_.fail(origin, fmt::format("set {} holds itself", shown(name)));
    }
    std::vector<int32_t> out;
    for (const SetChunk& chunk : found->second.chunks) add_chunk(chunk, out);
    --depth_;
    sort_unique(out);
    entry.numbers = std::move(out);
    entry.done = true;
    return entry.numbers;
  }

 private:
  static constexpr int kDeepest = 64;
  struct Entry {
    std::vector<int32_t> numbers;
    bool done = false;
  };

  void add(const std::vector<int32_t>& more, Origin origin, std::vector<int32_t>& out) const {
    if (out.size() + more.size() > kMostMade) source_.fail(origin, "found too large a set");
    out.insert(out.end(), more.begin(), more.end());
  }

  void add_chunk(const SetChunk& chunk, std::vector<int32_t>& out) {
    add(chunk.ids, chunk.origin, out);
    for (int32_t row = chunk.row_begin; row < chunk.row_end; ++row) {
      out.push_back(rows_of(chunk)[static_cast<size_t>(row)]);
    }
    for (const IdRange& range : chunk.ranges) {
      for (int64_t id = range.first; id <= range.last; id += range.step) {
        if (out.size() >= kMostMade) source_.fail(chunk.origin, "found too large a set");
        out.push_back(static_cast<int32_t>(id));
      }
    }
    for (const auto& [other, line] : chunk.names) add(of(other, line), line, out);
  }

  const std::vector<int32_t>& rows_of(const SetChunk& chunk) const {
    if (&sets_ == &scope_.node_sets) return scope_.nodes.ids;
    return scope_.cells[static_cast<size_t>(chunk.table)].ids;
  }

  const Scope& scope_;
  const IdSets& sets_;
  const Source& source_;
  std::map<std::string, Entry> done_;
  int depth_ = 0;
};

}  // namespace

void generate(const Card& card, Scope& scope, const LocalSystem& system, const Source& source,
              Ignore& ignore) {
  Generator(card, scope, system, source, ignore).run();
}

std::vector<int32_t> numbers_of_set(const Scope& scope, const IdSets& sets, const std::string& name,
                                    const Source& source, Origin origin) {
  return SetNumbers(scope, sets, source).of(name, origin);
}

}  // namespace clatter::mesh::deck::abaqus
