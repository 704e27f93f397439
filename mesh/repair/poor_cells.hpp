// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Cells below the target quality: where they are, their effect, and when they are refused.
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
/// A mesh made here is refused below this. Straight flat cells hardly change frequencies, but
/// condition numbers grow by 1 / angle^2: at 0.1 deg solvers lose 5 to 6 of their 16 digits more
/// than on good cells; a sheet of 0.1 mm in cells of 20 mm is still above. Curved cells distorted
/// to 0.02 have lost their quadratic fields, and no repair step could improve them.
inline constexpr QualityLimits kQualityFloor = {0.1, 0.02};

/// The poor cells of a mesh.
struct PoorCells {
  int64_t flat = 0, squeezed = 0;  // dihedral angle, scaled Jacobian below the target
  int64_t cells = 0;               // either
  int64_t below_floor = 0;         // either, below kQualityFloor
  double volume_share = 0.0;       // of the mesh
  double frequency_effect = 0.0;   // relative, estimated (poor_cell_effect.hpp)
  std::vector<WorstCell> worst_flat, worst_squeezed;  // the worst few of each kind
  bool has_estimate = false;                          // false when all poor cells are linear
};

PoorCells find_poor_cells(const Mesh& mesh, const QualityReport& quality,
                          const QualityLimits& aims = kQualityAims);

/// A length unit for positions: "mm" and 1e-3.
struct PositionUnit {
  std::string name = "mm";
  double metres = 1e-3;
};

/// "12 of 19115 cells are poor: 3 with a dihedral angle below 8 deg (0.61 deg in cell 7 at (1.2,
/// 3.4, 5) mm, ...), 9 with a scaled Jacobian below 0.2 (...); 0.02 % of the volume, estimated
/// effect on frequencies 0.003 %".
std::string describe_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                                const PositionUnit& unit);

/// For the certificate: poor_cells, poor_cells_below_floor, poor_cells_volume_share,
/// poor_cells_frequency_effect.
void note_poor_cells(const PoorCells& poor, MeshCertificate& certificate);

/// Warns of poor cells. NumericsError when some are below kQualityFloor and `accept` is false;
/// gives their positions and the remedies.
void check_poor_cells(const PoorCells& poor, const Mesh& mesh, const QualityLimits& aims,
                      const PositionUnit& unit, bool accept);

}  // namespace clatter::mesh
