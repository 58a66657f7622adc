// LAPACK's C interface with std::complex, without the macros of C's complex numbers.
#pragma once

#include <complex>

#define lapack_complex_float std::complex<float>
#define lapack_complex_double std::complex<double>
#include <lapacke.h>
