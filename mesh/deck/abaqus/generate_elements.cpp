// SPDX-License-Identifier: GPL-3.0-or-later
// *ELGEN, *ELCOPY.
#include <fmt/format.h>

#include <unordered_map>

#include "mesh/deck/abaqus/generator.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

class ElementGenerator : Generator {
 public:
  using Generator::Generator;

  void run() {
    index_elements();
    if (keyword_.key == "ELGEN") return rows_of_elements();
    copy_elements();
  }

 private:
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
        int32_t& at = copy.nodes[i];
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

  std::unordered_map<int32_t, Place> places_;
};

}  // namespace

void generate_elements(const Card& card, Scope& scope, const Source& source, Ignore& ignore) {
  ElementGenerator(card, scope, source, ignore).run();
}

}  // namespace clatter::mesh::deck::abaqus
