// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A main bearing whose film is solved on a grid.
#include <memory>
#include <string>
#include <vector>

#include "dynamics/crank/journal_film.hpp"
#include "dynamics/shaft/journal_bearing.hpp"

namespace clatter::dynamics {

/// A plain bearing by JournalFilm.
class FilmBearing : public FilmedBearing {
 public:
  FilmBearing(std::string name, std::unique_ptr<Port> journal, std::unique_ptr<Port> housing,
              const ShaftAxes& axes, const Eigen::Vector3d& offset,
              const JournalFilmOptions& options);
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void begin_step(double time) override;
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  /// Also `<name>_pressure`, the largest [Pa].
  void record(History& history) const override;
  std::vector<double> save() const override { return film_.save(); }
  void restore(const std::vector<double>& state) override { film_.restore(state); }

 protected:
  FilmForce film_force(const JournalMotion& motion) const override;
  const BearingSize& size() const override { return film_.options().size; }

 private:
  mutable JournalFilm film_;
  const Stage* stage_ = nullptr;  // that is evaluated; else the force is the last one
  bool with_tangent_ = false;
  mutable FilmForce last_;
  std::string pressure_name_;
  double finished_pressure_ = 0.0, pressure_ = 0.0;  // [Pa]
};

}  // namespace clatter::dynamics
