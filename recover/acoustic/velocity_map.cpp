// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/velocity_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"
#include "recover/acoustic/landing.hpp"
#include "recover/acoustic/map_errors.hpp"
#include "recover/skin/triangle6.hpp"

namespace clatter::recover {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

/// A point of an exposed side of a face.
struct Sample {
  int32_t face;                 // of the body's skin
  Shape6 shape;                 // shape functions there
  Eigen::Vector3d at;           // [m]
  Eigen::Vector3d area_vector;  // its share of n dS [m2], n off that side
  Landing landing{};
};

/// Centres of the n^2 parts of a side of a face: 1 along the normal, -1 against it.
void add_samples(const rom::Skin& skin, int32_t face, double side, double spacing,
                 std::vector<Sample>& samples) {
  const Coordinates6 x = face_coordinates(skin.nodes, skin.triangles, face);
  const double size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
  const int n = std::max(2, static_cast<int>(std::ceil(size / spacing)));
  const auto add = [&](double u, double v) {
    const Shape6 shape = shape_functions(u, v);
    const Eigen::Matrix<double, 3, 2> t = x.transpose() * shape_gradients(u, v);
    samples.push_back(
        {face, shape, x.transpose() * shape, side * t.col(0).cross(t.col(1)) / (2.0 * n * n)});
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      add((i + 1.0 / 3.0) / n, (j + 1.0 / 3.0) / n);
      if (i + j + 1 < n) add((i + 2.0 / 3.0) / n, (j + 2.0 / 3.0) / n);
    }
}

std::vector<Sample> exposed_samples(const rom::Skin& skin, const Exposure& exposed,
                                    const sound::Surface& acoustic) {
  const double spacing = acoustic.mean_edge / 5.0;
  std::vector<Sample> samples;
  for (int32_t face = 0; face < skin.triangles.rows(); ++face) {
    if (exposed.front[face]) add_samples(skin, face, 1.0, spacing, samples);
    if (exposed.of_back(face)) add_samples(skin, face, -1.0, spacing, samples);
  }
  if (samples.empty())
    throw InputError("acoustic skin: found no exposed face, expected at least one");
  const LandingSearch search(acoustic);
  parallel_pieces(static_cast<int64_t>(samples.size()), [&](int64_t begin, int64_t end) {
    for (int64_t p = begin; p < end; ++p) {
      Sample& sample = samples[p];
      sample.landing = search.land(sample.at, sample.area_vector.normalized());
    }
  });
  return samples;
}

/// Adds weight . v(sample) to a row.
void add_to_row(const rom::Skin& skin, int32_t row, const Sample& sample,
                const Eigen::Vector3d& weight, Triplets& entries) {
  for (int a = 0; a < 6; ++a)
    for (int d = 0; d < 3; ++d)
      entries.emplace_back(row, 3 * skin.triangles(sample.face, a) + d,
                           sample.shape[a] * weight[d]);
}

void find_lids(const std::vector<Sample>& samples, const sound::Surface& acoustic,
               VelocityMap& out) {
  out.covered.setZero(acoustic.face_count());
  for (const Sample& sample : samples) {
    const int32_t c = sample.landing.face;
    out.covered[c] +=
        sample.area_vector.dot(acoustic.face_normal.row(c).transpose()) / acoustic.face_area[c];
  }
  for (int32_t c = 0; c < acoustic.face_count(); ++c)
    if (out.covered[c] < 0.5) {
      out.lids.push_back(c);
      out.lid_area += acoustic.face_area[c];
    }
}

/// The part of each lid without exposed faces moves with the sample nearest to its centre.
void add_moving_lids(const rom::Skin& skin, const std::vector<Sample>& samples,
                     const sound::Surface& acoustic, const VelocityMap& map, Triplets& entries,
                     FlowMapBuilder& flow) {
  for (int32_t lid : map.lids) {
    const Eigen::Vector3d centre = acoustic.face_centre.row(lid);
    const auto nearest = std::min_element(
        samples.begin(), samples.end(), [&](const Sample& one, const Sample& other) {
          return (one.at - centre).squaredNorm() < (other.at - centre).squaredNorm();
        });
    const double bare = 1.0 - std::clamp(map.covered[lid], 0.0, 1.0);
    const Eigen::Vector3d normal = bare * acoustic.face_normal.row(lid).transpose();
    for (int b = 0; b < 3; ++b) {
      add_to_row(skin, 3 * lid + b, *nearest, normal, entries);
      flow.add(nearest->face, acoustic.triangles(lid, b), nearest->shape,
               acoustic.face_area[lid] / 3.0 * normal);
    }
  }
}

SparseRows assembled(const rom::Skin& skin, const sound::Surface& acoustic,
                     const Triplets& entries) {
  SparseRows map(3 * acoustic.face_count(), 3 * skin.nodes.rows());
  map.setFromTriplets(entries.begin(), entries.end());
  return map;
}

}  // namespace

VelocityMap velocity_map(const rom::Skin& skin, const Exposure& exposed,
                         const sound::Surface& acoustic, LidMotion lids) {
  const std::vector<Sample> samples = exposed_samples(skin, exposed, acoustic);
  VelocityMap out;
  find_lids(samples, acoustic, out);
  Triplets entries;
  FlowMapBuilder flow;
  ExposedFlux flux(skin.nodes.rows());
  for (const Sample& sample : samples) {
    const int32_t c = sample.landing.face;
    const bool is_lid = out.covered[c] < 0.5;
    for (int b = 0; b < 3; ++b) {
      // The inverse of the means of N_a N_b is 12 on the diagonal less 3 everywhere.
      const double weight = is_lid ? 1.0 : 12.0 * sample.landing.shape[b] - 3.0;
      add_to_row(skin, 3 * c + b, sample, weight / acoustic.face_area[c] * sample.area_vector,
                 entries);
      flow.add(sample.face, acoustic.triangles(c, b), sample.shape,
               (is_lid ? 1.0 / 3.0 : sample.landing.shape[b]) * sample.area_vector);
    }
    for (int a = 0; a < 6; ++a)
      flux.add(skin.triangles(sample.face, a), sample.shape[a] * sample.area_vector);
  }
  out.map = assembled(skin, acoustic, entries);
  out.errors = map_errors(skin, acoustic, out, flux);
  if (lids == LidMotion::kNearest) {
    add_moving_lids(skin, samples, acoustic, out, entries, flow);
    out.map = assembled(skin, acoustic, entries);
  }
  out.flow = flow.finish();
  return out;
}

}  // namespace clatter::recover
