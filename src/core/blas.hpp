// What BLAS does differently from machine to machine: its kernels, and its memory. OpenBLAS takes 128 MB of
// addresses for each thread that calls it at the same time, at its first call, and repeats that for ever
// where the system refuses it.
#pragma once

#include <cstddef>
#include <string>

namespace eigentrail {

/// Whether BLAS has the memory to be called by so many threads at once; takes it if it is to be had.
bool blas_has_memory_for(std::size_t threads);

/// Name of the kernels that OpenBLAS has chosen for this processor, on which the last bits of results depend;
/// "other" of another library.
std::string blas_kernel();

}  // namespace eigentrail
