#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_types.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <sundials/sundials_context.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "bench/speed/contender.hpp"

namespace dualdamp::bench::speed {
namespace {

void check(int status, const char* call) {
  if (status < 0) throw std::runtime_error(std::string(call) + " failed with " + std::to_string(status));
}

template <class T>
using Handle = std::unique_ptr<T, void (*)(T*)>;

int rate(realtype t, N_Vector state, N_Vector derivative, void* data) {
  const PhaseField& field = *static_cast<const PhaseField*>(data);
  const double* s = N_VGetArrayPointer(state);
  double* d = N_VGetArrayPointer(derivative);
  d[0] = s[1];
  d[1] = field.acceleration(s[0], s[1], t);
  return 0;
}

int jacobian(realtype, N_Vector, N_Vector, SUNMatrix matrix, void* data, N_Vector, N_Vector, N_Vector) {
  const PhaseField& field = *static_cast<const PhaseField*>(data);
  SM_ELEMENT_D(matrix, 0, 0) = 0.0;
  SM_ELEMENT_D(matrix, 0, 1) = 1.0;
  SM_ELEMENT_D(matrix, 1, 0) = -field.stiffness;
  SM_ELEMENT_D(matrix, 1, 1) = -field.damping;
  return 0;
}

/// Positive while the phase lasts.
int guard(realtype, N_Vector state, realtype* value, void* data) {
  value[0] = static_cast<const PhaseField*>(data)->direction * N_VGetArrayPointer(state)[1];
  return 0;
}

enum class Method { adams, bdf };

/// One CVODE memory and all that it points to.
struct Solver {
  Solver(const StandardCase& work, double tolerance, Method method);

  void begin(double time, double x, double v) {
    N_VGetArrayPointer(state.get())[0] = x;
    N_VGetArrayPointer(state.get())[1] = v;
    check(CVodeReInit(memory.get(), time, state.get()), "CVodeReInit");
  }

  sundials::Context context;
  Handle<_generic_N_Vector> state;
  Handle<_generic_SUNMatrix> matrix{nullptr, SUNMatDestroy};
  Handle<_generic_SUNLinearSolver> linear{nullptr, [](SUNLinearSolver solver) { SUNLinSolFree(solver); }};
  Handle<_generic_SUNNonlinearSolver> fixed_point{nullptr,
                                                  [](SUNNonlinearSolver solver) { SUNNonlinSolFree(solver); }};
  Handle<void> memory;
  PhaseField field;
};

Solver::Solver(const StandardCase& work, double tolerance, Method method)
    : state(N_VNew_Serial(2, context), N_VDestroy),
      memory(CVodeCreate(method == Method::adams ? CV_ADAMS : CV_BDF, context), [](void* m) { CVodeFree(&m); }),
      field(work) {
  void* cvode = memory.get();
  check(CVodeInit(cvode, rate, 0.0, state.get()), "CVodeInit");
  check(CVodeSStolerances(cvode, tolerance, tolerance), "CVodeSStolerances");
  check(CVodeSetUserData(cvode, &field), "CVodeSetUserData");
  check(CVodeSetMaxNumSteps(cvode, 1'000'000), "CVodeSetMaxNumSteps");
  check(CVodeRootInit(cvode, 1, guard), "CVodeRootInit");
  int downwards = -1;
  check(CVodeSetRootDirection(cvode, &downwards), "CVodeSetRootDirection");
  if (method == Method::adams) {
    fixed_point.reset(SUNNonlinSol_FixedPoint(state.get(), 0, context));
    check(CVodeSetNonlinearSolver(cvode, fixed_point.get()), "CVodeSetNonlinearSolver");
  } else {
    matrix.reset(SUNDenseMatrix(2, 2, context));
    linear.reset(SUNLinSol_Dense(state.get(), matrix.get(), context));
    check(CVodeSetLinearSolver(cvode, linear.get(), matrix.get()), "CVodeSetLinearSolver");
    check(CVodeSetJacFn(cvode, jacobian), "CVodeSetJacFn");
  }
}

Followed follow(const StandardCase& work, Solver& solver, int periods) {
  const double end = periods * 2.0 * std::numbers::pi / work.frequency;
  PhaseField& field = solver.field;
  field.direction = std::copysign(1.0, work.start_velocity);
  solver.begin(0.0, work.start_position, work.start_velocity);

  Followed followed;
  double turning = 0.0;
  for (;;) {
    double time = 0.0;
    const int status = CVode(solver.memory.get(), end, solver.state.get(), &time, CV_NORMAL);
    check(status, "CVode");
    if (status != CV_ROOT_RETURN) return followed;
    const double x = N_VGetArrayPointer(solver.state.get())[0];
    field.direction = field.direction_after(x, time);
    solver.begin(time, x, 0.0);
    followed.amplitude = 0.5 * std::abs(x - turning);
    turning = x;
    ++followed.reversals;
  }
}

Contender contender(const char* name, const StandardCase& work, double tolerance, Method method) {
  return {name, tolerance, 1, [work, solver = std::make_shared<Solver>(work, tolerance, method)](int periods) {
            return follow(work, *solver, periods);
          }};
}

}  // namespace

std::vector<Contender> cvode_contenders(const StandardCase& work) {
  return {contender("CVODE Adams 1e-9", work, 1e-9, Method::adams),
          contender("CVODE Adams 1e-12", work, 1e-12, Method::adams),
          contender("CVODE BDF 1e-9", work, 1e-9, Method::bdf),
          contender("CVODE BDF 1e-12", work, 1e-12, Method::bdf)};
}

}  // namespace dualdamp::bench::speed
