// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/result_export.hpp"

#include <fmt/format.h>

#include <functional>
#include <limits>
#include <map>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/h5_slab.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/xml.hpp"
#include "core/fe/fe_cells.hpp"
#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh_file.hpp"
#include "core/mesh/vtu_writer.hpp"
#include "modal/modes_file.hpp"
#include "modal/statics.hpp"

namespace clatter::modal {
namespace {

using Path = std::filesystem::path;
using Fields = std::map<std::string, RowMatrix>;

/// Access to results one by one: titles, and the fields of each ("displacement", "stress", ...).
struct Results {
  std::vector<std::string> titles;
  std::function<Fields(size_t)> fields;
  bool one_field = false;  // named by the title only
};

Results modes_of(const H5File& file) {
  const Eigen::VectorXd hz = file.read_vector("frequency_hz");
  const auto digits = std::to_string(hz.size()).size();
  Results results;
  for (Eigen::Index j = 0; j < hz.size(); ++j)
    results.titles.push_back(fmt::format("mode {:0{}} {:.6g} Hz", j + 1, digits, hz[j]));
  results.one_field = true;
  results.fields = [&file](size_t j) {
    return Fields{{"displacement", read_slab(file.path(), "shapes", static_cast<int64_t>(j))}};
  };
  return results;
}

// Expands rows of the region's nodes to all nodes.
RowMatrix spread(const RowMatrix& values, const std::vector<int32_t>& nodes, int64_t n,
                 const std::string& where) {
  RowMatrix all = RowMatrix::Constant(n, values.cols(), std::numeric_limits<double>::quiet_NaN());
  if (values.rows() != static_cast<Eigen::Index>(nodes.size()))
    throw InputError(
        fmt::format("{}: found {} rows, expected {}", where, values.rows(), nodes.size()));
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i] < 0 || nodes[i] >= n)
      throw InputError(fmt::format("{}: found node {}, expected 0 to {}", where, nodes[i], n - 1));
    all.row(nodes[i]) = values.row(static_cast<Eigen::Index>(i));
  }
  return all;
}

Results cases_of(const H5File& file) {
  Results results;
  results.titles = file.list("cases");
  results.fields = [&file, titles = results.titles](size_t j) {
    const std::string at = "cases/" + titles[j] + "/";
    const int64_t n = file.shape("nodes").at(0);
    Fields fields = {{"displacement", file.read_rows(at + "displacement")}};
    if (file.has(at + "temperature_rise"))
      fields["temperature rise"] = RowMatrix(file.read_vector(at + "temperature_rise"));
    const std::vector<std::string> regions = file.list(at + "stress");
    for (const std::string& region : regions) {
      const std::string suffix = regions.size() > 1 ? " " + region : "";
      const std::vector<int32_t> nodes = file.read_ints("stress_nodes/" + region);
      const std::string where = file.path().string() + ": " + at;
      fields["stress" + suffix] = spread(file.read_rows(at + "stress/" + region), nodes, n, where);
      const Eigen::VectorXd mises = file.read_vector(at + "von_mises/" + region);
      fields["von Mises" + suffix] = spread(RowMatrix(mises), nodes, n, where);
    }
    return fields;
  };
  return results;
}

/// The mesh for the fields.
mesh::Mesh drawn_mesh(const H5File& results, const Path& cells) {
  const std::string where = results.path().string();
  mesh::Mesh drawn;
  drawn.name = results.get_string("/", "name");
  drawn.nodes = results.read_rows("nodes");
  drawn.surfaces = mesh::read_surfaces(results, drawn.nodes.rows(), where);
  if (cells.empty()) {
    drawn.surface("skin");
    return drawn;
  }
  const H5File file = H5File::open(cells);
  if (file.get_string("/", "schema") == mesh::kMeshSchema) {
    mesh::Mesh own = mesh::read_mesh(cells);
    drawn.cells = std::move(own.cells);
    drawn.shells = std::move(own.shells);
    drawn.regions = std::move(own.regions);
    drawn.node_ids = std::move(own.node_ids);
  } else {
    fe::FeCells own = fe::read_cells(open_artefact(cells, fe::kFeSchema), file.read_rows("nodes"));
    drawn.cells = std::move(own.blocks);
    drawn.shells = std::move(own.shells);
    drawn.regions = std::move(own.regions);
    drawn.node_ids = std::move(own.node_ids);
  }
  if (file.read_rows("nodes") != drawn.nodes)
    throw InputError(
        fmt::format("{}: its nodes are not those of {}: expected the model that was "
                    "solved, or its mesh",
                    cells.string(), where));
  return drawn;
}

void write_all(const Results& results, mesh::Mesh& drawn, const Path& path) {
  for (size_t j = 0; j < results.titles.size(); ++j)
    for (auto& [name, values] : results.fields(j))
      drawn.fields[results.one_field ? results.titles[j] : results.titles[j] + " " + name] =
          std::move(values);
  write_whole_file(path, mesh::vtu_text(drawn));
  drawn.fields.clear();
}

void write_series(const Results& results, mesh::Mesh& drawn, const Path& path) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  const auto digits = std::to_string(results.titles.size()).size();
  for (size_t j = 0; j < results.titles.size(); ++j) {
    drawn.fields = results.fields(j);
    const Path one =
        path.parent_path() / fmt::format("{}_{:0{}}.vtu", path.stem().string(), j + 1, digits);
    write_whole_file(one, mesh::vtu_text(drawn));
    text += fmt::format("<DataSet timestep=\"{}\" group=\"{}\" file=\"{}\"/>\n", j + 1,
                        escape_xml(results.titles[j]), escape_xml(one.filename().string()));
  }
  drawn.fields.clear();
  write_whole_file(path, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace

void check_result_exports(const std::vector<Path>& exports) {
  for (const Path& path : exports)
    if (path.extension() != ".vtu" && path.extension() != ".pvd")
      throw InputError(fmt::format("{}: found extension '{}', expected .vtu or .pvd", path.string(),
                                   path.extension().string()));
}

void export_results(const Path& results, const Path& cells, const std::vector<Path>& exports) {
  if (exports.empty()) return;
  check_result_exports(exports);
  const H5File file = H5File::open(results);
  const std::string schema =
      file.has_attribute("/", "schema") ? file.get_string("/", "schema") : "no schema";
  const bool modes = schema == kModesSchema;
  if (!modes && schema != fe::kStaticSchema)
    throw InputError(fmt::format("{}: schema: found {}, expected results ({} or {})",
                                 results.string(), schema, kModesSchema, fe::kStaticSchema));
  mesh::Mesh drawn = drawn_mesh(file, cells);
  const Results all = modes ? modes_of(file) : cases_of(file);
  for (const Path& path : exports)
    path.extension() == ".pvd" ? write_series(all, drawn, path) : write_all(all, drawn, path);
}

}  // namespace clatter::modal
