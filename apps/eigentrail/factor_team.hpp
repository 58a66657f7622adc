// Processes that factor the matrices of a large model together, by PETSc and MUMPS, in programs that were
// built with it. The first one runs the command, and alone reads, prints and writes; the others wait for
// matrices to factor and for right-hand sides.
#pragma once

#include <functional>

#include "eigentrail/core/sparse_solver.hpp"

namespace eigentrail::app {

/// Runs a command that may factor large matrices and returns its exit code. The maker that it is given is
/// empty, for SuiteSparse in this process, unless mpirun has started the program. Throws InputError if
/// several processes were started and the program was built without PETSc.
int factoring_together(const std::function<int(const SparseSolverMaker&)>& command);

}  // namespace eigentrail::app
