// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/balance_slopes.hpp"

#include <cmath>

#include "dynamics/film/face_law.hpp"

namespace clatter::film {

void BalanceSlopes::subtract(const RowMatrix& dh, const Eigen::VectorXd* height,
                             RowMatrix& rows) const {
  const FilmExtent& extent = terms_.extent();
  if (!terms_.stage().steady) subtract_storage(dh, rows);
  subtract_faces(dh, rows);
  subtract_rims(dh, rows);
  if (extent.partial() && height != nullptr) {
    const Eigen::ArrayXd slopes = by_height();
    for (int c = 0; c < pad_.grid().size(); ++c)
      rows.row(pad_.row(c)).head(dh.cols()) -= slopes[c] * height->transpose();
  }
  for (int c = 0; c < pad_.grid().size(); ++c)
    if (extent.is_given(c)) rows.row(pad_.row(c)).setZero();
  if (pad_.grooves() && terms_.stage().recesses != nullptr) subtract_grooves(dh, rows);
}

// What the wall carries is proportional to its speed.
void BalanceSlopes::subtract_by_speed(RowMatrix& rows) const {
  const double speed = terms_.stage().speed_axial;
  if (speed == 0.0) return;
  const auto at = [&](int cell) -> double& { return rows(pad_.row(cell), 0); };
  for (size_t f = 0; f < pad_.faces().size(); ++f) {
    if (!pad_.faces()[f].axial) continue;
    const FaceTerms& face = terms_.faces()[f];
    const double flow = (face.carry * split_.on_face(terms_, f).at(fill_[face.upstream()]) +
                         known_flow(PadFaces::face_flow(f))) /
                        speed;
    at(face.a) -= flow;
    at(face.b) += flow;
  }
  for (size_t r = 0; r < pad_.rims().size(); ++r) {
    if (!pad_.rims()[r].axial) continue;
    const RimTerms& rim = terms_.rims()[r];
    at(rim.cell) -= ((rim.carry > 0.0 ? rim.carry * split_.on_rim(terms_, r).at(fill_[rim.cell])
                                      : rim.entering) +
                     known_flow(pad_.rim_flow(r))) /
                    speed;
  }
  for (int c = 0; c < pad_.grid().size(); ++c) {
    if (terms_.extent().is_given(c)) at(c) = 0.0;
    if (terms_.extent().is_given(c) || !terms_.extent().partial()) continue;
    at(c) -= std::abs(terms_.covered(c)) * split_.end_thickness(terms_, c, fill_[c], pressure_[c]) /
             speed;
  }
}

// What the wall carries in the stage over a face where it is known.
double BalanceSlopes::known_flow(Eigen::Index flow) const {
  const KnownFlows* known = terms_.stage().known;
  if (known == nullptr || !known->at[static_cast<size_t>(flow)]) return 0.0;
  return terms_.stage().kappa * known->rate[flow] / terms_.volume_scale();
}

void BalanceSlopes::subtract_storage(const RowMatrix& dh, RowMatrix& rows) const {
  const bool partial = terms_.extent().partial();
  Eigen::ArrayXd held = terms_.density(pressure_, fill_) * pad_.grid().area();
  if (partial) held *= terms_.stage().cover->of_cells(pad_.grid().n_angle());
  for (int c = 0; c < pad_.grid().size(); ++c)
    rows.row(pad_.row(c)).head(dh.cols()) =
        -(held[c] * terms_.film().d_content[c] / terms_.volume_scale() +
          (partial
               ? std::abs(terms_.covered(c)) * split_.end_slope(terms_, c, fill_[c], pressure_[c])
               : 0.0)) *
        dh.row(c);
}

void BalanceSlopes::subtract_faces(const RowMatrix& dh, RowMatrix& rows) const {
  const FilmCells& film = terms_.film();
  const FilmStage& stage = terms_.stage();
  const double mobility = terms_.mobility();
  for (size_t f = 0; f < pad_.faces().size(); ++f) {
    const Face& face = pad_.faces()[f];
    const FaceTerms& terms = terms_.faces()[f];
    const int a = face.a, b = face.b, upstream = terms.upstream();
    const Eigen::ArrayXd &g = film.flow(face.axial), &dg = film.d_flow(face.axial);
    const OpenPart part = terms_.open_face(f);
    const double drive =
        mobility * face.length * part.length / part.distance * (pressure_[a] - pressure_[b]);
    const double moved = stage.duration() * stage.speed(face.axial) * face.length * part.carried /
                         terms_.volume_scale();
    // By the values beside the face, and from those to the cells' own.
    const auto [g_a, g_b] = part.beside(g[a], g[b]);
    double by_a = drive * conductance_slope(g_a, g_b), by_b = drive * conductance_slope(g_b, g_a);
    part.to_cells(by_a, by_b);
    by_a *= dg[a];
    by_b *= dg[b];
    if (split_.carries_content(terms_, f)) {
      const int content = terms_.content_cell(terms);
      (content == a ? by_a : by_b) +=
          moved * 2.0 * (1.0 + terms.lift) * fill_[upstream] * film.d_content[content];
    } else {
      const double drag = moved * split_.on_face(terms_, f).at(fill_[upstream]);
      const auto [c_a, c_b] = part.beside(film.carry[a], film.carry[b]);
      double by_c_a = drag * carry_slope(c_a, c_b), by_c_b = drag * carry_slope(c_b, c_a);
      part.to_cells(by_c_a, by_c_b);
      by_a += by_c_a * film.d_carry[a];
      by_b += by_c_b * film.d_carry[b];
    }
    if (by_a == 0.0 && by_b == 0.0) continue;
    double *to_a = rows.row(pad_.row(a)).data(), *to_b = rows.row(pad_.row(b)).data();
    for (Eigen::Index m = 0; m < dh.cols(); ++m) {
      const double flow = by_a * dh(a, m) + by_b * dh(b, m);
      to_a[m] -= flow;
      to_b[m] += flow;
    }
  }
}

void BalanceSlopes::subtract_rims(const RowMatrix& dh, RowMatrix& rows) const {
  const FilmCells& film = terms_.film();
  const FilmStage& stage = terms_.stage();
  for (size_t r = 0; r < pad_.rims().size(); ++r) {
    const Rim& rim = pad_.rims()[r];
    const int c = rim.cell;
    const double g = film.flow(rim.axial)[c], dg = film.d_flow(rim.axial)[c];
    const double outward = rim.sign * stage.speed(rim.axial);
    const OpenPart part = terms_.open_rim(r);
    const double drive = terms_.mobility() * rim.length * part.length / part.distance *
                         (pressure_[c] - rim.edge.pressure);
    const double carried = outward <= 0.0 ? terms_.rims()[r].inflow.slope
                           : split_.rim_carries_content(terms_, r)
                               ? 2.0 * fill_[c] * film.d_content[c]
                               : split_.on_rim(terms_, r).at(fill_[c]) * film.d_carry[c];
    const double drag =
        stage.duration() * outward * rim.length * part.carried * carried / terms_.volume_scale();
    rows.row(pad_.row(c)).head(dh.cols()) -= (drive * 3.0 * g * g * dg + drag) * dh.row(c);
  }
}

// What flows into the groove beside a cell.
void BalanceSlopes::subtract_grooves(const RowMatrix& dh, RowMatrix& rows) const {
  const PadGrid& grid = pad_.grid();
  const RecessCells& recesses = *terms_.stage().recesses;
  for (int c = 0; c < grid.size(); ++c) {
    if (!terms_.extent().is(CellKind::kBesideGroove, c)) continue;
    const double g = terms_.film().flow_axial[c];
    rows.row(pad_.row(c)).head(dh.cols()) -=
        terms_.mobility() * 3.0 * g * g * terms_.film().d_flow_axial[c] *
        grid.arc(c / grid.n_axial()) / grid.height(c % grid.n_axial()) *
        groove_conductance(recesses.share[c]) * (pressure_[c] - recesses.pressure[c]) * dh.row(c);
  }
}

// By the pad's height at fixed unknowns and gaps.
Eigen::ArrayXd BalanceSlopes::by_height() const {
  const PadGrid& grid = pad_.grid();
  const FilmCells& film = terms_.film();
  const FilmStage& stage = terms_.stage();
  const double mobility = terms_.mobility();
  Eigen::ArrayXd slopes =
      terms_.density(pressure_, fill_) * film.content * grid.area() / terms_.volume_scale();
  slopes *= stage.cover->share_slope.replicate(grid.n_angle(), 1);
  for (size_t f = 0; f < pad_.faces().size(); ++f) {
    const Face& face = pad_.faces()[f];
    const int a = face.a, b = face.b;
    const OpenPart part = terms_.open_face(f);
    const Eigen::ArrayXd& g = film.flow(face.axial);
    const auto [g_a, g_b] = part.beside(g[a], g[b]);
    const auto [c_a, c_b] = part.beside(film.carry[a], film.carry[b]);
    // Of a function of two values beside the face through that of the less covered cell.
    auto through_outer = [&](auto&& slope, double v_a, double v_b, double own_a, double own_b) {
      return part.outer_is_b ? slope(v_b, v_a) * (own_b - own_a) * part.outer_slope
                             : slope(v_a, v_b) * (own_a - own_b) * part.outer_slope;
    };
    double change = face_conductance(g_a, g_b) *
                    (part.length_slope - part.length * part.distance_slope / part.distance);
    change += part.length * through_outer(conductance_slope, g_a, g_b, g[a], g[b]);
    change *= mobility * face.length / part.distance * (pressure_[a] - pressure_[b]);
    const double moved =
        stage.kappa * stage.speed(face.axial) * face.length / terms_.volume_scale();
    const double fill = split_.on_face(terms_, f).at(fill_[terms_.faces()[f].upstream()]);
    change += moved * fill * face_carry(c_a, c_b) * part.carried_slope;
    if (!split_.carries_content(terms_, f))
      change += moved * fill * part.carried *
                through_outer(carry_slope, c_a, c_b, film.carry[a], film.carry[b]);
    slopes[a] += change;
    slopes[b] -= change;
  }
  for (size_t r = 0; r < pad_.rims().size(); ++r) {
    const Rim& rim = pad_.rims()[r];
    const int c = rim.cell;
    const OpenPart part = terms_.open_rim(r);
    const double g = film.flow(rim.axial)[c];
    const double outward = rim.sign * stage.speed(rim.axial);
    const double carried = outward > 0.0 ? split_.on_rim(terms_, r).at(fill_[c]) * film.carry[c]
                                         : terms_.rims()[r].inflow.value;
    slopes[c] +=
        mobility * rim.length / part.distance * g * g * g *
            (part.length_slope - part.length * part.distance_slope / part.distance) *
            (pressure_[c] - rim.edge.pressure) +
        stage.kappa * outward * rim.length * carried * part.carried_slope / terms_.volume_scale();
  }
  const Eigen::ArrayXd& slope = stage.cover->edge_slope;
  for (int c = 0; c < grid.size(); ++c) {
    const double covered = terms_.covered(c);
    if (covered == 0.0) continue;
    const int j = c % grid.n_axial();
    const double change = terms_.slid(c) * (slope[j + 1] - slope[j]);
    slopes[c] += (covered > 0.0 ? change : -change) *
                 split_.end_thickness(terms_, c, fill_[c], pressure_[c]);
  }
  return slopes;
}

}  // namespace clatter::film
