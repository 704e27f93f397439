// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mixed lubricated contact between a piston skirt and its liner as a force element.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/film/contact_model.hpp"
#include "dynamics/film/pad_snapshot.hpp"
#include "dynamics/film/stroke_steps.hpp"

namespace clatter::film {

class Pad;

/// Film, asperity contact and friction between skirt and liner (paper, sections 2.2.2 and 2.2.3).
///
///   h = c + d(z) + G_l(z) y_l - G_p y_p,   z = z_B(t) + skirt's axial displacement - liner's
///   f = (dh/dy)^T A (p + p_c) + friction
///
/// A is the area inside the liner (cover.hpp): beyond its ends there is no film, no contact and no
/// friction, and the film has an open edge with the pads' supply.
///
/// p solves the mass-conserving Reynolds equation in the stage form of reynolds.hpp on a grid fixed
/// to the skirt; its content follows the integrator's tableau, and so does z_B within a step. The
/// liner's slope along the stroke loads the piston axially (through dh/dz), so that the contact
/// does exactly the work of p on h. p_c = p_a(h) times the ratio of contact_damping.hpp is the
/// asperity pressure.
/// Friction acts at the wall, at the bore's radius. Forces and moments on both bodies cancel, with
/// the levers of the ideal position: pin at z_B(t), bore's axis at `bore_axis` from it.
///
/// With a free crank the pin's coordinate counts from the stroke of the clock, and so z is exact as
/// it is. The speed at which skirt and liner slide, the oil that is dragged, grooves of the liner,
/// the height that viscosity has, and factors of shapes are those at the angle of the crank. Of the
/// derivatives by this angle the tangent has that by the sliding speed, which grows as 1 / kappa,
/// other than of viscosity and of the layer on the liner.
class PistonLiner : public dynamics::ForceElement {
 public:
  /// `coordinates`: in the order of PistonLinerBodies, without that of a free crank. InputError for
  /// parameters out of range.
  PistonLiner(PistonLinerOptions options, PistonLinerBodies bodies, std::vector<int> coordinates);
  ~PistonLiner() override;

  std::string name() const override { return model_.options.name; }
  void evaluate(const dynamics::Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, dynamics::Response& response) override;
  void begin_step(double time) override;
  void finish_stage(const dynamics::Stage& stage) override;
  void accept_step(double time) override;
  dynamics::Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  void record(dynamics::History& history) const override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

  int size() const { return model_.at.size(); }
  std::vector<PadSnapshot> snapshot() const;
  const PistonLinerOptions& options() const { return model_.options; }
  /// Linear solves of the film so far; a measure of the cost of the effect.
  long film_solves() const;
  /// Worst mass residual of the last evaluation (0 without film).
  double film_residual() const;
  /// The oil of both pads and of the liner that they pass; none unless the layer is remembered.
  std::optional<OilBalance> oil_balance() const;

 private:
  void check_recesses() const;
  void list_touched(dynamics::Response& response);
  void record_oil(dynamics::History& history) const;

  ContactModel model_;
  std::vector<std::unique_ptr<Pad>> pads_;
  StrokeSteps stroke_;
  CycleScales scales_;              // of shapes of bore and skirt
  std::vector<ScaleState> scaled_;  // at the last stage
  double step_begin_ = 0.0;         // start of this step [s]
  double travel_ = 0.0;             // stroke up to its last stage [m]
  bool running_ = false;            // false: the content is still the initial one
  std::vector<int> touched_row_;    // of a coordinate in the response's tangent; -1: none
  int touched_count_ = 0;
};

}  // namespace clatter::film
