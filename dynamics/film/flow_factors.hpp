// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Effect of roughness on the flow and shear of a film: functions of H = h / sigma.
namespace clatter::film {

/// A value and its derivative.
struct ValueSlope {
  double value = 0.0;
  double slope = 0.0;
};

/// Mean gap over Gaussian roughness, contacts counted as zero:
/// h_T = h/2 (1 + erf(h / (sqrt 2 sigma))) + sigma / sqrt(2 pi) exp(-h^2 / (2 sigma^2)).
///
/// `h` [m] may be negative, the result stays positive; slope dh_T/dh is the share of the area out
/// of contact. Source: Patir and Cheng 1978, eq. (8).
ValueSlope mean_gap(double h, double sigma);

/// Patir-Cheng pressure flow factor along the flow, phi_x = 1 - C e^{-r H} (gamma <= 1) or 1 + C
/// H^-r (gamma > 1).
///
/// `peklenik` gamma is the ratio of the correlation lengths along and across the flow: 1/9, 1/6,
/// 1/3, 1, 3, 6 or 9 (InputError otherwise). Across: gamma -> 1/gamma. Slope by H. Source: Patir
/// and Cheng 1978, table 1. Below `lowest_ratio` the factor is constant (hard case N4).
ValueSlope pressure_flow_factor(double ratio, double peklenik);

/// Patir-Cheng shear flow factor of one rough wall, Phi_s = A1 H^a1 e^{-a2 H + a3 H^2} (H <= 5), A2
/// e^{-H/4} (H > 5).
///
/// gamma as of the pressure flow factor. Slope by H. Source: Patir and Cheng 1979, table 2.
/// Below `lowest_ratio` the factor is constant.
ValueSlope shear_flow_factor(double ratio, double peklenik);

/// Patir-Cheng shear stress factor of one rough wall, phi_fs = A3 H^a4 e^{-a5 H + a6 H^2}, by which
/// mu U / h of the smooth wall opposite exceeds phi_f mu U / h; 0.5 <= H <= 7.
///
/// gamma as of the pressure flow factor. Slope by H. Source: Patir and Cheng 1979, table 3. Below
/// its range it is constant; beyond, where they set it 0 (from at most 0.02), it falls as e^{-H}.
ValueSlope shear_stress_factor(double ratio, double peklenik);

/// Patir-Cheng factor of the shear by a pressure gradient, phi_fp = 1 - D e^{-s H}, of the smooth
/// wall opposite a rough one: (h/2) dp/dx phi_fp.
///
/// gamma as of the pressure flow factor. Slope by H. Source: Patir and Cheng 1979, table 3. Below
/// `lowest_stress_ratio` it is constant and positive.
ValueSlope pressure_stress_factor(double ratio, double peklenik);
/// Lower end of the range of phi_fp: 1 for gamma < 1, 0.75 for 1, 0.5 above.
double lowest_stress_ratio(double peklenik);

/// Mean of sigma / h over the roughness, phi_f / H: shear stress on the wall is mu U / sigma times
/// this.
///
/// phi_f of Patir and Cheng 1979, eq. (17) to (19): the mean over the polynomial density
/// 35/96 (1 - (d/3)^2)^3 with gaps under sigma/100 excluded. Below H = 0 constant. Slope by H.
ValueSlope mean_inverse_gap(double ratio);

/// Lower end of the range of H = h / sigma in which the fits hold: 1 for gamma < 1, else 0.5.
///
/// The fits of gamma = 1/9 and 1/6 turn negative below H = 0.93 and 0.77. InputError for a gamma
/// that no table has. Source: Patir and Cheng 1978, 1979.
double lowest_ratio(double peklenik);

}  // namespace clatter::film
