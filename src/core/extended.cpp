#include "eigentrail/core/extended.hpp"

// The C library has the functions of binary128; the C++ library has not.
#include <math.h>

namespace eigentrail {

Extended abs(const Extended& x) {
  return Extended::of(fabsf128(x.value_));
}
Extended floor(const Extended& x) {
  return Extended::of(floorf128(x.value_));
}
Extended sqrt(const Extended& x) {
  return Extended::of(sqrtf128(x.value_));
}
Extended exp(const Extended& x) {
  return Extended::of(expf128(x.value_));
}
Extended log(const Extended& x) {
  return Extended::of(logf128(x.value_));
}
Extended sin(const Extended& x) {
  return Extended::of(sinf128(x.value_));
}
Extended cos(const Extended& x) {
  return Extended::of(cosf128(x.value_));
}
Extended tan(const Extended& x) {
  return Extended::of(tanf128(x.value_));
}
Extended asin(const Extended& x) {
  return Extended::of(asinf128(x.value_));
}
Extended acos(const Extended& x) {
  return Extended::of(acosf128(x.value_));
}
Extended atan(const Extended& x) {
  return Extended::of(atanf128(x.value_));
}
Extended sinh(const Extended& x) {
  return Extended::of(sinhf128(x.value_));
}
Extended cosh(const Extended& x) {
  return Extended::of(coshf128(x.value_));
}
Extended tanh(const Extended& x) {
  return Extended::of(tanhf128(x.value_));
}
bool isfinite(const Extended& x) {
  return x.value_ - x.value_ == 0;
}

}  // namespace eigentrail
