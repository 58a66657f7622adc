#include "eigentrail/core/extended.hpp"

namespace eigentrail {
namespace {

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

}  // namespace

Extended abs(const Extended& x) {
  return Extended::of(binary128_abs(x.value_));
}
Extended floor(const Extended& x) {
  return Extended::of(binary128_floor(x.value_));
}
Extended sqrt(const Extended& x) {
  return Extended::of(binary128_sqrt(x.value_));
}
Extended exp(const Extended& x) {
  return Extended::of(binary128_exp(x.value_));
}
Extended log(const Extended& x) {
  return Extended::of(binary128_log(x.value_));
}
Extended sin(const Extended& x) {
  return Extended::of(binary128_sin(x.value_));
}
Extended cos(const Extended& x) {
  return Extended::of(binary128_cos(x.value_));
}
Extended tan(const Extended& x) {
  return Extended::of(binary128_tan(x.value_));
}
Extended asin(const Extended& x) {
  return Extended::of(binary128_asin(x.value_));
}
Extended acos(const Extended& x) {
  return Extended::of(binary128_acos(x.value_));
}
Extended atan(const Extended& x) {
  return Extended::of(binary128_atan(x.value_));
}
Extended sinh(const Extended& x) {
  return Extended::of(binary128_sinh(x.value_));
}
Extended cosh(const Extended& x) {
  return Extended::of(binary128_cosh(x.value_));
}
Extended tanh(const Extended& x) {
  return Extended::of(binary128_tanh(x.value_));
}
bool isfinite(const Extended& x) {
  return x.value_ - x.value_ == 0;
}

}  // namespace eigentrail
