#include "steady/kinsol_solver.hpp"

#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <type_traits>

namespace eigentrail {
namespace {

/// Data for the C callbacks.
struct Session {
  const NonlinearProblem& problem;
  std::exception_ptr exception = nullptr;
  std::string message = {};
};

template <class T>
using Owned = std::unique_ptr<std::remove_pointer_t<T>, void (*)(T)>;

template <class T>
Owned<T> own(T object, void (*release)(T), const char* what) {
  if (object == nullptr) throw std::runtime_error(std::string("SUNDIALS could not create ") + what);
  return {object, release};
}

void check(int code, const char* call) {
  if (code < 0)
    throw std::runtime_error(std::string("SUNDIALS: ") + call + " returned " + std::to_string(code));
}

Eigen::Map<Vector> view(N_Vector v) {
  return {NV_DATA_S(v), NV_LENGTH_S(v)};
}

/// Runs a callback. An exception is stored, and KINSOL is told to stop.
template <class Body>
int guarded(Session& session, Body&& body) {
  try {
    return body() ? 0 : 1;
  } catch (...) {
    session.exception = std::current_exception();
    return -1;
  }
}

int evaluate_residual(N_Vector u, N_Vector f, void* data) {
  auto& session = *static_cast<Session*>(data);
  return guarded(session, [&] {
    Vector value;
    if (!session.problem.residual(view(u), value)) return false;
    view(f) = value;
    return true;
  });
}

// KINSOL calls this function to fill in the Jacobian; the Jacobian is factored here and the factors stay with
// `problem`. The SUNMatrix holds no data: it only makes KINSOL call this function.
int fill_jacobian(N_Vector u, N_Vector, SUNMatrix, void* data, N_Vector, N_Vector) {
  auto& session = *static_cast<Session*>(data);
  return guarded(session, [&] { return session.problem.factor(view(u)); });
}

int solve_linear(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, realtype) {
  auto& session = *static_cast<Session*>(solver->content);
  return guarded(session, [&] {
    Vector solution;
    session.problem.solve(view(b), solution);
    view(x) = solution;
    return solution.allFinite();
  });
}

void keep_message(int, const char*, const char*, char* message, void* data) {
  static_cast<Session*>(data)->message = message;
}

Owned<SUNMatrix> token_matrix(SUNContext context) {
  auto matrix = own<SUNMatrix>(SUNMatNewEmpty(context), SUNMatFreeEmpty, "a matrix");
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->zero = [](SUNMatrix) { return 0; };
  return matrix;
}

Owned<SUNLinearSolver> linear_solver(Session& session, SUNContext context) {
  auto solver = own<SUNLinearSolver>(SUNLinSolNewEmpty(context), SUNLinSolFreeEmpty, "a linear solver");
  solver->content = &session;
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->initialize = [](SUNLinearSolver) { return 0; };
  solver->ops->setup = [](SUNLinearSolver, SUNMatrix) { return 0; };
  solver->ops->solve = solve_linear;
  return solver;
}

void free_kinsol(void* memory) {
  KINFree(&memory);
}

}  // namespace

NonlinearResult solve_with_kinsol(const NonlinearProblem& problem, double tolerance, int max_iterations,
                                  Vector& u) {
  Session session{problem};
  const sundials::Context context;
  const auto n = static_cast<sunindextype>(u.size());
  const auto wrap = [&](double* data) {
    return own<N_Vector>(N_VMake_Serial(n, data, context), N_VDestroy, "a vector");
  };
  Vector u_scale_data = problem.u_scale;
  Vector f_scale_data = problem.f_scale;
  const auto unknowns = wrap(u.data());
  const auto u_scale = wrap(u_scale_data.data());
  const auto f_scale = wrap(f_scale_data.data());
  const auto matrix = token_matrix(context);
  const auto solver = linear_solver(session, context);

  const auto memory = own<void*>(KINCreate(context), free_kinsol, "KINSOL's memory");
  check(KINSetErrHandlerFn(memory.get(), keep_message, &session), "KINSetErrHandlerFn");
  check(KINSetUserData(memory.get(), &session), "KINSetUserData");
  check(KINInit(memory.get(), evaluate_residual, unknowns.get()), "KINInit");
  check(KINSetLinearSolver(memory.get(), solver.get(), matrix.get()), "KINSetLinearSolver");
  check(KINSetJacFn(memory.get(), fill_jacobian), "KINSetJacFn");
  check(KINSetMaxSetupCalls(memory.get(), 1), "KINSetMaxSetupCalls");
  check(KINSetNumMaxIters(memory.get(), max_iterations), "KINSetNumMaxIters");
  check(KINSetFuncNormTol(memory.get(), tolerance), "KINSetFuncNormTol");

  const int flag = KINSol(memory.get(), unknowns.get(), KIN_LINESEARCH, u_scale.get(), f_scale.get());
  if (session.exception) std::rethrow_exception(session.exception);

  NonlinearResult result;
  long iterations = 0;
  check(KINGetNumNonlinSolvIters(memory.get(), &iterations), "KINGetNumNonlinSolvIters");
  result.iterations = static_cast<int>(iterations);
  result.converged = flag == KIN_SUCCESS || flag == KIN_INITIAL_GUESS_OK;
  if (!result.converged) {
    const std::unique_ptr<char, void (*)(void*)> name(KINGetReturnFlagName(flag), std::free);
    result.message = std::string(name.get()) + (session.message.empty() ? "" : ": " + session.message);
  }
  return result;
}

}  // namespace eigentrail
