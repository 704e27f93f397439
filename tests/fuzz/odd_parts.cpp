// SPDX-License-Identifier: GPL-3.0-or-later
// Parts that are difficult to mesh, as STEP files: odd_parts KIND SEED FILE. Dimensions are random
// by the seed, lengths in mm. Without arguments it lists the kinds.
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace {

namespace occ = gmsh::model::occ;
using gmsh::vectorpair;
using std::numbers::pi;

std::mt19937 engine;

double draw(double low, double high) {
  return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
}
/// Log-uniform between low and high.
double draw_log(double low, double high) { return low * std::pow(high / low, draw(0.0, 1.0)); }
int draw_int(int low, int high) { return low + static_cast<int>(draw(0.0, high - low + 0.999)); }

vectorpair solid(int tag) { return {{3, tag}}; }

vectorpair cut(const vectorpair& object, const vectorpair& tool) {
  vectorpair out;
  std::vector<vectorpair> map;
  occ::cut(object, tool, out, map);
  return out;
}

vectorpair fuse(const vectorpair& object, const vectorpair& tool) {
  vectorpair out;
  std::vector<vectorpair> map;
  occ::fuse(object, tool, out, map);
  return out;
}

int box(double x, double y, double z, double dx, double dy, double dz) {
  return occ::addBox(x, y, z, dx, dy, dz);
}

std::vector<int> edges_of(const vectorpair& body) {
  occ::synchronize();
  vectorpair faces, lines;
  gmsh::model::getBoundary(body, faces, false, false, false);
  gmsh::model::getBoundary(faces, lines, false, false, false);
  std::vector<int> tags;
  for (const auto& [dim, tag] : lines) tags.push_back(std::abs(tag));
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

/// A disk of radius r swept along the points' spline.
vectorpair pipe(const std::vector<std::array<double, 3>>& path, double r) {
  std::vector<int> points;
  for (const auto& p : path) points.push_back(occ::addPoint(p[0], p[1], p[2]));
  const int wire = occ::addWire({occ::addSpline(points)});
  const auto &a = path[0], &b = path[1];
  const std::array<double, 3> t = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const int disk = occ::addDisk(a[0], a[1], a[2], r, r);
  // From the z axis onto the tangent: half a turn about the bisector.
  const double length = std::hypot(t[0], t[1], t[2]);
  occ::rotate({{2, disk}}, a[0], a[1], a[2], t[0] / length, t[1] / length, t[2] / length + 1.0, pi);
  vectorpair out;
  occ::addPipe({{2, disk}}, wire, out);
  occ::remove({{2, disk}});
  for (const auto& entity : out)
    if (entity.first == 3) return {entity};
  return {};
}

void thin_fins() {
  const int n = draw_int(3, 12);
  const double t = draw_log(0.15, 1.0), pitch = t + draw(2.0, 6.0), height = draw(8.0, 40.0);
  vectorpair body = solid(box(0, 0, 0, n * pitch, 30, 5));
  vectorpair fins;
  for (int i = 0; i < n; ++i)
    fins.emplace_back(3, box((i + 0.5) * pitch, 0, 5 - 0.1, t, 30, height));
  fuse(body, fins);
}

void tiny_fillets() {
  const int body = box(0, 0, 0, draw(20, 60), draw(20, 60), draw(10, 40));
  vectorpair out;
  occ::fillet({body}, edges_of(solid(body)), {draw_log(0.02, 2.0)}, out);
}

void near_tangent_bores() {
  const double r = draw(6, 12), gap = draw_log(0.005, 0.5);
  const int a = occ::addCylinder(20, 20, -1, 0, 0, 32, r);
  const int b = occ::addCylinder(20 + 2 * r + gap, 20, -1, 0, 0, 32, r);
  cut(solid(box(0, 0, 0, 80, 40, 30)), {{3, a}, {3, b}});
}

void sliver_faces() {
  const double step = draw_log(0.002, 0.2);
  vectorpair body = fuse(solid(box(0, 0, 0, 40, 30, 10)), solid(box(step, step, 9, 25, 20, 10)));
  const int wedge = box(-5, -5, 0, 60, 60, 20);  // a cut that leaves almost nothing
  occ::rotate(solid(wedge), 0, 0, 0, 0, 1, 0, -draw_log(1e-3, 1e-1));
  occ::translate(solid(wedge), 0, 0, 10 - step);
  cut(body, solid(wedge));
}

void intersecting_cylinders() {
  const double r = draw(8, 12);
  const int a = occ::addCylinder(-30, 0, 0, 60, 0, 0, r);
  const int b = occ::addCylinder(0, -30, 0, 0, 60, 0, r * (1.0 - draw_log(1e-4, 0.3)));
  fuse(solid(a), solid(b));
}

std::vector<std::array<double, 3>> helix(double r, double pitch, double z0, double turns) {
  std::vector<std::array<double, 3>> path;
  const int n = static_cast<int>(16 * turns);
  for (int i = 0; i <= n; ++i) {
    const double a = 2 * pi * turns * i / n;
    path.push_back({r * std::cos(a), r * std::sin(a), z0 + pitch * turns * i / n});
  }
  return path;
}

void thread() {
  const double r = draw(4, 10), pitch = draw(1.0, 2.5), turns = draw(2, 6);
  const int rod = occ::addCylinder(0, 0, 0, 0, 0, pitch * turns + 10, r);
  cut(solid(rod), pipe(helix(r, pitch, 5, turns), 0.3 * pitch));
}

void spring() { pipe(helix(draw(8, 15), draw(5, 8), 0, draw(2, 5)), draw(0.5, 2.0)); }

void hollow_box() {
  const double t = draw_log(0.2, 1.0), x = draw(30, 120), y = draw(30, 80), z = draw(15, 60);
  cut(solid(box(0, 0, 0, x, y, z)), solid(box(t, t, t, x - 2 * t, y - 2 * t, z - 2 * t)));
}

void forty_holes() {
  vectorpair holes;
  const double t = draw_log(0.8, 10.0);
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 5; ++j)
      holes.emplace_back(3, occ::addCylinder(8 + 12 * i + draw(-1, 1), 8 + 12 * j, -1, 0, 0, t + 2,
                                             draw_log(0.3, 5.0)));
  cut(solid(box(0, 0, 0, 100, 64, t)), holes);
}

void cone_tip() {
  const int cone = occ::addCone(0, 0, 0, 0, 0, draw(20, 60), draw(3, 20), 0);
  fuse(solid(cone), solid(occ::addCylinder(0, 0, -10, 0, 0, 10 + draw(0, 5), draw(2, 3))));
}

void torus_knot() {
  std::vector<std::array<double, 3>> path;
  constexpr int kPoints = 60;
  for (int i = 0; i < kPoints - 4; ++i) {  // open: a closed pipe is read as faces without a solid
    const double a = 2 * pi * i / kPoints, ring = 20 + 8 * std::cos(3 * a);
    path.push_back({ring * std::cos(2 * a), ring * std::sin(2 * a), 8 * std::sin(3 * a)});
  }
  pipe(path, draw(0.8, 3.0));
}

void ball_in_a_corner() {
  const double r = draw(5, 15), off = draw_log(1e-3, 1.0);
  const int ball = occ::addSphere(r + off, r + off, r + off, r);
  vectorpair body = cut(solid(box(0, 0, 0, 40, 40, 40)), solid(ball));
  cut(body, solid(occ::addTorus(20, 20, 40, 15, draw(0.5, 4.0))));
}

// A bolted plate: nuts with a thread on rods, all touching; several solids.
void nuts() {
  const int n = draw_int(2, 4);
  const double r = draw(3, 5);
  vectorpair plate = solid(box(-10, -12, -6, 24.0 * n - 4, 24, 6)), rods;
  for (int i = 0; i < n; ++i) {
    const double x = 24.0 * i;
    std::vector<int> points, lines;
    for (int k = 0; k < 6; ++k)
      points.push_back(
          occ::addPoint(x + 1.9 * r * std::cos(k * pi / 3), 1.9 * r * std::sin(k * pi / 3), 0));
    for (size_t k = 0; k < 6; ++k) lines.push_back(occ::addLine(points[k], points[(k + 1) % 6]));
    vectorpair prism;
    occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(lines)})}}, 0, 0, 1.6 * r, prism);
    vectorpair nut;
    for (const auto& entity : prism)
      if (entity.first == 3) nut = {entity};
    const int chamfer = occ::addSphere(x, 0, 0.8 * r, 1.95 * r);
    vectorpair out;
    std::vector<vectorpair> map;
    occ::intersect(nut, solid(chamfer), out, map);
    out = cut(out, solid(occ::addCylinder(x, 0, -1, 0, 0, 3 * r, r)));
    rods.emplace_back(3, occ::addCylinder(x, 0, -6, 0, 0, 6 + 2.2 * r, r));
    plate = cut(plate, solid(occ::addCylinder(x, 0, -7, 0, 0, 8, r)));
  }
}

// A ring between two wavy splines: OpenCASCADE integrates such faces with few points.
void wavy_ring() {
  const int waves = draw_int(5, 40);
  const double depth = draw(0.2, 3.0);
  std::vector<int> points;
  const int n = 6 * waves;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * pi * i / n, r = 25 + depth * std::cos(waves * a);
    points.push_back(occ::addPoint(r * std::cos(a), r * std::sin(a), 0));
  }
  points.push_back(points.front());
  const int outer = occ::addCurveLoop({occ::addSpline(points)});
  const int face = occ::addPlaneSurface({outer});
  vectorpair out;
  occ::extrude({{2, face}}, 0, 0, draw(3, 15), out);
  vectorpair body;
  for (const auto& entity : out)
    if (entity.first == 3) body = {entity};
  cut(body, solid(occ::addCylinder(0, 0, -1, 0, 0, 20, draw(10, 25.0 - depth - 0.3))));
}

const std::map<std::string, std::function<void()>> kKinds = {
    {"thin_fins", thin_fins},
    {"tiny_fillets", tiny_fillets},
    {"near_tangent_bores", near_tangent_bores},
    {"sliver_faces", sliver_faces},
    {"intersecting_cylinders", intersecting_cylinders},
    {"thread", thread},
    {"spring", spring},
    {"hollow_box", hollow_box},
    {"forty_holes", forty_holes},
    {"cone_tip", cone_tip},
    {"torus_knot", torus_knot},
    {"ball_in_a_corner", ball_in_a_corner},
    {"nuts", nuts},
    {"wavy_ring", wavy_ring},
};

int make(const std::string& kind, unsigned seed, const std::string& file) {
  engine.seed(seed);
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::model::add(kind);
  kKinds.at(kind)();
  occ::synchronize();
  vectorpair solids, others;
  gmsh::model::getEntities(solids, 3);
  gmsh::write(file);
  gmsh::finalize();
  std::printf("%zu solids\n", solids.size());
  return solids.empty() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 1)
    for (const auto& [kind, unused] : kKinds) std::puts(kind.c_str());
  if (argc != 4) return argc == 1 ? 0 : 2;
  try {
    return make(argv[1], static_cast<unsigned>(std::stoul(argv[2])), argv[3]);
  } catch (const std::string& text) {
    std::fprintf(stderr, "odd_parts: %s\n", text.c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "odd_parts: %s\n", error.what());
  }
  return 1;
}
