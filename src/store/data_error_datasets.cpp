#include "store/data_error_datasets.hpp"

namespace eigentrail {
namespace {

using RowMajorReal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr const char* interpolation = "interpolation_error";
constexpr const char* digits = "digits_error";
constexpr const char* interval = "event_interval";

void write_bounds(Hdf5Writer& file, const std::string& name, const std::string& long_name,
                  const Matrix& bounds) {
  const auto rows = static_cast<std::uint64_t>(bounds.rows());
  const auto columns = static_cast<std::uint64_t>(bounds.cols());
  file.create_dataset(
      {name, ElementType::real, {rows, columns}, false, {{"units", "1/s"}, {"long_name", long_name}}});
  file.attach_scale(name, "step", 0);
  file.attach_scale(name, "mode", 1);
  const RowMajorReal ordered = bounds;
  file.write_rows(name, 0, std::vector<double>(ordered.data(), ordered.data() + ordered.size()));
}

Matrix read_bounds(const Hdf5File& file, const std::string& name, std::size_t rows, std::size_t columns) {
  file.require_fit(file.shape(name) == Shape{rows, columns}, name);
  if (rows * columns == 0) return Matrix(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  const std::vector<double> data = file.read_real(name);
  return Eigen::Map<const RowMajorReal>(data.data(), static_cast<Eigen::Index>(rows),
                                        static_cast<Eigen::Index>(columns));
}

}  // namespace

bool is_data_error_dataset(const std::string& name) {
  return name == interpolation || name == digits || name == interval;
}

void write_data_errors(Hdf5Writer& file, const std::string& parameter, const DataErrors& errors) {
  write_bounds(file, interpolation, "bound of the error of the eigenvalue between the samples of the model",
               errors.interpolation);
  write_bounds(file, digits, "bound of the error of the eigenvalue from the digits of the samples",
               errors.digits);
  const auto events = static_cast<std::uint64_t>(errors.intervals.size());
  file.create_dataset({interval,
                       ElementType::real,
                       {events, 2},
                       false,
                       {{"units", file.units(parameter)},
                        {"long_name", "where the event lies as far as the errors of the data tell"}}});
  file.attach_scale(interval, "event", 0);
  file.attach_scale(interval, "end", 1);
  if (events == 0) return;
  std::vector<double> ends;
  for (const EventInterval& one : errors.intervals) {
    ends.push_back(one.from);
    ends.push_back(one.to);
  }
  file.write_rows(interval, 0, ends);
}

std::optional<DataErrors> read_data_errors(const Hdf5File& file, std::size_t steps, std::size_t modes,
                                           std::size_t events) {
  if (!file.has(interpolation)) return std::nullopt;
  DataErrors errors{
      read_bounds(file, interpolation, steps, modes), read_bounds(file, digits, steps, modes), {}};
  const Matrix ends = read_bounds(file, interval, events, 2);
  for (Eigen::Index i = 0; i < ends.rows(); ++i) errors.intervals.push_back({ends(i, 0), ends(i, 1)});
  return errors;
}

}  // namespace eigentrail
