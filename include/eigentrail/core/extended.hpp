// Numbers with a 113-bit significand (IEEE 754 binary128, about 34 decimal digits), used for reference
// solutions.
//
// Implemented in software, about fifty times slower than double. Traces do not use it.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <limits>
#include <type_traits>

namespace eigentrail {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Binary128 = __float128;
#else
using Binary128 = long double;  // platforms whose long double is binary128
static_assert(std::numeric_limits<long double>::digits == 113);
#endif

// Functions of the C library for binary128. They are declared here by their standard names (ISO/IEC TS
// 18661-3), because the types in the C library's header differ between compilers.
extern "C" {
Binary128 binary128_abs(Binary128) noexcept __asm__("fabsf128");
Binary128 binary128_floor(Binary128) noexcept __asm__("floorf128");
Binary128 binary128_sqrt(Binary128) noexcept __asm__("sqrtf128");
Binary128 binary128_exp(Binary128) noexcept __asm__("expf128");
Binary128 binary128_log(Binary128) noexcept __asm__("logf128");
Binary128 binary128_sin(Binary128) noexcept __asm__("sinf128");
Binary128 binary128_cos(Binary128) noexcept __asm__("cosf128");
Binary128 binary128_tan(Binary128) noexcept __asm__("tanf128");
Binary128 binary128_asin(Binary128) noexcept __asm__("asinf128");
Binary128 binary128_acos(Binary128) noexcept __asm__("acosf128");
Binary128 binary128_atan(Binary128) noexcept __asm__("atanf128");
Binary128 binary128_sinh(Binary128) noexcept __asm__("sinhf128");
Binary128 binary128_cosh(Binary128) noexcept __asm__("coshf128");
Binary128 binary128_tanh(Binary128) noexcept __asm__("tanhf128");
}

/// A binary128 number. A class is needed because the C++ standard library has no functions for the compilers'
/// own binary128 types. The functions are hidden friends, found only for Extended arguments, so no call with
/// a double selects them.
class Extended {
 public:
  Extended() = default;
  template <class Number>
  requires std::is_arithmetic_v<Number> Extended(Number value) : value_(value) {}  // NOLINT: exact

  /// Nearest double.
  explicit operator double() const { return static_cast<double>(value_); }

  Extended& operator+=(const Extended& b) {
    value_ += b.value_;
    return *this;
  }
  Extended& operator-=(const Extended& b) {
    value_ -= b.value_;
    return *this;
  }
  Extended& operator*=(const Extended& b) {
    value_ *= b.value_;
    return *this;
  }
  Extended& operator/=(const Extended& b) {
    value_ /= b.value_;
    return *this;
  }

  friend Extended operator+(Extended a, const Extended& b) { return a += b; }
  friend Extended operator-(Extended a, const Extended& b) { return a -= b; }
  friend Extended operator*(Extended a, const Extended& b) { return a *= b; }
  friend Extended operator/(Extended a, const Extended& b) { return a /= b; }
  friend Extended operator-(const Extended& a) { return Extended(0.0) - a; }
  friend Extended operator+(const Extended& a) { return a; }

  friend bool operator==(const Extended& a, const Extended& b) { return a.value_ == b.value_; }
  friend bool operator<(const Extended& a, const Extended& b) { return a.value_ < b.value_; }
  friend bool operator>(const Extended& a, const Extended& b) { return a.value_ > b.value_; }
  friend bool operator<=(const Extended& a, const Extended& b) { return a.value_ <= b.value_; }
  friend bool operator>=(const Extended& a, const Extended& b) { return a.value_ >= b.value_; }

  friend Extended abs(const Extended& x) { return of(binary128_abs(x.value_)); }
  friend Extended floor(const Extended& x) { return of(binary128_floor(x.value_)); }
  friend Extended sqrt(const Extended& x) { return of(binary128_sqrt(x.value_)); }
  friend Extended exp(const Extended& x) { return of(binary128_exp(x.value_)); }
  friend Extended log(const Extended& x) { return of(binary128_log(x.value_)); }
  friend Extended sin(const Extended& x) { return of(binary128_sin(x.value_)); }
  friend Extended cos(const Extended& x) { return of(binary128_cos(x.value_)); }
  friend Extended tan(const Extended& x) { return of(binary128_tan(x.value_)); }
  friend Extended asin(const Extended& x) { return of(binary128_asin(x.value_)); }
  friend Extended acos(const Extended& x) { return of(binary128_acos(x.value_)); }
  friend Extended atan(const Extended& x) { return of(binary128_atan(x.value_)); }
  friend Extended sinh(const Extended& x) { return of(binary128_sinh(x.value_)); }
  friend Extended cosh(const Extended& x) { return of(binary128_cosh(x.value_)); }
  friend Extended tanh(const Extended& x) { return of(binary128_tanh(x.value_)); }
  friend bool isfinite(const Extended& x) { return x.value_ - x.value_ == 0; }

 private:
  static Extended of(Binary128 value) {
    Extended result;
    result.value_ = value;
    return result;
  }

  Binary128 value_ = 0;
};

using ExtendedMatrix = Eigen::Matrix<Extended, Eigen::Dynamic, Eigen::Dynamic>;
using ExtendedVector = Eigen::Matrix<Extended, Eigen::Dynamic, 1>;
using ExtendedComplex = std::complex<Extended>;
using ExtendedComplexMatrix = Eigen::Matrix<ExtendedComplex, Eigen::Dynamic, Eigen::Dynamic>;

/// Nearest double-precision values.
template <class Derived>
Eigen::MatrixXd to_double(const Eigen::MatrixBase<Derived>& values) {
  return values.unaryExpr([](const Extended& x) { return static_cast<double>(x); });
}
inline std::complex<double> to_double(const ExtendedComplex& value) {
  return {static_cast<double>(value.real()), static_cast<double>(value.imag())};
}

}  // namespace eigentrail

template <>
struct Eigen::NumTraits<eigentrail::Extended> : Eigen::GenericNumTraits<double> {
  using Real = eigentrail::Extended;
  using NonInteger = eigentrail::Extended;
  using Nested = eigentrail::Extended;
  using Literal = double;
  static Real epsilon() { return Real(0x1p-112); }
  static Real dummy_precision() { return Real(0x1p-100); }
  static int digits10() { return 33; }
  enum { RequireInitialization = 1, ReadCost = 2, AddCost = 50, MulCost = 50 };
};
