#pragma once
// Equations as a deck has them, before the axes of its nodes count.
#include <vector>

#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck::abaqus {

/// A term in the directions of its node.
struct Term {
  int32_t row = 0;
  int direction = 0;  // 0 to 5
  double coefficient = 0.0;
};

/// Its first term depends on the others.
struct RawEquation {
  Spot spot = 0;
  std::vector<Term> terms;
};

/// A line of *MPC and those that continue it: they begin with 0.
using MpcLines = std::vector<Fields>;

/// Adds the equations of one *MPC, or a rigid body for BEAM; InputError for types that are not
/// read.
void add_mpc(Reading* reading, size_t use, const MpcLines& lines,
             std::vector<RawEquation>* equations);

}  // namespace clatter::mesh::deck::abaqus
