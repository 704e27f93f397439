// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The keys of a fe.toml, table by table. Their checks need the mesh, so that each recipe that is
// read has keys of its own. recipe_model.cpp, recipe_couplings.cpp, recipe_sets.cpp,
// recipe_heat.cpp and recipe_loads.cpp each define some tables.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/recipe/matrix_files.hpp"
#include "assembly/recipe/point_table.hpp"
#include "assembly/recipe/recipe_names.hpp"

namespace clatter::assembly {

/// [material.NAME] and its regions.
struct RegionMaterial {
  fe::MaterialTable material;
  std::vector<std::string> regions;
};

/// Selections and points of a coupling or node set, also of each of its terms.
struct MemberTable {
  Selection selection;
  std::vector<std::string> points;
  double weight = 1.0;
  std::vector<int> directions;  // empty: those of the table above
  std::string system;           // of the directions; [[nodes]] only
  fe::Axes axes;                // it
};

/// Its rows of nodes and points.
template <class Rows>
void member_rows(Rows& key, MemberTable& members) {
  key.text("surface", members.selection.surface, "a surface of the mesh");
  key.text("node_set", members.selection.node_set, "or a set of nodes of the mesh")
      .excludes("surface");
  key.texts("points", members.points, "names of [[point]] tables, in addition");
}

/// Its row of [[nodes]].
template <class Rows>
void system_row(Rows& key, MemberTable& members) {
  key.text("system", members.system,
           "name of a [system] with the directions at each node; the basic frame without it");
}

struct CouplingTable {
  CouplingSpec spec;
  std::optional<int> dofs;
  MemberTable members;
  std::vector<MemberTable> terms;
};

struct TermTable {
  EquationSpec::Term term;
  std::optional<double> coefficient;
};

/// [[equation]], [[spring]], [[matrix]] with their [[.terms]].
template <class Spec>
struct WithTerms {
  Spec spec;
  std::vector<TermTable> terms;
  std::vector<double> K, M;  // of [[matrix]]
};

struct SectorTable {
  double centre = 0.0, half_width = 0.0;  // [rad]
  int strips = 1;
};

struct ContactTable {
  ContactSpec spec;
  std::vector<SectorTable> sectors;
  std::optional<std::pair<double, double>> axial;  // [m]
  int rows = 0;
};

struct NodesTable {
  NodeSpec spec;
  Eigen::Vector3d near = Eigen::Vector3d::Zero();
  MemberTable members;
  std::vector<MemberTable> terms;
};

struct MassTable {
  PointMassSpec spec;
  std::vector<double> inertia;
};

struct LoadTable {
  LoadSpec spec;
  double total = 1.0, scale = 1.0, reference = 0.0;
  double reference_temperature = 293.15;  // [K]
  std::optional<double> value;
  std::optional<Eigen::Vector3d> direction;
  std::vector<std::string> regions;
  std::map<std::string, double> rises;  // of regions [K]
  std::filesystem::path table;
  std::string system;
};

struct CaseTable {
  std::string name;
  std::map<std::string, double> factors;  // of loads
};

/// The whole file, before it is a Recipe.
struct RecipeTable {
  double metre = 1.0;
  std::map<std::string, fe::AxesTable> systems;
  std::map<std::string, RegionMaterial> materials;
  std::optional<MatrixFiles> matrix_files;  // which are read elsewhere
  fe::MassForm mass = fe::MassForm::kConsistent;
  DampingSpec damping;
  std::vector<PointSpec> points;
  std::vector<SupportSpec> supports;
  std::vector<CouplingTable> couplings;
  std::vector<WithTerms<EquationSpec>> equations;
  std::vector<WithTerms<SpringSpec>> springs;
  std::vector<WithTerms<MatrixSpec>> matrices;
  std::vector<StraightEdgesSpec> straight_edges;
  std::vector<TieSpec> ties, bolts;
  std::vector<ContactTable> contacts;
  std::vector<MeanSpec> means;
  std::vector<NodesTable> sensors, nodes;
  std::vector<MassTable> point_masses;
  std::vector<HeatSpec> heats;
  std::vector<LoadTable> loads;
  std::vector<CaseTable> cases;
};

class RecipeKeys {
 public:
  explicit RecipeKeys(const mesh::Mesh& mesh);
  RecipeKeys(const RecipeKeys&) = delete;
  RecipeKeys& operator=(const RecipeKeys&) = delete;

  const keys::Table& table() const { return file_.table(); }
  Recipe read(const Config& config);

 private:
  template <class S>
  using Keys = keys::Keys<S>;

  const Keys<RegionMaterial>& material_keys();
  const Keys<fe::MassForm>& mass_keys();
  const Keys<DampingSpec>& damping_keys();
  const Keys<PointSpec>& point_keys();
  const Keys<SupportSpec>& support_keys();
  /// @param turned their directions may be those of a system.
  const Keys<MemberTable>& member_keys(bool turned);
  const Keys<CouplingTable>& coupling_keys();
  const Keys<TermTable>& term_keys();
  const Keys<WithTerms<EquationSpec>>& equation_keys();
  const Keys<WithTerms<SpringSpec>>& spring_keys();
  const Keys<WithTerms<MatrixSpec>>& matrix_keys();
  const Keys<StraightEdgesSpec>& straight_edges_keys();
  const Keys<TieSpec>& tie_keys(bool bolt);
  const Keys<SectorTable>& sector_keys();
  const Keys<ContactTable>& contact_keys();
  const Keys<MeanSpec>& mean_keys();
  const Keys<NodesTable>& sensor_keys();
  const Keys<NodesTable>& nodes_keys();
  const Keys<MassTable>& point_mass_keys();
  const Keys<HeatSpec::Film>& film_keys();
  const Keys<HeatSpec::Flux>& flux_keys();
  const Keys<HeatSpec::Fixed>& fixed_keys();
  const Keys<HeatSpec::Source>& source_keys();
  const Keys<HeatSpec::Contact>& conductance_keys();
  const Keys<HeatSpec>& heat_keys();
  const Keys<LoadTable>& load_keys();
  const Keys<CaseTable>& case_keys();
  const Keys<RecipeTable>& file_keys();

  /// Keys that live as long as this.
  template <class S, class... Arguments>
  const Keys<S>& keep(Arguments&&... arguments) {
    const auto keys = std::make_shared<const Keys<S>>(std::forward<Arguments>(arguments)...);
    kept_.push_back(keys);
    return *keys;
  }

  void check_members(const Config& table, MemberTable& members) const;
  /// Members of a table and of its terms, as terms; `all`: directions without any.
  static std::vector<TermSpec> terms_of(const std::string& what, const MemberTable& own,
                                        const std::vector<MemberTable>& given,
                                        const std::vector<int>& all);
  void finish_coupling(const Config& table, CouplingTable& coupling);
  void finish_materials(const Config& config, const std::map<std::string, RegionMaterial>& given);
  void check_hanging(const Config& config, const RecipeTable& file) const;
  /// The columns of a file at the nodes of the mesh, or of the surface `on` (n_nodes rows, others
  /// 0); says how far these nodes are from the points, and how far the points are from linear fits.
  /// A table that is farther from the part than the part is large is refused.
  RowMatrix values_of_table(const Config& table, const std::filesystem::path& path,
                            const std::vector<TableColumn>& columns, const std::string& on);
  void read_film(const Config& table, HeatSpec::Film& film);
  void finish_load(const Config& table, LoadTable& load);
  void finish_temperature(const Config& table, LoadTable& load);
  Eigen::VectorXd rise_of_regions(const Config& table, const LoadTable& load) const;
  void check_field(const Config& table, const std::string& name, Eigen::Index columns) const;

  /// 1, 2, ... of tables of a kind.
  int next(const std::string& kind) { return ++count_[kind]; }

  RecipeNames names_;
  std::map<std::string, int> count_;
  std::vector<std::filesystem::path> files_;  // read in addition
  std::vector<fe::Material> materials_;       // of the regions

  std::vector<std::shared_ptr<const void>> kept_;
  const Keys<RecipeTable>& file_ = file_keys();
};

}  // namespace clatter::assembly
