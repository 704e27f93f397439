// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The interface to Gmsh with its OpenCASCADE kernel: solids, booleans, faces, the mesh.
//
// Gmsh has global state, so at most one session exists at a time. It runs with one thread and the
// Delaunay algorithm because only that gives identical results on every run (hard case G7). Its
// errors are plain std::string (G1); here they become InputError or NumericsError. All lengths are
// in the part's unit.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"
#include "mesh/cad/step_names.hpp"
#include "mesh/face/select.hpp"

namespace clatter::mesh {

using Solid = int;
using Solids = std::vector<Solid>;

/// A ball with finer cells; outside it the size grows with the distance.
struct FineSpot {
  Eigen::Vector3d centre;
  double radius, size;
};

/// A size on a face, which grows with the distance from it.
struct Gradation {
  int face;
  double size, growth;  // on the face; per length
};

/// The same on a curve.
struct CurveGradation {
  int curve;
  double size, growth;
  int points;  // on the curve, from which the distance is measured
};

/// The requested cell sizes.
struct SizeSettings {
  double size = 1.0;                 // target edge length
  double min_size = 0.0;             // lower limit of sizes from curvature
  int per_turn = 0;                  // elements on a full circle; 0: ignores curvature
  std::map<int, double> face_sizes;  // by face tag
  std::vector<Gradation> gradations;
  std::vector<CurveGradation> curves;  // where there are some, sizes on edges do not extend into
                                       // faces otherwise
  std::vector<FineSpot> spots;
  bool adaptive_faces = false;  // faces by MeshAdapt, the most robust, instead of frontal
};

/// A mesh as Gmsh generates it; tables hold rows of `nodes`.
struct RawMesh {
  RowMatrix nodes;                     // n x 3
  std::vector<size_t> node_tags;       // Gmsh's numbers of the rows, ascending
  std::map<Solid, IndexMatrix> cells;  // tet4 or tet10, Gmsh order
  std::map<int, IndexMatrix>
      face_cells;  // by face tag: tri3 or tri6, orientation as the face has it
};

/// Of a node inside a face or a curve.
struct PlaceOnGeometry {
  int dim = 2, tag = 0;
  std::array<double, 2> at{};  // parameters; of a curve the first
};

/// A mesh of faces alone; tables hold rows of `nodes`.
struct RawSheet {
  struct Cells {
    IndexMatrix triangles, quads;  // tri3 and quad4, or tri6 and quad8; oriented as the face is
  };
  RowMatrix nodes;                   // n x 3, all of them of cells
  std::map<int, Cells> faces;        // by face tag
  std::map<int, IndexMatrix> edges;  // by curve tag: lines of two or three nodes
};

/// Elements of one kind in one entity of a Gmsh file.
struct MshElements {
  int dim = 0, gmsh_type = 0, nodes_each = 0;
  std::string kind;                 // Gmsh's name: "Tetrahedron 10"
  std::vector<int> groups;          // physical groups of the entity
  std::vector<size_t> tags, nodes;  // numbers in the file; nodes_each a row
};

/// A Gmsh file as Gmsh has read it.
struct MshContents {
  std::vector<size_t> node_tags;
  std::vector<double> coordinates;  // three a node
  std::vector<MshElements> elements;
  std::vector<std::string> warnings;
};

/// The lower-case extension of a geometry file that can be written, ".step", ".stp" or ".brep";
/// InputError for others.
std::string cad_extension(const std::filesystem::path& path);

class GmshSession {
 public:
  explicit GmshSession(const std::string& model_name);
  ~GmshSession();
  GmshSession(const GmshSession&) = delete;
  GmshSession& operator=(const GmshSession&) = delete;

  // --- solids (gmsh_solids.cpp) ---
  Solid box(const Eigen::Vector3d& min, const Eigen::Vector3d& max);
  /// From the centre of the base along `axis`, whose length is the cylinder's.
  Solid cylinder(const Eigen::Vector3d& base, const Eigen::Vector3d& axis, double radius);
  /// A plane polygon extruded along `extrusion`.
  Solid prism(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& extrusion);

  /// Booleans consume their arguments. Each checks that the volume of the result is plausible and
  /// that at least one solid remains (NumericsError names the operation); hard case G5.
  Solids fuse(const Solids& objects, const Solids& tools);
  Solids cut(const Solids& objects, const Solids& tools);
  Solids intersect(const Solids& objects, const Solids& tools);
  /// Makes touching and overlapping solids share their faces; pieces per argument, volumes of the
  /// pieces checked to 1e-6 against the argument.
  std::vector<Solids> fragment(const Solids& solids);
  /// The same without the check: OpenCASCADE's integral changes where an edge of a face becomes a
  /// spline. solid_volumes.hpp checks with the mesh.
  /// Faces, edges and corners of different solids that are nearer than `within` become one.
  std::vector<Solids> join(const Solids& solids, double within = 0.0);
  /// Name of a solid in the file it came from, "" where it has none. Joining discards them.
  std::string name_of(Solid solid);

  Solids copy(const Solids& solids);
  void rotate(const Solids& solids, const Eigen::Vector3d& point, const Eigen::Vector3d& axis,
              double angle_deg);
  double volume(const Solids& solids) const;
  /// Of all faces of the solids, in the part's unit squared.
  double area(const Solids& solids);
  Eigen::Vector3d centre(Solid solid) const;
  Solids all_solids() const;

  /// Solids of a STEP, BREP or IGES file, lengths converted to `unit` ("mm", "m", "cm", "in") where
  /// the format has units (STEP, IGES). InputError when it holds no solid.
  Solids import_cad(const std::filesystem::path& path, const std::string& unit);
  /// The same of a file for a sheet: its solids, or its faces where it has none. Faces of different
  /// shapes that touch share edges. InputError when it holds neither.
  Solids import_sheet(const std::filesystem::path& path, const std::string& unit);
  /// Replaces all solids by those of `shape`, an OpenCASCADE TopoDS_Shape.
  Solids replace_solids(const void* shape);
  /// Writes all solids as STEP (.step, .stp) or BREP (.brep), by the extension of the name;
  /// InputError for another one.
  void write_cad(const std::filesystem::path& path, const std::string& unit);

  // --- faces (gmsh_faces.cpp) ---
  /// Faces that bound exactly one solid, by ascending tag; kEdgeSamples points of each edge. All
  /// faces where there is no solid.
  std::vector<FaceFacts> boundary_faces();
  /// Faces of each solid in turn: those between two solids appear twice.
  std::vector<FaceFacts> faces_of_solids();
  /// Smallest radius of curvature at each of the samples of the face, infinite where it is plane.
  std::vector<double> radii(int face);
  /// The smallest of these; 0 for a plane face.
  double smallest_radius(int face);
  /// The point of the place's face or curve that is nearest to x, by Gauss and Newton from the
  /// place's parameters, which become its own.
  Eigen::Vector3d nearest_point(const Eigen::Vector3d& x, PlaceOnGeometry& place);
  /// Smallest and largest coordinates of all solids, from the edges of their faces.
  BoxFilter extent();

  // --- sheets (gmsh_sheet.cpp) ---
  /// A box with rounded vertical edges.
  Solid rounded_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, double radius);
  /// Rounds the edges that lie in a box.
  Solids fillet(const Solids& solids, const BoxFilter& edges, double radius);
  std::vector<int> all_faces() const;
  std::vector<int> curves_of(int face);
  /// All curves: tag and edge_points alone.
  std::vector<FaceFacts> edges();
  /// Faces that touch or cross share edges; without solids.
  void join_faces();
  /// Removes all solids, and the other faces.
  void keep_faces(const std::vector<int>& faces);
  /// Meshes all faces with cells of this order, quadrilaterals as far as they go.
  RawSheet generate_sheet(const SizeSettings& settings, bool triangles, int order);

  // --- mesh (gmsh_session.cpp) ---
  /// Meshes all solids with linear tetrahedra, from scratch at each call. NumericsError, with the
  /// faces that intersect, when Gmsh fails; it then stays locked ("I'm busy", 4.8.4), and the
  /// session cannot mesh again.
  void generate(const SizeSettings& settings);
  /// Quadratic (or linear) triangles on all faces, no cells: nodes and face_cells of a mesh for
  /// integrals over the geometry. Discards the previous mesh.
  RawMesh generate_skin(const SizeSettings& settings, int order = 2);
  /// Replaces the cells and inner nodes of a linear mesh by those of `raw`; rows of `nodes` beyond
  /// `node_tags` are new nodes. The boundary is unchanged.
  void replace_cells(const RawMesh& raw);
  /// Makes the cells quadratic; mid-side nodes of boundary edges are moved onto the geometry.
  void make_quadratic();
  /// Moves nodes, those of the boundary along the geometry, until curved cells unfold (Gmsh's
  /// HighOrder: minimises a barrier on det J around bad cells). False when it gives up; the mesh
  /// may be better nevertheless.
  bool optimise_curved_cells();
  /// Moves mid-side nodes until curved cells unfold (Gmsh's HighOrderElastic; hard case G2).
  void repair_curved_cells();
  RawMesh extract() const;
  /// Of the nodes of the mesh that lie inside faces and curves, by Gmsh's numbers.
  std::map<size_t, PlaceOnGeometry> places_of_nodes() const;
  static std::string library_version();  // of the header: "4.8"
  std::string running_version() const;   // of the library: "4.8.4"

  // --- Gmsh's own files (gmsh_file.cpp) ---
  /// Reads an MSH file; InputError for all errors of Gmsh. A corrupt file may end the process:
  /// gmsh_in_child.hpp.
  MshContents import_msh(const std::filesystem::path& path);

 private:
  void synchronize();
  std::vector<std::pair<int, int>> import_shapes(const std::filesystem::path& path,
                                                 const std::string& unit, bool make_solids);
  std::vector<FaceFacts> faces(bool shared);
  RawMesh extract_skin() const;
  std::string reason_of_failure() const;
  std::string name_of(const FaceFacts& face) const;

  std::vector<NamedFace> named_;  // as they were read
  bool synchronized_ = false;
  int order_ = 1;
};

}  // namespace clatter::mesh
