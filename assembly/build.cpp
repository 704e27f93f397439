#include "assembly/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "assembly/assemble.hpp"
#include "assembly/certify.hpp"
#include "assembly/elimination.hpp"
#include "assembly/load_case.hpp"
#include "assembly/mass_properties.hpp"
#include "core/error.hpp"
#include "core/log.hpp"

namespace clatter::assembly {
namespace {

/// Builds step by step; the members are what the steps hand on.
class Builder {
 public:
  Builder(const mesh::Mesh& mesh, const Recipe& recipe, BuiltModel& out)
      : mesh_(mesh), recipe_(recipe), out_(out) {}

  void run(StepClock& clock);

 private:
  const SurfaceIntegrals& surface(const std::string& name);
  std::vector<int32_t> nodes_at(const Place& place) const;
  void find_fixed();
  void place_node_sets();
  void add_couplings();
  void add_generalised(const std::string& name, const Coupling& coupling, const std::string& where);
  void number_node_sets();
  void add_point_masses();
  void add_loads(const Eigen::MatrixXd& momentum);
  Eigen::VectorXd load_vector(const LoadSpec& load, const Eigen::MatrixXd& momentum);
  Eigen::MatrixXd nodal_rigid() const;
  Eigen::MatrixXd reduced_rigid(const Eigen::MatrixXd& nodal) const;

  const mesh::Mesh& mesh_;
  const Recipe& recipe_;
  BuiltModel& out_;
  std::map<std::string, SurfaceIntegrals> surfaces_;
  std::vector<int32_t> fixed_, kept_;
  std::vector<std::vector<int32_t>> set_nodes_;  // like recipe_.nodes
  std::vector<Functional> functionals_;          // rows of C, by generalised coordinate
  std::vector<std::string> generalised_sets_;    // sets whose dofs are running numbers so far
  std::unique_ptr<Eliminator> eliminator_;
  Elimination elimination_;
  MassMoments moments_;
};

const SurfaceIntegrals& Builder::surface(const std::string& name) {
  auto found = surfaces_.find(name);
  if (found == surfaces_.end())
    found = surfaces_.emplace(name, integrate_surface(mesh_.nodes, mesh_.surface(name))).first;
  return found->second;
}

std::vector<int32_t> Builder::nodes_at(const Place& place) const {
  return place.surface.empty() ? mesh_.node_set(place.node_set)
                               : mesh::nodes_of(mesh_.surface(place.surface));
}

void Builder::find_fixed() {
  for (const SupportSpec& support : recipe_.supports)
    for (const int32_t node : nodes_at(support.place))
      for (const int direction : support.directions) fixed_.push_back(3 * node + direction);
  std::sort(fixed_.begin(), fixed_.end());
  fixed_.erase(std::unique(fixed_.begin(), fixed_.end()), fixed_.end());
}

/// Sensors take the nearest node of their surface. All these displacements stay coordinates.
void Builder::place_node_sets() {
  for (const NodeSpec& spec : recipe_.nodes) {
    std::vector<int32_t> nodes = nodes_at(spec.place);
    if (spec.near) {
      const auto distance = [&](int32_t node) {
        return (mesh_.nodes.row(node).transpose() - *spec.near).norm();
      };
      const int32_t nearest =
          *std::min_element(nodes.begin(), nodes.end(),
                            [&](int32_t a, int32_t b) { return distance(a) < distance(b); });
      nodes = {nearest};
      say(fmt::format("{}: node {} at ({:.4f}, {:.4f}, {:.4f}) m, {:.4f} m from the wanted place",
                      spec.name, nearest, mesh_.nodes(nearest, 0), mesh_.nodes(nearest, 1),
                      mesh_.nodes(nearest, 2), distance(nearest)));
    }
    for (const int32_t node : nodes) {
      for (int d = 0; d < 3; ++d) {
        kept_.push_back(3 * node + d);
        if (std::binary_search(fixed_.begin(), fixed_.end(), kept_.back()))
          throw InputError(fmt::format("{}: found node {} held by a support, expected a free one",
                                       spec.place.where, node));
      }
    }
    set_nodes_.push_back(std::move(nodes));
  }
}

/// The set's dofs are running numbers of generalised coordinates until the elimination ends.
void Builder::add_generalised(const std::string& name, const Coupling& coupling,
                              const std::string& where) {
  const int first = eliminator_->add(coupling, where);
  DofSet set = coupling.set;
  for (size_t k = 0; k < coupling.rows.size(); ++k)
    set.dofs.push_back(first + static_cast<int32_t>(k));
  const std::vector<Functional> rows = coupling.nodal_rows();
  functionals_.insert(functionals_.end(), coupling.means.begin(), coupling.means.end());
  functionals_.insert(functionals_.end(), rows.begin(), rows.end());
  generalised_sets_.push_back(name);
  out_.model.sets[name] = std::move(set);
}

void Builder::add_couplings() {
  eliminator_ = std::make_unique<Eliminator>(3 * mesh_.nodes.rows(), fixed_, kept_);
  for (const CouplingSpec& spec : recipe_.couplings)
    add_generalised(spec.name,
                    distributing_coupling(spec.name, spec.kind, mesh_.nodes, surface(spec.surface),
                                          spec.point, spec.dofs, spec.where),
                    spec.where);
  for (const ContactSpec& spec : recipe_.contacts) {
    const PatchCoupling patches =
        contact_patches(spec.name, mesh_.nodes, surface(spec.surface), spec.grid, spec.where);
    add_generalised(spec.name, patches.coupling, spec.where);
    out_.model.grids[spec.name] = patches.grid;
    say(fmt::format("{}: {} strips x {} rows on radius {:.5f} m, {} to {} nodes a patch", spec.name,
                    patches.grid.angle.size(), patches.grid.axial.size(), patches.grid.radius,
                    patches.nodes_per_patch.minCoeff(), patches.nodes_per_patch.maxCoeff()));
  }
  for (const MeanSpec& spec : recipe_.means)
    add_generalised(spec.name,
                    mean_displacement(spec.name, mesh_.nodes, surface(spec.surface), spec.direction,
                                      spec.range, spec.where),
                    spec.where);
  elimination_ = eliminator_->finish();
  for (const std::string& name : generalised_sets_)
    for (int32_t& dof : out_.model.sets[name].dofs)
      dof = elimination_.reduced_of[static_cast<size_t>(3 * mesh_.nodes.rows() + dof)];
}

void Builder::number_node_sets() {
  for (size_t s = 0; s < recipe_.nodes.size(); ++s) {
    const NodeSpec& spec = recipe_.nodes[s];
    const std::vector<int32_t>& nodes = set_nodes_[s];
    DofSet set;
    set.kind = spec.kind;
    const auto rows = 3 * static_cast<Eigen::Index>(nodes.size());
    set.position.resize(rows, 3);
    set.direction =
        Eigen::Matrix3d::Identity().replicate(static_cast<Eigen::Index>(nodes.size()), 1);
    set.is_rotation.assign(static_cast<size_t>(rows), 0);
    for (Eigen::Index r = 0; r < rows; ++r) {
      const int32_t node = nodes[static_cast<size_t>(r / 3)];
      set.dofs.push_back(elimination_.reduced_of[static_cast<size_t>(3 * node + r % 3)]);
      set.position.row(r) = mesh_.nodes.row(node);
      const char axis = "xyz"[r % 3];
      set.labels.push_back(nodes.size() == 1 ? fmt::format("{}.{}", spec.name, axis)
                                             : fmt::format("{}[{}].{}", spec.name, r / 3, axis));
    }
    out_.model.sets[spec.name] = std::move(set);
  }
}

/// Nodes and reference nodes are coordinates of the model, so point masses enter it directly.
void Builder::add_point_masses() {
  for (const PointMassSpec& spec : recipe_.point_masses) {
    const DofSet& set = out_.model.sets.at(spec.on);
    const bool turns = set.dofs.size() == 6 && set.is_rotation[3] != 0;
    if (set.kind == "contact_grid" || set.kind == "mean")
      throw InputError(fmt::format("{}: found a set of kind {}, expected a coupling or nodes",
                                   spec.where, set.kind));
    if (!turns && !spec.inertia.isZero(0.0))
      throw InputError(
          fmt::format("{}: found an inertia on a set without rotations, expected a "
                      "coupling with dofs = 6",
                      spec.where));
    const auto places = static_cast<double>(turns ? 1 : set.dofs.size() / 3);
    for (size_t k = 0; k < set.dofs.size(); ++k) {
      if (set.is_rotation[k] != 0) continue;
      out_.model.M.coeffRef(set.dofs[k], set.dofs[k]) += spec.mass / places;
      if (k % 3 == 0)
        add_point(moments_, spec.mass / places,
                  set.position.row(static_cast<Eigen::Index>(k)).transpose(), spec.inertia);
    }
    for (int a = 0; turns && a < 3; ++a)
      for (int b = 0; b <= a; ++b)
        out_.model.M.coeffRef(set.dofs[static_cast<size_t>(3 + a)],
                              set.dofs[static_cast<size_t>(3 + b)]) += spec.inertia(a, b);
  }
  out_.model.M.makeCompressed();
}

Eigen::VectorXd Builder::load_vector(const LoadSpec& load, const Eigen::MatrixXd& momentum) {
  const SparseMatrix& T = out_.model.T;
  switch (load.kind) {
    case LoadSpec::Kind::kPressure:
      return T.transpose() * pressure_load(mesh_.nodes.rows(), surface(load.surface));
    case LoadSpec::Kind::kResultant:
      return T.transpose() * resultant_load(mesh_.nodes.rows(), surface(load.surface), load.force);
    case LoadSpec::Kind::kForce:
      return set_load(T.cols(), out_.model.sets.at(load.set), load.force, load.moment, load.where);
    case LoadSpec::Kind::kGravity:
      break;
  }
  Eigen::VectorXd force = T.transpose() * Eigen::VectorXd(momentum * load.force);
  for (const PointMassSpec& spec : recipe_.point_masses)
    force += set_load(T.cols(), out_.model.sets.at(spec.on), spec.mass * load.force,
                      Eigen::Vector3d::Zero(), load.where);
  return force;
}

void Builder::add_loads(const Eigen::MatrixXd& momentum) {
  for (const LoadSpec& load : recipe_.loads) {
    Eigen::VectorXd force = load_vector(load, momentum);
    const Eigen::VectorXd resultant = out_.model.rigid.transpose() * force;
    say(fmt::format("load {}: resultant ({:.5g}, {:.5g}, {:.5g}) N a unit of {}", load.name,
                    resultant(0), resultant(1), resultant(2), load.unit));
    out_.model.loads[load.name] = std::move(force);
    out_.model.load_units[load.name] = load.unit;
  }
}

/// Unit rigid motions of all nodes; supported displacements stay zero.
Eigen::MatrixXd Builder::nodal_rigid() const {
  Eigen::MatrixXd rigid(3 * mesh_.nodes.rows(), 6);
  for (Eigen::Index a = 0; a < mesh_.nodes.rows(); ++a)
    rigid.middleRows<3>(3 * a) = rigid_motion(mesh_.nodes.row(a).transpose());
  for (const int32_t dof : fixed_) rigid.row(dof).setZero();
  return rigid;
}

Eigen::MatrixXd Builder::reduced_rigid(const Eigen::MatrixXd& nodal) const {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(elimination_.size(), 6);
  const auto reduced = [this](Eigen::Index id) {
    return elimination_.reduced_of[static_cast<size_t>(id)];
  };
  for (Eigen::Index dof = 0; dof < nodal.rows(); ++dof)
    if (reduced(dof) >= 0) rigid.row(reduced(dof)) = nodal.row(dof);
  for (size_t g = 0; g < functionals_.size(); ++g) {
    const int32_t row = reduced(nodal.rows() + static_cast<Eigen::Index>(g));
    if (row < 0) continue;
    for (size_t k = 0; k < functionals_[g].dofs.size(); ++k)
      rigid.row(row) += functionals_[g].values[k] * nodal.row(functionals_[g].dofs[k]);
  }
  return rigid;
}

void Builder::run(StepClock& clock) {
  FeModel& model = out_.model;
  model.name = mesh_.name;
  model.nodes = mesh_.nodes;
  model.alpha = recipe_.damping.alpha;
  model.beta = recipe_.damping.beta;
  model.surfaces = mesh_.surfaces;

  const NodePattern pattern = node_pattern(mesh_);
  clock.lap("pattern");
  NodalMatrices matrices = assemble(mesh_, recipe_.materials, pattern);
  clock.lap("assemble");
  find_fixed();
  place_node_sets();
  add_couplings();
  number_node_sets();
  clock.lap("couplings");
  const Eigen::MatrixXd nodal = nodal_rigid();
  model.rigid = reduced_rigid(nodal);
  Eigen::MatrixXd momentum;  // M times unit accelerations, needed for gravity only
  for (const LoadSpec& load : recipe_.loads)
    if (load.kind == LoadSpec::Kind::kGravity && momentum.size() == 0)
      momentum = multiply_symmetric(matrices.M,
                                    Eigen::Matrix3d::Identity().replicate(mesh_.nodes.rows(), 1));
  transform(matrices.K, elimination_);
  transform(matrices.M, elimination_);
  // Swapped, since Eigen 3.4 copies where std::move is asked for.
  model.K.swap(matrices.K);
  model.M.swap(matrices.M);
  model.T.swap(elimination_.T);
  clock.lap("transform");
  moments_ = integrate_mass(mesh_, recipe_.materials);
  add_point_masses();
  model.mass = properties_of(moments_);
  add_loads(momentum);
  clock.lap("masses and loads");
  out_.certificate = certify(model, nodal, elimination_, static_cast<int>(fixed_.size()));
  clock.lap("certificate");
}

}  // namespace

BuiltModel build_fe_model(const mesh::Mesh& mesh, const Recipe& recipe, StepClock& clock) {
  BuiltModel built;
  Builder(mesh, recipe, built).run(clock);
  return built;
}

}  // namespace clatter::assembly
