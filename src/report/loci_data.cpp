#include <cmath>
#include <cstdlib>
#include <set>

#include "core/texts.hpp"
#include "eigentrail/continuation/event_kinds.hpp"
#include "eigentrail/continuation/trace_options.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/scene/units.hpp"
#include "report/file_data.hpp"
#include "scene/frequency_unit.hpp"

namespace eigentrail {
namespace {

/// Bounds of the errors of the data of a mode, 1/s, per step; not finite where they are not known.
std::vector<double> errors_of(const DataErrors& errors, std::size_t mode) {
  std::vector<double> list;
  for (Eigen::Index step = 0; step < errors.interpolation.rows(); ++step)
    list.push_back(errors.on_step(static_cast<std::size_t>(step), static_cast<Eigen::Index>(mode)));
  return list;
}

Json modes_data(const LociFile& loci) {
  Json list = Json::array();
  for (std::size_t i = 0; i < loci.modes.size(); ++i) {
    list.push_back({{"label", loci.modes[i]},
                    {"name", loci.mode_names[i]},
                    {"certified", loci.certified_share(i)},
                    {"uncertified", loci.uncertified(i)}});
    if (loci.data_errors) list.back()["errors"] = base64(errors_of(*loci.data_errors, i));
  }
  return list;
}

/// Mode numbers, counted from 0, from a text such as "1;3", which counts from 1. Numbers of modes that the
/// file does not have are left out.
Json mode_numbers(const std::string& text, std::size_t n_modes) {
  Json list = Json::array();
  for (const std::string& part : split(text, ';')) {
    const int number = std::atoi(part.c_str());
    if (number > 0 && static_cast<std::size_t>(number) <= n_modes) list.push_back(number - 1);
  }
  return list;
}

Json events_data(const LociFile& loci) {
  Json list = Json::array();
  for (std::size_t i = 0; i < loci.events.size(); ++i) {
    const LociEvent& event = loci.events[i];
    // A file may contain kinds of events that this version does not know.
    const EventKindInfo* kind = find_event_kind(event.kind);
    Json item{{"kind", kind != nullptr ? std::string(kind->long_name) : event.kind},
              {"symbol", kind != nullptr ? kind->symbol : "circle-open-dot"},
              {"labelled", kind != nullptr && kind->labelled},
              {"remark", kind != nullptr ? kind->remark(event) : ""},
              {"parameter", event.parameter},
              {"real", event.s.real()},
              {"imag", event.s.imag()},
              {"modes", mode_numbers(event.modes, loci.modes.size())},
              {"value", event.value},
              {"node", event.node}};
    if (loci.data_errors && std::isfinite(loci.data_errors->intervals[i].from))
      item["interval"] = {loci.data_errors->intervals[i].from, loci.data_errors->intervals[i].to};
    list.push_back(std::move(item));
  }
  return list;
}

Json end_data(const RangeEnd& end) {
  return {{"parameter", end.p},
          {"cause", end.cause},
          {"margin", end.margin},
          {"mode", end.mode < 0 ? Json() : Json(end.mode + 1)}};
}

/// Operating ranges in the unit of the traced parameter; `margin` is null where that of API 684 is wanted.
Json operating_data(const OperatingRanges& operating) {
  Json ranges = Json::array();
  for (const OperatingRange& range : operating.ranges) ranges.push_back({range.from, range.to});
  return {{"ranges", ranges}, {"margin", operating.margin ? Json(*operating.margin) : Json(nullptr)}};
}

/// Measure of whirl (1 forward on circles, -1 backward) and the share of the other sense, per point and mode;
/// null if nothing in the model spins.
Json whirl_data(const LociFile& loci, const Hdf5File& file) {
  const Shape expected{static_cast<std::uint64_t>(loci.n_nodes()), loci.modes.size()};
  for (const char* name : {"whirl", "whirl_reverse"}) {
    if (!file.has(name) || file.shape(name) != expected) return nullptr;
  }
  return {{"measure", base64<float>(file.read_real("whirl"))},
          {"reverse", base64<float>(file.read_real("whirl_reverse"))}};
}

}  // namespace

Json ranges_data(const std::vector<StableRange>& ranges) {
  Json list = Json::array();
  for (const StableRange& range : ranges) {
    list.push_back({{"kind", stability_name(range.kind)},
                    {"whole_model", range.whole},
                    {"from", end_data(range.from)},
                    {"to", end_data(range.to)},
                    {"least_margin", range.least_margin},
                    {"largest_margin", range.largest_margin},
                    {"largest_at", range.largest_at}});
  }
  return list;
}

Vector si_values(const Scene& scene, const std::string& parameter, double p) {
  Vector values = scene.parameters.declared_values();
  if (const auto index = scene.parameters.index(parameter)) values[*index] = p;
  return scene.parameters.in_si(values);
}

Json excitation_data(const LociFile& loci) {
  constexpr int places = 64;
  try {
    const Scene scene = parse_scene(loci.attribute("scene"), loci.attribute("scene_path"));
    const auto index = scene.parameters.index(loci.parameter);
    if (!index) return nullptr;
    std::set<int> used;
    const EventOptions events = read_event_options(scene, loci.parameter, used);
    const auto& dimension = scene.parameters[static_cast<std::size_t>(*index)].dimension;
    const bool is_frequency = dimension == parse_unit("rad/s")->dimension;
    if (!events.excitation && !is_frequency) return nullptr;
    std::vector<double> parameters, frequencies;
    for (int i = 0; i <= places; ++i) {
      const double p = loci.lowest() + (loci.highest() - loci.lowest()) * i / places;
      const Vector values = si_values(scene, loci.parameter, p);
      parameters.push_back(p);
      frequencies.push_back(events.excitation ? events.excitation->value(values) : values[*index]);
    }
    return {{"parameter", parameters},
            {"frequency", frequencies},
            {"harmonics", events.values(EventKind::resonance)},
            {"operating", operating_data(events.operating)}};
  } catch (const InputError&) {
    return nullptr;  // a scene that this version cannot read: the page has no lines of harmonics
  }
}

Json loci_data(const LociFile& loci, const Hdf5File& file, const ReportBudget& budget) {
  if (loci.n_nodes() < 2) {
    throw InputError(loci.path + ": holds " + std::to_string(loci.n_nodes()) +
                     " points, a page needs two; trace the scene again");
  }
  Json data{{"kind", "loci"}};
  data["parameter"] = {{"name", loci.parameter}, {"unit", loci.parameter_unit}};
  const FrequencyUnit unit = frequency_unit(loci.parameter_unit);
  data["frequency_unit"] = {{"name", unit.name}, {"factor", unit.factor}};
  data["whirl"] = whirl_data(loci, file);
  data["coordinates"] = loci.coordinates;
  data["constraints"] = loci.constraints.size();
  data["curves"] = curves_data(loci, budget);
  data["modes"] = modes_data(loci);
  data["events"] = events_data(loci);
  data["ranges"] = loci.ranges ? ranges_data(*loci.ranges) : Json();
  data["excitation"] = excitation_data(loci);
  data["shapes"] = shapes_data(loci, file, budget);
  return data;
}

}  // namespace eigentrail
