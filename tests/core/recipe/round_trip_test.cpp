// SPDX-License-Identifier: GPL-3.0-or-later
// What is written of a fe.toml reads back to the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "core/base/error.hpp"
#include "core/keys/keys.hpp"
#include "core/recipe/recipe.hpp"

namespace clatter::recipe {
namespace {

using ::testing::HasSubstr;

/// Random tables, each key given or not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  bool flip() { return engine_() % 2 == 0; }
  double number() { return std::ldexp(2.0 * unit() - 1.0, static_cast<int>(engine_() % 60) - 30); }
  double positive() { return std::abs(number()) + 1e-12; }
  Eigen::Vector3d vector() { return {number(), number(), number()}; }
  /// Reading gives it length 1: that of a unit vector along an axis is exact.
  Eigen::Vector3d direction() { return Eigen::Vector3d::Unit(engine_() % 3); }
  std::vector<double> numbers(size_t count) {
    std::vector<double> all(count);
    for (double& one : all) one = number();
    return all;
  }
  std::string name() {
    static const std::vector<std::string> kNames = {"a", "hub_2", "St 37.2", "\"x\" \\ y", "b\tc"};
    return kNames[engine_() % kNames.size()] + std::to_string(++count_);
  }
  std::vector<std::string> names() { return {name(), name()}; }
  template <class E>
  E one_of(std::initializer_list<E> all) {
    return *(all.begin() + engine_() % all.size());
  }
  std::vector<int> directions() {
    std::vector<int> all;
    for (int d = 0; d < 6; ++d)
      if (flip()) all.push_back(d);
    return all.empty() ? std::vector<int>{4} : all;
  }
  Selection selection(bool with_surface) {
    if (with_surface && flip()) return {.surface = name()};
    return flip() ? Selection{.node_set = name()} : Selection{.point = name()};
  }

 private:
  double unit() { return std::uniform_real_distribution<double>()(engine_); }
  std::mt19937 engine_;
  int count_ = 0;
};

Members random_members(Random& r, bool with_system) {
  Members out{
      .selection = r.flip() ? Selection{.surface = r.name()} : Selection{.node_set = r.name()},
      .points = r.names()};
  out.weight = r.positive();
  if (r.flip()) out.directions = r.directions();
  if (with_system && r.flip()) out.system = r.name();
  return out;
}

std::vector<Term> random_terms(Random& r) {
  std::vector<Term> terms(3);
  for (Term& term : terms) {
    term.selection = r.selection(false);
    term.direction = r.one_of({0, 1, 2, 3, 4, 5});
    if (r.flip()) term.coefficient = r.number();
  }
  return terms;
}

void add_materials(Random& r, File& file) {
  fe::AxesTable& axes = file.systems[r.name()];
  axes.axes.kind = r.one_of({fe::Axes::Kind::kRectangular, fe::Axes::Kind::kSpherical});
  axes.axes.origin = r.vector();
  axes.x = Eigen::Vector3d::UnitY();
  RegionMaterial& steel = file.materials[r.name()];
  steel.regions = r.names();
  steel.material.E = {r.positive()};
  steel.material.E_in_gpa = r.flip();
  steel.material.nu = {0.25 + 0.1 * r.flip()};
  steel.material.material.density = r.positive();
  steel.material.material.loss_factor = 0.01 * r.flip();
  steel.material.material.integration.hex20 =
      r.one_of({fe::Integration::kFull, fe::Integration::kReduced});
  if (r.flip()) steel.material.expansion = r.numbers(3);
  RegionMaterial& wood = file.materials[r.name()];
  wood.material.E = {3.0, 2.0, 2.5};
  wood.material.nu = {0.1, 0.05, 0.02};
  wood.material.G = {r.positive(), r.positive(), r.positive()};
  wood.material.material.density = r.positive();
  wood.material.system = r.name();
  file.mass.form = r.one_of({fe::MassForm::kConsistent, fe::MassForm::kHrz});
  file.damping = {{}, r.positive(), r.positive(), {}, {}};
}

void add_joints(Random& r, File& file) {
  file.points.push_back({.name = r.name(), .at = r.vector(), .number = 17});
  file.points.push_back({.name = r.name(), .node_set = r.name()});
  Support& support = file.supports.emplace_back();
  support.selection = r.selection(true);
  support.directions = r.directions();
  if (r.flip()) support.system = r.name();
  for (const bool rigid : {true, false}) {
    Coupling& coupling = file.couplings.emplace_back();
    coupling.name = r.name();
    coupling.rigid = rigid;
    if (r.flip())
      coupling.on_point = r.name();
    else if (r.flip())
      coupling.at = r.vector();
    coupling.members = random_members(r, false);
    coupling.members.weight = 1.0;
    coupling.members.directions.clear();
    coupling.directions = r.directions();
    if (!rigid) coupling.terms = {random_members(r, false), random_members(r, false)};
  }
  file.equations.push_back({{}, random_terms(r)});
  file.springs.push_back({{}, r.flip() ? r.name() : "", r.positive(), random_terms(r)});
  file.matrices.push_back({{}, r.name(), random_terms(r), r.numbers(6), {}});
  file.matrices.push_back({{}, "", random_terms(r), {}, r.numbers(6)});
  file.straight_edges.push_back({{}, r.name()});
  for (const bool keeps : {true, false}) {
    Part& part = file.parts.emplace_back();
    part.name = r.name();
    part.file = r.name() + ".rom.h5";
    part.keeps_names = keeps;
    if (r.flip()) part.system = r.name();
    part.mirror = r.one_of({Part::Mirror::kNone, Part::Mirror::kY});
  }
  Gasket& gasket = file.gaskets.emplace_back();
  gasket.name = r.name();
  gasket.slave = r.name();
  gasket.master = r.name();
  gasket.normal = r.positive();
  gasket.tangential = r.positive();
  gasket.loss_factor = 0.2 * r.flip();
  file.ties.push_back({{}, r.name(), r.name(), r.name(), {}});
  file.ties.push_back({{}, "", r.name(), r.name(), r.positive()});
  file.bolts.push_back({{}, r.name(), r.name(), r.name(), r.positive(), r.direction()});
}

void add_sets(Random& r, File& file) {
  Contact& contact = file.contacts.emplace_back();
  contact.name = r.name();
  contact.surface = r.name();
  contact.axis_point = r.vector();
  contact.axis = r.direction();
  contact.sectors = {{0.5, 0.25, 3}, {-0.7, 0.1, 1}};
  contact.axial = {-r.positive(), r.positive()};
  contact.rows = 5;
  file.means.push_back({{}, r.name(), r.name(), r.direction(), std::pair{0.0, r.positive()}});
  file.sensors.push_back({{}, r.name(), r.name(), r.vector()});
  Nodes& nodes = file.nodes.emplace_back();
  nodes.name = r.name();
  nodes.members.points = r.names();
  nodes.members.system = r.name();
  nodes.terms = {random_members(r, true)};
  file.point_masses.push_back(
      {{}, r.name(), r.positive(), r.vector(), r.numbers(r.flip() ? 3 : 6)});
  Heat& heat = file.heats.emplace_back();
  heat.name = r.name();
  heat.films = {{{}, r.name(), {r.positive()}, {300.0}, {}, {}},
                {{},
                 r.name(),
                 {1.0, r.positive()},
                 {350.0, 360.0},
                 {Eigen::Vector3d::UnitX(), {0.25, 0.5}},
                 {}}};
  heat.fluxes = {{{}, r.name(), {r.number()}, {}, {}}};
  heat.fixed = {{{}, {.node_set = r.name()}, 400.0}};
  heat.sources = {{{}, r.names(), r.number()}, {{}, {}, r.number()}};
  heat.contacts = {{{}, r.name(), r.positive()}};
}

void add_loads(Random& r, File& file) {
  using Kind = Load::Kind;
  const auto add = [&](Kind kind) -> Load& {
    Load& load = file.loads.emplace_back();
    load.name = r.name();
    load.kind = kind;
    if (r.flip()) load.unit = r.name();
    return load;
  };
  add(Kind::kPressure).selection.surface = r.name();
  Load& resultant = add(Kind::kResultant);
  resultant.selection.surface = r.name();
  resultant.direction = r.direction();
  resultant.total = r.number();
  Load& force = add(Kind::kForce);
  force.set = r.name();
  force.force = r.vector();
  if (r.flip()) force.moment = r.vector();
  add(Kind::kAcceleration).direction = r.direction();
  Load& accelerations = add(Kind::kAcceleration);
  accelerations.field = r.name();
  accelerations.scale = r.number();
  Load& rotation = add(Kind::kCentrifugal);
  rotation.axis = {r.vector(), r.direction()};
  if (r.flip()) rotation.regions = r.names();
  for (const std::vector<int>& directions : {std::vector{0, 2}, std::vector{3}}) {
    Load& moved = add(Kind::kDisplacement);
    moved.selection = r.selection(true);
    moved.directions = directions;
    moved.value = r.number();
    if (r.flip()) moved.system = r.name();
  }
  add(Kind::kNodal).field = r.name();
  add(Kind::kTemperature).value = r.number();
  add(Kind::kTemperature).rises = {{r.name(), r.number()}, {r.name(), r.number()}};
  Load& of_field = add(Kind::kTemperature);
  of_field.field = r.name();
  of_field.reference = r.number();
  Load& of_heat = add(Kind::kTemperature);
  of_heat.heat = r.name();
  of_heat.reference_temperature = 310.0;
  file.cases.push_back({.name = r.name(), .factors = {{r.name(), r.number()}, {"b", 0.0}}});
}

File random_file(unsigned seed, double metre) {
  Random r(seed);
  File file;
  file.metre = metre;
  add_materials(r, file);
  add_joints(r, file);
  add_sets(r, file);
  add_loads(r, file);
  return file;
}

File read(const std::string& text) { return file_keys().read(Config::parse(text, "a.fe.toml")); }

TEST(RecipeText, OfEveryTableReadsBackToTheSame) {
  for (unsigned seed = 0; seed < 50; ++seed)
    for (const double metre : {1.0, 1e-3}) {
      const File file = random_file(seed, metre);
      const std::string text = file_keys().text_of(file);
      const File again = read(text);
      ASSERT_EQ(file_keys().text_of(again), text);
      file_keys().check_ranges(again);
      // In SI to the last bit, in millimetres to rounding.
      const double rounding = metre == 1.0 ? 0.0 : 1e-14;
      ASSERT_EQ(again.springs[0].stiffness, file.springs[0].stiffness);
      ASSERT_EQ(again.matrices[0].K, file.matrices[0].K);
      ASSERT_EQ(again.springs[0].terms[1].coefficient, file.springs[0].terms[1].coefficient);
      ASSERT_EQ(again.loads[2].force, file.loads[2].force);
      ASSERT_TRUE(again.loads[5].axis.point.isApprox(file.loads[5].axis.point, rounding));
      ASSERT_TRUE(again.points[0].at->isApprox(*file.points[0].at, rounding));
      const double moved = *file.loads[6].value, turned = *file.loads[7].value;
      ASSERT_NEAR(*again.loads[6].value, moved, rounding * std::abs(moved));
      ASSERT_EQ(*again.loads[7].value, turned);
      ASSERT_NEAR(*again.ties[1].distance, *file.ties[1].distance,
                  rounding * *file.ties[1].distance);
      ASSERT_NEAR(again.contacts[0].sectors[0].centre, 0.5, 1e-15);
    }
}

TEST(RecipeText, LooksAsPeopleWriteIt) {
  File file;
  Equation& equation = file.equations.emplace_back();
  equation.source = Source("deck.bdf:12");
  equation.terms.resize(2);
  equation.terms[0].selection.point = "hub";
  equation.terms[0].coefficient = 1.5;
  equation.terms[1].selection.node_set = "rim";
  equation.terms[1].direction = 2;
  equation.terms[1].coefficient = -1.0;
  file.mass.form = fe::MassForm::kHrz;
  file.mass.source.remark("lumping", "lumped");
  Matrix& matrix = file.matrices.emplace_back();
  matrix.terms = {equation.terms[0], equation.terms[1]};
  for (Term& term : matrix.terms) term.coefficient.reset();
  matrix.K = {1.0, -0.5, 2.0};
  EXPECT_EQ(file_keys().text_of(file), R"(length_unit = "m"

[mass]
lumping = "hrz"  # lumped

[[equation]]  # deck.bdf:12
terms = [
  { point = "hub", direction = "x", coefficient = 1.5 },
  { node_set = "rim", direction = "z", coefficient = -1 },
]

[[matrix]]
terms = [
  { point = "hub", direction = "x" },
  { node_set = "rim", direction = "z" },
]
K = [
  1,
  -0.5, 2,
]
)");
}

std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

/// A text never hides what its reader refuses, and data in memory are refused as well.
TEST(RecipeText, OfANumberOutsideItsRangeIsRefused) {
  File file;
  file.points.push_back(
      {.source = Source("deck.inp:3"), .name = "p", .at = Eigen::Vector3d::Zero()});
  Coupling& coupling = file.couplings.emplace_back();
  coupling.source = Source("deck.inp:7");
  coupling.on_point = "p";
  coupling.terms.resize(1);
  coupling.terms[0].selection.node_set = "rim";
  coupling.terms[0].weight = -2.0;
  EXPECT_THAT(file_keys().text_of(file), HasSubstr("weight = -2\n"));
  EXPECT_EQ(refusal_of([&] { file_keys().check_ranges(file); }),
            "deck.inp:7: weight: found -2, expected a number above 0");
  coupling.terms.clear();
  file_keys().check_ranges(file);
  Spring& spring = file.springs.emplace_back();
  spring.source = Source("deck.inp:9");
  EXPECT_EQ(refusal_of([&] { file_keys().check_ranges(file); }),
            "deck.inp:9: stiffness: found 0, expected a number above 0");
  EXPECT_THAT(file_keys().text_of(file), HasSubstr("stiffness = 0\n"));
}

}  // namespace
}  // namespace clatter::recipe
