#include "assembly/recipe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace clatter::assembly {
namespace {

constexpr double kRadian = std::numbers::pi / 180.0;

template <typename Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

/// What all tables share: the mesh, the length unit, the names in use.
class Reader {
 public:
  Reader(const Config& config, const mesh::Mesh& mesh) : config_(config), mesh_(mesh) {
    metre_ = config.choice("length_unit", {"m", "mm"}) == "mm" ? 1e-3 : 1.0;
  }

  Recipe read();

 private:
  [[noreturn]] void fail_unknown(const Config& table, std::string_view key,
                                 const std::string& found,
                                 const std::vector<std::string>& present) const {
    table.fail(key,
               fmt::format("found \"{}\", expected one of: {}", found, fmt::join(present, ", ")));
  }
  std::string where(const Config& table, const std::string& what) const {
    return fmt::format("{}: {}", table.where(), what);
  }
  Eigen::Vector3d vector(const Config& table, std::string_view key) const {
    return Eigen::Vector3d(table.numbers(key, 3).data());
  }
  Eigen::Vector3d point(const Config& table, std::string_view key) const {
    return metre_ * vector(table, key);
  }
  Eigen::Vector3d unit_vector(const Config& table, std::string_view key) const {
    const Eigen::Vector3d v = vector(table, key);
    if (!(v.norm() > 0.0)) table.fail(key, "found the zero vector, expected a direction");
    return v.normalized();
  }
  std::optional<std::pair<double, double>> range(const Config& table, std::string_view key) const;
  std::string surface(const Config& table) const;
  Place place(const Config& table, const std::string& what) const;
  std::string new_set(const Config& table);
  std::string known_set(const Config& table, std::string_view key) const;

  void materials(Recipe& recipe) const;
  void damping(Recipe& recipe) const;
  void supports(Recipe& recipe) const;
  void couplings(Recipe& recipe);
  void contacts(Recipe& recipe);
  std::vector<Sector> sectors(const Config& table) const;
  Eigen::VectorXd axial_edges(const Config& table) const;
  void means(Recipe& recipe);
  void nodes(Recipe& recipe);
  void point_masses(Recipe& recipe) const;
  void loads(Recipe& recipe) const;
  LoadSpec load(const Config& table) const;

  const Config& config_;
  const mesh::Mesh& mesh_;
  double metre_ = 1.0;
  std::set<std::string> sets_;
};

std::optional<std::pair<double, double>> Reader::range(const Config& table,
                                                       std::string_view key) const {
  if (!table.has(key)) return std::nullopt;
  const std::vector<double> ends = table.numbers(key, 2);
  if (!(ends[0] < ends[1]))
    table.fail(key, fmt::format("found [{:g}, {:g}], expected ascending", ends[0], ends[1]));
  return std::pair{metre_ * ends[0], metre_ * ends[1]};
}

std::string Reader::surface(const Config& table) const {
  const std::string name = table.text("surface");
  if (!mesh_.surfaces.contains(name))
    fail_unknown(table, "surface", name, names_of(mesh_.surfaces));
  if (mesh_.surfaces.at(name).face_count() == 0)
    table.fail("surface", fmt::format("found \"{}\" without faces, expected some", name));
  return name;
}

Place Reader::place(const Config& table, const std::string& what) const {
  Place place;
  place.where = where(table, what);
  if (table.has("surface")) {
    if (table.has("node_set")) table.fail("node_set", "found a surface as well, expected one");
    place.surface = surface(table);
    return place;
  }
  place.node_set = table.text("node_set");
  if (!mesh_.node_sets.contains(place.node_set))
    fail_unknown(table, "node_set", place.node_set, names_of(mesh_.node_sets));
  if (mesh_.node_sets.at(place.node_set).empty())
    table.fail("node_set",
               fmt::format("found \"{}\" without nodes, expected some", place.node_set));
  return place;
}

std::string Reader::new_set(const Config& table) {
  const std::string name = table.text("name");
  if (name.empty() || name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without '/'", name));
  if (!sets_.insert(name).second)
    table.fail("name", fmt::format("found \"{}\" twice, expected different names", name));
  return name;
}

std::string Reader::known_set(const Config& table, std::string_view key) const {
  const std::string name = table.text(key);
  if (!sets_.contains(name)) fail_unknown(table, key, name, {sets_.begin(), sets_.end()});
  return name;
}

void Reader::materials(Recipe& recipe) const {
  const Config all = config_.table("material");
  std::vector<bool> given(mesh_.regions.size(), false);
  recipe.materials.resize(mesh_.regions.size());
  for (const std::string& name : all.keys()) {
    const Config table = all.table(name);
    const Material material = read_material(table);
    for (const std::string& region : table.texts("regions")) {
      const auto found = std::find(mesh_.regions.begin(), mesh_.regions.end(), region);
      if (found == mesh_.regions.end()) fail_unknown(table, "regions", region, mesh_.regions);
      const auto index = static_cast<size_t>(found - mesh_.regions.begin());
      if (given[index])
        table.fail("regions", fmt::format("found \"{}\" in two materials, expected one", region));
      given[index] = true;
      recipe.materials[index] = material;
    }
  }
  for (size_t r = 0; r < given.size(); ++r)
    if (!given[r])
      config_.fail("material",
                   fmt::format("found none for region \"{}\", expected one for each of: {}",
                               mesh_.regions[r], fmt::join(mesh_.regions, ", ")));
}

/// zeta = alpha w / 2 + beta / (2 w): `ratio` at `at_hz` gives alpha for the beta beside it.
void Reader::damping(Recipe& recipe) const {
  const auto table = config_.find_table("damping");
  if (!table) return;
  recipe.damping.beta = table->number_or("beta", 0.0, Range::not_negative());
  if (!table->has("ratio")) {
    recipe.damping.alpha = table->number_or("alpha", 0.0, Range::not_negative());
    return;
  }
  if (table->has("alpha")) table->fail("alpha", "found ratio as well, expected one of them");
  const double ratio = table->number("ratio", Range::not_negative());
  const double omega = 2.0 * std::numbers::pi * table->number("at_hz", Range::positive());
  recipe.damping.alpha = (2.0 * ratio - recipe.damping.beta / omega) / omega;
  if (recipe.damping.alpha < 0.0)
    table->fail("ratio",
                fmt::format("found {:g}, but beta alone gives more, expected at least {:g}", ratio,
                            0.5 * recipe.damping.beta / omega));
}

void Reader::supports(Recipe& recipe) const {
  for (const Config& table : config_.tables("support")) {
    SupportSpec spec;
    spec.place = place(table, "support");
    const std::string axes = table.text_or("directions", "xyz");
    spec.directions.clear();
    for (const char axis : axes) {
      if (axis < 'x' || axis > 'z')
        table.fail("directions", fmt::format("found \"{}\", expected letters of xyz", axes));
      spec.directions.push_back(axis - 'x');
    }
    recipe.supports.push_back(spec);
  }
}

void Reader::couplings(Recipe& recipe) {
  for (const Config& table : config_.tables("coupling")) {
    CouplingSpec spec;
    spec.name = new_set(table);
    spec.where = where(table, "coupling " + spec.name);
    spec.kind = table.choice("kind", {"node", "bearing", "mount"});
    spec.surface = surface(table);
    if (table.has("point")) spec.point = point(table, "point");
    spec.dofs = static_cast<int>(table.integer_or("dofs", 6));
    if (spec.dofs != 6 && spec.dofs != 3)
      table.fail("dofs", fmt::format("found {}, expected 6 or 3", spec.dofs));
    recipe.couplings.push_back(spec);
  }
}

std::vector<Sector> Reader::sectors(const Config& table) const {
  std::vector<Sector> sectors;
  for (const Config& part : table.tables("sector")) {
    const double centre = kRadian * part.number("centre_deg", {-360.0, 360.0});
    const double half = kRadian * part.number("half_width_deg", {0.0, 180.0, true});
    const auto strips = static_cast<int>(part.integer("strips", {1.0, 1000.0}));
    sectors.push_back({centre - half, centre + half, strips});
  }
  if (sectors.empty()) table.fail("sector", "found none, expected at least one [[contact.sector]]");
  std::sort(sectors.begin(), sectors.end(),
            [](const Sector& a, const Sector& b) { return a.begin < b.begin; });
  // The last sector must also end before the first one comes round again.
  for (size_t i = 0; i < sectors.size(); ++i) {
    const bool last = i + 1 == sectors.size();
    const double next =
        last ? sectors.front().begin + 2.0 * std::numbers::pi : sectors[i + 1].begin;
    if (sectors[i].end > next + 1e-9)
      table.fail("sector", "found sectors that overlap, expected separate ones");
  }
  return sectors;
}

Eigen::VectorXd Reader::axial_edges(const Config& table) const {
  const auto ends = range(table, "axial");
  if (!ends) table.fail("axial", "not found, expected [lower, upper] from axis_point");
  const auto rows = static_cast<Eigen::Index>(table.integer("rows", {1.0, 1000.0}));
  return Eigen::VectorXd::LinSpaced(rows + 1, ends->first, ends->second);
}

void Reader::contacts(Recipe& recipe) {
  for (const Config& table : config_.tables("contact")) {
    ContactSpec spec;
    spec.name = new_set(table);
    spec.where = where(table, "contact " + spec.name);
    spec.surface = surface(table);
    spec.grid.axis_point = point(table, "axis_point");
    spec.grid.axis = unit_vector(table, "axis");
    const Eigen::Vector3d zero = unit_vector(table, "zero_angle");
    const Eigen::Vector3d across = zero - zero.dot(spec.grid.axis) * spec.grid.axis;
    if (across.norm() < 1e-6) table.fail("zero_angle", "found the axis, expected one across it");
    spec.grid.zero_angle = across.normalized();
    spec.grid.sectors = sectors(table);
    spec.grid.axial_edges = axial_edges(table);
    recipe.contacts.push_back(spec);
  }
}

void Reader::means(Recipe& recipe) {
  for (const Config& table : config_.tables("mean")) {
    MeanSpec spec;
    spec.name = new_set(table);
    spec.where = where(table, "mean " + spec.name);
    spec.surface = surface(table);
    spec.direction = unit_vector(table, "direction");
    spec.range = range(table, "range");
    recipe.means.push_back(spec);
  }
}

void Reader::nodes(Recipe& recipe) {
  for (const Config& table : config_.tables("sensor")) {
    NodeSpec spec{new_set(table), "sensor", {}, {}};
    spec.place.where = where(table, "sensor " + spec.name);
    spec.place.surface = surface(table);
    spec.near = point(table, "near");
    recipe.nodes.push_back(spec);
  }
  for (const Config& table : config_.tables("nodes")) {
    NodeSpec spec{new_set(table), "node", {}, {}};
    spec.place = place(table, "nodes " + spec.name);
    recipe.nodes.push_back(spec);
  }
}

void Reader::point_masses(Recipe& recipe) const {
  for (const Config& table : config_.tables("point_mass")) {
    PointMassSpec spec;
    spec.on = known_set(table, "on");
    spec.where = where(table, "point_mass on " + spec.on);
    spec.mass = table.number("mass", Range::positive());
    const std::vector<double> J = table.numbers_or("inertia", {0.0, 0.0, 0.0});
    if (J.size() != 3 && J.size() != 6)
      table.fail("inertia", fmt::format("found {} numbers, expected 3 (xx, yy, zz) or 6 (and the "
                                        "tensor's xy, yz, zx)",
                                        J.size()));
    spec.inertia.diagonal() << J[0], J[1], J[2];
    if (J.size() == 6) {
      spec.inertia(0, 1) = spec.inertia(1, 0) = J[3];
      spec.inertia(1, 2) = spec.inertia(2, 1) = J[4];
      spec.inertia(2, 0) = spec.inertia(0, 2) = J[5];
    }
    // No body has an inertia whose second moments tr(J)/2 I - J are negative.
    const Eigen::Vector3d moments =
        Eigen::Vector3d::Constant(0.5 * spec.inertia.trace()) - spec.inertia.diagonal();
    if (moments.minCoeff() < -1e-12 * spec.inertia.trace() ||
        spec.inertia.diagonal().minCoeff() < 0)
      table.fail("inertia", fmt::format("found [{:g}, {:g}, {:g}, ...], expected numbers of a body "
                                        "(each at most the sum of the other two)",
                                        J[0], J[1], J[2]));
    recipe.point_masses.push_back(spec);
  }
}

LoadSpec Reader::load(const Config& table) const {
  LoadSpec spec;
  spec.name = table.text("name");
  if (spec.name.empty() || spec.name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without '/'", spec.name));
  spec.where = where(table, "load " + spec.name);
  const std::string kind = table.choice("kind", {"pressure", "resultant", "force", "gravity"});
  if (kind == "pressure") {
    spec.surface = surface(table);
    spec.unit = "Pa";
  } else if (kind == "resultant") {
    spec.kind = LoadSpec::Kind::kResultant;
    spec.surface = surface(table);
    spec.force = table.number_or("total", 1.0) * unit_vector(table, "direction");
    spec.unit = table.text_or("unit", "N");
  } else if (kind == "force") {
    spec.kind = LoadSpec::Kind::kForce;
    spec.set = known_set(table, "set");
    if (table.has("force")) spec.force = vector(table, "force");
    if (table.has("moment")) spec.moment = vector(table, "moment");
    if (spec.force.isZero(0.0) && spec.moment.isZero(0.0))
      table.fail("force", "found neither a force [N] nor a moment [N m], expected one");
    spec.unit = table.text_or("unit", "1");
  } else {
    spec.kind = LoadSpec::Kind::kGravity;
    spec.force = unit_vector(table, "direction");
    spec.unit = "m/s2";
  }
  return spec;
}

void Reader::loads(Recipe& recipe) const {
  std::set<std::string> names;
  for (const Config& table : config_.tables("load")) {
    recipe.loads.push_back(load(table));
    if (!names.insert(recipe.loads.back().name).second)
      table.fail("name", fmt::format("found \"{}\" twice, expected different names",
                                     recipe.loads.back().name));
  }
}

Recipe Reader::read() {
  Recipe recipe;
  materials(recipe);
  damping(recipe);
  supports(recipe);
  couplings(recipe);
  contacts(recipe);
  means(recipe);
  nodes(recipe);
  point_masses(recipe);
  loads(recipe);
  config_.finish();
  return recipe;
}

}  // namespace

Recipe read_recipe(const Config& config, const mesh::Mesh& mesh) {
  return Reader(config, mesh).read();
}

}  // namespace clatter::assembly
