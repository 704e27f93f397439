// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part/metis_partition.hpp"

#include <fmt/format.h>
#include <metis.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/cell_faces.hpp"

namespace clatter::mesh {
namespace {

static_assert(sizeof(idx_t) == sizeof(int32_t), "Debian's METIS has 32-bit indices");

/// METIS in this process: k-way (its recursive bisection crashes on some graphs), contiguous parts,
/// a seed of its own. False when it reports an error.
bool run_metis(const CellNeighbours& graph, int parts, std::vector<int32_t>& part) {
  std::vector<idx_t> start(graph.start.begin(), graph.start.end());
  std::vector<idx_t> neighbour = graph.neighbour;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_CONTIG] = 1;
  options[METIS_OPTION_SEED] = 1;
  idx_t cells = static_cast<idx_t>(part.size()), constraints = 1, count = parts, cut = 0;
  return METIS_PartGraphKway(&cells, &constraints, start.data(), neighbour.data(), nullptr, nullptr,
                             nullptr, &count, nullptr, nullptr, options, &cut,
                             part.data()) == METIS_OK;
}

bool write_all(int file, const void* data, size_t bytes) {
  const char* at = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::write(file, at, bytes);
    if (done <= 0) return false;
    at += done;
    bytes -= static_cast<size_t>(done);
  }
  return true;
}

bool read_all(int file, void* data, size_t bytes) {
  char* at = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t done = ::read(file, at, bytes);
    if (done <= 0) return false;
    at += done;
    bytes -= static_cast<size_t>(done);
  }
  return true;
}

/// Every part must have cells, and faces must connect them.
void check_parts(const CellNeighbours& graph, const Partition& partition) {
  std::vector<int32_t> first(static_cast<size_t>(partition.parts), -1);
  for (size_t c = 0; c < partition.part.size(); ++c) {
    const int32_t p = partition.part[c];
    if (p < 0 || p >= partition.parts)
      throw NumericsError(fmt::format("partition: METIS gave cell {} the part {}", c, p));
    if (first[p] < 0) first[p] = static_cast<int32_t>(c);
  }
  std::vector<bool> reached(partition.part.size(), false);
  std::vector<int32_t> stack;
  for (int32_t p = 0; p < partition.parts; ++p) {
    if (first[p] < 0)
      throw NumericsError(
          fmt::format("partition: part {} of {} is empty: choose fewer parts", p, partition.parts));
    stack.push_back(first[p]);
    reached[stack.back()] = true;
    while (!stack.empty()) {
      const auto cell = static_cast<size_t>(stack.back());
      stack.pop_back();
      for (int64_t k = graph.start[cell]; k < graph.start[cell + 1]; ++k) {
        const auto next = static_cast<size_t>(graph.neighbour[k]);
        if (reached[next] || partition.part[next] != p) continue;
        reached[next] = true;
        stack.push_back(static_cast<int32_t>(next));
      }
    }
  }
  const auto lost = std::find(reached.begin(), reached.end(), false);
  if (lost != reached.end())
    throw NumericsError(fmt::format("partition: part {} is not connected: choose another number",
                                    partition.part[lost - reached.begin()]));
}

}  // namespace

std::vector<int32_t> metis_parts(const CellNeighbours& graph, int parts) {
  std::vector<int32_t> part(graph.start.size() - 1);
  const size_t bytes = part.size() * sizeof(int32_t);
  int pipe[2];
  if (::pipe(pipe) != 0) throw NumericsError("partition: no pipe to a child process");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(pipe[0]);
    const bool good = run_metis(graph, parts, part) && write_all(pipe[1], part.data(), bytes);
    ::_exit(good ? 0 : 1);
  }
  ::close(pipe[1]);
  const bool complete = child > 0 && read_all(pipe[0], part.data(), bytes);
  ::close(pipe[0]);
  int status = 0;
  if (child > 0) ::waitpid(child, &status, 0);
  if (child < 0 || WIFSIGNALED(status))
    throw NumericsError(
        fmt::format("partition: METIS ended with signal {}", child < 0 ? 0 : WTERMSIG(status)));
  if (!complete || status != 0) throw NumericsError("partition: METIS reported an error");
  return part;
}

CellNeighbours cell_neighbours(const Mesh& mesh) {
  std::vector<int32_t> first_of_block;
  int32_t cells = 0;
  for (const CellBlock& block : mesh.cells) {
    first_of_block.push_back(cells);
    cells += static_cast<int32_t>(block.nodes.rows());
  }
  std::vector<std::pair<int32_t, int32_t>> pairs;
  for_each_face(all_faces(mesh), [&](auto first, auto last) {
    const auto number = [&](const FaceRef& place) {
      return first_of_block[place.block] + place.cell;
    };
    for (auto other = first + 1; other != last; ++other) {
      pairs.emplace_back(number(*first), number(*other));
      pairs.emplace_back(number(*other), number(*first));
    }
  });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  CellNeighbours graph;
  graph.start.assign(static_cast<size_t>(cells) + 1, 0);
  for (const auto& [cell, neighbour] : pairs) {
    ++graph.start[static_cast<size_t>(cell) + 1];
    graph.neighbour.push_back(neighbour);
  }
  std::partial_sum(graph.start.begin(), graph.start.end(), graph.start.begin());
  return graph;
}

std::vector<int32_t> CellNeighbours::bodies() const {
  std::vector<int32_t> body(start.size() - 1, -1);
  std::vector<size_t> stack;
  int32_t count = 0;
  for (size_t seed = 0; seed < body.size(); ++seed) {
    if (body[seed] >= 0) continue;
    body[seed] = count;
    stack.push_back(seed);
    while (!stack.empty()) {
      const size_t cell = stack.back();
      stack.pop_back();
      for (int64_t k = start[cell]; k < start[cell + 1]; ++k) {
        const auto next = static_cast<size_t>(neighbour[k]);
        if (body[next] >= 0) continue;
        body[next] = count;
        stack.push_back(next);
      }
    }
    ++count;
  }
  return body;
}

Partition partition_cells(const Mesh& mesh, int parts) {
  if (!mesh.shells.empty())
    throw InputError(
        fmt::format("partition: found the shells of region \"{}\", expected solids alone",
                    mesh.regions[mesh.shells[0].region]));
  const int64_t cells = mesh.cell_count();
  if (parts < 1 || parts > cells)
    throw InputError(
        fmt::format("partition: found {} parts, expected 1 to {} (cells)", parts, cells));
  Partition out{parts, std::vector<int32_t>(cells, 0), 0};
  if (parts == 1) return out;  // METIS divides by zero (hard case M2)
  const CellNeighbours graph = cell_neighbours(mesh);
  if (graph.neighbour.size() > static_cast<size_t>(std::numeric_limits<idx_t>::max()))
    throw InputError(fmt::format("partition: found {} shared faces, more than METIS can index",
                                 graph.neighbour.size() / 2));
  const std::vector<int32_t> bodies = graph.bodies();
  if (const int32_t last = *std::max_element(bodies.begin(), bodies.end()); last > 0)
    throw InputError(
        fmt::format("partition: found {} bodies that share no face, expected one", last + 1));
  out.part = metis_parts(graph, parts);
  check_parts(graph, out);
  for (size_t c = 0; c < out.part.size(); ++c)
    for (int64_t k = graph.start[c]; k < graph.start[c + 1]; ++k)
      if (out.part[graph.neighbour[k]] > out.part[c]) ++out.cut;
  return out;
}

}  // namespace clatter::mesh
