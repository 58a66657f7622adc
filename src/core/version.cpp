#include "eigentrail/core/version.hpp"

namespace eigentrail {

std::string version() {
  return EIGENTRAIL_VERSION;
}

}  // namespace eigentrail
