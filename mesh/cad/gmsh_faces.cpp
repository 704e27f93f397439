// SPDX-License-Identifier: GPL-3.0-or-later
// Properties of the faces of solids from Gmsh and OpenCASCADE: samples, shapes, curvature.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesh/cad/gmsh_call.hpp"
#include "mesh/cad/gmsh_session.hpp"

namespace clatter::mesh {
namespace {

constexpr int kSurfaceSamples = 5;  // per direction

std::vector<Eigen::Vector3d> points_of(int dim, int tag, const std::vector<double>& parameters) {
  std::vector<double> coordinates;
  gmsh::model::getValue(dim, tag, parameters, coordinates);
  std::vector<Eigen::Vector3d> points;
  for (size_t i = 0; i + 2 < coordinates.size(); i += 3) {
    points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  }
  return points;
}

std::vector<Eigen::Vector3d> sample_edge(int curve) {
  std::vector<double> low, high, t;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  for (int i = 0; i < kEdgeSamples; ++i)
    t.push_back(low[0] + (high[0] - low[0]) * i / (kEdgeSamples - 1));
  return points_of(1, curve, t);
}

std::vector<Eigen::Vector3d> sample_edges(int face) {
  gmsh::vectorpair curves;
  gmsh::model::getBoundary({{2, face}}, curves, false, false, false);
  std::vector<Eigen::Vector3d> points;
  for (const auto& [dim, tag] : curves) {
    const auto on_curve = sample_edge(tag);
    points.insert(points.end(), on_curve.begin(), on_curve.end());
  }
  return points;
}

std::vector<double> surface_parameters(int face) {
  std::vector<double> low, high, uv;
  gmsh::model::getParametrizationBounds(2, face, low, high);
  for (int i = 0; i < kSurfaceSamples; ++i) {
    for (int j = 0; j < kSurfaceSamples; ++j) {
      uv.push_back(low[0] + (high[0] - low[0]) * (i + 0.5) / kSurfaceSamples);
      uv.push_back(low[1] + (high[1] - low[1]) * (j + 0.5) / kSurfaceSamples);
    }
  }
  return uv;
}

// Normals are undefined at poles and apexes: those samples are skipped.
SurfaceShape shape_of(int face, const FaceFacts& facts, const std::vector<double>& uv) {
  std::vector<double> n;
  gmsh::model::getNormal(face, uv, n);
  std::vector<Eigen::Vector3d> points, normals;
  for (size_t i = 0; i < facts.surface_points.size(); ++i) {
    const Eigen::Vector3d normal(n[3 * i], n[3 * i + 1], n[3 * i + 2]);
    if (!normal.allFinite() || !(std::abs(normal.norm() - 1.0) < 1e-6)) continue;
    points.push_back(facts.surface_points[i]);
    normals.push_back(normal);
  }
  return find_shape(facts.kind, points, normals);
}

FaceFacts facts_of(int face) {
  FaceFacts facts;
  facts.tag = face;
  gmsh::model::getType(2, face, facts.kind);
  gmsh::model::occ::getMass(2, face, facts.area);
  double x, y, z;
  gmsh::model::occ::getCenterOfMass(2, face, x, y, z);
  facts.centre = {x, y, z};
  facts.edge_points = sample_edges(face);
  const std::vector<double> uv = surface_parameters(face);
  facts.surface_points = points_of(2, face, uv);
  facts.shape = shape_of(face, facts, uv);
  if (facts.kind == "Cylinder") {
    std::vector<double> largest, smallest, direction_1, direction_2;
    gmsh::model::getPrincipalCurvatures(face, {uv[0], uv[1]}, largest, smallest, direction_1,
                                        direction_2);
    facts.radius = 1.0 / std::max(std::abs(largest[0]), std::abs(smallest[0]));
  }
  return facts;
}

}  // namespace

std::vector<double> GmshSession::radii(int face) {
  return gmsh_call("gmsh: curvature", [&] {
    synchronize();
    std::vector<double> largest, smallest, direction_1, direction_2;
    gmsh::model::getPrincipalCurvatures(face, surface_parameters(face), largest, smallest,
                                        direction_1, direction_2);
    std::vector<double> found;
    for (size_t i = 0; i < largest.size(); ++i) {
      double curvature = 0.0;
      for (const double k : {largest[i], smallest[i]})
        if (std::isfinite(k)) curvature = std::max(curvature, std::abs(k));
      found.push_back(1.0 / curvature);
    }
    return found;
  });
}

double GmshSession::smallest_radius(int face) {
  const std::vector<double> all = radii(face);
  const auto least = std::min_element(all.begin(), all.end());
  return least == all.end() || std::isinf(*least) ? 0.0 : *least;
}

// Bores of radius 20, length 30 and of 30, 20 about one centre have the same area: the inertia
// tells them apart.
std::string GmshSession::name_of(const FaceFacts& face) const {
  constexpr double kSame = 1e-6;
  const double size = std::sqrt(face.area);
  for (const NamedFace& named : named_) {
    if (std::abs(named.area - face.area) > kSame * face.area ||
        (named.centre - face.centre).norm() > kSame * size)
      continue;
    std::vector<double> inertia;
    gmsh::model::occ::getMatrixOfInertia(2, face.tag, inertia);
    const double polar = inertia.at(0) + inertia.at(4) + inertia.at(8);
    if (std::abs(named.polar - polar) <= 10.0 * kSame * polar) return named.name;
  }
  return "";
}

std::map<size_t, PlaceOnGeometry> GmshSession::places_of_nodes() const {
  return gmsh_call("gmsh: parameters of nodes", [&] {
    std::map<size_t, PlaceOnGeometry> places;
    for (const int dim : {1, 2}) {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dim);
      for (const auto& [of_dim, tag] : entities) {
        std::vector<size_t> nodes;
        std::vector<double> x, all;
        gmsh::model::mesh::getNodes(nodes, x, all, dim, tag, false, true);
        const auto each = static_cast<size_t>(dim);
        if (all.size() != each * nodes.size()) gmsh::model::getParametrization(dim, tag, x, all);
        for (size_t i = 0; i < nodes.size(); ++i) {
          PlaceOnGeometry& place = places[nodes[i]];
          place = {dim, tag, {}};
          std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(each * i), each, place.at.begin());
        }
      }
    }
    return places;
  });
}

Eigen::Vector3d GmshSession::nearest_point(const Eigen::Vector3d& x, PlaceOnGeometry& place) {
  constexpr int kSteps = 5;
  constexpr double kSame = 1e-12;  // of the range of the parameters
  return gmsh_call("gmsh: nearest point", [&] {
    std::vector<double> low, high, value, gradient;
    gmsh::model::getParametrizationBounds(place.dim, place.tag, low, high);
    const Eigen::Map<const Eigen::VectorXd> from(low.data(), place.dim), to(high.data(), place.dim);
    Eigen::Map<Eigen::VectorXd> at(place.at.data(), place.dim);
    for (int step = 0;; ++step) {
      const std::vector<double> parameters(at.begin(), at.end());
      gmsh::model::getValue(place.dim, place.tag, parameters, value);
      const Eigen::Vector3d found(value.at(0), value.at(1), value.at(2));
      if (step == kSteps) return found;
      gmsh::model::getDerivative(place.dim, place.tag, parameters, gradient);
      const Eigen::Map<Eigen::MatrixXd> J(gradient.data(), 3, place.dim);
      const Eigen::VectorXd change = (J.transpose() * J).ldlt().solve(J.transpose() * (x - found));
      if (!change.allFinite()) return found;
      const Eigen::VectorXd next = (at + change).cwiseMax(from).cwiseMin(to);
      if (((next - at).array().abs() <= kSame * (to - from).array()).all()) return found;
      at = next;
    }
  });
}

std::vector<FaceFacts> GmshSession::boundary_faces() { return faces(false); }

std::vector<FaceFacts> GmshSession::faces_of_solids() { return faces(true); }

std::vector<FaceFacts> GmshSession::faces(bool shared) {
  return gmsh_call("faces", [&] {
    synchronize();
    gmsh::vectorpair tags;
    gmsh::model::getEntities(tags, 2);
    gmsh::vectorpair solids;
    gmsh::model::getEntities(solids, 3);
    std::vector<FaceFacts> facts;
    for (const auto& [dim, tag] : tags) {
      std::vector<int> up, down;
      gmsh::model::getAdjacencies(2, tag, up, down);
      if (up.size() == 1 || solids.empty()) facts.push_back(facts_of(tag));
      if (up.size() == 2 && shared) facts.insert(facts.end(), 2, facts_of(tag));
    }
    for (FaceFacts& face : facts) face.name = name_of(face);
    return facts;
  });
}

std::vector<FaceFacts> GmshSession::edges() {
  return gmsh_call("edges", [&] {
    synchronize();
    gmsh::vectorpair tags;
    gmsh::model::getEntities(tags, 1);
    std::vector<FaceFacts> facts;
    for (const auto& [dim, tag] : tags) {
      FaceFacts& edge = facts.emplace_back();
      edge.tag = tag;
      edge.edge_points = sample_edge(tag);
      edge.centre = edge.edge_points[kEdgeSamples / 2];
    }
    return facts;
  });
}

BoxFilter GmshSession::extent() {
  constexpr double kFar = 1e300;
  BoxFilter box{Eigen::Vector3d::Constant(kFar), Eigen::Vector3d::Constant(-kFar)};
  for (const FaceFacts& face : boundary_faces()) {
    for (const Eigen::Vector3d& x : face.edge_points) {
      box.min = box.min.cwiseMin(x);
      box.max = box.max.cwiseMax(x);
    }
  }
  return box;
}

}  // namespace clatter::mesh
