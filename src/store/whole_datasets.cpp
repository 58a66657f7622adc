#include "store/whole_datasets.hpp"

#include <array>

#include "store/loci_schema.hpp"

namespace eigentrail {
namespace {

/// Files of version 0.1 are without this one; their ranges are those of the followed modes.
constexpr const char* whole_model = "stable_whole";

constexpr const char* interpolation = "interpolation_error";
constexpr const char* digits = "digits_error";
constexpr const char* interval = "event_interval";

Stability kind_of(const std::string& name) {
  for (const Stability kind : {Stability::stable, Stability::undecided}) {
    if (name == stability_name(kind)) return kind;
  }
  return Stability::marginal;
}

}  // namespace

void write_stable_ranges(Hdf5Writer& file, const std::string& unit, const std::vector<StableRange>& ranges) {
  using Range = StableRange;
  write_dimension(file, {"range", "1", "range without growing modes"}, counted(ranges.size()));
  const auto write = [&](const char* name, auto field) {
    write_whole(file, whole_dataset(name, unit), column_of(std::span(ranges), field));
  };
  const auto ends = [](auto value) {
    return [value](const Range& range) { return std::array{value(range.from), value(range.to)}; };
  };
  write("stable_from", [](const Range& range) { return range.from.p; });
  write("stable_to", [](const Range& range) { return range.to.p; });
  write("stable_kind", [](const Range& range) { return stability_name(range.kind); });
  write("stable_cause", ends([](const RangeEnd& end) { return end.cause; }));
  write("stable_margin", ends([](const RangeEnd& end) { return end.margin; }));
  write("stable_mode", ends([](const RangeEnd& end) { return end.mode < 0 ? -1 : end.mode + 1; }));
  write("stable_least_margin", &Range::least_margin);
  write("stable_largest_margin", &Range::largest_margin);
  write("stable_largest_at", &Range::largest_at);
  write(whole_model, &Range::whole);
}

std::optional<std::vector<StableRange>> read_stable_ranges(const Hdf5File& file, std::size_t n_modes) {
  if (!file.has("stable_from")) return std::nullopt;
  const Shape shape = file.shape("range");
  const std::uint64_t count = shape.empty() ? 0 : shape[0];
  for (const LociDataset& dataset : datasets_of_ranges()) {
    if (dataset.name == whole_model && !file.has(whole_model)) continue;
    const Shape expected = dataset.dimensions.size() == 2 ? Shape{count, 2} : Shape{count};
    file.require_fit(file.shape(dataset.name) == expected, dataset.name);
  }
  const auto from = file.read_real("stable_from");
  const auto to = file.read_real("stable_to");
  const auto kinds = file.read_texts("stable_kind");
  const auto causes = file.read_texts("stable_cause");
  const auto margins = file.read_real("stable_margin");
  const auto modes = file.read_integers("stable_mode");
  for (const std::int64_t mode : modes) {
    if (mode > static_cast<std::int64_t>(n_modes))
      file.fail("stable_mode names mode " + std::to_string(mode) + " of " + std::to_string(n_modes));
  }
  const auto least = file.read_real("stable_least_margin");
  const auto largest = file.read_real("stable_largest_margin");
  const auto largest_at = file.read_real("stable_largest_at");
  const auto whole =
      file.has(whole_model) ? file.read_integers(whole_model) : std::vector<std::int64_t>(count);
  std::vector<StableRange> ranges;
  for (std::size_t i = 0; i < count; ++i) {
    const auto end = [&](double p, std::size_t at) {
      const int mode = modes[at] < 0 ? -1 : static_cast<int>(modes[at]) - 1;
      return RangeEnd{p, causes[at], margins[at], mode};
    };
    ranges.push_back({kind_of(kinds[i]), end(from[i], 2 * i), end(to[i], 2 * i + 1), least[i], largest[i],
                      largest_at[i], whole[i] == 1});
  }
  return ranges;
}

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
