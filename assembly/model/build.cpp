// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/build.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "assembly/constraint/constrain.hpp"
#include "assembly/load/load_builder.hpp"
#include "assembly/load/mass_properties.hpp"
#include "assembly/load/point_mass.hpp"
#include "assembly/load/spring.hpp"
#include "assembly/model/certify.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/assemble.hpp"

namespace clatter::assembly {
namespace {

constexpr double kNoStiffness = 1e-13;  // of the largest diagonal entry of K: rounding
constexpr double kNoMass = 1e-13;       // least eigenvalue of a reference's scaled mass block

/// Builds the model step by step; the members are the data that the steps share.
class Builder {
 public:
  Builder(const mesh::Mesh& mesh, const Recipe& recipe, BuiltModel& out)
      : mesh_(mesh), recipe_(recipe), out_(out), surfaces_(mesh), numbers_(mesh.nodes, points_) {
    for (const PointSpec& spec : recipe.points) points_.push_back(spec.point);
  }

  void run(StepClock& clock);

 private:
  Eigen::MatrixXd momentum(const SparseMatrix& M) const;
  void take_coordinates();
  void take_supports(SupportBlocks& blocks);
  void add_point_masses();
  void check_points() const;
  void check_stiffness() const;

  const mesh::Mesh& mesh_;
  const Recipe& recipe_;
  BuiltModel& out_;
  SurfaceCache surfaces_;
  std::vector<ReferencePoint> points_;
  DofNumbers numbers_;
  Constrained constrained_;
};

/// M times unit accelerations, when a load needs it.
Eigen::MatrixXd Builder::momentum(const SparseMatrix& M) const {
  for (const LoadSpec& load : recipe_.loads)
    if (load.kind == LoadSpec::Kind::kGravity)
      return multiply_symmetric(M, Eigen::Matrix3d::Identity().replicate(mesh_.nodes.rows(), 1));
  return {};
}

/// The rows of T of nodes and points.
void Builder::take_coordinates() {
  fe::FeModel& model = out_.model;
  const Elimination& e = constrained_.elimination;
  model.sets = constrained_.sets;
  model.grids = constrained_.grids;
  model.rigid = constrained_.rigid;
  const Eigen::Index nodal = numbers_.nodal();
  const SparseMatrix t = e.T.transpose(), t_s = e.T_s.transpose();
  model.T = SparseMatrix(t.leftCols(nodal)).transpose();
  model.supports.T = SparseMatrix(t_s.leftCols(nodal)).transpose();
  if (points_.empty()) return;
  fe::FePoints& points = model.points;
  const auto count = static_cast<Eigen::Index>(points_.size());
  points.position.resize(count, 3);
  std::vector<Eigen::Triplet<double, int32_t>> pick;  // 6 p + d of the DoFs
  for (size_t p = 0; p < points_.size(); ++p) {
    points.names.push_back(points_[p].name);
    points.position.row(static_cast<Eigen::Index>(p)) = points_[p].position.transpose();
    for (int d = 0; d < 6; ++d)
      pick.emplace_back(static_cast<int32_t>(6 * p) + d,
                        numbers_.of_point(static_cast<int32_t>(p), d), 1.0);
  }
  SparseMatrix P(6 * count, numbers_.count());
  P.setFromTriplets(pick.begin(), pick.end());
  points.T = P * e.T;
  points.T_s = P * e.T_s;
}

void Builder::take_supports(SupportBlocks& blocks) {
  fe::FeSupports& supports = out_.model.supports;
  supports.K_sq.swap(blocks.sq);
  supports.K_ss.swap(blocks.ss);
  supports.rigid = constrained_.rigid_s;
  for (const SupportSpec& spec : recipe_.supports) supports.names.push_back(spec.name);
  const auto n = static_cast<Eigen::Index>(constrained_.held.size());
  supports.set.kind = "support";
  supports.set.position.resize(n, 3);
  supports.set.direction.resize(n, 3);
  for (Eigen::Index k = 0; k < n; ++k) {
    const HeldDof& held = constrained_.held[static_cast<size_t>(k)];
    supports.support.push_back(held.support);
    supports.set.dofs.push_back(static_cast<int32_t>(k));
    supports.set.labels.push_back(held.label);
    supports.set.position.row(k) = numbers_.position(held.owner).transpose();
    supports.set.direction.row(k) = held.direction.transpose();
    supports.set.is_rotation.push_back(held.is_rotation ? 1 : 0);
  }
}

/// On points through their rows of T, on sets directly: these are coordinates of the model.
void Builder::add_point_masses() {
  fe::FeModel& model = out_.model;
  MassMoments moments = integrate_mass(mesh_, recipe_.materials);
  for (const PointMassSpec& spec : recipe_.point_masses) {
    const auto point =
        std::find_if(points_.begin(), points_.end(),
                     [&](const ReferencePoint& other) { return other.name == spec.on; });
    if (point == points_.end()) {
      const rom::DofSet& set = model.set(spec.on);
      add_to_set(model.M, spec, set);
      add_moments(moments, spec, set);
    } else {
      add_to_point(model.M, spec, model.points.T, 6 * (point - points_.begin()));
      add_point(moments, spec.mass, point->position + spec.offset, spec.inertia);
    }
  }
  model.M.makeCompressed();
  model.mass = properties_of(moments);
}

/// A rigid body without elastic attachment moves freely: K is zero there, exactly so where its
/// cells belong to it alone. Otherwise elimination leaves rounding of either sign instead of
/// stiffness.
void Builder::check_stiffness() const {
  const fe::FeModel& model = out_.model;
  if (model.size() == 0) return;
  const Eigen::VectorXd diagonal = model.K.diagonal();
  const double length =
      (model.nodes.colwise().maxCoeff() - model.nodes.colwise().minCoeff()).norm();
  for (const auto& [name, set] : model.sets) {
    if (!has_rotations(set)) continue;
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      const double unit = set.is_rotation[k] != 0 ? length * length : 1.0;
      const double stiffness = diagonal(set.dofs[k]);
      if (stiffness == 0.0 || stiffness > kNoStiffness * unit * diagonal.maxCoeff()) continue;
      throw InputError(fmt::format(
          "{}: found no stiffness against {}: {} moves a rigid body without elastic attachment, "
          "expected supports of it or a coupling to deformable cells",
          mesh_.name, set.labels[k], name));
    }
  }
}

/// A reference node with a motion that moves nothing would make M singular. DoFs that only springs
/// hold have no mass: modal analysis excludes such coordinates.
void Builder::check_points() const {
  for (const auto& [name, set] : out_.model.sets) {
    if (!has_rotations(set)) continue;
    std::vector<int32_t> dofs = set.dofs;
    std::erase_if(dofs, [&](int32_t dof) { return out_.model.M.coeff(dof, dof) == 0.0; });
    const auto n = static_cast<Eigen::Index>(dofs.size());
    if (n == 0) continue;
    Eigen::MatrixXd block(n, n);
    for (Eigen::Index a = 0; a < n; ++a)
      for (Eigen::Index b = 0; b <= a; ++b) {
        const int32_t i = dofs[static_cast<size_t>(a)], j = dofs[static_cast<size_t>(b)];
        block(a, b) = block(b, a) = out_.model.M.coeff(std::max(i, j), std::min(i, j));
      }
    const Eigen::VectorXd scale = block.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
        scale.asDiagonal() * block * scale.asDiagonal(), Eigen::EigenvaluesOnly);
    if (!(eigen.eigenvalues()(0) > kNoMass))
      throw InputError(fmt::format(
          "{}: found a motion of {} that moves nothing (the coupled nodes lie on a line or at "
          "a point), expected supports for its rotations or a wider coupling",
          mesh_.name, name));
  }
}

void Builder::run(StepClock& clock) {
  fe::FeModel& model = out_.model;
  model.name = mesh_.name;
  model.nodes = mesh_.nodes;
  model.alpha = recipe_.damping.alpha;
  model.beta = recipe_.damping.beta;
  model.surfaces = mesh_.surfaces;
  model.cells = {mesh_.regions, recipe_.materials, mesh_.cells, mesh_.node_ids};

  constrained_ = constrain(mesh_, recipe_, numbers_, surfaces_);
  take_coordinates();
  clock.lap("couplings");
  const fe::NodePattern pattern = fe::node_pattern(mesh_);
  clock.lap("pattern");
  fe::NodalMatrices matrices =
      fe::assemble(mesh_, recipe_.materials, pattern, recipe_.mass, constrained_.rigid_of_node);
  clock.lap("assemble");
  const Eigen::MatrixXd body_force = momentum(matrices.M);
  SupportBlocks blocks;
  transform(matrices.K, constrained_.elimination, &blocks);
  transform(matrices.M, constrained_.elimination);
  add_springs(recipe_.springs, constrained_.springs, constrained_.elimination, matrices.K, blocks);
  // Swapped, since Eigen 3.4 copies on std::move.
  model.K.swap(matrices.K);
  model.M.swap(matrices.M);
  take_supports(blocks);
  clock.lap("transform");
  add_point_masses();
  check_points();
  check_stiffness();
  LoadBuilder(mesh_, recipe_, numbers_, constrained_, surfaces_, body_force).build(model);
  clock.lap("masses and loads");
  out_.certificate = certify(model, constrained_, recipe_.mass);
  clock.lap("certificate");
}

}  // namespace

BuiltModel build_fe_model(const mesh::Mesh& mesh, const Recipe& recipe, StepClock& clock) {
  BuiltModel built;
  Builder(mesh, recipe, built).run(clock);
  return built;
}

}  // namespace clatter::assembly
