// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/modes_file.hpp"

#include <fmt/format.h>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/mesh/mesh_file.hpp"
#include "modal/certificates.hpp"

namespace clatter::modal {
namespace {

void write_proof(H5File& file, const modes::PartModes& part) {
  const sparse::ModeSet& modes = part.modes;
  ModesCertificate certificate;
  certificate.count_proved = modes.proof.proved ? 1.0 : 0.0;
  certificate.count_below = static_cast<double>(modes.proof.below);
  certificate.count_limit_hz = sparse::hz_of_value(modes.proof.limit);
  certificate.residual_max = modes.size() > 0 ? modes.residuals.maxCoeff() : 0.0;
  if (modes.errors.size() > 0) certificate.frequency_error_estimate = modes.errors.maxCoeff();
  if (part.part_errors.rows() > 0 && part.part_errors.allFinite())
    certificate.frequency_error_parts = part.part_errors.rowwise().sum().maxCoeff();
  certificate.rigid_modes = modes.rigid;
  certificate.shift = modes.sigma;
  certificate.solves = static_cast<double>(modes.solves);
  certificate.factors = modes.factors;
  certificate.retries = modes.retries;
  certificate.massless_unknowns = static_cast<double>(modes.massless);
  if (modes.size() > 0) certificate.frequency_rounding_max = modes.rounding.maxCoeff();
  certificate.factor_entries = static_cast<double>(modes.factor.entries);
  certificate.factor_rcond = modes.factor.rcond;
  write_certificate(file, certificate);
}

}  // namespace

void write_modes(H5File& file, const modes::PartModes& part) {
  const sparse::ModeSet& modes = part.modes;
  file.set("/", "name", part.name);
  file.set("/", "source", part.source);
  file.set("/", "method", modes.method);
  file.set("/", "rigid_modes", modes.rigid);
  file.write("frequency_hz", modes.frequencies_hz());
  file.write("eigenvalue", modes.values);
  file.write("residual", modes.residuals);
  file.write("rounding", modes.rounding);
  if (part.loss_factors.size() > 0) file.write("loss_factor", part.loss_factors);
  if (part.part_errors.rows() > 0) {
    file.write("parts/names", part.parts);
    file.write("parts/errors", part.part_errors);
  }
  file.write("nodes", part.nodes);
  constexpr Eigen::Index kModes = 16;  // at a time
  std::vector<float> shapes;
  shapes.reserve(static_cast<size_t>(modes.size()) * static_cast<size_t>(3 * part.nodes.rows()));
  for (Eigen::Index first = 0; first < modes.size(); first += kModes) {
    const Eigen::MatrixXd some =
        part.shapes(first, std::min<Eigen::Index>(kModes, modes.size() - first));
    shapes.insert(shapes.end(), some.data(), some.data() + some.size());
  }
  file.write_float("shapes", shapes, {modes.size(), part.nodes.rows(), 3});
  mesh::write_surfaces(file, part.surfaces);
  write_proof(file, part);
}

ModeTable read_mode_table(const std::filesystem::path& path) {
  const H5File file = open_artefact(path, kModesSchema);
  ModeTable table;
  table.name = file.get_string("/", "name");
  table.rigid = static_cast<int>(file.get_int("/", "rigid_modes"));
  table.frequency_hz = file.read_vector("frequency_hz");
  table.residual = file.read_vector("residual");
  const Eigen::Index count = table.frequency_hz.size();
  if (table.residual.size() != count || table.rigid < 0 || table.rigid > count) {
    throw InputError(fmt::format("{}: found {} frequencies, {} residuals, {} rigid modes",
                                 path.string(), count, table.residual.size(), table.rigid));
  }
  if (!table.frequency_hz.allFinite() || (table.frequency_hz.array() < 0.0).any()) {
    throw InputError(fmt::format("{}: frequency_hz: found a value that is negative or not finite",
                                 path.string()));
  }
  return table;
}

}  // namespace clatter::modal
