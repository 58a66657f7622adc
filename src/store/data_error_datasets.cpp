#include "store/data_error_datasets.hpp"

#include <array>

#include "store/loci_schema.hpp"

namespace eigentrail {
namespace {

constexpr const char* interpolation = "interpolation_error";
constexpr const char* digits = "digits_error";
constexpr const char* interval = "event_interval";

}  // namespace

void write_data_errors(Hdf5Writer& file, const std::string& unit, const DataErrors& errors) {
  write_whole(file, whole_dataset(interpolation), row_major(errors.interpolation));
  write_whole(file, whole_dataset(digits), row_major(errors.digits));
  write_whole(file, whole_dataset(interval, unit),
              column_of(std::span(errors.intervals), [](const EventInterval& one) {
                return std::array{one.from, one.to};
              }));
}

std::optional<DataErrors> read_data_errors(const Hdf5File& file, std::size_t steps, std::size_t modes,
                                           std::size_t events) {
  if (!file.has(interpolation)) return std::nullopt;
  DataErrors errors{
      read_matrix(file, interpolation, steps, modes), read_matrix(file, digits, steps, modes), {}};
  const Matrix ends = read_matrix(file, interval, events, 2);
  for (Eigen::Index i = 0; i < ends.rows(); ++i) errors.intervals.push_back({ends(i, 0), ends(i, 1)});
  return errors;
}

}  // namespace eigentrail
