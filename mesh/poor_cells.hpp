#pragma once
// Cells that are poorer than aimed at: where they are, what they cost, and when they are too poor.
#include <string>
#include <vector>

#include "mesh/mesh.hpp"
#include "mesh/quality.hpp"

namespace clatter::mesh {

/// Smallest dihedral angle and smallest scaled Jacobian (validity.hpp) of a cell.
struct QualityLimits {
  double dihedral_deg, scaled_jacobian;
};
inline constexpr QualityLimits kQualityAims = {8.0, 0.2};
/// Below, a mesh of our own is refused. 1 deg: condition numbers grow by 1 / angle^2, 3000 times
/// what a good cell has; solvers lose four digits. Scaled Jacobian 0.02: below, one such cell on a
/// wall moved a frequency by up to several per cent (tests/mesh/poor_cells_test.cpp).
inline constexpr QualityLimits kQualityFloor = {1.0, 0.02};

/// What is poor in a mesh.
struct PoorCells {
  int64_t flat = 0, squeezed = 0;  // dihedral angle, scaled Jacobian below the aim
  int64_t cells = 0;               // either
  int64_t below_floor = 0;         // either, below kQualityFloor
  double volume_share = 0.0;       // of the mesh
  double frequency_effect = 0.0;   // relative, estimated (poor_cell_effect.hpp)
  std::vector<WorstCell> worst_flat, worst_squeezed;  // the worst few of each that are poor
  bool has_estimate = false;                          // false where all poor cells are linear
};

PoorCells find_poor_cells(const Mesh& mesh, const QualityReport& quality,
                          const QualityLimits& aims = kQualityAims);

/// A length unit for places: "mm" and 1e-3.
struct PlaceUnit {
  std::string name = "mm";
  double metres = 1e-3;
};

/// "12 of 19115 cells are poor: 3 with a dihedral angle below 8 deg (0.61 deg in cell 7 at (1.2,
/// 3.4, 5) mm, ...), 9 with a scaled Jacobian below 0.2 (...); 0.02 % of the volume, estimated
/// effect on frequencies 0.003 %".
std::string describe_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                                const PlaceUnit& unit);

/// Warns of poor cells. NumericsError when some are below kQualityFloor and `accept` is false; says
/// where, and the ways out.
void judge_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                      const PlaceUnit& unit, bool accept);

}  // namespace clatter::mesh
