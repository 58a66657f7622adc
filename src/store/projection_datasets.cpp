#include "store/projection_datasets.hpp"

#include "store/loci_schema.hpp"

namespace eigentrail {

void write_projection(Hdf5Writer& file, const Projection& projection) {
  if (projection.is_of_family()) {
    write_dimension(file, {"freedom", "1", "freedom of the large model"}, projection.names);
    write_whole(file, whole_dataset("projection_basis"), row_major(projection.basis));
  }
  write_dimension(file, {"projection_place", "1", "values of the parameter whose modes span the space"},
                  projection.sampled_at);
  file.set_attribute("projection_error", projection.error);
  file.set_attribute("projection_error_at", projection.error_at);
  file.set_attribute("count_sparse_factorizations", static_cast<std::int64_t>(projection.factorizations));
  file.set_attribute("count_sparse_solutions", static_cast<std::int64_t>(projection.solutions));
}

}  // namespace eigentrail
