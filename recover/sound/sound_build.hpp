// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// From a reduced model to its sound.
#include <functional>
#include <vector>

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

/// Samples of an earlier file of the same part, with pressures and checks: of the same acoustic
/// skin, flow map, normal velocities and space as `sound` has; none where it has others.
using EarlierSamples = std::function<std::vector<SoundSample>(const PartSound& sound)>;

/// Computes R and H on a grid of frequencies that is refined until values interpolated between
/// them are within the tolerance of computed ones.
///
/// Each interval is tested at its middle, whose sample is then kept; an interval that failed is
/// tested again in halves. A frequency that `earlier` has is not solved again: its microphones are
/// made of its pressures, to the bits of a new computation.
/// @throws InputError for a frequency above the limit of the basis, a microphone inside the part
/// @throws NumericsError when the tolerance needs more frequencies than allowed
PartSound part_sound(const rom::ReducedModel& model, const SoundOptions& options, StepClock& clock,
                     const EarlierSamples& earlier = {});

}  // namespace clatter::recover
