#include "store/range_datasets.hpp"

#include <algorithm>
#include <array>

namespace eigentrail {
namespace {

struct RangeDataset {
  const char* name;
  ElementType type;
  bool per_end;  ///< two values per range, one for each end
  const char* units;
  const char* long_name;
};

constexpr const char* parameter_unit = "";  ///< stands for the unit of the traced parameter

/// Files of version 0.1 are without this one; their ranges are those of the followed modes.
constexpr const char* whole_model = "stable_whole";

constexpr std::array<RangeDataset, 10> datasets{{
    {"stable_from", ElementType::real, false, parameter_unit, "where the range begins, as the trace goes"},
    {"stable_to", ElementType::real, false, parameter_unit, "where the range ends, as the trace goes"},
    {"stable_kind", ElementType::text, false, "1",
     "stable: all modes decay; marginal: none grows, some stay on the imaginary axis; undecided: "
     "errors of the data leave it open"},
    {"stable_cause", ElementType::text, true, "1",
     "what ends the range: an event, start or end of the trace, infinity, or sign change"},
    {"stable_margin", ElementType::real, true, "1/s", "-max Re s of the followed modes"},
    {"stable_mode", ElementType::integer, true, "1",
     "number of the mode that meets the imaginary axis or has the margin; -1: none stands out"},
    {"stable_least_margin", ElementType::real, false, "1/s", "least margin of the range"},
    {"stable_largest_margin", ElementType::real, false, "1/s", "largest margin of the range"},
    {"stable_largest_at", ElementType::real, false, parameter_unit, "where the margin is largest"},
    {whole_model, ElementType::integer, false, "1",
     "1: no mode of the whole model grows; 0: no followed mode grows, others are not known"},
}};

void create(Hdf5Writer& file, const std::string& unit) {
  file.create_dataset({"range",
                       ElementType::integer,
                       {0},
                       true,
                       {{"units", "1"}, {"long_name", "range without growing modes"}}});
  file.make_scale("range", "range");
  for (const RangeDataset& dataset : datasets) {
    const std::string units = dataset.units == std::string(parameter_unit) ? unit : dataset.units;
    const Shape shape = dataset.per_end ? Shape{0, 2} : Shape{0};
    file.create_dataset(
        {dataset.name, dataset.type, shape, true, {{"units", units}, {"long_name", dataset.long_name}}});
    file.attach_scale(dataset.name, "range", 0);
    if (dataset.per_end) file.attach_scale(dataset.name, "end", 1);
  }
}

Stability kind_of(const std::string& name) {
  for (const Stability kind : {Stability::stable, Stability::undecided}) {
    if (name == stability_name(kind)) return kind;
  }
  return Stability::marginal;
}

std::int64_t number_of(int mode) {
  return mode < 0 ? -1 : mode + 1;
}

}  // namespace

bool is_range_dataset(const std::string& name) {
  return name == "range" ||
         std::any_of(datasets.begin(), datasets.end(),
                     [&name](const RangeDataset& dataset) { return dataset.name == name; });
}

void write_stable_ranges(Hdf5Writer& file, const std::string& parameter,
                         const std::vector<StableRange>& ranges) {
  create(file, file.units(parameter));
  if (ranges.empty()) return;
  std::vector<std::int64_t> numbers, modes, whole;
  std::vector<double> from, to, margins, least, largest, largest_at;
  std::vector<std::string> kinds, causes;
  for (const StableRange& range : ranges) {
    numbers.push_back(static_cast<std::int64_t>(numbers.size()));
    from.push_back(range.from.p);
    to.push_back(range.to.p);
    kinds.push_back(stability_name(range.kind));
    for (const RangeEnd* end : {&range.from, &range.to}) {
      causes.push_back(end->cause);
      margins.push_back(end->margin);
      modes.push_back(number_of(end->mode));
    }
    least.push_back(range.least_margin);
    largest.push_back(range.largest_margin);
    largest_at.push_back(range.largest_at);
    whole.push_back(range.whole ? 1 : 0);
  }
  file.write_rows("range", 0, numbers);
  file.write_rows("stable_from", 0, from);
  file.write_rows("stable_to", 0, to);
  file.write_rows("stable_kind", 0, kinds);
  file.write_rows("stable_cause", 0, causes);
  file.write_rows("stable_margin", 0, margins);
  file.write_rows("stable_mode", 0, modes);
  file.write_rows("stable_least_margin", 0, least);
  file.write_rows("stable_largest_margin", 0, largest);
  file.write_rows("stable_largest_at", 0, largest_at);
  file.write_rows(whole_model, 0, whole);
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
