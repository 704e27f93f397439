// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bodies of a scene, their interface coordinates, force elements and loads.
#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/modal_body.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/integrate/stage_state.hpp"

namespace clatter::dynamics {

/// A prescribed force: value(t) times a unit load on one body.
struct Load {
  std::string term;  // its name in the energy balance: "gas", "inertia frame"
  int body = 0;
  Eigen::VectorXd direction;            // modal, n_m of the body: shapes^T f_r of the unit load
  std::function<double(double)> value;  // of time [s]
  /// The time of the first row of the load's table after a time [s]; infinity after the last one.
  /// Empty: there is no table.
  std::function<double(double)> next_row{};
};

/// A sum of DoFs of a body's q; a rotation, or a displacement.
struct WeightedDofs {
  std::vector<int> dofs;
  std::vector<double> weights;
  bool is_rotation = false;
  bool operator==(const WeightedDofs&) const = default;
};

/// Coordinates that are each a multiple of a mode of their own, y = scale * eta: those of rigid
/// bodies in a plane. Many bodies of three such rows each are handled in one loop.
struct SingleRows {
  std::vector<int> y, mode;  // mode: in eta
  std::vector<double> scale;
};

/// Computing time of an element.
struct ElementCost {
  std::string name;
  double seconds = 0.0;
  long long evaluations = 0;
};

/// Collects bodies, interface coordinates, elements and loads.
///
/// The modal coordinates of all bodies are concatenated in one vector eta (N). The interface
/// coordinates y = P eta (n_y) are numbered in the order in which they were requested; every row
/// belongs to one body.
class System {
 public:
  /// Returns the body's index.
  int add_body(ModalBody body);
  /// Index in y of coordinate `dof` of a body's q; the same index for the same DoF.
  int coordinate(int body, int dof);
  /// Index in y of a motion of a body's rigid frame (ModalBody::force_of): the displacement of
  /// `point` [m, in the part's frame] along axis k < 3, or the rotation about axis k - 3 in 3 to 5,
  /// where `point` has no meaning. A force on it has exactly that resultant.
  int frame_coordinate(int body, int k, const Eigen::Vector3d& point = Eigen::Vector3d::Zero());
  /// Index in y of a modal coordinate of a body, itself a coordinate on which elements act.
  int modal_coordinate(int body, int mode);
  /// Index in y of a sum of weighted DoFs of a body's q, such as the rigid motion that fits a
  /// surface best; the same index for the same sum.
  int combined_coordinate(int body, const WeightedDofs& sum);
  void add_element(std::unique_ptr<ForceElement> element);
  void add_load(Load load);

  const std::vector<ModalBody>& bodies() const { return bodies_; }
  const std::vector<Load>& loads() const { return loads_; }
  ForceElement& element(int index) { return *elements_[index].element; }
  const ForceElement& element(int index) const { return *elements_[index].element; }
  int elements() const { return static_cast<int>(elements_.size()); }
  std::vector<ElementCost> costs() const;
  int modes() const { return modes_; }                                    // N
  int interface_size() const { return static_cast<int>(owner_.size()); }  // n_y
  /// First modal coordinate of a body in eta.
  int mode_offset(int body) const { return parts_[body].offset; }
  /// The body of a y.
  int owner(int y_index) const { return owner_[y_index]; }
  /// Interface rows of a body (indices in y), and P of that body (rows x its modes).
  const std::vector<int>& rows(int body) const { return parts_[body].rows; }
  const Eigen::MatrixXd& P(int body) const { return parts_[body].P; }
  /// The rows of the bodies that have only such rows.
  const SingleRows& single_rows() const { return singles_; }
  bool has_single_rows(int body) const { return parts_[body].is_single; }
  /// 1 where a y is a rotation.
  bool is_rotation(int y_index) const;
  /// The modal coordinate that a y is; -1: it is a DoF.
  int mode_of(int y_index) const;
  /// "piston: coordinate 7", for messages.
  std::string coordinate_name(int y_index) const;

  // All bodies' modal constants, N each.
  const Eigen::VectorXd& omega_squared() const { return omega_squared_; }
  const Eigen::VectorXd& damping() const { return damping_; }
  const Eigen::VectorXd& inertia() const { return inertia_; }

  /// 1 for coordinates of second order, 0 for states, N.
  const Eigen::VectorXd& second_order() const { return second_order_; }
  /// The state at the start, N.
  const Eigen::VectorXd& eta_start() const { return eta_start_; }
  const Eigen::VectorXd& v_start() const { return v_start_; }
  /// The frames of the spatial bodies are at `time` as they were made; for the start of a run.
  void start_frames(double time) const;
  /// At the end of a step: the free rotations of the spatial bodies (spatial_frame.hpp) go on from
  /// `now`, and both ends of the step are written in the new local coordinates.
  void restart_frames(StageState& before, StageState& now) const;

  /// y = P eta; for displacements and velocities alike.
  void interface(const Eigen::VectorXd& modal, Eigen::VectorXd& y) const;
  Eigen::VectorXd interface(const Eigen::VectorXd& modal) const;
  /// The same for 2 or 4 vectors at once: P is read once.
  template <size_t kCount>
  void interface(const std::array<const Eigen::VectorXd*, kCount>& modal,
                 const std::array<Eigen::VectorXd*, kCount>& y) const;
  /// g += P^T f_y.
  void add_interface_force(const Eigen::VectorXd& f_y, Eigen::VectorXd& g) const;
  /// What impulses on interface coordinates, n_y, change at once: states take them as they are (an
  /// angular momentum), velocities by their inertia, the modes of a spatial body by the mass matrix
  /// that they share with its rotation. `eta`, `v`: the changes, N.
  void jump(const StageState& state, const Eigen::VectorXd& impulse, Eigen::VectorXd& eta,
            Eigen::VectorXd& v) const;
  /// Modal force of all loads at `time` (N).
  void load_force(double time, Eigen::VectorXd& g) const;

  /// Sums the elements' forces f (n_y) at a trial state and, if requested, updates their tangents.
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Eigen::VectorXd& f);
  /// T dy of one element with its last tangent, for its tangent rows; valid until the next call.
  const Eigen::VectorXd& tangent_forces(int element, const Eigen::VectorXd& dy) const;
  /// The y index of a tangent row of an element.
  int tangent_row(int element, Eigen::Index row) const;
  /// The y indices of each of an element's groups; one who has none is one group of all.
  const std::vector<std::vector<int>>& groups(int element) const {
    return elements_[element].groups;
  }
  bool has_groups(int element) const { return !this->element(element).groups().empty(); }
  /// f += T dy with the elements' last tangents.
  void add_tangent_forces(const Eigen::VectorXd& dy, Eigen::VectorXd& f) const;
  /// A stage ends with the forces f + T dy: adds T dy to f, and keeps each element's sum where
  /// keep_forces() asked for it.
  void pass_on(const Eigen::VectorXd& dy, Eigen::VectorXd& f);
  void keep_forces() { keeps_forces_ = true; }
  /// What an element passed on at the end of the last stage, n_e; empty before the first.
  const Eigen::VectorXd& passed_force(int element) const { return elements_[element].passed; }
  /// An element's last response.
  const Response& response(int element) const { return elements_[element].response; }
  /// Response::touched of an element when its last tangent was computed: the tangent's rows.
  const std::vector<int>& tangent_rows(int element) const {
    return elements_[element].tangent_rows;
  }
  void begin_step(double time);
  void finish_stage(const Stage& stage);
  void accept_step(double time);

 private:
  /// Where a coordinate is on its body.
  struct Place {
    int dof;                // of q; kFrame: of the rigid frame; kMode: a mode; kSum: a sum of DoFs
    int axis;               // k of the rigid frame, the mode, or the index in sums_
    Eigen::Vector3d point;  // of the rigid frame
    bool operator==(const Place&) const = default;
  };
  static constexpr int kFrame = -1, kMode = -2, kSum = -3;
  /// What a body has of the coordinates.
  struct BodyPart {
    int offset = 0;                // its first modal coordinate in eta
    Eigen::MatrixXd P;             // rows x its modes
    std::vector<int> rows;         // y indices
    std::vector<Place> places;     // parallel to rows
    bool is_single = true;         // it has single rows only
    mutable Eigen::VectorXd held;  // space for its rows: no step takes memory
  };
  /// An element and what is kept of it.
  struct ElementPart {
    std::unique_ptr<ForceElement> element;
    ElementCost cost;
    std::vector<std::vector<int>> groups;   // y indices
    Response response;                      // the last one
    std::vector<int> tangent_rows;          // Response::touched of the last tangent
    Eigen::VectorXd passed;                 // where forces are kept
    Eigen::VectorXd y, v;                   // its coordinates
    mutable Eigen::VectorXd moved, change;  // space for its tangent rows
  };
  int find_or_add(int body, const Place& place);
  void find_singles(int body);
  void add_block_forces(const ElementPart& part, const Eigen::VectorXd& dy) const;
  const Place& place_of(int y_index) const;

  std::vector<ModalBody> bodies_;
  std::vector<BodyPart> parts_;  // of the bodies
  std::vector<ElementPart> elements_;
  std::vector<Load> loads_;
  std::vector<int> owner_;  // per y: body
  std::vector<WeightedDofs> sums_;
  SingleRows singles_;
  Eigen::VectorXd omega_squared_, damping_, inertia_, second_order_, eta_start_, v_start_;
  int modes_ = 0;
  bool keeps_forces_ = false;
  mutable std::vector<double> row_sums_;  // space for one body's rows, for some vectors
};

/// all(indices) += values.
void scatter_add(const Eigen::VectorXd& values, const std::vector<int>& indices,
                 Eigen::VectorXd& all);
/// Picks entries of a vector.
void gather(const Eigen::VectorXd& all, const std::vector<int>& indices, Eigen::VectorXd& picked);
Eigen::VectorXd gather(const Eigen::VectorXd& all, const std::vector<int>& indices);

}  // namespace clatter::dynamics
