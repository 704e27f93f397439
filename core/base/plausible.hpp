// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Material and part data outside physical ranges, most often because of a wrong unit. Reported with
// the unit that was probably meant, never refused.
#include <string>
#include <vector>

namespace clatter {

/// Each returns a warning about an implausible value, with a guess where one unit makes it
/// plausible ("density 7.85e-09 kg/m3: did you mean 7850 (7.85e-09 t/mm3)?"), or "" for a plausible
/// value.
///
/// Density [kg/m3]: 10 (foams) to 23 000 (osmium: 22 590).
std::string density_warning(double density);
/// Young's modulus [Pa]: 3e5 (soft rubber) to 1.3e12 (diamond: 1.2e12). Where the density is that
/// of a metal (over 2 500 kg/m3), sqrt(E / rho) is at least 500 m/s (lead: 1 200).
std::string modulus_warning(double modulus, double density);
/// Poisson's ratio: not negative (only special foams have such).
std::string poisson_warning(double poisson);
/// Largest side of the part's bounding box [m]: 1 mm to 30 m (ship engines).
std::string length_warning(double length);
/// First elastic frequency f [Hz] of a part with largest side L [m]: f L is below the speed of
/// sound in any solid (20 000 m/s), and above 0.02 m/s (a steel strip of 1 : 10 000).
std::string first_frequency_warning(double hz, double length);

/// Issues one warning "where: a; b" of all texts that are not empty, without duplicates; none when
/// all are empty.
void warn_implausible(const std::string& where, const std::vector<std::string>& warnings);

}  // namespace clatter
