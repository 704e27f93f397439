// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/recipe/text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/error.hpp"
#include "mesh/deck/recipe/loads.hpp"
#include "mesh/deck/recipe/names.hpp"

namespace clatter::mesh::deck {
namespace {

std::vector<double> numbers(const Eigen::Vector3d& v) { return {v(0), v(1), v(2)}; }

class RecipeWriter {
 public:
  explicit RecipeWriter(Deck& deck) : deck_(deck), names_(deck) {}

  std::string write() {
    put("# Read from {}; SI units.\nlength_unit = \"m\"\n",
        deck_.files.empty() ? "a deck" : deck_.files.front());
    for (const auto& [card, count] : deck_.ignored)
      put("# ignored in the deck: {} ({} times)\n", card, count);
    if (!deck_.passed.empty()) put("# {}\n", deck_.passed);
    for (const Repair& one : deck_.renumbered) put("# {}\n", one.text);
    for (const std::string& one : deck_.notes) put("# {}\n", one);
    if (deck_.mass == MassForm::kLumped)
      put("\n[mass]\nlumping = \"hrz\"  # lumped: without this table consistent\n");
    offer_damping();
    systems();
    materials();
    std::string relations = std::exchange(text_, {});
    // Couplings register points on nodes, so points are written after them.
    couplings();
    if (deck_.mesh.node_sets.contains(kHangingMidSideNodes))
      put("\n[[straight_edges]]  # cells of the deck without these mid-side nodes\nnode_set = {}\n",
          toml_text(kHangingMidSideNodes));
    for (const Tie& tie : deck_.ties) add_tie(tie);
    for (const Bolt& bolt : deck_.bolts)
      put("\n[[bolt]]  # {}\nname = {}\nslave = {}\nmaster = {}\ndirection = {}\n", bolt.where,
          toml_text(names_.point(bolt.reference)), toml_text(bolt.slave), toml_text(bolt.master),
          toml_list(numbers(bolt.direction)));
    for (const Equation& equation : deck_.equations)
      put("\n[[equation]]  # {}\n{}", equation.where, terms_text(equation.terms));
    for (const Spring& spring : deck_.springs) add_spring(spring);
    for (const NodalMatrix& matrix : deck_.matrices) add_matrix(matrix);
    masses();
    retained();
    const std::string steps = write_steps(deck_, names_);
    std::string rest = std::exchange(text_, {});
    points();
    for (const Support& support : deck_.supports) text_ += support_text(support, names_);
    return relations + text_ + rest + steps;
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
  }

  /// One model has one damping, a deck may have several: the user decides.
  void offer_damping() {
    std::vector<Damping> all = deck_.damping;
    for (const auto& [name, material] : deck_.materials)
      all.push_back({material.where, name, material.mass_damping, material.stiffness_damping});
    for (const Damping& one : all) {
      if (one.mass == 0.0 && one.stiffness == 0.0) continue;
      put("\n# the deck's damping of {} ({}), not used unless these lines are:\n# [damping]\n"
          "# alpha = {}\n# beta = {}\n",
          one.of, one.where, one.stiffness, one.mass);
    }
  }

  void systems() {
    constexpr const char* kKinds[] = {"rectangular", "cylindrical", "spherical"};
    for (const auto& [name, system] : deck_.systems)
      put("\n[system.{}]\nkind = \"{}\"\norigin = {}\nx = {}\nz = {}\n", toml_key(name),
          kKinds[static_cast<int>(system.kind)], toml_list(numbers(system.origin)),
          toml_list(numbers(system.axes.col(0))), toml_list(numbers(system.axes.col(2))));
  }

  /// Regions with the same material, axes and integration share a table.
  void materials() {
    std::map<std::string, std::vector<std::string>> regions_of;  // by the text of the table
    std::vector<std::pair<std::string, std::string>> order;      // material name, text
    for (size_t r = 0; r < deck_.regions.size(); ++r) {
      const Region& region = deck_.regions[r];
      if (region.material.empty()) {
        put("\n# region {} has no material in the deck: name it in a [material.NAME]\n",
            toml_text(deck_.mesh.regions[r]));
        continue;
      }
      const std::string body = material_body(region);
      auto& regions = regions_of[region.material + "\n" + body];
      if (regions.empty()) order.emplace_back(region.material, body);
      regions.push_back(toml_text(deck_.mesh.regions[r]));
    }
    std::map<std::string, int> used;
    for (const auto& [name, body] : order) {
      const int count = ++used[name];
      put("\n[material.{}]\nregions = [{}]\n{}",
          toml_key(count == 1 ? name : fmt::format("{}_{}", name, count)),
          fmt::join(regions_of.at(name + "\n" + body), ", "), body);
    }
  }

  std::string material_body(const Region& region) const {
    const auto found = deck_.materials.find(region.material);
    if (found == deck_.materials.end())
      throw InputError(
          fmt::format("{}: material {} is not in the deck", region.where, region.material));
    const Material& material = found->second;
    const std::vector<double>& c = material.constants;
    std::string out;
    switch (material.kind) {
      case Material::Kind::kIsotropic:
        out += fmt::format("E = {}\nnu = {}\n", c.at(0), c.at(1));
        break;
      case Material::Kind::kOrthotropic:
        out += fmt::format("E = {}\nnu = {}\nG = {}\n", toml_list({c.at(0), c.at(1), c.at(2)}),
                           toml_list({c.at(3), c.at(4), c.at(5)}),
                           toml_list({c.at(6), c.at(7), c.at(8)}));
        break;
      case Material::Kind::kAnisotropic:
        out += fmt::format("C = {}\n", toml_list(c));
        break;
    }
    out += material.density > 0.0 ? fmt::format("rho = {}\n", material.density)
                                  : "rho = 1.0  # the deck has none: mass and frequencies are "
                                    "meaningless with this one\n";
    if (material.expansion.size() == 1)
      out += fmt::format("expansion = {}\n", material.expansion[0]);
    if (material.expansion.size() == 3)
      out += fmt::format("expansion = {}\n", toml_list(material.expansion));
    if (!region.system.empty()) out += fmt::format("system = {}\n", toml_text(region.system));
    for (const auto& [type, formulation] : region.formulation)
      out += integration(type, formulation);
    return out;
  }

  static std::string integration(CellType type, Formulation formulation) {
    const bool linear_hex = type == CellType::kHex8;
    if (formulation == Formulation::kDefault) return "";
    if (linear_hex && formulation == Formulation::kReduced)
      return "hex8 = \"incompatible\"  # the deck has one point and hourglass control\n";
    if (linear_hex || type == CellType::kHex20 || type == CellType::kWedge6 ||
        type == CellType::kWedge15)
      return fmt::format("{} = \"{}\"\n", traits(type).name,
                         formulation == Formulation::kFull      ? "full"
                         : formulation == Formulation::kReduced ? "reduced"
                         : formulation == Formulation::kFine    ? "fine"
                                                                : "incompatible");
    return "";
  }

  void points() {
    for (const Point& point : deck_.points) {
      if (point.of_bolt || point.left_out) continue;
      put("\n[[point]]\nname = \"point_{0}\"\nat = {1}\nnumber = {0}\n", point.id,
          toml_list(numbers(point.at)));
    }
    for (const auto& [name, set] : names_.points_on_nodes())
      put("\n[[point]]\nname = {}\nnode_set = {}\n", toml_text(name), toml_text(set));
  }

  std::string reference(NodeIndex node_index) {
    return names_.is_point(node_index) ? names_.point(node_index)
                                       : names_.point_on_node(node_index);
  }

  void put_nodes(const std::vector<NodeIndex>& node_indices, const std::string& wish) {
    const NamedNodes named = names_.node_indices(node_indices, wish);
    if (!named.node_set.empty()) put("node_set = {}\n", toml_text(named.node_set));
    if (!named.points.empty()) put("points = [\"{}\"]\n", fmt::join(named.points, "\", \""));
  }

  void couplings() {
    for (const Rigid& rigid : deck_.rigid) {
      put("\n[[coupling]]\nname = {}\ntype = \"rigid\"\npoint = \"{}\"\ndirections = {}\n",
          toml_text(rigid.name), reference(rigid.reference), toml_directions(rigid.dofs));
      put_nodes(rigid.dependents, rigid.name);
    }
    for (const Distributing& one : deck_.distributing) {
      put("\n[[coupling]]\nname = {}\npoint = \"{}\"\ndirections = {}\n", toml_text(one.name),
          reference(one.reference), toml_directions(one.dofs));
      if (!one.surface.empty()) put("surface = {}\n", toml_text(one.surface));
      for (const Distributing::Term& term : one.terms) {
        put("[[coupling.term]]\nweight = {}\ndirections = {}\n", term.weight,
            toml_directions(term.dofs));
        put_nodes(term.node_indices, one.name);
      }
    }
  }

  void add_tie(const Tie& tie) {
    put("\n[[tie]]\nname = {}\nslave = {}\nmaster = {}\n", toml_text(tie.name),
        toml_text(tie.slave), toml_text(tie.master));
    if (tie.distance >= 0.0) put("distance = {}\n", tie.distance);
  }

  std::string terms_text(const std::vector<Equation::Term>& all, bool with_coefficients = true) {
    constexpr const char* kNames[6] = {"x", "y", "z", "rx", "ry", "rz"};
    std::vector<std::string> terms;
    for (const Equation::Term& term : all) {
      const bool turns = term.direction >= 3 && !names_.is_point(term.node_index);
      const std::string target =
          names_.is_point(term.node_index) || turns
              ? fmt::format("point = \"{}\"", reference(term.node_index))
              : fmt::format("node_set = {}", toml_text(names_.node(term.node_index)));
      terms.push_back(fmt::format(
          "  {{ {}, direction = \"{}\"{} }}", target, kNames[term.direction],
          with_coefficients ? fmt::format(", coefficient = {}", term.coefficient) : ""));
    }
    return fmt::format("terms = [\n{},\n]\n", fmt::join(terms, ",\n"));
  }

  void add_spring(const Spring& spring) {
    put("\n[[spring]]  # {}\nstiffness = {}\n{}", spring.where, spring.stiffness,
        terms_text(spring.terms));
  }

  /// True for a node that no [[nodes]] can keep along x y z: a rigid coupling or an equation moves
  /// it, or it is retained along other axes.
  bool is_dependent(NodeIndex index) {
    if (dependent_.empty()) {
      dependent_.resize(static_cast<size_t>(deck_.mesh.nodes.rows()) + deck_.points.size(), false);
      for (const Rigid& rigid : deck_.rigid)
        for (const NodeIndex one : rigid.dependents) dependent_[one] = true;
      for (const Support& retained : deck_.retained)
        for (const NodeIndex one : retained.node_indices)
          if (!retained.system.empty()) dependent_[one] = true;
      for (const Equation& equation : deck_.equations)
        if (!equation.terms.empty()) dependent_[equation.terms[0].node_index] = true;
    }
    return dependent_[index];
  }

  void add_matrix(const NodalMatrix& matrix) {
    std::vector<std::string> rows;
    for (Eigen::Index i = 0; i < matrix.values.rows(); ++i) {
      std::vector<double> row;
      for (Eigen::Index j = 0; j <= i; ++j) row.push_back(matrix.values(i, j));
      rows.push_back(fmt::format("  {}", fmt::join(row, ", ")));
    }
    put("\n[[matrix]]  # {}\nname = {}\n{}{} = [\n{},\n]\n", matrix.where, toml_text(matrix.name),
        terms_text(matrix.terms, false), matrix.is_mass ? "M" : "K", fmt::join(rows, ",\n"));
  }

  void masses() {
    for (const Mass& mass : deck_.masses) {
      if (mass.mass == 0.0 && mass.inertia.isZero(0.0)) continue;
      const bool plain = mass.inertia.isZero(0.0) && mass.offset.isZero(0.0);
      std::string on;
      if (names_.is_point(mass.node_index) || !plain || is_dependent(mass.node_index)) {
        on = reference(mass.node_index);
      } else {
        const std::string set = names_.node(mass.node_index);
        on = "mass_" + set;
        put("\n[[nodes]]\nname = {}\nnode_set = {}\n", toml_text(on), toml_text(set));
      }
      const Eigen::Matrix3d& J = mass.inertia;
      put("\n[[point_mass]]\non = {}\nmass = {}\n", toml_text(on), mass.mass);
      if (!J.isZero(0.0))
        put("inertia = {}\n", toml_list({J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(1, 2), J(2, 0)}));
      if (!mass.offset.isZero(0.0)) put("offset = {}\n", toml_list(numbers(mass.offset)));
    }
  }

  /// The set of all DoFs that a condensation retains.
  void retained() {
    if (deck_.retained.empty()) return;
    put("\n[[nodes]]  # boundary = [\"retained\"] of clatter-condense\nname = \"retained\"\n");
    for (const Support& set : deck_.retained) {
      std::vector<NodeIndex> nodes, points;
      for (const NodeIndex index : set.node_indices)
        (names_.is_point(index) ? points : nodes).push_back(index);
      for (const auto& [some, mask] :
           {std::pair(nodes, static_cast<DofMask>(set.dofs & kTranslations)),
            std::pair(points, set.dofs)}) {
        if (some.empty() || mask == 0) continue;
        put("[[nodes.term]]\n");
        put_nodes(some, "retained");
        put("directions = {}\n", toml_directions(mask));
        if (!set.system.empty()) put("system = {}\n", toml_text(set.system));
      }
    }
  }

  Deck& deck_;
  RecipeNames names_;
  std::vector<bool> dependent_;  // by node and point; empty until it is needed
  std::string text_;
};

}  // namespace

std::string recipe_text(Deck& deck) { return RecipeWriter(deck).write(); }

}  // namespace clatter::mesh::deck
