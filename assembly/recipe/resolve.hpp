// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A fe.toml on its mesh, table by table: names are looked up and values checked that need the mesh.
// resolve_shells.cpp, resolve_beams.cpp, resolve_joints.cpp, resolve_sets.cpp, resolve_heat.cpp and
// resolve_loads.cpp each have some tables.
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/recipe/point_table.hpp"
#include "assembly/recipe/recipe_names.hpp"

namespace clatter::assembly {

class Resolver {
 public:
  explicit Resolver(const mesh::Mesh& mesh) : names_{mesh} {}
  /// @param parts of the file, attached to the mesh.
  Recipe resolve(const recipe::File& file, std::vector<PartSpec> parts);
  /// One for each region; InputError with the regions that have none.
  std::vector<fe::Material> materials(const recipe::File& file) const;

 private:
  using Source = keys::Source;

  /// Each table of a list by its function, which gets the number from 1.
  template <class Spec, class Table>
  std::vector<Spec> each(const std::vector<Table>& tables,
                         Spec (Resolver::*resolved)(const Table&, size_t)) {
    std::vector<Spec> specs;
    for (const Table& table : tables) specs.push_back((this->*resolved)(table, specs.size() + 1));
    return specs;
  }

  void name_parts(const std::vector<PartSpec>& parts);
  void name_materials(const recipe::File& file);
  const fe::Material& named_material(const Source& table, std::string_view key,
                                     const std::string& name) const;
  std::vector<fe::ShellSection> sections(const recipe::File& file) const;
  fe::ShellSection section(const recipe::Shell& shell) const;
  void check_sheet(const recipe::File& file, const mesh::ShellBlock& block,
                   const fe::ShellSection& section) const;
  void check_loads_of_parts(const recipe::File& file) const;
  void check_hanging(const recipe::File& file) const;
  fe::Prestress prestress(const recipe::Prestress& prestress, bool with_parts);
  PointSpec point(const recipe::Point& point, size_t number);
  SupportSpec support(const recipe::Support& support, size_t number);
  CouplingSpec coupling(const recipe::Coupling& coupling, size_t number);
  EquationSpec equation(const recipe::Equation& equation, size_t number);
  SpringSpec spring(const recipe::Spring& spring, size_t number);
  /// The stiffness and the mass of a beam between the points of `out`.
  void beam(const recipe::Beam& beam, size_t number, Recipe& out) const;
  MatrixSpec matrix(const recipe::Matrix& matrix, size_t number);
  StraightEdgesSpec straight_edges(const recipe::StraightEdges& edges, size_t number);
  TieSpec tie(const recipe::Tie& tie, size_t number);
  TieSpec bolt(const recipe::Tie& tie, size_t number);
  GasketSpec gasket(const recipe::Gasket& gasket, size_t number);
  ContactSpec contact(const recipe::Contact& contact, size_t number);
  MeanSpec mean(const recipe::Mean& mean, size_t number);
  NodeSpec sensor(const recipe::Sensor& sensor, size_t number);
  NodeSpec nodes(const recipe::Nodes& nodes, size_t number);
  PointMassSpec point_mass(const recipe::PointMass& mass, size_t number);
  SurfaceMassSpec surface_mass(const recipe::SurfaceMass& mass, size_t number);
  HeatSpec heat(const recipe::Heat& heat, size_t number);
  LoadSpec load(const recipe::Load& load, size_t number);

  /// Members of a table and of its terms; `all`: directions of those without any.
  std::vector<TermSpec> terms_of(const Source& table, const std::string& what,
                                 const recipe::Members& own,
                                 const std::vector<recipe::Members>& given,
                                 const std::vector<int>& all) const;
  /// The terms of an equation, spring or matrix, which is `what` in messages.
  std::vector<EquationSpec::Term> terms_of(const Source& table, const std::string& what,
                                           const std::vector<recipe::Term>& given) const;
  TieSpec tied(const recipe::Tie& tie, const std::string& name, const char* kind);
  /// The columns of a file at the nodes of the mesh, or of the surface `on` (n_nodes rows, others
  /// 0); says how far these nodes are from the points, and how far the points are from linear fits.
  /// A table that is farther from the part than the part is large is refused.
  RowMatrix values_of_table(const Source& table, const std::filesystem::path& path,
                            const std::vector<TableColumn>& columns, const std::string& on);
  HeatSpec::Film film(const recipe::Heat::Film& film);
  HeatSpec::Flux flux(const recipe::Heat::Flux& flux);
  HeatSpec::Source source(const recipe::Heat::HeatSource& source) const;
  void finish_temperature(LoadSpec& load);
  Eigen::VectorXd rise_of_regions(const LoadSpec& load) const;
  void check_field(const Source& table, const std::string& name, Eigen::Index columns) const;
  std::map<std::string, double> factors(const recipe::Case& sum) const;

  RecipeNames names_;
  double metre_ = 1.0;                        // of CSV files [m]
  std::vector<std::filesystem::path> files_;  // read in addition
  std::map<std::string, fe::Material> named_materials_;
  std::vector<fe::Material> materials_;     // of the regions
  std::vector<fe::ShellSection> sections_;  // likewise; of those with shells
};

}  // namespace clatter::assembly
