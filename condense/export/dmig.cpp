// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/dmig.hpp"

#include "condense/export/bulk_data.hpp"
#include "condense/export/pencil_modes.hpp"
#include "core/base/whole_file.hpp"

namespace clatter::condense {

void export_dmig(const ExportedPart& part, const std::filesystem::path& path) {
  const Eigen::MatrixXd D = damping_of(part.model);
  const bool damped = !D.isZero(0.0);
  WholeFile file(path);
  std::ostream& out = file.stream();
  write_bulk_head(out, part,
                  {damped ? "Case control: K2GG = KCLATTR, M2GG = MCLATTR and B2GG = BCLATTR"
                          : "Case control: K2GG = KCLATTR and M2GG = MCLATTR"});
  write_spoints(out, part);
  write_grids(out, part, part.options.deck_nodes);
  write_dmig(out, "KCLATTR", part.model.K_rr, part);
  write_dmig(out, "MCLATTR", part.model.M_rr, part);
  if (damped) write_dmig(out, "BCLATTR", D, part);
  file.commit();
}

}  // namespace clatter::condense
