#include <set>

#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/blade_files.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

class ElastoDynBladeReader {
 public:
  ElastoDynBladeReader(std::string_view text, const std::string& path) : lines_(text, path) {
    blade_.path = path;
  }

  ElastoDynBlade read() {
    std::vector<std::string_view> words;
    while (!(words = lines_.next()).empty()) {
      if (equal_words(words[0], "BlFract")) break;
      read_value(words);
    }
    if (words.empty()) lines_.fail("no table that begins with BlFract; is this a blade file of ElastoDyn?");
    if (stations_ == 0)
      lines_.fail("no number of stations NBlInpSt above the table; is this a blade file of ElastoDyn?");
    read_table(words);
    return std::move(blade_);
  }

 private:
  void read_value(const std::vector<std::string_view>& words) {
    if (has_name(words, "NBlInpSt")) stations_ = lines_.count(words[0], "NBlInpSt", limits::list_length);
    const std::pair<const char*, double*> values[] = {
        {"BldFlDmp(1)", &blade_.damping[0]}, {"BldFlDmp(2)", &blade_.damping[1]},
        {"BldEdDmp(1)", &blade_.damping[2]}, {"FlStTunr(1)", &blade_.tuners[0]},
        {"FlStTunr(2)", &blade_.tuners[1]},  {"AdjBlMs", &blade_.mass_factor},
        {"AdjFlSt", &blade_.flap_factor},    {"AdjEdSt", &blade_.edge_factor}};
    for (const auto& [name, value] : values) {
      if (!has_name(words, name)) continue;
      *value = lines_.number(words[0], std::string(name) + ": expected a number");
      const bool may_be_zero = std::string_view(name).find("Dmp") != std::string_view::npos;
      if (*value < 0.0 || (*value == 0.0 && !may_be_zero))
        lines_.fail(std::string(name) + ": expected a " +
                    (may_be_zero ? "number that is not negative" : "positive number"));
    }
  }

  void read_table(const std::vector<std::string_view>& names) {
    std::vector<std::vector<double>*> columns;
    for (const std::string_view name : names) {
      if (columns.size() == limits::text_length) lines_.fail("the table has too many columns");
      columns.push_back(&blade_.columns[printable(std::string(name))]);
    }
    if (blade_.columns.size() != names.size()) lines_.fail("two columns of the table have the same name");
    for (const char* required : {"BlFract", "StrcTwst", "BMassDen", "FlpStff", "EdgStff"}) {
      if (!blade_.columns.contains(required))
        lines_.fail("the table has no column " + std::string(required) +
                    "; expected BlFract, StrcTwst, BMassDen, FlpStff and EdgStff");
    }
    lines_.next();  // units
    for (std::size_t i = 0; i < stations_; ++i) {
      const std::string what =
          "station " + std::to_string(i + 1) + " of NBlInpSt = " + std::to_string(stations_);
      const std::vector<double> row = lines_.row(lines_.next(), columns.size(), what);
      for (std::size_t k = 0; k < row.size(); ++k) columns[k]->push_back(row[k]);
      check_station(what);
    }
    if (blade_.columns["BlFract"].back() != 1.0) lines_.fail("BlFract must end at 1, at the tip");
    const auto rest = lines_.next();
    if (rest.size() >= columns.size() && number_of(rest[0]))
      lines_.fail("the table has more rows than NBlInpSt = " + std::to_string(stations_));
  }

  void check_station(const std::string& what) {
    const std::vector<double>& span = blade_.columns["BlFract"];
    if (span.size() == 1 && span[0] != 0.0) lines_.fail(what + ": BlFract must begin with 0, at the root");
    if (span.size() > 1 && !(span.back() > span[span.size() - 2]))
      lines_.fail(what + ": BlFract must increase from station to station");
    for (const char* name : {"BMassDen", "FlpStff", "EdgStff"}) {
      if (!(blade_.columns[name].back() > 0.0)) lines_.fail(what + ": " + name + " must be positive");
    }
  }

  InputLines lines_;
  std::size_t stations_ = 0;
  ElastoDynBlade blade_;
};

}  // namespace

ElastoDynBlade parse_elastodyn_blade(std::string_view text, const std::string& path) {
  return ElastoDynBladeReader(text, path).read();
}

ElastoDynRotor parse_elastodyn_rotor(std::string_view text, const std::string& path) {
  ElastoDynRotor rotor;
  rotor.path = path;
  InputLines lines(text, path);
  std::map<std::string, double*> wanted = {{"TipRad", &rotor.tip_radius},
                                           {"HubRad", &rotor.hub_radius},
                                           {"PreCone(1)", &rotor.precone},
                                           {"RotSpeed", &rotor.rotor_speed}};
  std::set<std::string> found;
  for (auto words = lines.next(); !words.empty(); words = lines.next()) {
    for (const auto& [name, value] : wanted) {
      if (!has_name(words, name)) continue;
      *value = lines.number(words[0], name + ": expected a number");
      found.insert(name);
    }
    if (has_name(words, "BldFile(1)") || has_name(words, "BldFile1"))
      rotor.blade_file = without_quotes(words[0]);
  }
  if (!found.contains("TipRad") || !found.contains("HubRad"))
    lines.fail("no TipRad and HubRad; is this a main file of ElastoDyn?");
  if (rotor.hub_radius < 0.0 || !(rotor.tip_radius > rotor.hub_radius))
    lines.fail("expected 0 <= HubRad < TipRad; they are " + short_text(rotor.hub_radius, 6) + " and " +
               short_text(rotor.tip_radius, 6));
  return rotor;
}

bool names_value(std::string_view text, std::string_view name) {
  InputLines lines(text, "");
  for (auto words = lines.next(); !words.empty(); words = lines.next()) {
    if (has_name(words, name) || equal_words(words[0], name)) return true;
  }
  return false;
}

}  // namespace eigentrail
