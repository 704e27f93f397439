// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A second reduction: boundary coordinates as characteristic constraint modes.
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// The table [interface] of a `.rom.toml`.
struct InterfaceOptions {
  std::vector<std::string> sets;  // whose coordinates become modes
  int modes = 0;                  // how many elastic ones, or
  double fmax_hz = 0.0;           // all below; exactly one of both is positive
  bool by_area = false;           // weight = "area": patch areas instead of M_ss
};

const keys::Keys<InterfaceOptions>& interface_keys();

/// Without sets those of the boundary. InputError for a set that is not in it.
void choose_sets(const Config& table, const std::vector<std::string>& boundary,
                 InterfaceOptions& options);

struct InterfaceReport {
  int coordinates = 0;             // boundary coordinates that became modes
  int modes = 0;                   // that replaced them
  double cutoff_hz = 0.0;          // lowest of the truncated modes; 0: by area or none truncated
  double frequency_error = 0.0;    // largest relative one of the body's modes, below the limit
  double pressure_work_error = 0;  // largest relative one (film_work.hpp); without a grid 0
};

/// A model in the coordinates of interface modes.
struct ReducedInterface {
  rom::ReducedModel model;
  Eigen::MatrixXd motions;  // r x m, the free rigid motions
  InterfaceReport report;
};

/// Replaces q by q = W z: of the boundary coordinates b = [R S], S those of the named sets,
///   q_S = Psi_SR q_R + Phi_S z,   K_SS Phi_S = N Phi_S Lambda,   Psi_SR = -K_SS^{-1} K_SR
/// (Castanier, Tan and Pierre 2001; K_bb and M_bb of a Craig-Bampton model are Guyan's), N = M_SS,
/// or the diagonal of patch areas, whose modes are the shapes of the most pressure work. With the
/// entire boundary named, R is empty and the free rigid motions are kept with the elastic modes.
/// All parts of the model are transformed; sets in S move to ReducedModel::combined; z comes after
/// q_R, n_boundary counts q_R only. valid_to_hz falls to the cut-off of the modes.
/// @param motions r x m, the free rigid motions; limit_hz up to where frequencies are compared
/// before and after; length [m] the body's size.
/// InputError when q_R does not hold the body, and for areas of sets that are no contact grids.
ReducedInterface reduce_interface(const rom::ReducedModel& model, const InterfaceOptions& options,
                                  const Eigen::MatrixXd& motions, double length, double limit_hz);

/// interface_coordinates, _modes, _cutoff_hz, _frequency_error, _film_work_error of a certificate.
void record(const InterfaceReport& report, rom::ReducedCertificate& certificate);
/// A line for the user from such a certificate.
std::string interface_line(const rom::ReducedCertificate& certificate);

}  // namespace clatter::condense
