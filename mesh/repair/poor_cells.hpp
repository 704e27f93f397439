// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cells below the target quality: where they are, their effect, and when they are refused.
//
// The effect decides, not the angle alone: a sliver among good cells changes nothing, a sheet of
// flat cells everything. By the minimum principle (Strang and Fix 1973) a frequency of the mesh is
// at most the Rayleigh quotient of any field of the mesh. Take a mode's interpolant, at the nodes
// of poor cells the best fit: poor cells raise omega^2 by at most
//
//   X: what no field of the mesh can have there (frequency_effect(), of quadratic fields), plus
//   S: the share of the energy in cells far below, whatever their error is (locking of flat cells
//      in thin sheets, rounding),
//   N: what larger cells around those would change: a flat cell ties the fields on its two sides.
//
// X and S are at hand for the mean bending of the part. Energy is not spread evenly: at the clamped
// end of a beam the energy per length is 4 times the mean, at the surface of a wall the one per
// volume 3 times that of the wall. So
//
//   relative change of frequencies <=
//     4 frequency_effect + 4 * 3 / 2 * volume share far below + 0.05 * volume share around these
//
// where a mesh of cells of twice the size is taken to err by 5 % at most, the limit of refusal.
// Measured: mesh/README.md. Time steps do not depend on cells: bodies are reduced to modes.
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "mesh/repair/mesh_certificate.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {

/// Smallest dihedral angle and smallest scaled Jacobian (validity.hpp) of a cell.
struct QualityLimits {
  double dihedral_deg, scaled_jacobian;
};
inline constexpr QualityLimits kQualityAims = {8.0, 0.2};
/// Cells below this are far below: nothing is known of their error, so their share of the energy
/// counts. Curved cells distorted to 0.02 have lost their quadratic fields, and no repair step
/// could improve them.
inline constexpr QualityLimits kQualityFloor = {0.1, 0.02};
/// Largest change of frequencies by poor cells that is said only, and that is warned of; a mesh
/// made here with more is refused. 0.1 % is below the error of good meshes of this kind, 5 % above
/// it.
inline constexpr double kHarmless = 1e-3, kMostEffect = 0.05;

/// The poor cells of a mesh.
struct PoorCells {
  int64_t flat = 0, squeezed = 0;  // dihedral angle, scaled Jacobian below the target
  int64_t cells = 0;               // either
  int64_t below_floor = 0;         // either, below kQualityFloor
  double volume_share = 0.0;       // of the mesh
  double share_below_floor = 0.0;  // of the mesh's volume, of those below kQualityFloor
  double share_around = 0.0;       // of cells that share a node with these
  double frequency_effect = 0.0;   // relative, estimated (poor_cell_effect.hpp)
  std::vector<WorstCell> worst_flat, worst_squeezed;  // the worst few of each kind
  bool has_estimate = false;                          // false when all poor cells are linear

  /// Largest relative change of frequencies by these cells (above).
  double most_effect() const;
};
/// The part of most_effect() of cells below the floor.
double effect_of_share(double share_below_floor);

PoorCells find_poor_cells(const Mesh& mesh, const QualityReport& quality,
                          const QualityLimits& aims = kQualityAims);

/// A length unit for positions: "mm" and 1e-3.
struct PositionUnit {
  std::string name = "mm";
  double metres = 1e-3;
};

/// "12 of 19115 cells are poor: 3 with a dihedral angle below 8 deg (0.61 deg in cell 7 at (1.2,
/// 3.4, 5) mm, ...), 9 with a scaled Jacobian below 0.2 (...); 0.02 % of the volume, estimated
/// effect on frequencies 0.003 %, at most 0.012 %".
std::string describe_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                                const PositionUnit& unit);

/// For the certificate: poor_cells, poor_cells_below_floor, poor_cells_volume_share,
/// poor_cells_frequency_effect, poor_cells_most_effect.
void note_poor_cells(const PoorCells& poor, MeshCertificate& certificate);

/// Says what poor cells there are, or warns of them. Returns why the mesh is refused, with their
/// positions: their effect is above kMostEffect and `accept` is false; else nothing.
std::string refusal_of_poor_cells(const PoorCells& poor, const Mesh& mesh,
                                  const QualityLimits& aims, const PositionUnit& unit, bool accept);

}  // namespace clatter::mesh
