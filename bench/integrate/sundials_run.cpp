// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/integrate/sundials_run.hpp"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <ida/ida.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <vector>

#include "core/base/error.hpp"

namespace clatter::bench {

using Eigen::Map;
using Eigen::VectorXd;

namespace {

constexpr long kMostSteps = 50'000'000;
constexpr int kRecoverable = 1;  // SUNDIALS reduces its step

void check(int flag, const char* call) {
  if (flag < 0) throw NumericsError(fmt::format("bench: {} failed with flag {}", call, flag));
}

/// What a callback of SUNDIALS returns: exceptions must not pass through C.
template <class Call>
int guarded(Call&& call) {
  try {
    call();
    return 0;
  } catch (const dynamics::StepRefused&) {
    return kRecoverable;
  } catch (const std::exception&) {
    return -1;
  }
}

}  // namespace

struct SundialsRun::Impl {
  FirstOrder& system;
  const bool is_ida;
  const VectorXd inverse_D;
  SUNContext context = nullptr;
  N_Vector x = nullptr, rate = nullptr, limits = nullptr;
  SUNMatrix matrix = nullptr;
  SUNLinearSolver linear = nullptr;
  void* memory = nullptr;
  VectorXd copy;
  SundialsCounts earlier;  // before the last restart

  Impl(FirstOrder& first_order, SundialsSolver solver)
      : system(first_order),
        is_ida(solver == SundialsSolver::kIda),
        inverse_D(first_order.D().cwiseInverse()) {}

  ~Impl() {
    if (memory != nullptr) is_ida ? IDAFree(&memory) : CVodeFree(&memory);
    if (linear != nullptr) SUNLinSolFree(linear);
    if (matrix != nullptr) SUNMatDestroy(matrix);
    for (const N_Vector vector : {x, rate, limits})
      if (vector != nullptr) N_VDestroy(vector);
    if (context != nullptr) SUNContext_Free(&context);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  static Impl& of(void* data) { return *static_cast<Impl*>(data); }
  Map<VectorXd> map(N_Vector vector) const {
    return {N_VGetArrayPointer(vector), static_cast<Eigen::Index>(system.size())};
  }
  double* values(SUNMatrix J) const {
    std::copy(system.starts().begin(), system.starts().end(), SUNSparseMatrix_IndexPointers(J));
    std::copy(system.rows().begin(), system.rows().end(), SUNSparseMatrix_IndexValues(J));
    return SUNSparseMatrix_Data(J);
  }

  void rates(double time, N_Vector at, N_Vector result) {
    system.evaluate(time, N_VGetArrayPointer(at), N_VGetArrayPointer(result));
    map(result).array() *= inverse_D.array();
  }
  void rates_jacobian(double time, N_Vector at, SUNMatrix J) {
    double* entries = values(J);
    system.jacobian(time, N_VGetArrayPointer(at), entries);
    for (size_t i = 0; i < system.rows().size(); ++i) entries[i] *= inverse_D(system.rows()[i]);
  }
  void residual(double time, N_Vector at, N_Vector slope, N_Vector result) {
    system.evaluate(time, N_VGetArrayPointer(at), N_VGetArrayPointer(result));
    map(result) = system.D().cwiseProduct(map(slope)) - map(result);
  }
  void residual_jacobian(double time, double c, N_Vector at, SUNMatrix J) {
    double* entries = values(J);
    system.jacobian(time, N_VGetArrayPointer(at), entries);
    for (size_t i = 0; i < system.rows().size(); ++i) entries[i] = -entries[i];
    for (int i = 0; i < system.size(); ++i) entries[system.diagonal()[i]] += c * system.D()(i);
  }

  static int cvode_rates(double t, N_Vector at, N_Vector result, void* data) {
    return guarded([&] { of(data).rates(t, at, result); });
  }
  static int cvode_jacobian(double t, N_Vector at, N_Vector, SUNMatrix J, void* data, N_Vector,
                            N_Vector, N_Vector) {
    return guarded([&] { of(data).rates_jacobian(t, at, J); });
  }
  static int cvode_roots(double t, N_Vector at, double* found, void* data) {
    return guarded([&] { of(data).system.event_functions(t, N_VGetArrayPointer(at), found); });
  }
  static int ida_residual(double t, N_Vector at, N_Vector slope, N_Vector result, void* data) {
    return guarded([&] { of(data).residual(t, at, slope, result); });
  }
  static int ida_jacobian(double t, double c, N_Vector at, N_Vector, N_Vector, SUNMatrix J,
                          void* data, N_Vector, N_Vector, N_Vector) {
    return guarded([&] { of(data).residual_jacobian(t, c, at, J); });
  }
  static int ida_roots(double t, N_Vector at, N_Vector, double* found, void* data) {
    return cvode_roots(t, at, found, data);
  }
  static void silent(int, const char*, const char*, char*, void*) {}

  void create(const SundialsOptions& options, double time) {
    const int max_order = options.max_order;
    linear = SUNLinSol_KLU(x, matrix, context);
    if (is_ida) {
      memory = IDACreate(context);
      check(IDAInit(memory, ida_residual, time, x, rate), "IDAInit");
      check(IDASVtolerances(memory, 0.0, limits), "IDASVtolerances");
      check(IDASetUserData(memory, this), "IDASetUserData");
      check(IDASetLinearSolver(memory, linear, matrix), "IDASetLinearSolver");
      check(IDASetJacFn(memory, ida_jacobian), "IDASetJacFn");
      check(IDASetMaxOrd(memory, max_order), "IDASetMaxOrd");
      check(IDASetMaxNumSteps(memory, kMostSteps), "IDASetMaxNumSteps");
      if (!options.test_velocities) leave_out_velocities();
      check(IDASetErrHandlerFn(memory, silent, nullptr), "IDASetErrHandlerFn");
      if (system.events() > 0)
        check(IDARootInit(memory, system.events(), ida_roots), "IDARootInit");
    } else {
      memory = CVodeCreate(CV_BDF, context);
      check(CVodeInit(memory, cvode_rates, time, x), "CVodeInit");
      check(CVodeSVtolerances(memory, 0.0, limits), "CVodeSVtolerances");
      check(CVodeSetUserData(memory, this), "CVodeSetUserData");
      check(CVodeSetLinearSolver(memory, linear, matrix), "CVodeSetLinearSolver");
      check(CVodeSetJacFn(memory, cvode_jacobian), "CVodeSetJacFn");
      check(CVodeSetMaxOrd(memory, max_order), "CVodeSetMaxOrd");
      check(CVodeSetMaxNumSteps(memory, kMostSteps), "CVodeSetMaxNumSteps");
      check(CVodeSetErrHandlerFn(memory, silent, nullptr), "CVodeSetErrHandlerFn");
      if (system.events() > 0)
        check(CVodeRootInit(memory, system.events(), cvode_roots), "CVodeRootInit");
    }
    // Contacts may begin and end: 0, both directions.
    sides.resize(system.events(), 0);
    for (int e = 0; e < system.own_events(); ++e)
      sides[e] = -system.side(e, time, N_VGetArrayPointer(x));
    look_for_changes();
  }

  void leave_out_velocities() {
    const N_Vector is_tested = N_VClone(x);
    map(is_tested).setZero();
    map(is_tested).head(system.modes()).setOnes();
    check(IDASetId(memory, is_tested), "IDASetId");
    check(IDASetSuppressAlg(memory, SUNTRUE), "IDASetSuppressAlg");
    N_VDestroy(is_tested);
  }

  std::vector<int> sides;  // direction in which each event function can change its sign
  void look_for_changes() {
    if (sides.empty()) return;
    check(is_ida ? IDASetRootDirection(memory, sides.data())
                 : CVodeSetRootDirection(memory, sides.data()),
          "SetRootDirection");
  }

  void restart(double time) {
    std::vector<int> found(sides.size());
    check(is_ida ? IDAGetRootInfo(memory, found.data()) : CVodeGetRootInfo(memory, found.data()),
          "GetRootInfo");
    earlier = counts();
    for (size_t e = 0; e < found.size(); ++e) {
      if (found[e] == 0) continue;
      ++earlier.events;
      if (static_cast<int>(e) >= system.own_events()) continue;
      sides[e] = -system.pass_event(static_cast<int>(e), time, N_VGetArrayPointer(x));
    }
    rates(time, x, rate);
    check(is_ida ? IDAReInit(memory, time, x, rate) : CVodeReInit(memory, time, x), "ReInit");
    look_for_changes();
  }

  SundialsCounts counts() const {
    SundialsCounts all = earlier;
    long steps = 0, rejected = 0, evaluations = 0, jacobians = 0;
    if (is_ida) {
      IDAGetNumSteps(memory, &steps);
      IDAGetNumErrTestFails(memory, &rejected);
      IDAGetNumResEvals(memory, &evaluations);
      IDAGetNumJacEvals(memory, &jacobians);
    } else {
      CVodeGetNumSteps(memory, &steps);
      CVodeGetNumErrTestFails(memory, &rejected);
      CVodeGetNumRhsEvals(memory, &evaluations);
      CVodeGetNumJacEvals(memory, &jacobians);
    }
    all.steps += steps;
    all.rejected += rejected;
    all.evaluations += evaluations;
    all.jacobians += jacobians;
    return all;
  }
};

SundialsRun::SundialsRun(FirstOrder& system, const SundialsOptions& options, double time,
                         const VectorXd& x, const VectorXd& limits)
    : impl_(std::make_unique<Impl>(system, options.solver)) {
  Impl& run = *impl_;
  const auto n = static_cast<sunindextype>(system.size());
  check(SUNContext_Create(nullptr, &run.context), "SUNContext_Create");
  run.x = N_VNew_Serial(n, run.context);
  run.rate = N_VNew_Serial(n, run.context);
  run.limits = N_VNew_Serial(n, run.context);
  run.map(run.x) = x;
  run.map(run.limits) = limits;
  run.rates(time, run.x, run.rate);
  run.matrix =
      SUNSparseMatrix(n, n, static_cast<sunindextype>(system.rows().size()), CSC_MAT, run.context);
  run.values(run.matrix);
  run.create(options, time);
}

SundialsRun::~SundialsRun() = default;

const VectorXd& SundialsRun::advance(double time, double end) {
  Impl& run = *impl_;
  double reached = 0.0;
  check(run.is_ida ? IDASetStopTime(run.memory, end) : CVodeSetStopTime(run.memory, end),
        "SetStopTime");
  for (;;) {
    const int flag = run.is_ida ? IDASolve(run.memory, time, &reached, run.x, run.rate, IDA_NORMAL)
                                : CVode(run.memory, time, run.x, &reached, CV_NORMAL);
    check(flag, run.is_ida ? "IDASolve" : "CVode");
    if (flag != CV_ROOT_RETURN) break;  // IDA_ROOT_RETURN is the same number
    run.restart(reached);
  }
  run.copy = run.map(run.x);
  return run.copy;
}

SundialsCounts SundialsRun::counts() const { return impl_->counts(); }

}  // namespace clatter::bench
