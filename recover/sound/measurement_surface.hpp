// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Standard microphone positions around a part, and the surface that they stand for.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/sound/space.hpp"
#include "core/sound/surface.hpp"

namespace clatter::recover {

/// A point at which the pressure is wanted.
struct Microphone {
  std::string name;
  Eigen::Vector3d position;  // [m], in the frame of the part
};

/// Positions that are chosen by a rule.
enum class MicrophoneSet {
  kNone,
  kEngine1m,  // five, 1 m from the sides of the box around the part, as in test cells of engines
  kIso3744,   // of the parallelepiped of ISO 3744:2010 on one reflecting plane
};

/// The name in configurations and files: "none", "engine_1m", "iso_3744".
const char* name_of(MicrophoneSet set);

/// The surface of a box at 1 m from the box around a part, with positions on it.
struct MeasurementSurface {
  MicrophoneSet set = MicrophoneSet::kNone;
  double area = 0.0;  // S [m2], without the side in the ground plane
  std::vector<Microphone> microphones{};
};

/// Finds positions and area.
///
/// engine_1m: plus_y, minus_y, plus_x, minus_x, top: 1 m from the middle of each side but the lower
/// one; the area is of five sides down to a ground plane with a normal along z, else of six.
/// iso_3744: the box ends at the ground plane. Each side of the measurement surface is divided into
/// the smallest number of equal rectangles with edges up to 3 m; a position is at the centre of
/// each rectangle and at each corner that is not in the ground plane: iso_01, iso_02, ..., centres
/// first. A small part has nine (five centres, four upper corners).
/// @throws InputError for iso_3744 without a ground plane whose normal is along an axis
MeasurementSurface measurement_surface(MicrophoneSet set, const sound::Surface& acoustic,
                                       const std::optional<sound::Plane>& ground);

}  // namespace clatter::recover
