// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The oil on the liner beyond one pad, and where all oil of the pad went.
#include <vector>

#include "dynamics/film/liner_layer.hpp"
#include "dynamics/film/reynolds.hpp"

namespace clatter::film {

/// A layer that supplies a film over its edges and takes what it moves in accepted steps.
class PadLayer {
 public:
  /// `film` has the faces of the pad.
  PadLayer(const LinerLayerOptions& options, const Reynolds& film)
      : layer_(options, film.grid()), has_grooves_(film.pad().grooves()) {}

  /// The run begins with the pad at engine z `height` [m] and this thickness [m] wherever it is
  /// not, and `in_gap` [m3] in it.
  void start(double height, double thickness, double in_gap);
  /// What the edges meet when the pad has moved by `travel` [m] in the step.
  const OutsideLayers& meet(double travel);
  /// An accepted step, as LinerLayer::advance(), in which the film moved `moved`
  /// (OilContent::moved()) and after which `in_gap` [m3] is in the gap.
  void advance(const PadFaces& pad, double dt, double travel, const Eigen::ArrayXd& moved,
               const std::vector<double>& left, double in_gap);

  const LinerLayer& layer() const { return layer_; }
  /// Of the last accepted step.
  const OilBalance& balance() const { return balance_; }

  void save(std::vector<double>& state) const;
  size_t saved_size() const { return 1 + layer_.saved_size() + (has_grooves_ ? 2 : 0); }
  std::vector<double>::const_iterator restore(std::vector<double>::const_iterator next,
                                              double in_gap);

 private:
  void balance(double in_gap);

  LinerLayer layer_;
  bool has_grooves_;
  OutsideLayers outside_;
  EdgeVolumes volumes_;
  double first_ = 0.0;                                  // oil of pad and liner at the start [m3]
  double into_grooves_ = 0.0, moved_by_grooves_ = 0.0;  // since the start, and without sign [m3]
  OilBalance balance_;
};

}  // namespace clatter::film
