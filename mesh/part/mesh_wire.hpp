// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Serialisation of a finished mesh (core/base/wire.hpp), sent by the child process that runs gmsh.
#include "core/base/stopwatch.hpp"
#include "core/base/wire.hpp"
#include "mesh/cad/gmsh_session.hpp"
#include "mesh/part/mesher.hpp"

namespace clatter {

template <class Archive, SelfOf<DeckOrigin> Self>
void wire(Archive& archive, Self& s) {
  auto& [units, largest_node, largest_element] = s;
  archive(units, largest_node, largest_element);
}

}  // namespace clatter

namespace clatter::mesh {

template <class Archive, SelfOf<CellBlock> Self>
void wire(Archive& archive, Self& s) {
  auto& [type, region, nodes, ids] = s;
  archive(type, region, nodes, ids);
}

template <class Archive, SelfOf<ShellBlock> Self>
void wire(Archive& archive, Self& s) {
  auto& [type, region, nodes, ids, thickness, offset, axis] = s;
  archive(type, region, nodes, ids, thickness, offset, axis);
}

template <class Archive, SelfOf<FaceBlock> Self>
void wire(Archive& archive, Self& s) {
  auto& [type, nodes] = s;
  archive(type, nodes);
}

template <class Archive, SelfOf<Surface> Self>
void wire(Archive& archive, Self& s) {
  auto& [faces] = s;
  archive(faces);
}

template <class Archive, SelfOf<Mesh> Self>
void wire(Archive& archive, Self& s) {
  auto& [name, nodes, node_ids, regions, cells, shells, surfaces, node_sets, fields, deck,
         turning] = s;
  archive(name, nodes, node_ids, regions, cells, shells, surfaces, node_sets, fields, deck,
          turning);
}

template <class Archive, SelfOf<WorstCell> Self>
void wire(Archive& archive, Self& s) {
  auto& [value, block, cell, label, position] = s;
  archive(value, block, cell, label, position);
}

template <class Archive, SelfOf<Measure> Self>
void wire(Archive& archive, Self& s) {
  auto& [worst, block, cell, label, position, low, high, histogram, by_type, worst_cells] = s;
  archive(worst, block, cell, label, position, low, high, histogram, by_type, worst_cells);
}

template <class Archive, SelfOf<QualityReport> Self>
void wire(Archive& archive, Self& s) {
  auto& [min_dihedral, max_dihedral, ratio, jacobian] = s;
  archive(min_dihedral, max_dihedral, ratio, jacobian);
}

template <class Archive, SelfOf<MeshCertificate> Self>
void wire(Archive& archive, Self& s) {
  for (const auto& field : MeshCertificate::fields())
    field.visit(s, [&](auto& value) { archive(value); });
}

template <class Archive, SelfOf<PartMesh> Self>
void wire(Archive& archive, Self& s) {
  auto& [mesh, quality, certificate] = s;
  archive(mesh, quality, certificate);
}

template <class Archive, SelfOf<MshElements> Self>
void wire(Archive& archive, Self& s) {
  auto& [dim, gmsh_type, nodes_each, kind, groups, tags, nodes] = s;
  archive(dim, gmsh_type, nodes_each, kind, groups, tags, nodes);
}

template <class Archive, SelfOf<MshContents> Self>
void wire(Archive& archive, Self& s) {
  auto& [node_tags, coordinates, elements, warnings] = s;
  archive(node_tags, coordinates, elements, warnings);
}

}  // namespace clatter::mesh
