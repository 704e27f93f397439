// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <iostream>
#include <numbers>

#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {
namespace {

namespace occ = gmsh::model::occ;

constexpr double kVolumeTolerance = 1e-6;  // relative; OpenCASCADE integrates to about 1e-9

gmsh::vectorpair tagged(const Solids& solids) {
  gmsh::vectorpair pairs;
  for (Solid s : solids) pairs.emplace_back(3, s);
  return pairs;
}

Solids untagged(const gmsh::vectorpair& pairs) {
  Solids solids;
  for (const auto& [dim, tag] : pairs) {
    if (dim == 3) solids.push_back(tag);
  }
  return solids;
}

void require(bool holds, const char* operation, double found, double low, double high) {
  if (holds) return;
  throw NumericsError(
      fmt::format("boolean {}: found volume {:.9g}, expected {:.9g} to {:.9g}: the geometry kernel "
                  "lost or doubled a piece; change a dimension that makes faces coincide",
                  operation, found, low, high));
}

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// OpenCASCADE reports its transfers on stdout, which is reserved for --json.
class QuietStdout {
 public:
  QuietStdout() : kept_(std::cout.rdbuf(nullptr)) {}
  ~QuietStdout() {
    std::cout.rdbuf(kept_);
    std::cout.clear();
  }
  QuietStdout(const QuietStdout&) = delete;
  QuietStdout& operator=(const QuietStdout&) = delete;

 private:
  std::streambuf* kept_;
};

// OpenCASCADE's names of units.
std::string occ_unit(const std::string& unit) {
  if (unit == "m") return "M";
  if (unit == "cm") return "CM";
  if (unit == "in") return "INCH";
  return "MM";
}

// gmsh 4.8 sets the unit before it creates OpenCASCADE's IGES reader, which has no units until
// then: the first file of a process is read twice.
void wake_iges_units(const std::filesystem::path& path) {
  std::string current;
  gmsh::model::getCurrent(current);
  gmsh::option::setString("Geometry.OCCTargetUnit", "");
  gmsh::model::add("iges");
  gmsh::vectorpair unused;
  occ::importShapes(path.string(), unused);
  gmsh::model::remove();
  gmsh::model::setCurrent(current);
}

}  // namespace

void GmshSession::synchronize() {
  if (synchronized_) return;
  occ::synchronize();
  synchronized_ = true;
}

Solid GmshSession::box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  const Eigen::Vector3d d = max - min;
  synchronized_ = false;
  return gmsh_call("box",
                   [&] { return occ::addBox(min.x(), min.y(), min.z(), d.x(), d.y(), d.z()); });
}

Solid GmshSession::cylinder(const Eigen::Vector3d& base, const Eigen::Vector3d& axis,
                            double radius) {
  synchronized_ = false;
  return gmsh_call("cylinder", [&] {
    return occ::addCylinder(base.x(), base.y(), base.z(), axis.x(), axis.y(), axis.z(), radius);
  });
}

Solid GmshSession::prism(const std::vector<Eigen::Vector3d>& polygon,
                         const Eigen::Vector3d& extrusion) {
  synchronized_ = false;
  return gmsh_call("prism", [&] {
    std::vector<int> points, lines;
    for (const Eigen::Vector3d& p : polygon) points.push_back(occ::addPoint(p.x(), p.y(), p.z()));
    for (size_t i = 0; i < points.size(); ++i) {
      lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
    }
    const int face = occ::addPlaneSurface({occ::addCurveLoop(lines)});
    gmsh::vectorpair out;
    occ::extrude({{2, face}}, extrusion.x(), extrusion.y(), extrusion.z(), out);
    const Solids solids = untagged(out);
    if (solids.size() != 1) throw NumericsError("prism: the polygon gives no solid");
    return solids.front();
  });
}

Solids GmshSession::fuse(const Solids& objects, const Solids& tools) {
  const double a = volume(objects), b = volume(tools);
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  gmsh_call("boolean fuse", [&] { occ::fuse(tagged(objects), tagged(tools), out, map); });
  synchronized_ = false;
  const Solids result = untagged(out);
  const double v = volume(result), slack = kVolumeTolerance * (a + b);
  const double low = std::max(objects.size() == 1 ? a : 0.0, tools.size() == 1 ? b : 0.0);
  require(!result.empty() && v >= low - slack && v <= a + b + slack, "fuse", v, low, a + b);
  return result;
}

Solids GmshSession::cut(const Solids& objects, const Solids& tools) {
  const double a = volume(objects), b = volume(tools);
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  gmsh_call("boolean cut", [&] { occ::cut(tagged(objects), tagged(tools), out, map); });
  synchronized_ = false;
  const Solids result = untagged(out);
  const double v = volume(result), slack = kVolumeTolerance * a;
  const double low = std::max(0.0, a - b);
  require(!result.empty() && v >= low - slack && v <= a + slack, "cut", v, low, a);
  return result;
}

Solids GmshSession::intersect(const Solids& objects, const Solids& tools) {
  const double high = std::min(volume(objects), volume(tools));
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  gmsh_call("boolean intersect", [&] { occ::intersect(tagged(objects), tagged(tools), out, map); });
  synchronized_ = false;
  const Solids result = untagged(out);
  const double v = volume(result);
  require(!result.empty() && v > 0.0 && v <= high * (1.0 + kVolumeTolerance), "intersect", v, 0.0,
          high);
  return result;
}

std::vector<Solids> GmshSession::fragment(const Solids& solids) {
  std::vector<double> before;
  for (Solid s : solids) before.push_back(volume({s}));
  const std::vector<Solids> pieces = join(solids);
  for (size_t i = 0; i < solids.size(); ++i) {
    const double v = volume(pieces[i]), slack = kVolumeTolerance * before[i];
    require(std::abs(v - before[i]) <= slack, "fragment", v, before[i] - slack, before[i] + slack);
  }
  return pieces;
}

std::vector<Solids> GmshSession::join(const Solids& solids, double within) {
  gmsh::vectorpair out;
  std::vector<gmsh::vectorpair> map;
  gmsh_call("boolean fragment", [&] {
    gmsh::option::setNumber("Geometry.ToleranceBoolean", within);
    occ::fragment(tagged(solids), {}, out, map);
    gmsh::option::setNumber("Geometry.ToleranceBoolean", 0.0);
  });
  synchronized_ = false;
  std::vector<Solids> pieces;
  for (size_t i = 0; i < solids.size(); ++i) pieces.push_back(untagged(map.at(i)));
  return pieces;
}

std::string GmshSession::name_of(Solid solid) {
  return gmsh_call("names", [&] {
    synchronize();
    std::string name;
    gmsh::model::getEntityName(3, solid, name);
    name.erase(0, name.rfind('/') + 1);                   // of "Shapes/Engine/Nut M8"
    return name.starts_with("Open CASCADE") ? "" : name;  // a default name
  });
}

double GmshSession::area(const Solids& solids) {
  return gmsh_call("area", [&] {
    synchronize();
    gmsh::vectorpair faces;
    gmsh::model::getBoundary(tagged(solids), faces, false, false, false);
    double sum = 0.0;
    for (const auto& [dim, tag] : faces) {
      double one = 0.0;
      occ::getMass(dim, tag, one);
      sum += one;
    }
    return sum;
  });
}

Solids GmshSession::copy(const Solids& solids) {
  gmsh::vectorpair out;
  gmsh_call("copy", [&] { occ::copy(tagged(solids), out); });
  synchronized_ = false;
  return untagged(out);
}

void GmshSession::rotate(const Solids& solids, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& axis, double angle_deg) {
  gmsh_call("rotate", [&] {
    occ::rotate(tagged(solids), point.x(), point.y(), point.z(), axis.x(), axis.y(), axis.z(),
                angle_deg * std::numbers::pi / 180.0);
  });
  synchronized_ = false;
}

double GmshSession::volume(const Solids& solids) const {
  double sum = 0.0;
  for (Solid s : solids) {
    double mass = 0.0;
    gmsh_call("volume", [&] { occ::getMass(3, s, mass); });
    sum += mass;
  }
  return sum;
}

Eigen::Vector3d GmshSession::centre(Solid solid) const {
  double x = 0.0, y = 0.0, z = 0.0;
  gmsh_call("centre", [&] { occ::getCenterOfMass(3, solid, x, y, z); });
  return {x, y, z};
}

Solids GmshSession::all_solids() const {
  gmsh::vectorpair pairs;
  gmsh_call("solids", [&] { occ::getEntities(pairs, 3); });
  return untagged(pairs);
}

gmsh::vectorpair GmshSession::import_shapes(const std::filesystem::path& path,
                                            const std::string& unit, bool make_solids) {
  if (!std::filesystem::exists(path)) {
    throw InputError(fmt::format("{}: file not found", path.string()));
  }
  const std::string extension = extension_of(path);
  const bool known = extension == ".step" || extension == ".stp" || extension == ".brep" ||
                     extension == ".iges" || extension == ".igs";
  if (!known) {
    throw InputError(
        fmt::format("{}: found extension '{}', expected .step, .stp, .brep, .iges "
                    "or .igs",
                    path.string(), extension));
  }
  enter_step("reading " + path.string());
  const bool iges = extension == ".iges" || extension == ".igs";
  gmsh::vectorpair out;
  gmsh_call<InputError>(path.string(), [&] {
    const QuietStdout quiet;
    if (iges) wake_iges_units(path);
    gmsh::option::setString("Geometry.OCCTargetUnit", occ_unit(unit));  // before import (G6)
    // IGES mostly holds separate faces: they are sewn to solids.
    gmsh::option::setNumber("Geometry.OCCSewFaces", iges);
    gmsh::option::setNumber("Geometry.OCCMakeSolids", iges && make_solids);
    occ::importShapes(path.string(), out);
    if (extension == ".step" || extension == ".stp")
      named_ = named_faces_of_step(path, occ_unit(unit));
  });
  synchronized_ = false;
  return out;
}

Solids GmshSession::import_cad(const std::filesystem::path& path, const std::string& unit) {
  const gmsh::vectorpair shapes = import_shapes(path, unit, true);
  const Solids solids = untagged(shapes);
  if (!solids.empty()) return solids;
  const bool has_faces =
      std::ranges::any_of(shapes, [](const auto& pair) { return pair.first == 2; });
  throw InputError(fmt::format("{}: found no solid, expected at least one{}", path.string(),
                               has_faces ? "; kind = \"sheet\" meshes its faces as shells" : ""));
}

Solids GmshSession::import_sheet(const std::filesystem::path& path, const std::string& unit) {
  const gmsh::vectorpair shapes = import_shapes(path, unit, false);
  const Solids solids = untagged(shapes);
  if (solids.empty() && all_faces().empty())
    throw InputError(
        fmt::format("{}: found neither a solid nor a face, expected a sheet", path.string()));
  return solids;
}

Solids GmshSession::replace_solids(const void* shape) {
  return gmsh_call("solids", [&] {
    gmsh::vectorpair all, out;
    occ::getEntities(all, 3);
    occ::remove(all, true);
    synchronized_ = false;
    synchronize();
    occ::importShapesNativePointer(shape, out);
    synchronized_ = false;
    return untagged(out);
  });
}

std::string cad_extension(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension != ".step" && extension != ".stp" && extension != ".brep") {
    throw InputError(fmt::format("{}: found extension '{}', expected .step, .stp or .brep",
                                 path.string(), extension));
  }
  return extension;
}

void GmshSession::write_cad(const std::filesystem::path& path, const std::string& unit) {
  cad_extension(path);
  const std::filesystem::path part = path.parent_path() / ("part." + path.filename().string());
  gmsh_call<FileError>(path.string(), [&] {
    const QuietStdout quiet;
    synchronize();
    gmsh::option::setString("Geometry.OCCTargetUnit", occ_unit(unit));
    gmsh::write(part.string());
  });
  std::error_code trouble;
  std::filesystem::rename(part, path, trouble);
  if (trouble) throw FileError(fmt::format("{}: {}", path.string(), trouble.message()));
}

}  // namespace clatter::mesh
