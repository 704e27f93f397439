// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Mixed lubricated contact between a piston skirt and its liner as a force element.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/film/axial_motion.hpp"
#include "dynamics/film/gap_map.hpp"
#include "dynamics/film/piston_liner_options.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// Fields of one pad at the last evaluated state, n_angle x n_axial each.
struct PadSnapshot {
  std::string name;              // "thrust", "antithrust"; "skirt" of the entire one
  Eigen::VectorXd angle;         // cell centres, from the thrust side [rad]
  Eigen::VectorXd axial;         // cell centres, z from the pin centre [m]
  RowMatrix gap;                 // h [m]
  RowMatrix pressure;            // film [Pa]; empty without film
  RowMatrix fill;                // theta [1]; empty without film
  RowMatrix contact_pressure;    // asperities [Pa]; empty without asperities
  Eigen::VectorXd liner_height;  // cells of the layer on the liner, engine z [m]; empty without
  RowMatrix liner_oil;           // its thickness, n_angle x cells [m], 0 under the pad
};

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

  std::string name() const override { return options_.name; }
  void evaluate(const dynamics::Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, dynamics::Response& response) override;
  void begin_step(double time) override;
  void finish_stage(const dynamics::Stage& stage) override;
  void accept_step(double time) override;
  dynamics::Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  void record(dynamics::History& history) const override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

  int size() const { return at_.size(); }
  std::vector<PadSnapshot> snapshot() const;
  const PistonLinerOptions& options() const { return options_; }
  /// Linear solves of the film so far; a measure of the cost of the effect.
  long film_solves() const;
  /// Worst mass residual of the last evaluation (0 without film).
  double film_residual() const;
  /// The oil of both pads and of the liner that they pass; none unless the layer is remembered.
  std::optional<OilBalance> oil_balance() const;

 private:
  struct Pad;
  void check() const;
  void add_pad(const char* name, double centre);
  void evaluate_pad(Pad& pad, const dynamics::Stage& stage, const Eigen::VectorXd& y,
                    const Eigen::VectorXd& v, bool with_tangent);
  /// Heights of the pin [m].
  struct Heights {
    double clock, crank;  // from which its coordinate counts; of the ideal pin
  };
  void update_gap(Pad& pad, const Heights& heights, const std::vector<ScaleState>& scales,
                  const Eigen::VectorXd& y);
  void check_recesses() const;
  void add_recesses(Pad& pad);
  void place_recesses(Pad& pad, double position) const;
  double recess_power(const Pad& pad) const;
  void find_ends(const rom::ContactGrid& grid);
  void update_cover(Pad& pad, double height) const;
  double lowest_gap(const Pad& pad) const;
  [[noreturn]] void refuse_gap(const Pad& pad, double lowest) const;
  void solve_film(Pad& pad, const dynamics::Stage& stage);
  void solve_film_equations(Pad& pad, const dynamics::Stage& stage, const FilmStage& inner);
  void meet_layer(Pad& pad, const dynamics::Stage& stage);
  void accept_layer(Pad& pad, double time);
  static void balance_oil(Pad& pad);
  double travel(const dynamics::Stage& stage) const;
  void start_content(Pad& pad, const dynamics::Stage& stage, const Eigen::VectorXd& y,
                     const Eigen::VectorXd& v);
  void update_contact(Pad& pad);
  void damp_contact(Pad& pad);
  void update_rate_tangent(Pad& pad, double kappa, const Eigen::VectorXd& v);
  void update_friction(Pad& pad);
  void update_force(Pad& pad) const;
  void update_tangent(Pad& pad);
  void update_crank_column(Pad& pad) const;
  Eigen::Matrix3Xd friction_tangent(const Pad& pad) const;
  void collect(bool with_tangent, dynamics::Response& response);
  void list_touched(dynamics::Response& response);
  double end_force(const Pad& pad) const;
  void add_end_tangent(Pad& pad) const;
  void find_stroke(const dynamics::Stage& stage, const Eigen::VectorXd& y,
                   const Eigen::VectorXd& v);
  double stroke_height(double position, const Eigen::VectorXd& y) const;
  Eigen::Vector3d friction_wrench(const Pad& pad) const;

  PistonLinerOptions options_;
  PistonLinerBodies bodies_;
  ContactCoordinates at_;
  Eigen::VectorXd height_by_y_;  // of the pads, n_e
  AxialMotion axial_;
  std::vector<std::unique_ptr<Pad>> pads_;
  std::unique_ptr<RoughFilm> rough_;
  std::unique_ptr<Viscosity> viscosity_;
  std::unique_ptr<Asperity> asperity_;
  std::unique_ptr<ContactDamping> damping_;
  StrokeState stroke_, ideal_;  // of the clock, from which the pin counts; of the ideal pin
  dynamics::CrankLead lead_;
  double slide_by_turn_ = 0.0;      // of the ideal pin's velocity by the coordinate of a free crank
  CycleScales scales_;              // of shapes of bore and skirt
  std::vector<ScaleState> scaled_;  // at the last stage
  // z_B' by the clock and of the ideal pin at the finished stages of this step [m/s].
  std::array<double, 4> stroke_rates_{}, ideal_rates_{};
  double step_begin_ = 0.0, travel_ = 0.0;  // start of this step [s], stroke up to its last stage
                                            // [m]; with the layer on the liner
  bool running_ = false;                    // false: the content is still the initial one
  std::vector<int> touched_row_;            // of a coordinate in the response's tangent; -1: none
  int touched_count_ = 0;
};

}  // namespace clatter::film
