// SPDX-License-Identifier: GPL-3.0-or-later
#include "film_march.hpp"

#include <Eigen/LU>
#include <cmath>

namespace clatter::film {
namespace {

const double kGamma = 2.0 - std::sqrt(2.0);
const double kDiagonal = 0.5 * kGamma;
const double kWeight = 0.25 * std::sqrt(2.0);

}  // namespace

PadGrid strip(double begin, double end, int cells) {
  return PadGrid::uniform(0.0, 1.0, 1, begin, end, cells, 1.0);
}

Edges strip_edges(const Edge& first, const Edge& last) {
  return {Edge::wall(), Edge::wall(), first, last};
}

Eigen::ArrayXd along(const PadGrid& grid, const std::function<double(double)>& gap) {
  Eigen::ArrayXd h(grid.size());
  for (int i = 0; i < grid.n_angle(); ++i)
    for (int j = 0; j < grid.n_axial(); ++j) h[grid.cell(i, j)] = gap(grid.axial(j));
  return h;
}

FilmCells smooth(const Eigen::ArrayXd& h) {
  FilmCells cells;
  cells.set_smooth(h);
  return cells;
}

double load(const Reynolds& film) { return (film.pressure() * film.grid().area()).sum(); }

double order(double coarse_error, double fine_error) {
  return std::log2(std::abs(coarse_error / fine_error));
}

FilmMarch::FilmMarch(Reynolds& film, std::function<Eigen::ArrayXd(double)> gap, double viscosity,
                     double begin)
    : film_(film), gap_(std::move(gap)), viscosity_(viscosity), time_(begin) {
  content_ = gap_(begin);
  const double kappa = 1e-9;
  stage(begin + kappa, kappa, content_);
  rate_ = (film_.fill() * cells_.content - content_) / kappa;
}

void FilmMarch::stage(double time, double kappa, const Eigen::ArrayXd& before) {
  cells_.set_smooth(gap_(time));
  film_.solve(cells_, before, {kappa, viscosity_, 0.0, 0.0, false});
}

void FilmMarch::implicit_euler(double dt) {
  time_ += dt;
  stage(time_, dt, content_);
  const Eigen::ArrayXd content = film_.fill() * cells_.content;
  rate_ = (content - content_) / dt;
  content_ = content;
}

void FilmMarch::tr_bdf2(double dt) {
  const double kappa = kDiagonal * dt;
  Eigen::ArrayXd before = content_ + kappa * rate_;
  stage(time_ + kGamma * dt, kappa, before);
  const Eigen::ArrayXd middle_rate = (film_.fill() * cells_.content - before) / kappa;
  before = content_ + kWeight * dt * (rate_ + middle_rate);
  stage(time_ + dt, kappa, before);
  content_ = film_.fill() * cells_.content;
  rate_ = (content_ - before) / kappa;
  time_ += dt;
}

Flight::Flight(dynamics::ForceElement& element, Eigen::VectorXd body_mass, Eigen::VectorXd y0,
               Eigen::VectorXd v0)
    : mass(std::move(body_mass)), y(std::move(y0)), v(std::move(v0)), element_(element) {
  a_.setZero(y.size());
  force.setZero(y.size());
}

void Flight::restore(const Flight& earlier) {
  y = earlier.y;
  v = earlier.v;
  a_ = earlier.a_;
  force = earlier.force;
  time = earlier.time;
  refused = earlier.refused;
}

void Flight::start() {
  const double kappa = 1e-12;
  element_.begin_step(time);
  Eigen::VectorXd y_new, a_new;
  const dynamics::Stage first{time, kappa, 0, {}};
  if (!solve_stage(first, y, v, y_new, a_new)) throw std::runtime_error("start refused");
  element_.finish_stage(first);
  element_.accept_step(time);
  a_ = a_new;
}

bool Flight::solve_stage(const dynamics::Stage& stage, const Eigen::VectorXd& y_before,
                         const Eigen::VectorXd& v_before, Eigen::VectorXd& y_new,
                         Eigen::VectorXd& a_new) {
  const double kappa = stage.kappa;
  y_new = y_before + kappa * v_before;
  const Eigen::VectorXd compliance = kappa * kappa * mass.cwiseInverse();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Eigen::VectorXd v_new = (y_new - y_before) / kappa;
    try {
      element_.evaluate(stage, y_new, v_new, true, response_);
    } catch (const dynamics::StepRefused&) {
      return false;
    }
    const Eigen::VectorXd residual =
        y_new - y_before - kappa * v_before - compliance.cwiseProduct(response_.force);
    const Eigen::MatrixXd jacobian =
        Eigen::MatrixXd::Identity(y.size(), y.size()) - compliance.asDiagonal() * response_.tangent;
    const Eigen::VectorXd change = jacobian.partialPivLu().solve(residual);
    if (change.norm() < 1e-15) {
      a_new = response_.force.cwiseQuotient(mass);
      force = response_.force;
      return true;
    }
    y_new -= change;
  }
  return false;
}

bool Flight::step(double dt) {
  const double kappa = kDiagonal * dt;
  element_.begin_step(time);
  const dynamics::Stage middle{time + kGamma * dt, kappa, 1, {kappa}};
  const dynamics::Stage last{time + dt, kappa, 2, {kWeight * dt, kWeight * dt}};
  Eigen::VectorXd y_middle, a_middle, y_last, a_last;
  const Eigen::VectorXd y_before = y + kappa * v, v_before = v + kappa * a_;
  if (!solve_stage(middle, y_before, v_before, y_middle, a_middle)) return ++refused, false;
  element_.finish_stage(middle);
  const Eigen::VectorXd v_middle = v_before + kappa * a_middle;
  if (!solve_stage(last, y + kWeight * dt * (v + v_middle), v + kWeight * dt * (a_ + a_middle),
                   y_last, a_last))
    return ++refused, false;
  element_.finish_stage(last);
  element_.accept_step(time + dt);
  v = v + kWeight * dt * (a_ + a_middle) + kappa * a_last;
  y = y_last;
  a_ = a_last;
  time += dt;
  return true;
}

}  // namespace clatter::film
