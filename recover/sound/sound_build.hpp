// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From a reduced model to its sound.
#include "core/base/stopwatch.hpp"
#include "core/rom/reduced_model.hpp"
#include "recover/sound/sound_certificate.hpp"
#include "recover/sound/sound_table.hpp"

namespace clatter::recover {

/// The sound of a part with the surface that it was computed on.
struct PartSound {
  SoundTable table;
  sound::Surface skin;
  VelocityMap map;
  Eigen::MatrixXd face_velocity;  // n_c x r: mean normal velocity of each triangle of the skin
  Eigen::MatrixXd efficiency;     // frequencies x r: R_jj / (rho c int v_j^2 dS), 0 without motion
  SoundCertificate certificate;
};

/// Computes R and H on a grid of frequencies that is refined until values interpolated between
/// them are within the tolerance of computed ones.
///
/// Each interval is tested at its middle, whose sample is then kept; an interval that failed is
/// tested again in halves.
/// @throws InputError for a frequency above the limit of the basis, a microphone inside the part
/// @throws NumericsError when the tolerance needs more frequencies than allowed
PartSound part_sound(const rom::ReducedModel& model, const SoundOptions& options, StepClock& clock);

}  // namespace clatter::recover
