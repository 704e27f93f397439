#pragma once
// Gmsh with its OpenCASCADE kernel behind one door: solids, booleans, faces, the mesh.
//
// Gmsh is one global state, so at most one session lives at a time. It runs with one thread and
// the Delaunay algorithm because only that gives the same bits on every run (hard case G7). Its
// errors are plain std::string (G1); here they become InputError or NumericsError. Lengths are in
// the part's unit throughout.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/matrix.hpp"
#include "mesh/face/select.hpp"

namespace clatter::mesh {

using Solid = int;
using Solids = std::vector<Solid>;

/// A ball in which cells shall be finer; outside, the size grows back with the distance.
struct FineSpot {
  Eigen::Vector3d centre;
  double radius, size;
};

/// Around a face the size grows from its own with the distance.
struct Gradation {
  int face;
  double size, growth;  // on the face; per length
};

/// How fine a mesh is wanted.
struct SizeSettings {
  double size = 1.0;                 // target edge length
  double min_size = 0.0;             // curvature asks for nothing below
  int per_turn = 0;                  // elements on a full circle; 0: curvature is not looked at
  std::map<int, double> face_sizes;  // by face tag
  std::vector<Gradation> gradations;
  std::vector<FineSpot> spots;
  bool adaptive_faces = false;  // faces by Gmsh's MeshAdapt, the sturdiest, in place of the frontal
};

/// A mesh as Gmsh leaves it; tables hold rows of `nodes`.
struct RawMesh {
  RowMatrix nodes;                     // n x 3
  std::vector<size_t> node_tags;       // Gmsh's numbers of the rows, ascending
  std::map<Solid, IndexMatrix> cells;  // tet4 or tet10, Gmsh order
  std::map<int, IndexMatrix>
      face_cells;  // by face tag: tri3 or tri6, orientation as the face has it
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

/// The lower-case extension of a file to which geometry can be written, ".step", ".stp" or ".brep";
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
  /// A plane polygon pushed along `extrusion`.
  Solid prism(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& extrusion);

  /// Booleans consume their arguments. Each checks that the volume of the result is possible and
  /// that at least one solid is left (NumericsError names the operation); hard case G5.
  Solids fuse(const Solids& objects, const Solids& tools);
  Solids cut(const Solids& objects, const Solids& tools);
  Solids intersect(const Solids& objects, const Solids& tools);
  /// Makes touching and overlapping solids share their faces; pieces per argument, volumes of the
  /// pieces checked to 1e-6 against the argument.
  std::vector<Solids> fragment(const Solids& solids);
  /// The same without the check: OpenCASCADE's integral moves by itself where a face gets a spline
  /// for an edge. solid_volumes.hpp checks by the mesh.
  std::vector<Solids> join(const Solids& solids);
  /// Name of a solid in the file it came from, "" where it has none. Joining loses them.
  std::string name_of(Solid solid);

  Solids copy(const Solids& solids);
  void rotate(const Solids& solids, const Eigen::Vector3d& point, const Eigen::Vector3d& axis,
              double angle_deg);
  double volume(const Solids& solids) const;
  Eigen::Vector3d centre(Solid solid) const;
  Solids all_solids() const;

  /// Solids of a STEP, BREP or IGES file, lengths converted to `unit` ("mm", "m", "cm", "in") where
  /// the format knows its own (STEP, IGES). InputError when it holds no solid.
  Solids import_cad(const std::filesystem::path& path, const std::string& unit);
  /// Removes all solids and takes those of `shape`, an OpenCASCADE TopoDS_Shape, in their place.
  Solids replace_solids(const void* shape);
  /// Writes all solids as STEP (.step, .stp) or BREP (.brep), whichever the name says; InputError
  /// for other names.
  void write_cad(const std::filesystem::path& path, const std::string& unit);

  // --- faces (gmsh_faces.cpp) ---
  /// Faces that bound exactly one solid, by ascending tag; kEdgeSamples points of each edge.
  std::vector<FaceFacts> boundary_faces();
  /// Faces of each solid in turn: those between two solids come twice.
  std::vector<FaceFacts> faces_of_solids();
  /// Smallest radius of curvature at each of the samples of the face, infinite where it is plane.
  std::vector<double> radii(int face);
  /// The smallest of these; 0 for a plane face.
  double smallest_radius(int face);
  /// Smallest and largest coordinates of all solids, from the edges of their faces.
  BoxFilter extent();

  // --- mesh (gmsh_session.cpp) ---
  /// Linear tetrahedra in all solids, anew at each call. NumericsError, with the faces that cut
  /// each other, when Gmsh fails; it then stays locked ("I'm busy", 4.8.4), so the session can mesh
  /// no more.
  void generate(const SizeSettings& settings);
  /// Quadratic (or linear) triangles on all faces, no cells: nodes and face_cells of a mesh for
  /// integrals over the geometry. Forgets the mesh before.
  RawMesh generate_skin(const SizeSettings& settings, int order = 2);
  /// Replaces the cells and inner nodes of a linear mesh by those of `raw`; rows of `nodes` beyond
  /// `node_tags` are new nodes. The boundary stays.
  void replace_cells(const RawMesh& raw);
  /// Makes the cells quadratic; middle nodes of boundary edges go onto the geometry.
  void make_quadratic();
  /// Moves nodes, those of the boundary along the geometry, until curved cells unfold (Gmsh's
  /// HighOrder: minimises a barrier on det J around bad cells). False when it gives up; the mesh
  /// may be better all the same.
  bool optimise_curved_cells();
  /// Moves middle nodes until curved cells unfold (Gmsh's HighOrderElastic; hard case G2).
  void repair_curved_cells();
  RawMesh extract() const;
  static std::string library_version();  // of the header: "4.8"
  std::string running_version() const;   // of the library: "4.8.4"

  // --- Gmsh's own files (gmsh_file.cpp) ---
  /// Reads an MSH file; InputError for all that Gmsh reports. A damaged file may end the process:
  /// gmsh_in_child.hpp.
  MshContents import_msh(const std::filesystem::path& path);

 private:
  void synchronize();
  std::vector<FaceFacts> faces(bool shared);
  RawMesh extract_skin() const;
  std::string reason_of_failure() const;
  bool synchronized_ = false;
  int order_ = 1;
};

}  // namespace clatter::mesh
