// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Conversion of eigenvalues and frequencies.

namespace clatter::sparse {

/// lambda of a frequency: (2 pi f)^2.
double value_of_hz(double hz);
double hz_of_value(double value);

}  // namespace clatter::sparse
