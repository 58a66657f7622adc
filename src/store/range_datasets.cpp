#include "store/range_datasets.hpp"

#include <algorithm>
#include <array>

#include "store/labelled_datasets.hpp"

namespace eigentrail {
namespace {

struct RangeDataset {
  const char* name;
  bool per_end;  ///< two values per range, one for each end
  const char* units;
  const char* long_name;
};

constexpr const char* parameter_unit = "";  ///< stands for the unit of the traced parameter

/// Files of version 0.1 are without this one; their ranges are those of the followed modes.
constexpr const char* whole_model = "stable_whole";

constexpr std::array<RangeDataset, 10> datasets{{
    {"stable_from", false, parameter_unit, "where the range begins, as the trace goes"},
    {"stable_to", false, parameter_unit, "where the range ends, as the trace goes"},
    {"stable_kind", false, "1",
     "stable: all modes decay; marginal: none grows, some stay on the imaginary axis; undecided: "
     "errors of the data leave it open"},
    {"stable_cause", true, "1",
     "what ends the range: an event, start or end of the trace, infinity, or sign change"},
    {"stable_margin", true, "1/s", "-max Re s of the followed modes"},
    {"stable_mode", true, "1",
     "number of the mode that meets the imaginary axis or has the margin; -1: none stands out"},
    {"stable_least_margin", false, "1/s", "least margin of the range"},
    {"stable_largest_margin", false, "1/s", "largest margin of the range"},
    {"stable_largest_at", false, parameter_unit, "where the margin is largest"},
    {whole_model, false, "1",
     "1: no mode of the whole model grows; 0: no followed mode grows, others are not known"},
}};

Stability kind_of(const std::string& name) {
  for (const Stability kind : {Stability::stable, Stability::undecided}) {
    if (name == stability_name(kind)) return kind;
  }
  return Stability::marginal;
}

}  // namespace

bool is_range_dataset(const std::string& name) {
  return name == "range" ||
         std::any_of(datasets.begin(), datasets.end(),
                     [&name](const RangeDataset& dataset) { return dataset.name == name; });
}

void write_stable_ranges(Hdf5Writer& file, const std::string& parameter,
                         const std::vector<StableRange>& ranges) {
  using Range = StableRange;
  write_dimension(file, {"range", "1", "range without growing modes"}, counted(ranges.size()));
  const auto* dataset = datasets.begin();
  const auto write = [&](auto field) {
    std::vector<std::string> dimensions{"range"};
    if (dataset->per_end) dimensions.emplace_back("end");
    const bool of_parameter = dataset->units == std::string(parameter_unit);
    write_column(file,
                 {dataset->name, of_parameter ? file.units(parameter) : dataset->units, dataset->long_name},
                 dimensions, ranges, field);
    ++dataset;
  };
  const auto ends = [](auto value) {
    return [value](const Range& range) { return std::array{value(range.from), value(range.to)}; };
  };
  write([](const Range& range) { return range.from.p; });
  write([](const Range& range) { return range.to.p; });
  write([](const Range& range) { return stability_name(range.kind); });
  write(ends([](const RangeEnd& end) { return end.cause; }));
  write(ends([](const RangeEnd& end) { return end.margin; }));
  write(ends([](const RangeEnd& end) { return end.mode < 0 ? -1 : end.mode + 1; }));
  write(&Range::least_margin);
  write(&Range::largest_margin);
  write(&Range::largest_at);
  write(&Range::whole);
}

std::optional<std::vector<StableRange>> read_stable_ranges(const Hdf5File& file, std::size_t n_modes) {
  if (!file.has("stable_from")) return std::nullopt;
  const Shape shape = file.shape("range");
  const std::uint64_t count = shape.empty() ? 0 : shape[0];
  for (const RangeDataset& dataset : datasets) {
    if (dataset.name == whole_model && !file.has(whole_model)) continue;
    const Shape expected = dataset.per_end ? Shape{count, 2} : Shape{count};
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

}  // namespace eigentrail
