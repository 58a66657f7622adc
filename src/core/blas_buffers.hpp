// Memory of BLAS. OpenBLAS takes 128 MB of addresses for each thread that calls it at the same time, at its
// first call, and repeats that for ever where the system refuses it.
#pragma once

#include <cstddef>

namespace eigentrail {

/// Whether BLAS has the memory to be called by so many threads at once; takes it if it is to be had.
bool blas_has_memory_for(std::size_t threads);

}  // namespace eigentrail
