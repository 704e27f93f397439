// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A System as a first-order system, for integrators that know nothing of bodies and elements.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "dynamics/chain/profile_contact.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::bench {

/// D x' = g(t, x), D > 0 diagonal, x = (eta, v): all modal coordinates and states (N), then the
/// velocities of those of second order:
///
///   eta' = v,    v' = phi^T f + loads - delta v - omega^2 eta,    delta z' = phi^T f  (states)
///
/// Forces are those of the elements, the Jacobian is from their tangents. A tangent is df/dy +
/// df/dv / kappa, so two evaluations, with kappa = 1 s and 2 s, give both parts.
///
/// Contacts of links with profiles have event functions if asked for: the gap of each outline,
/// negative where it touches. Nothing changes at these events.
///
/// InputError for bodies with quasi-static modes. Elements with internal states under the
/// integrator's tableau (the oil film) do not fit: they have no meaning outside of a step.
class FirstOrder {
 public:
  explicit FirstOrder(dynamics::System& system, bool events_of_contacts = false);

  int size() const { return static_cast<int>(D_.size()); }
  int modes() const { return system_->modes(); }
  const Eigen::VectorXd& D() const { return D_; }
  /// x of modal displacements and velocities, N each.
  Eigen::VectorXd state(const Eigen::VectorXd& eta, const Eigen::VectorXd& v) const;
  /// Modal velocities of x, N; 0 of states.
  Eigen::VectorXd velocities(const Eigen::VectorXd& x) const;
  /// g(t, x), n. Throws StepRefused.
  void evaluate(double time, const double* x, double* g);

  /// Pattern of dg/dx by columns, rows ascending, with its diagonal: n + 1 starts.
  const std::vector<int64_t>& starts() const { return starts_; }
  const std::vector<int64_t>& rows() const { return rows_; }
  /// Positions of the diagonal in the pattern, n.
  const std::vector<int64_t>& diagonal() const { return diagonal_; }
  /// Values of dg/dx in the order of the pattern. NumericsError when a force depends on the rate of
  /// a state. Throws StepRefused.
  void jacobian(double time, const double* x, double* values);

  /// Event functions of all elements, then those of contacts.
  int events() const { return own_events() + gaps_; }
  int own_events() const { return static_cast<int>(events_.size()); }
  void event_functions(double time, const double* x, double* values);
  /// An element's own event happens: it changes its mode, its impulse changes x. The side of zero
  /// to which the function then moves, 1 or -1.
  int pass_event(int event, double time, double* x);
  /// The side of zero on which an own event function is or, at a root, to which it moves.
  int side(int event, double time, const double* x);

 private:
  struct Block {  // the part of the Jacobian of an element, or of a group of its coordinates
    int element, group;
    std::vector<int> modes;             // on which it acts, ascending
    Eigen::MatrixXd P;                  // n_e x modes
    std::vector<int64_t> at_eta, at_v;  // positions in the pattern, modes x modes; -1: none
    Eigen::MatrixXd T_1, A, B, P_touched, product, by_eta, by_v;  // of the last Jacobian
  };
  struct EventFunction {
    int element, index;
  };
  Block block_of(int element, int group) const;
  void find_pattern();
  void set_state(const double* x);
  void add_block(Block& block, double* values) const;
  const Eigen::MatrixXd* tangent_of(const Block& block) const;
  int row_of(int mode) const;  // of the equation that has the force on this mode

  dynamics::System* system_;
  std::vector<int> v_at_;  // per mode: position of its velocity in x; -1: a state
  Eigen::VectorXd D_;
  std::vector<Block> blocks_;
  std::vector<int64_t> starts_, rows_, diagonal_;
  std::vector<int64_t> eta_of_v_, omega_at_, damping_at_;  // per mode, in the pattern
  std::vector<EventFunction> events_;
  std::vector<dynamics::ProfileContact*> contacts_;  // that have event functions
  int gaps_ = 0;                                     // event functions of contacts
  Eigen::VectorXd eta_, v_, y_, v_y_, f_, F_, y_contact_, v_contact_;
};

}  // namespace clatter::bench
