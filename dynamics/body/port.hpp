// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points and frames of bodies where forces act.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/given/drive.hpp"

namespace clatter::dynamics {

using Matrix6X = Eigen::Matrix<double, 6, Eigen::Dynamic>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A force [N] and a moment [N m], or the rates that go with them, in one vector.
inline Vector6 wrench(const Eigen::Vector3d& force, const Eigen::Vector3d& moment) {
  Vector6 both;
  both << force, moment;
  return both;
}

/// Motion of a port in the engine's axes and its derivatives by the n_p coordinates of the port.
/// Rows of the matrices: three of the position, three of a small rotation about it.
struct PortState {
  Eigen::Vector3d position, velocity;  // [m], [m/s]
  Eigen::Vector3d spin;                // angular velocity [rad/s]
  Eigen::Matrix3d rotation;            // from the body's axes to those of the engine
  Matrix6X by_y;                       // d(position, rotation)/dy
  Matrix6X rate_by_y, rate_by_v;       // d(velocity, spin)/dy, /dv
  Matrix6X work;                       // force on the coordinates = work^T (force, moment)
  Vector6 driven;                      // prescribed part of (velocity, spin): its drive's work

  /// Zero motion of a port with n coordinates.
  void clear(int n);
};

/// A point, with the axes of its body, at which elements apply force and moment.
class Port {
 public:
  virtual ~Port() = default;
  const std::vector<int>& coordinates() const { return coordinates_; }
  int size() const { return static_cast<int>(coordinates_.size()); }
  /// Writes all of `state`; `y`, `v`: n_p displacements and velocities (rates, for states).
  virtual void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                      PortState& state) = 0;
  /// It moves as prescribed: forces on it do work on what drives it.
  virtual bool is_driven() const { return false; }
  /// tangent += d(work^T wrench)/dy at the last motion(), of `y`, and a constant wrench (force,
  /// moment), n_p x n_p.
  virtual void add_curvature(const Eigen::VectorXd& /*y*/, const Vector6& /*wrench*/,
                             Eigen::Ref<Eigen::MatrixXd> /*tangent*/) {}

 protected:
  explicit Port(std::vector<int> coordinates) : coordinates_(std::move(coordinates)) {}
  std::vector<int> coordinates_;
};

/// A point at rest.
class GroundPort : public Port {
 public:
  explicit GroundPort(const Eigen::Vector3d& position) : Port({}), position_(position) {}
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;

 private:
  Eigen::Vector3d position_;
};

/// A node of a body with small motion: position + (x, y, z), with or without rotations.
class NodePort : public Port {
 public:
  /// @param position of the node at rest [m]. @param coordinates y indices of x, y, z and, for a
  /// node that rotates, rx, ry, rz.
  NodePort(const Eigen::Vector3d& position, std::vector<int> coordinates);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  const Eigen::Vector3d& place() const { return position_; }

 private:
  Eigen::Vector3d position_;
};

/// A point of a shaft that a drive turns in a bearing on the ground or on a body with small motion.
///
/// Forces act on the bearing as on a body fixed to it; their moment about the shaft's axis is held
/// by the drive.
class DrivenPort : public Port {
 public:
  /// @param drive of the shaft. @param centre a point of its axis [m]. @param arm from there to the
  /// point at the angle 0 [m]. @param axis unit vector, about which it turns right-handed.
  /// @param bearing nullptr: on the ground.
  DrivenPort(Drive drive, const Eigen::Vector3d& centre, const Eigen::Vector3d& arm,
             const Eigen::Vector3d& axis, std::unique_ptr<NodePort> bearing = nullptr);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  bool is_driven() const override { return true; }

 private:
  void add_bearing(const Eigen::VectorXd& y, const Eigen::VectorXd& v, const Eigen::Vector3d& out,
                   PortState& state);
  Drive drive_;
  Eigen::Vector3d centre_, arm_, axis_;
  std::unique_ptr<NodePort> bearing_;
  PortState at_bearing_;
};

/// A node of a body with small motion in a frame that a drive turns.
class TurningNodePort : public Port {
 public:
  /// @param shaft that turns the frame. @param centre a point of its axis [m]. @param axis unit
  /// vector. @param start angle of the shaft at which the frame has the engine's axes [rad].
  /// @param position of the node there, without deformation [m]. @param coordinates y indices of
  /// x, y, z and, for a node that rotates, rx, ry, rz, in the frame's axes.
  TurningNodePort(Drive shaft, const Eigen::Vector3d& centre, const Eigen::Vector3d& axis,
                  double start, const Eigen::Vector3d& position, std::vector<int> coordinates);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  bool is_driven() const override { return true; }

 private:
  Drive shaft_;
  Eigen::Vector3d centre_, axis_, arm_;
  double start_;
};

/// The plane in which a planar body moves.
struct PlaneAxes {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d first = Eigen::Vector3d::UnitX(), second = Eigen::Vector3d::UnitY();
};

/// A point of a planar body (rigid_body.hpp).
class PlanarPort : public Port {
 public:
  /// @param coordinates y indices of u, v, angle. @param arm from the centre of mass, in the body's
  /// axes [m].
  PlanarPort(std::vector<int> coordinates, const Eigen::Vector2d& arm, const PlaneAxes& plane = {});
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  void add_curvature(const Eigen::VectorXd& y, const Vector6& wrench,
                     Eigen::Ref<Eigen::MatrixXd> tangent) override;

 private:
  /// A vector of the body in the engine's axes.
  Eigen::Vector3d turned(const Eigen::Vector2d& arm, double angle) const;
  Eigen::Vector2d arm_;
  PlaneAxes plane_;
};

/// A point of a body that slides along an axis fixed in space (make_sliding_body). Its motion along
/// the axis is the body's own; across it the point follows the guide, which therefore gets all
/// other forces and all moments: by virtual work, without a constraint.
class SlidePort : public Port {
 public:
  /// @param coordinate y index of the displacement along the axis [m]. @param axis unit vector.
  /// @param start position of the point at displacement 0 [m]. @param guide a port of the guide at
  /// that point, which is not driven. @param guide_start its position then [m].
  SlidePort(int coordinate, const Eigen::Vector3d& axis, const Eigen::Vector3d& start,
            std::unique_ptr<Port> guide, const Eigen::Vector3d& guide_start);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  void add_curvature(const Eigen::VectorXd& y, const Vector6& wrench,
                     Eigen::Ref<Eigen::MatrixXd> tangent) override;

 private:
  Eigen::Vector3d axis_, start_, guide_start_;
  Eigen::Matrix3d across_;  // removes the part along the axis
  std::unique_ptr<Port> guide_;
  PortState at_guide_;  // of the last motion()
  Eigen::VectorXd guide_y_, guide_v_;
};

}  // namespace clatter::dynamics
