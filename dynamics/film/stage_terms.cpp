// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/stage_terms.hpp"

#include <algorithm>

#include "dynamics/film/face_law.hpp"

namespace clatter::film {

StageTerms::StageTerms(PadFaces faces) : pad_(std::move(faces)), extent_(pad_.grid()) {
  const int n = grid().size();
  for (const Face& face : pad_.faces()) faces_.push_back({face.a, face.b});
  for (const Rim& rim : pad_.rims()) rims_.push_back({rim.cell, rim.edge.pressure});
  for (Eigen::ArrayXd* values : {&storage_, &squeeze_, &before_, &covered_}) values->setZero(n);
  if (pad_.grooves()) exchange_.setZero(n);
}

void StageTerms::set(const FilmCells& film, const Eigen::ArrayXd& content_before,
                     const FilmStage& stage) {
  film_ = film;
  stage_ = stage;
  extent_.set(stage.cover, stage.recesses);
  mobility_ = stage.duration() / (12.0 * stage.viscosity);
  Sums sums;
  weigh_faces(sums);
  weigh_rims(sums);
  scale(sums, content_before);
  if (extent_.partial()) weigh_ends();
  if (pad_.grooves()) weigh_grooves();
}

OpenPart StageTerms::open_face(size_t f) const {
  OpenPart part = extent_.open(pad_.faces()[f]);
  if (stage_.known != nullptr && stage_.known->at[f]) part.carried = part.carried_slope = 0.0;
  return part;
}

OpenPart StageTerms::open_rim(size_t r) const {
  OpenPart part = extent_.open(pad_.rims()[r]);
  if (stage_.known != nullptr && stage_.known->at[pad_.rim_flow(r)])
    part.carried = part.carried_slope = 0.0;
  return part;
}

void StageTerms::weigh_faces(Sums& sums) {
  const double duration = stage_.duration();
  for (size_t f = 0; f < faces_.size(); ++f) {
    const Face& face = pad_.faces()[f];
    FaceTerms& terms = faces_[f];
    const OpenPart part = open_face(f);
    terms = {face.a, face.b};
    if (part.closed()) continue;
    const Eigen::ArrayXd& g = film_.flow(face.axial);
    const auto [g_a, g_b] = part.beside(g[face.a], g[face.b]);
    const auto [c_a, c_b] = part.beside(film_.carry[face.a], film_.carry[face.b]);
    const double carry = face_carry(c_a, c_b);
    terms.conduct =
        mobility_ * face_conductance(g_a, g_b) * (face.length * part.length) / part.distance;
    terms.carry = duration * stage_.speed(face.axial) * (face.length * part.carried) * carry;
    sums.conduct += terms.conduct;
    sums.carry += std::abs(terms.carry);
    terms.lift = lift(face);
    // At least 1: a cell that fills must not carry less than it will when it is full.
    if (layers())
      terms.ratio =
          std::max(2.0 * (1.0 + terms.lift) * film_.content[content_cell(terms)] / carry, 1.0);
  }
}

void StageTerms::weigh_rims(Sums& sums) {
  const double duration = stage_.duration();
  const OutsideLayers* outside = stage_.outside;
  for (size_t r = 0; r < rims_.size(); ++r) {
    const Rim& rim = pad_.rims()[r];
    const int c = rim.cell;
    RimTerms& terms = rims_[r];
    terms = {c, rim.edge.pressure};
    if (extent_.is(CellKind::kOutside, c)) continue;
    const OpenPart part = open_rim(r);
    const double g = film_.flow(rim.axial)[c], carry = film_.carry[c];
    terms.conduct = mobility_ * (g * g * g) * (rim.length * part.length) / part.distance;
    terms.carry = duration * stage_.speed(rim.axial) * (rim.length * part.carried) * carry;
    sums.conduct += terms.conduct;
    sums.carry += std::abs(terms.carry);
    terms.carry *= rim.sign;
    Edge edge = rim.edge;
    if (outside != nullptr && rim.axial)
      edge.layer = (rim.sign < 0.0 ? outside->begin : outside->end)[c / grid().n_axial()];
    terms.inflow = entering(edge, c);
    terms.entering = std::min(terms.carry, 0.0) * terms.inflow.value / carry;
    if (layers()) terms.ratio = std::max(2.0 * film_.content[c] / carry, 1.0);
  }
}

void StageTerms::scale(Sums sums, const Eigen::ArrayXd& content_before) {
  const double count = static_cast<double>(faces_.size() + rims_.size());
  storage_ = film_.content * grid().area();
  if (extent_.partial()) storage_ *= stage_.cover->of_cells(grid().n_angle());
  volume_scale_ = stage_.steady ? sums.carry / count : storage_.mean();
  if (!(volume_scale_ > 0.0)) volume_scale_ = 1.0;
  if (!(sums.conduct > 0.0)) sums.conduct = 1.0;  // the entire pad is outside
  pressure_scale_ = volume_scale_ * count / sums.conduct;
  for (FaceTerms& face : faces_) {
    face.conduct *= pressure_scale_ / volume_scale_;
    face.carry /= volume_scale_;
  }
  for (RimTerms& rim : rims_) {
    rim.conduct *= pressure_scale_ / volume_scale_;
    rim.carry /= volume_scale_;
    rim.entering /= volume_scale_;
  }
  if (stage_.steady) {
    storage_.setZero();
    before_.setZero();
  } else {
    storage_ /= volume_scale_;
    before_ = content_before * grid().area() / volume_scale_;
  }
  squeeze_ = storage_ * (compressible() ? pressure_scale_ / stage_.bulk_modulus : 0.0);
}

// The liner slides past the grid at 2 U_m and its ends with it.
double StageTerms::slid(int cell) const {
  return -2.0 * stage_.kappa * stage_.speed_axial / volume_scale_ *
         grid().arc(cell / grid().n_axial());
}

void StageTerms::weigh_ends() {
  const Eigen::ArrayXd& edge = stage_.cover->edge;
  for (int c = 0; c < grid().size(); ++c) {
    const int j = c % grid().n_axial();
    covered_[c] = extent_.is(CellKind::kOutside, c) ? 0.0 : slid(c) * (edge[j + 1] - edge[j]);
  }
}

void StageTerms::weigh_grooves() {
  exchange_.setZero();
  if (stage_.recesses == nullptr) return;
  for (int c = 0; c < grid().size(); ++c) {
    if (!extent_.is(CellKind::kBesideGroove, c)) continue;
    const double g = film_.flow_axial[c];
    exchange_[c] = mobility_ * g * g * g * grid().arc(c / grid().n_axial()) /
                   grid().height(c % grid().n_axial()) *
                   groove_conductance(stage_.recesses->share[c]) * pressure_scale_ / volume_scale_;
  }
}

// Excess on a face over the upstream cell: of the fill, as a fraction of the unfilled part of that
// cell, or of a layer, as a fraction of the layer.
double StageTerms::lift(const Face& face) const {
  const Eigen::ArrayXd* profile = stage_.profile_before;
  const double speed = stage_.speed(face.axial);
  if (profile == nullptr || speed == 0.0) return 0.0;
  const int upstream = speed > 0.0 ? face.a : face.b, downstream = speed > 0.0 ? face.b : face.a;
  const int beyond = speed > 0.0 ? face.beyond_a : face.beyond_b;
  const double here = (*profile)[upstream], whole = layers() ? here : 1.0 - here;
  if (beyond < 0 || whole <= 0.0 || extent_.is(CellKind::kOutside, beyond) ||
      extent_.is(CellKind::kOutside, downstream))
    return 0.0;
  if (extent_.in_recess(upstream) || extent_.in_recess(beyond) || extent_.in_recess(downstream))
    return 0.0;
  const double up = here - (*profile)[beyond], down = (*profile)[downstream] - here;
  if (up * down <= 0.0) return 0.0;
  return std::clamp(up * down / (up + down) / whole, -1.0, 1.0);
}

int StageTerms::content_cell(const FaceTerms& face) const {
  const int upstream = face.upstream();
  if (!extent_.is(CellKind::kGroove, upstream)) return upstream;
  return upstream == face.a ? face.b : face.a;
}

ValueSlope StageTerms::entering(const Edge& edge, int cell) const {
  const double carry = film_.carry[cell], d_carry = film_.d_carry[cell];
  ValueSlope least{edge.fill * carry, edge.fill * d_carry};
  auto bound = [&least](double value, double slope) {
    if (value < least.value) least = {value, slope};
  };
  if (layers()) {
    least = {carry, d_carry};
    bound(2.0 * edge.fill * film_.content[cell], 2.0 * edge.fill * film_.d_content[cell]);
  }
  bound(2.0 * edge.layer, 0.0);
  return least;
}

Eigen::ArrayXd StageTerms::density(const Eigen::ArrayXd& pressure,
                                   const Eigen::ArrayXd& fill) const {
  if (!compressible()) return fill;
  return fill + pressure / stage_.bulk_modulus;
}

}  // namespace clatter::film
