// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/cell.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "core/base/error.hpp"

namespace clatter::mesh {
namespace {

constexpr std::array<Edge, 12> kHexEdges = {{{0, 1},
                                             {0, 3},
                                             {0, 4},
                                             {1, 2},
                                             {1, 5},
                                             {2, 3},
                                             {2, 6},
                                             {3, 7},
                                             {4, 5},
                                             {4, 7},
                                             {5, 6},
                                             {6, 7}}};
constexpr std::array<Edge, 9> kWedgeEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}}};
constexpr std::array<Edge, 8> kPyramidEdges = {
    {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}};

// Edges in the order of the other programs' mid-side nodes, by their corners.
constexpr std::array<Edge, 6> kTetElsewhere = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 12> kHexAbaqus = {{{0, 1},
                                              {1, 2},
                                              {2, 3},
                                              {3, 0},
                                              {4, 5},
                                              {5, 6},
                                              {6, 7},
                                              {7, 4},
                                              {0, 4},
                                              {1, 5},
                                              {2, 6},
                                              {3, 7}}};
constexpr std::array<Edge, 12> kHexNastran = {{{0, 1},
                                               {1, 2},
                                               {2, 3},
                                               {3, 0},
                                               {0, 4},
                                               {1, 5},
                                               {2, 6},
                                               {3, 7},
                                               {4, 5},
                                               {5, 6},
                                               {6, 7},
                                               {7, 4}}};
constexpr std::array<Edge, 9> kWedgeAbaqus = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Edge, 9> kWedgeNastran = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}}};
constexpr std::array<Edge, 8> kPyramidElsewhere = {
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};

constexpr bool same(const Edge& a, const Edge& b) {
  return (a[0] == b[0] && a[1] == b[1]) || (a[0] == b[1] && a[1] == b[0]);
}

template <size_t E>
constexpr int middle_of(const std::array<Edge, E>& edges, const Edge& edge, int corners) {
  for (size_t e = 0; e < E; ++e)
    if (same(edges[e], edge)) return corners + static_cast<int>(e);
  return -1;
}

// `corners`: our corner at each of their corner positions.
template <size_t Corners, size_t E>
constexpr std::array<int, Corners + E> permutation(const std::array<Edge, E>& ours,
                                                   const std::array<Edge, E>& theirs,
                                                   const std::array<int, Corners>& corners) {
  std::array<int, Corners + E> p{};
  for (size_t i = 0; i < Corners; ++i) p[i] = corners[i];
  for (size_t e = 0; e < E; ++e) {
    const Edge edge = {corners[theirs[e][0]], corners[theirs[e][1]]};
    p[Corners + e] = middle_of(ours, edge, Corners);
  }
  return p;
}

constexpr std::array<int, 4> kTet = {0, 1, 2, 3}, kTetOver = {0, 2, 1, 3};
constexpr std::array<int, 8> kHex = {0, 1, 2, 3, 4, 5, 6, 7}, kHexOver = {0, 3, 2, 1, 4, 7, 6, 5};
constexpr std::array<int, 6> kWedge = {0, 1, 2, 3, 4, 5}, kWedgeOver = {0, 2, 1, 3, 5, 4};
constexpr std::array<int, 5> kPyramid = {0, 1, 2, 3, 4}, kPyramidOver = {0, 3, 2, 1, 4};

constexpr auto kTetP = permutation(kTetEdges, kTetElsewhere, kTet);
constexpr auto kTetMedP = permutation(kTetEdges, kTetElsewhere, kTetOver);
constexpr auto kHexAbaqusP = permutation(kHexEdges, kHexAbaqus, kHex);
constexpr auto kHexNastranP = permutation(kHexEdges, kHexNastran, kHex);
constexpr auto kHexMedP = permutation(kHexEdges, kHexAbaqus, kHexOver);
constexpr auto kWedgeAbaqusP = permutation(kWedgeEdges, kWedgeAbaqus, kWedge);
constexpr auto kWedgeNastranP = permutation(kWedgeEdges, kWedgeNastran, kWedge);
constexpr auto kWedgeOverP = permutation(kWedgeEdges, kWedgeAbaqus, kWedgeOver);  // VTK, MED
constexpr auto kPyramidP = permutation(kPyramidEdges, kPyramidElsewhere, kPyramid);
constexpr auto kPyramidMedP = permutation(kPyramidEdges, kPyramidElsewhere, kPyramidOver);

// A face from its corners (fourth -1: a triangle); mid-side nodes from the edges.
template <size_t E>
constexpr CellFace face(const std::array<int, 4>& corners, const std::array<Edge, E>& edges,
                        int cell_corners, int order) {
  const size_t n = corners[3] < 0 ? 3 : 4;
  CellFace out{n == 3 ? (order == 1 ? FaceType::kTri3 : FaceType::kTri6)
                      : (order == 1 ? FaceType::kQuad4 : FaceType::kQuad8),
               {}};
  for (size_t i = 0; i < n; ++i) {
    out.nodes[i] = corners[i];
    if (order == 2)
      out.nodes[n + i] = middle_of(edges, {corners[i], corners[(i + 1) % n]}, cell_corners);
  }
  return out;
}

template <size_t F, size_t E>
constexpr std::array<CellFace, F> all_faces(const std::array<std::array<int, 4>, F>& corners,
                                            const std::array<Edge, E>& edges, int cell_corners,
                                            int order) {
  std::array<CellFace, F> out{};
  for (size_t f = 0; f < F; ++f) out[f] = face(corners[f], edges, cell_corners, order);
  return out;
}

constexpr std::array<std::array<int, 4>, 4> kTetCorners = {
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {0, 3, 2, -1}, {1, 2, 3, -1}}};
constexpr std::array<std::array<int, 4>, 6> kHexCorners = {
    {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};
constexpr std::array<std::array<int, 4>, 5> kWedgeCorners = {
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}}};
constexpr std::array<std::array<int, 4>, 5> kPyramidCorners = {
    {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}};

constexpr auto kTet4Faces = all_faces(kTetCorners, kTetEdges, 4, 1);
constexpr auto kTet10Faces = all_faces(kTetCorners, kTetEdges, 4, 2);
constexpr auto kHex8Faces = all_faces(kHexCorners, kHexEdges, 8, 1);
constexpr auto kHex20Faces = all_faces(kHexCorners, kHexEdges, 8, 2);
constexpr auto kWedge6Faces = all_faces(kWedgeCorners, kWedgeEdges, 6, 1);
constexpr auto kWedge15Faces = all_faces(kWedgeCorners, kWedgeEdges, 6, 2);
constexpr auto kPyramid5Faces = all_faces(kPyramidCorners, kPyramidEdges, 5, 1);
constexpr auto kPyramid13Faces = all_faces(kPyramidCorners, kPyramidEdges, 5, 2);

std::span<const int> first(const auto& p, size_t n) { return std::span<const int>(p).first(n); }

const std::array<CellTraits, kCellTypes> kCells = {{
    {"tet4", 4, 4, 1, 10, 4, "C3D4", "CTETRA", "TE4", first(kTetP, 4), first(kTetP, 4),
     first(kTetP, 4), first(kTetMedP, 4), kTetEdges, kTet4Faces},
    {"tet10", 10, 4, 2, 24, 11, "C3D10", "CTETRA", "T10", kTetP, kTetP, kTetP, kTetMedP, kTetEdges,
     kTet10Faces},
    {"hex8", 8, 8, 1, 12, 5, "C3D8", "CHEXA", "HE8", first(kHexAbaqusP, 8), first(kHexAbaqusP, 8),
     first(kHexNastranP, 8), first(kHexMedP, 8), kHexEdges, kHex8Faces},
    {"hex20", 20, 8, 2, 25, 17, "C3D20", "CHEXA", "H20", kHexAbaqusP, kHexAbaqusP, kHexNastranP,
     kHexMedP, kHexEdges, kHex20Faces},
    {"wedge6", 6, 6, 1, 13, 6, "C3D6", "CPENTA", "PE6", first(kWedgeOverP, 6),
     first(kWedgeAbaqusP, 6), first(kWedgeNastranP, 6), first(kWedgeOverP, 6), kWedgeEdges,
     kWedge6Faces},
    {"wedge15", 15, 6, 2, 26, 18, "C3D15", "CPENTA", "P15", kWedgeOverP, kWedgeAbaqusP,
     kWedgeNastranP, kWedgeOverP, kWedgeEdges, kWedge15Faces},
    {"pyramid5", 5, 5, 1, 14, 7, "C3D5", "CPYRAM", "PY5", first(kPyramidP, 5), first(kPyramidP, 5),
     first(kPyramidP, 5), first(kPyramidMedP, 5), kPyramidEdges, kPyramid5Faces},
    {"pyramid13", 13, 5, 2, 27, 19, "", "CPYRAM", "P13", kPyramidP, kPyramidP, kPyramidP,
     kPyramidMedP, kPyramidEdges, kPyramid13Faces},
}};

constexpr std::array<FaceTraits, kFaceTypes> kFaces = {{
    {"tri3", 3, 3, 1, 2, "TR3"},
    {"tri6", 6, 3, 2, 9, "TR6"},
    {"quad4", 4, 4, 1, 3, "QU4"},
    {"quad8", 8, 4, 2, 16, "QU8"},
}};

template <class Type, class Table>
Type type_named(const Table& table, std::string_view name, const char* what,
                const std::string& where) {
  std::vector<std::string_view> known;
  for (size_t i = 0; i < table.size(); ++i) {
    if (table[i].name == name) return static_cast<Type>(i);
    known.push_back(table[i].name);
  }
  throw InputError(fmt::format("{}: found {} type '{}', expected one of: {}", where, what, name,
                               fmt::join(known, ", ")));
}

}  // namespace

const CellTraits& traits(CellType type) { return kCells[static_cast<size_t>(type)]; }
const FaceTraits& traits(FaceType type) { return kFaces[static_cast<size_t>(type)]; }

CellType cell_type_named(std::string_view name, const std::string& where) {
  return type_named<CellType>(kCells, name, "cell", where);
}

FaceType face_type_named(std::string_view name, const std::string& where) {
  return type_named<FaceType>(kFaces, name, "face", where);
}

}  // namespace clatter::mesh
