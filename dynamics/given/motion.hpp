// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Prescribed motion at an instant.

namespace clatter::dynamics {

/// A quantity with its first and second derivative in time.
template <class T>
struct Motion {
  T position, velocity, acceleration;
};

}  // namespace clatter::dynamics
