// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bodies of a scene, their interface coordinates, force elements and loads.
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/modal_body.hpp"
#include "dynamics/force/element.hpp"

namespace clatter::dynamics {

/// A prescribed force: value(t) times a unit load on one body.
struct Load {
  std::string term;  // its name in the energy balance: "gas", "inertia frame"
  int body = 0;
  Eigen::VectorXd direction;            // modal, n_m of the body: shapes^T f_r of the unit load
  std::function<double(double)> value;  // of time [s]
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
  void add_element(std::unique_ptr<ForceElement> element);
  void add_load(Load load);

  const std::vector<ModalBody>& bodies() const { return bodies_; }
  const std::vector<Load>& loads() const { return loads_; }
  ForceElement& element(int index) { return *elements_[static_cast<size_t>(index)]; }
  const ForceElement& element(int index) const { return *elements_[static_cast<size_t>(index)]; }
  int elements() const { return static_cast<int>(elements_.size()); }
  const std::vector<ElementCost>& costs() const { return costs_; }
  int modes() const { return modes_; }                                    // N
  int interface_size() const { return static_cast<int>(owner_.size()); }  // n_y
  /// First modal coordinate of a body in eta.
  int mode_offset(int body) const { return offsets_[static_cast<size_t>(body)]; }
  /// Interface rows of a body (indices in y), and P of that body (rows x its modes).
  const std::vector<int>& rows(int body) const { return rows_[static_cast<size_t>(body)]; }
  const Eigen::MatrixXd& P(int body) const { return P_[static_cast<size_t>(body)]; }
  /// 1 where a y is a rotation.
  bool is_rotation(int y_index) const;
  /// "piston: coordinate 7", for messages.
  std::string coordinate_name(int y_index) const;

  // All bodies' modal constants, N each.
  const Eigen::VectorXd& omega_squared() const { return omega_squared_; }
  const Eigen::VectorXd& damping() const { return damping_; }
  const Eigen::VectorXd& inertia() const { return inertia_; }

  /// y = P eta; for displacements and velocities alike.
  Eigen::VectorXd interface(const Eigen::VectorXd& modal) const;
  /// g += P^T f_y.
  void add_interface_force(const Eigen::VectorXd& f_y, Eigen::VectorXd& g) const;
  /// Modal force of all loads at `time` (N).
  Eigen::VectorXd load_force(double time) const;

  /// Sums the elements' forces f (n_y) and, if requested, tangents (n_y x n_y) at a trial state.
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Eigen::VectorXd& f, Eigen::MatrixXd& tangent);
  void begin_step(double time);
  void finish_stage(const Stage& stage);
  void accept_step(double time);

 private:
  /// Where a coordinate is on its body.
  struct Place {
    int dof;                // of q, or -1: of the rigid frame
    int axis;               // k of the rigid frame
    Eigen::Vector3d point;  // of the rigid frame
    bool operator==(const Place&) const = default;
  };
  int find_or_add(int body, const Place& place);
  const Place& place_of(int y_index) const;

  std::vector<ModalBody> bodies_;
  std::vector<int> offsets_;
  std::vector<std::vector<int>> rows_;      // per body: y indices
  std::vector<std::vector<Place>> places_;  // per body, parallel to rows_
  std::vector<Eigen::MatrixXd> P_;
  std::vector<int> owner_;  // per y: body
  std::vector<std::unique_ptr<ForceElement>> elements_;
  std::vector<ElementCost> costs_;
  std::vector<Load> loads_;
  Eigen::VectorXd omega_squared_, damping_, inertia_;
  int modes_ = 0;
  Response response_;
};

/// Picks entries of a vector.
Eigen::VectorXd gather(const Eigen::VectorXd& all, const std::vector<int>& indices);

}  // namespace clatter::dynamics
