// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Equations as written in a deck, before transformation to the basic axes.
#include <vector>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {

/// A term in the axes of its node (*TRANSFORM).
struct Term {
  int32_t row = 0;
  int direction = 0;  // 0 to 5
  double coefficient = 0.0;
};

/// Its first term depends on the others.
struct RawEquation {
  Origin origin = 0;
  std::vector<Term> terms;
};

/// A line of *MPC and its continuation lines, which begin with 0.
using MpcLines = std::vector<Fields>;

/// Adds the equations of one *MPC, or a rigid body for BEAM; InputError for unsupported types.
void add_mpc(Model& model, size_t use, const MpcLines& lines, std::vector<RawEquation>& equations);

}  // namespace clatter::mesh::deck::abaqus
