// CVODE for both kinds of work. Only this file includes SUNDIALS.

#include <cvode/cvode.h>
#include <fmt/core.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_types.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sundials/sundials_context.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "bench/speed/contender.hpp"
#include "bench/speed/smooth_contender.hpp"
#include "core/constants.hpp"

namespace dualdamp::bench::speed {
namespace {

enum class CvodeMethod {
  adams,         ///< with fixed-point iteration
  adams_newton,  ///< with dense Newton
  bdf,           ///< with dense Newton
};

/// Functions that CVODE calls, with the pointer given beside them as `data`.
struct CvodeProblem {
  CVRhsFn rate;
  CVRootFn guard;           ///< one value, positive within an interval
  CVLsJacFn jacobian;       ///< nullptr: CVODE's differences
  int root_direction = -1;  ///< of the guard's sign changes that are reported; 0: both
  double relative_tolerance = 0.0;
  std::span<const double> absolute_tolerances{};  ///< one for each state
};

/// One CVODE memory and the objects that it refers to.
class Cvode {
 public:
  Cvode(CvodeMethod method, const CvodeProblem& problem, void* data)
      : state_(N_VNew_Serial(static_cast<sunindextype>(problem.absolute_tolerances.size()), context_), N_VDestroy),
        memory_(CVodeCreate(method == CvodeMethod::bdf ? CV_BDF : CV_ADAMS, context_),
                [](void* m) { CVodeFree(&m); }) {
    void* cvode = memory_.get();
    check(CVodeInit(cvode, problem.rate, 0.0, state_.get()), "CVodeInit");
    const Vector absolute(N_VClone(state_.get()), N_VDestroy);
    std::ranges::copy(problem.absolute_tolerances, N_VGetArrayPointer(absolute.get()));
    check(CVodeSVtolerances(cvode, problem.relative_tolerance, absolute.get()), "CVodeSVtolerances");
    check(CVodeSetUserData(cvode, data), "CVodeSetUserData");
    check(CVodeSetMaxNumSteps(cvode, 1'000'000), "CVodeSetMaxNumSteps");
    check(CVodeRootInit(cvode, 1, problem.guard), "CVodeRootInit");
    int direction = problem.root_direction;
    check(CVodeSetRootDirection(cvode, &direction), "CVodeSetRootDirection");
    method == CvodeMethod::adams ? iterate() : solve_linear(problem);
  }

  [[nodiscard]] double* state() { return N_VGetArrayPointer(state_.get()); }

  /// Starts anew from state().
  void restart(double time) { check(CVodeReInit(memory_.get(), time, state_.get()), "CVodeReInit"); }

  /// Integrates to the next root, or to `end`; true at a root. `time`: the time reached.
  [[nodiscard]] bool advance(double end, double& time) {
    const int status = CVode(memory_.get(), end, state_.get(), &time, CV_NORMAL);
    check(status, "CVode");
    return status == CV_ROOT_RETURN;
  }

 private:
  template <class T>
  using Handle = std::unique_ptr<T, void (*)(T*)>;
  using Vector = Handle<_generic_N_Vector>;

  static void check(int status, const char* call) {
    if (status < 0) throw std::runtime_error(std::string(call) + " failed with " + std::to_string(status));
  }

  void iterate() {
    fixed_point_.reset(SUNNonlinSol_FixedPoint(state_.get(), 0, context_));
    check(CVodeSetNonlinearSolver(memory_.get(), fixed_point_.get()), "CVodeSetNonlinearSolver");
  }

  void solve_linear(const CvodeProblem& problem) {
    const auto size = static_cast<sunindextype>(problem.absolute_tolerances.size());
    matrix_.reset(SUNDenseMatrix(size, size, context_));
    linear_.reset(SUNLinSol_Dense(state_.get(), matrix_.get(), context_));
    check(CVodeSetLinearSolver(memory_.get(), linear_.get(), matrix_.get()), "CVodeSetLinearSolver");
    if (problem.jacobian != nullptr) check(CVodeSetJacFn(memory_.get(), problem.jacobian), "CVodeSetJacFn");
  }

  sundials::Context context_;
  Vector state_;
  Handle<_generic_SUNMatrix> matrix_{nullptr, SUNMatDestroy};
  Handle<_generic_SUNLinearSolver> linear_{nullptr, [](SUNLinearSolver solver) { SUNLinSolFree(solver); }};
  Handle<_generic_SUNNonlinearSolver> fixed_point_{nullptr,
                                                   [](SUNNonlinearSolver solver) { SUNNonlinSolFree(solver); }};
  Handle<void> memory_;
};

// The standard case.

int rigid_rate(realtype t, N_Vector state, N_Vector derivative, void* data) {
  const IntervalField& field = *static_cast<const IntervalField*>(data);
  const double* s = N_VGetArrayPointer(state);
  double* d = N_VGetArrayPointer(derivative);
  d[0] = s[1];
  d[1] = field.acceleration(s[0], s[1], t);
  return 0;
}

int rigid_jacobian(realtype, N_Vector, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector, N_Vector) {
  const IntervalField& field = *static_cast<const IntervalField*>(data);
  SM_ELEMENT_D(matrix, 0, 0) = 0.0;
  SM_ELEMENT_D(matrix, 0, 1) = 1.0;
  SM_ELEMENT_D(matrix, 1, 0) = -field.stiffness;
  SM_ELEMENT_D(matrix, 1, 1) = -field.damping;
  return 0;
}

/// Positive within the interval.
int rigid_guard(realtype, N_Vector state, realtype* value, void* data) {
  value[0] = static_cast<const IntervalField*>(data)->direction * N_VGetArrayPointer(state)[1];
  return 0;
}

struct RigidSolver {
  RigidSolver(const StandardCase& work, double tolerance, CvodeMethod method)
      : field(work),
        absolute{tolerance, tolerance},
        cvode(method,
              {.rate = rigid_rate,
               .guard = rigid_guard,
               .jacobian = rigid_jacobian,
               .relative_tolerance = tolerance,
               .absolute_tolerances = absolute},
              &field) {}

  void begin(double time, double x, double v) {
    cvode.state()[0] = x;
    cvode.state()[1] = v;
    cvode.restart(time);
  }

  IntervalField field;
  std::array<double, 2> absolute;
  Cvode cvode;
};

IntegratedMotion integrate(const StandardCase& work, RigidSolver& solver, int periods) {
  const double end = periods * core::two_pi / work.frequency;
  IntervalField& field = solver.field;
  field.direction = std::copysign(1.0, work.start_velocity);
  solver.begin(0.0, work.start_position, work.start_velocity);

  IntegratedMotion motion;
  double turning = 0.0;
  double time = 0.0;
  while (solver.cvode.advance(end, time)) {
    const double x = solver.cvode.state()[0];
    field.direction = field.direction_after(x, time);
    solver.begin(time, x, 0.0);
    motion.amplitude = 0.5 * std::abs(x - turning);
    turning = x;
    ++motion.reversals;
  }
  return motion;
}

Contender contender(const char* name, const StandardCase& work, double tolerance, CvodeMethod method) {
  return {name, tolerance, 1, [work, solver = std::make_shared<RigidSolver>(work, tolerance, method)](int periods) {
            return integrate(work, *solver, periods);
          }};
}

// Smooth laws.

/// Data of the functions that CVODE calls.
struct SmoothField {
  StandardCase standard;
  LawResponse (*respond)(double, double, double);
  bool has_state;
  bool frozen;  ///< sgn v is `direction`, else that of v
  double direction = 0.0;
};

int smooth_rate(realtype t, N_Vector state, N_Vector derivative, void* data) {
  const SmoothField& field = *static_cast<const SmoothField*>(data);
  const StandardCase& s = field.standard;
  const double* X = N_VGetArrayPointer(state);
  double* rates = N_VGetArrayPointer(derivative);
  const double direction = field.frozen ? field.direction : std::copysign(1.0, X[1]);
  const LawResponse law = field.respond(X[1], field.has_state ? X[2] : 0.0, direction);
  rates[0] = X[1];
  rates[1] =
      (s.stiffness * (s.base_amplitude * std::cos(s.frequency * t) - X[0]) - s.damping * X[1] - law.force) / s.mass;
  if (field.has_state) rates[2] = law.z_rate;
  return 0;
}

int velocity(realtype, N_Vector state, realtype* value, void*) {
  value[0] = N_VGetArrayPointer(state)[1];
  return 0;
}

std::vector<double> tolerances(const SmoothCase& work, double tolerance) {
  std::vector<double> list{tolerance * work.amplitude,
                           tolerance * work.amplitude * work.model.excitation.frequency};
  if (work.has_state) list.push_back(tolerance * work.z_scale);
  return list;
}

struct SmoothSolver {
  SmoothSolver(const SmoothCase& work, double tolerance, CvodeMethod method, bool restarts)
      : field{.standard = {}, .respond = work.respond, .has_state = work.has_state, .frozen = restarts},
        absolute(tolerances(work, tolerance)),
        cvode(method,
              {.rate = smooth_rate,
               .guard = velocity,
               .jacobian = nullptr,
               .root_direction = 0,
               .relative_tolerance = tolerance,
               .absolute_tolerances = absolute},
              &field) {}

  void integrate(const sim::State& start, int periods, std::vector<double>& turning_points);

  SmoothField field;
  std::vector<double> absolute;
  Cvode cvode;
};

void SmoothSolver::integrate(const sim::State& start, int periods, std::vector<double>& turning_points) {
  double* X = cvode.state();
  X[0] = start.x;
  X[1] = start.v;
  if (field.has_state) X[2] = start.memories.front().state.front();
  field.direction = std::copysign(1.0, start.v);
  cvode.restart(0.0);
  const double end = periods * core::two_pi / field.standard.frequency;
  double time = 0.0;
  while (cvode.advance(end, time)) {
    turning_points.push_back(X[0]);
    if (!field.frozen) continue;
    field.direction = -field.direction;
    X[1] = 0.0;
    cvode.restart(time);
  }
}

}  // namespace

std::vector<Contender> cvode_contenders(const StandardCase& work) {
  return {contender("CVODE Adams 1e-9", work, 1e-9, CvodeMethod::adams),
          contender("CVODE Adams 1e-12", work, 1e-12, CvodeMethod::adams),
          contender("CVODE BDF 1e-9", work, 1e-9, CvodeMethod::bdf),
          contender("CVODE BDF 1e-12", work, 1e-12, CvodeMethod::bdf)};
}

std::vector<SmoothContender> cvode_smooth(const SmoothCase& work, double tolerance) {
  std::vector<SmoothContender> contenders;
  const auto add = [&](const char* name, CvodeMethod method, bool restarts) {
    auto solver = std::make_shared<SmoothSolver>(work, tolerance, method, restarts);
    contenders.push_back({fmt::format("{} {:.0e}{}", name, tolerance, restarts ? ", restarts" : ""),
                          [solver, start = work.start](int periods, std::vector<double>& turning_points) {
                            solver->integrate(start, periods, turning_points);
                          }});
  };
  for (const bool restarts : {true, false}) {
    if (work.jumps && !restarts) continue;
    if (!work.stiff) add("Adams", CvodeMethod::adams, restarts);
    add("Adams Newton", CvodeMethod::adams_newton, restarts);
    add("BDF", CvodeMethod::bdf, restarts);
  }
  return contenders;
}

}  // namespace dualdamp::bench::speed
