// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/build.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "assembly/constraint/constrain.hpp"
#include "assembly/constraint/gasket.hpp"
#include "assembly/heat/solve_heat.hpp"
#include "assembly/load/load_vectors.hpp"
#include "assembly/load/mass_properties.hpp"
#include "assembly/load/nodal_matrix.hpp"
#include "assembly/load/point_mass.hpp"
#include "assembly/load/spring.hpp"
#include "assembly/load/surface_mass.hpp"
#include "assembly/model/cell_terms.hpp"
#include "assembly/model/certify.hpp"
#include "assembly/model/check.hpp"
#include "assembly/model/part_terms.hpp"
#include "core/base/named.hpp"
#include "core/fe/assemble_shells.hpp"
#include "core/rom/rigid_mass.hpp"

namespace clatter::assembly {
namespace {

/// The contents of a matrix without a copy: Eigen 3.4 copies on std::move.
SparseMatrix taken(SparseMatrix& from) {
  SparseMatrix to;
  to.swap(from);
  return to;
}

std::vector<ReferencePoint> reference_points(const Recipe& recipe) {
  std::vector<ReferencePoint> points;
  for (const PointSpec& spec : recipe.points) points.push_back(spec.point);
  return points;
}

/// Coordinates of reduced parts that belong to no node.
int64_t own_coordinates(const Recipe& recipe) {
  int64_t count = 0;
  for (const PartSpec& spec : recipe.parts)
    count += std::ranges::count_if(spec.coordinates,
                                   [](const PartCoordinate& one) { return one.own >= 0; });
  return count;
}

/// Some rows of a transformation.
SparseMatrix rows_of(const SparseMatrix& T, Eigen::Index first, Eigen::Index count) {
  const SparseMatrix t = T.transpose();
  return SparseMatrix(t.middleCols(first, count)).transpose();
}

/// Those of the displacements of nodes.
SparseMatrix nodal_rows(const SparseMatrix& T, Eigen::Index nodal) { return rows_of(T, 0, nodal); }

/// Those of the rotations of nodes.
fe::FeRotations rotations_of(const DofNumbers& numbers, const Elimination& elimination) {
  const auto first = static_cast<Eigen::Index>(numbers.first_rotation());
  const auto count = static_cast<Eigen::Index>(numbers.first_own()) - first;
  return {numbers.turning(), rows_of(elimination.T, first, count),
          rows_of(elimination.T_s, first, count)};
}

/// The imaginary part of the stiffness, with springs and matrices between DoFs.
CoordinateBlocks loss_blocks(SparseMatrix loss, const PartData& part,
                             const Constrained& constrained) {
  const Recipe& recipe = part.recipe;
  std::vector<SpringSpec> springs = recipe.springs;
  for (SpringSpec& spring : springs) spring.stiffness *= spring.loss_factor;
  std::vector<MatrixSpec> matrices = recipe.matrices;
  for (MatrixSpec& matrix : matrices) matrix.values *= matrix.loss_factor;
  const auto any = [](const auto& list) {
    return std::ranges::any_of(list, [](const auto& one) { return one.loss_factor > 0.0; });
  };
  const bool between = any(springs) || any(matrices);
  if (loss.rows() == 0 && !between) return {};
  const auto size = static_cast<Eigen::Index>(part.numbers.count());
  loss.conservativeResize(size, size);
  const Elimination& elimination = constrained.elimination;
  CoordinateBlocks lost = transform_with_supports(std::move(loss), elimination);
  if (!between) return lost;
  add_springs(springs, constrained.springs, elimination, lost);
  add_matrices(matrices, constrained.matrix_dofs, false, elimination, lost);
  return lost;
}

template <class Takes>
std::vector<bool> blocks_where(const mesh::Mesh& mesh, const Takes& takes) {
  std::vector<bool> blocks;
  for (const mesh::ShellBlock& block : mesh.shells) blocks.push_back(takes(block));
  return blocks;
}

SparseMatrix mass_of_shells(const PartData& part, fe::MassForm form,
                            const std::vector<bool>& blocks) {
  return fe::assemble_shells(part.mesh, part.recipe.materials, part.recipe.sections,
                             shell_ids(part.numbers, part.mesh.nodes.rows()), form, {}, blocks)
      .M;
}

/// M a of the sheets of each centrifugal load: shells, and surface masses where all rotate.
std::map<std::string, Eigen::VectorXd> rotation_of_sheets(const PartData& part,
                                                          const SparseMatrix& surface_mass) {
  std::map<std::string, Eigen::VectorXd> all;
  const mesh::Mesh& mesh = part.mesh;
  if (mesh.shells.empty() && surface_mass.rows() == 0) return all;
  Eigen::VectorXd arms = Eigen::VectorXd::Zero(part.numbers.count());
  for (const LoadSpec& load : part.recipe.loads) {
    if (load.kind != LoadSpec::Kind::kCentrifugal) continue;
    const std::vector<bool> rotating = blocks_where(mesh, [&](const mesh::ShellBlock& block) {
      return load.rotating.empty() || std::ranges::count(load.rotating, block.region) > 0;
    });
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
      arms.segment<3>(3 * a) = load.axis.arm(mesh.nodes.row(a).transpose());
    SparseMatrix M;
    if (std::ranges::count(rotating, true) > 0)
      M = mass_of_shells(part, fe::MassForm::kNodes, rotating);
    if (load.rotating.empty()) add(M, surface_mass);
    if (M.rows() > 0) all[load.name] = multiply_symmetric(M, arms);
  }
  return all;
}

/// Picks the rows 6 p + d of the points' DoFs: 6 n_points x n_dofs.
SparseMatrix point_rows(const DofNumbers& numbers) {
  const auto count = static_cast<int32_t>(numbers.points().size());
  std::vector<Eigen::Triplet<double, int32_t>> pick;
  for (int32_t p = 0; p < count; ++p)
    for (int d = 0; d < 6; ++d) pick.emplace_back(6 * p + d, numbers.of_point(p, d), 1.0);
  SparseMatrix P(6 * count, numbers.count());
  P.setFromTriplets(pick.begin(), pick.end());
  return P;
}

/// The points with their rows of the transformations.
fe::FePoints points_of(const DofNumbers& numbers, const Elimination& elimination) {
  if (numbers.points().empty()) return {};
  const SparseMatrix P = point_rows(numbers);
  fe::FePoints points{.names = {},
                      .position = RowMatrix(numbers.points().size(), 3),
                      .T = P * elimination.T,
                      .T_s = P * elimination.T_s};
  for (const ReferencePoint& point : numbers.points()) {
    points.position.row(static_cast<Eigen::Index>(points.names.size())) =
        point.position.transpose();
    points.names.push_back(point.name);
  }
  return points;
}

/// The closures of gaskets by the coordinates of the model.
std::vector<fe::FeGasket> on_coordinates(std::vector<fe::FeGasket> gaskets,
                                         const Elimination& elimination) {
  for (fe::FeGasket& gasket : gaskets) {
    gasket.closing_s = gasket.closing * elimination.T_s;
    gasket.closing = SparseMatrix(gasket.closing * elimination.T);
  }
  return gaskets;
}

/// M times unit accelerations of all nodes (3 columns), when a load needs it.
Eigen::MatrixXd momentum_of(const SparseMatrix& M, const PartData& part) {
  if (std::ranges::none_of(part.recipe.loads, &LoadSpec::is_uniform_acceleration)) return {};
  Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(M.rows(), 3);
  unit.topRows(part.numbers.nodal()) =
      Eigen::Matrix3d::Identity().replicate(part.mesh.nodes.rows(), 1);
  for (const PartSpec& spec : part.recipe.parts)
    for (size_t j = 0; j < spec.coordinates.size(); ++j)
      if (const int32_t own = spec.coordinates[j].own; own >= 0)
        unit.row(part.numbers.first_own() + own) =
            spec.model.rigid.row(static_cast<Eigen::Index>(j)).head<3>();
  return multiply_symmetric(M, unit);
}

/// A field of accelerations holds at the centres of quad8 cells too, which in M move as their
/// equilibrium asks: the mass of the nodes' shape functions less that in M.
SparseMatrix mass_of_fields_beside(const PartData& part) {
  const std::vector<bool> quad8 = blocks_where(part.mesh, [](const mesh::ShellBlock& block) {
    return block.type == mesh::FaceType::kQuad8;
  });
  if (std::ranges::count(quad8, true) == 0) return {};
  return mass_of_shells(part, fe::MassForm::kNodes, quad8) -
         mass_of_shells(part, part.recipe.mass, quad8);
}

/// M a of each load with a field of accelerations.
std::map<std::string, Eigen::VectorXd> momenta_of_fields(const SparseMatrix& M,
                                                         const PartData& part) {
  std::map<std::string, Eigen::VectorXd> momenta;
  SparseMatrix beside;
  for (const LoadSpec& load : part.recipe.loads) {
    if (load.kind != LoadSpec::Kind::kAcceleration || load.field.empty()) continue;
    if (momenta.empty()) beside = mass_of_fields_beside(part);
    const RowMatrix& field = part.mesh.fields.at(load.field);
    Eigen::VectorXd a = Eigen::VectorXd::Zero(M.rows());
    a.head(field.size()) = load.amount * field.reshaped<Eigen::RowMajor>();
    Eigen::VectorXd momentum = multiply_symmetric(M, a);
    if (beside.rows() > 0) momentum += multiply_symmetric(beside, a);
    momenta[load.name] = std::move(momentum);
  }
  return momenta;
}

/// Labels, positions and directions of the supported coordinates.
rom::DofSet support_set(const std::vector<HeldDof>& held, const DofNumbers& numbers) {
  rom::DofSet set;
  set.kind = "support";
  const auto n = static_cast<Eigen::Index>(held.size());
  set.position.resize(n, 3);
  set.direction.resize(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const HeldDof& one = held[k];
    set.dofs.push_back(static_cast<int32_t>(k));
    set.labels.push_back(one.label);
    set.position.row(k) = numbers.position(one.owner).transpose();
    set.direction.row(k) = one.direction.transpose();
    set.is_rotation.push_back(one.is_rotation ? 1 : 0);
  }
  return set;
}

/// The supported coordinates. @param K, M blocks sq, and ss of K, are taken.
fe::FeSupports supports_of(const PartData& part, const Constrained& constrained,
                           CoordinateBlocks& K, CoordinateBlocks& M) {
  std::vector<std::string> names;
  for (const SupportSpec& spec : part.recipe.supports) names.push_back(spec.name);
  std::vector<int32_t> support;
  for (const HeldDof& held : constrained.held) support.push_back(held.support);
  return {.names = std::move(names),
          .support = std::move(support),
          .set = support_set(constrained.held, part.numbers),
          .T = nodal_rows(constrained.elimination.T_s, part.numbers.nodal()),
          .K_sq = taken(K.sq),
          .K_ss = taken(K.ss),
          .M_sq = taken(M.sq),
          .rigid = constrained.rigid_s};
}

/// Index of the point that a [[point_mass]] is on, or -1 for one on a set.
Eigen::Index point_of(const DofNumbers& numbers, const PointMassSpec& spec) {
  const std::vector<ReferencePoint>& points = numbers.points();
  const auto found = std::find_if(points.begin(), points.end(), [&](const ReferencePoint& other) {
    return other.name == spec.on;
  });
  return found == points.end() ? -1 : found - points.begin();
}

/// The mass of the cells. Its blocks with supported coordinates have no rows without supports.
CoordinateBlocks mass_blocks(SparseMatrix&& nodal, const Elimination& elimination) {
  if (elimination.supports() > 0) return transform_with_supports(std::move(nodal), elimination);
  CoordinateBlocks M;
  M.qq = transform(std::move(nodal), elimination);
  M.sq.resize(0, elimination.size());
  return M;
}

/// Adds the point masses: on points through their rows of T and T_s, on sets directly, since these
/// are coordinates of the model.
/// @param M blocks qq and sq of the cells.
void add_point_masses(CoordinateBlocks& M, const PartData& part, const Constrained& constrained,
                      const fe::FePoints& points) {
  for (const PointMassSpec& spec : part.recipe.point_masses) {
    const Eigen::Index point = point_of(part.numbers, spec);
    if (point < 0) {
      add_to_set(M.qq, spec, find_named(constrained.sets, part.mesh.name, "set", spec.on));
    } else {
      add_to_point(M.qq, spec, points.T, 6 * point);
      if (M.sq.rows() > 0) add_between(M.sq, spec, points.T_s, points.T, 6 * point);
    }
  }
  M.qq.makeCompressed();
}

/// Of the cells, reduced parts, masses of points and surfaces, and mass matrices.
rom::MassProperties mass_of(const PartData& part, const Constrained& constrained) {
  MassMoments moments = integrate_mass(part.mesh, part.recipe.materials);
  add_shells(moments, part.mesh, part.recipe.materials, part.recipe.sections);
  add_parts(moments, part);
  for (const PointMassSpec& spec : part.recipe.point_masses) {
    const Eigen::Index point = point_of(part.numbers, spec);
    if (point < 0) {
      add_moments(moments, spec, constrained.sets.at(spec.on));
    } else {
      const Eigen::Vector3d& position = part.numbers.points()[point].position;
      add_point(moments, spec.mass, position + spec.offset, spec.inertia);
    }
  }
  add_surfaces(moments, part);
  const auto matrices =
      rigid_mass_of(part.recipe, part.mesh, part.numbers, constrained.nodal_rigid);
  if (matrices.topLeftCorner<3, 3>().trace() > 0.0) {
    const rom::MassProperties added = rom::properties_of(matrices, Eigen::Vector3d::Zero());
    add_point(moments, added.mass, added.centre, added.inertia);
  }
  return properties_of(moments);
}

}  // namespace

BuiltModel build_fe_model(const mesh::Mesh& mesh, const Recipe& recipe, StepClock& clock) {
  const std::vector<ReferencePoint> references = reference_points(recipe);
  const DofNumbers numbers(mesh.nodes, references, mesh::turning_nodes(mesh),
                           own_coordinates(recipe));
  SurfaceCache surfaces(mesh);
  const PartData part{mesh, recipe, numbers, surfaces};

  const Constrained constrained = constrain(part);
  const Elimination& elimination = constrained.elimination;
  SparseMatrix T = nodal_rows(elimination.T, numbers.nodal());
  fe::FePoints points = points_of(numbers, elimination);
  clock.lap("couplings");
  const fe::NodePattern pattern = fe::node_pattern(mesh);
  clock.lap("pattern");
  fe::NodalMatrices nodal = cell_matrices(part, constrained, pattern);
  SparseMatrix loss = loss_of_cells(part, constrained, pattern);
  if (recipe.prestress) add_prestress(part, pattern, nodal.K);
  if (!recipe.parts.empty()) {
    const PartMatrices parts = part_matrices(part);
    add(nodal.K, parts.K);
    add(nodal.M, parts.M);
    add(loss, parts.loss);
  }
  const SparseMatrix surface_mass = surface_mass_matrix(part);
  add(nodal.M, surface_mass);
  std::vector<fe::FeGasket> curves;
  if (!recipe.gaskets.empty()) {
    GasketStiffness gaskets = gasket_stiffness(part);
    add(nodal.K, gaskets.K);
    add(loss, gaskets.loss);
    curves = on_coordinates(std::move(gaskets.curves), elimination);
  }
  clock.lap("assemble");
  LoadInputs inputs{.momentum = momentum_of(nodal.M, part),
                    .of_fields = momenta_of_fields(nodal.M, part),
                    .of_sheets = rotation_of_sheets(part, surface_mass),
                    .heat = solve_heat(part, pattern)};
  if (!inputs.heat.empty()) clock.lap("heat");
  CoordinateBlocks K = transform_with_supports(std::move(nodal.K), elimination);
  CoordinateBlocks M = mass_blocks(std::move(nodal.M), elimination);
  CoordinateBlocks lost = loss_blocks(std::move(loss), part, constrained);
  add_springs(recipe.springs, constrained.springs, elimination, K);
  add_matrices(recipe.matrices, constrained.matrix_dofs, false, elimination, K);
  add_matrices(recipe.matrices, constrained.matrix_dofs, true, elimination, M);
  clock.lap("transform");
  add_point_masses(M, part, constrained, points);
  const rom::MassProperties mass = mass_of(part, constrained);
  check_references(mesh.name, constrained.sets, M.qq);
  check_stiffness(mesh, constrained.sets, K.qq);
  LoadVectors loads = load_vectors(part, constrained, inputs);
  add_loads_of_parts(loads, part, elimination);
  clock.lap("masses and loads");

  BuiltModel built{
      .model = {.name = mesh.name,
                .M = taken(M.qq),
                .K = taken(K.qq),
                .loss = taken(lost.qq),
                .T = taken(T),
                .nodes = mesh.nodes,
                .rigid = constrained.rigid,
                .supports = supports_of(part, constrained, K, M),
                .points = {points.names, points.position, taken(points.T), taken(points.T_s)},
                .rotations = rotations_of(numbers, elimination),
                .alpha = recipe.damping.alpha,
                .beta = recipe.damping.beta,
                .sets = constrained.sets,
                .grids = constrained.grids,
                .loads = std::move(loads.forces),
                .support_loads = std::move(loads.support_forces),
                .prescribed = std::move(loads.prescribed),
                .temperature_rise = std::move(loads.temperature_rise),
                .heat = std::move(inputs.heat),
                .cases = recipe.cases,
                .gaskets = std::move(curves),
                .surfaces = mesh.surfaces,
                .cells = {mesh.regions, recipe.materials, mesh.cells, mesh.shells, recipe.sections,
                          mesh.node_ids},
                .mass = mass,
                .deck = mesh.deck,
                .load_units = std::move(loads.units)},
      .certificate = {}};
  add_skins(built.model, part, elimination);
  built.certificate = certify(built.model, constrained, recipe);
  clock.lap("certificate");
  return built;
}

}  // namespace clatter::assembly
