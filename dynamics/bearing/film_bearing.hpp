// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A plain bearing whose film is solved on a grid.
#include <string>
#include <vector>

#include "dynamics/bearing/bearing_laws.hpp"
#include "dynamics/bearing/journal_film.hpp"

namespace clatter::dynamics {

/// A plain bearing by JournalFilm.
class FilmBearing : public FilmedBearing {
 public:
  FilmBearing(const BearingPlace& place, const JournalFilmOptions& options)
      : FilmedBearing(place), film_(options) {}
  void begin_step() override { film_.begin_step(); }
  void finish_stage(const Stage& stage) override;
  void accept_step() override;
  std::vector<double> save() const override { return film_.save(); }
  void restore(const std::vector<double>& state) override { film_.restore(state); }
  /// Also `<name>_pressure`, the largest [Pa].
  void record(const std::string& name, const PairMotion& motion, const PairForce& force,
              History& history) const override;

 protected:
  FilmForce film_force(const Stage& stage, const JournalMotion& motion,
                       bool with_derivatives) override {
    return film_.force(motion, stage, with_derivatives);
  }
  const BearingSize& size() const override { return film_.options().size; }

 private:
  JournalFilm film_;
  double finished_pressure_ = 0.0, pressure_ = 0.0;  // [Pa]
};

}  // namespace clatter::dynamics
