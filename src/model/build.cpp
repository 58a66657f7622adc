#include "eigentrail/model/build.hpp"

#include "model/matrix_family.hpp"
#include "model/read_multibody.hpp"

namespace eigentrail {

std::unique_ptr<Model> build_model(const Scene& scene, const std::vector<Vector>& check_at) {
  return is_matrix_family(scene) ? read_matrix_family(scene) : read_multibody(scene, check_at);
}

}  // namespace eigentrail
