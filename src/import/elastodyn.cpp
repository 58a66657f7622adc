#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/blade_files.hpp"
#include "import/formats.hpp"
#include "import/samples.hpp"
#include "import/station_scene.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

std::vector<double> times(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::string stations_of(const ElastoDynBlade& blade, std::vector<std::string>& warnings) {
  const auto column = [&](const char* name) { return blade.columns.at(name); };
  std::vector<std::pair<std::string, std::vector<double>>> columns = {
      {"span", column("BlFract")},
      {"twist [deg]", times(column("StrcTwst"), -1.0)},
      {"mass", times(column("BMassDen"), blade.mass_factor)},
      {"EI_flap", times(column("FlpStff"), blade.flap_factor)},
      {"EI_lag", times(column("EdgStff"), blade.edge_factor)}};
  const std::pair<const char*, std::pair<const char*, double>> optional[] = {
      {"GJStff", {"GJ", 1.0}},
      {"EAStff", {"EA", 1.0}},
      {"FlpIner", {"inertia_flap", blade.mass_factor}},
      {"EdgIner", {"inertia_lag", blade.mass_factor}}};
  for (const auto& [name, becomes] : optional) {
    if (blade.columns.contains(name))
      columns.emplace_back(becomes.first, times(column(name), becomes.second));
  }
  std::vector<std::string> unread;
  for (const char* name : {"Alpha", "PrecrvRef", "PreswpRef", "FlpcgOf", "EdgcgOf", "FlpEAOf", "EdgEAOf"}) {
    if (blade.columns.contains(name) && has_nonzero(blade.columns.at(name))) unread.emplace_back(name);
  }
  if (!unread.empty())
    warnings.push_back("columns that are not zero are not read, as ElastoDyn does: " + joined(unread));
  return csv_of(columns);
}

void warn(const ElastoDynBlade& blade, std::vector<std::string>& warnings) {
  if (blade.damping[1] != 0.0)
    warnings.push_back(
        "BldFlDmp(2) = " + short_text(blade.damping[1], 6) +
        " % is not used: the damping of the material gives the second flap mode BldFlDmp(1) in "
        "proportion to its frequency");
  if (blade.tuners != std::array{1.0, 1.0})
    warnings.emplace_back(
        "FlStTunr(1) and FlStTunr(2), factors of the stiffness of single modes, are not used");
  if (!blade.columns.contains("GJStff") || !blade.columns.contains("EAStff"))
    warnings.emplace_back(
        "the file has no GJStff and EAStff: the blade gets the stiff defaults of [[blade]], as ElastoDyn's "
        "blades neither twist nor extend");
}

Imported read_elastodyn(const ImportRequest& request) {
  const auto [main_file, blade] =
      read_blade_files(request.files, "ElastoDyn", "TipRad", parse_elastodyn_rotor, parse_elastodyn_blade);
  const ElastoDynRotor rotor = main_file.value_or(ElastoDynRotor{});
  BladeScene scene;
  scene.hub_radius = number_option(request, "hub-radius", rotor.hub_radius, false);
  scene.length = number_option(request, "length", rotor.tip_radius - rotor.hub_radius, false);
  scene.precone = rotor.precone;
  if (!(scene.length > 0.0))
    throw InputError(blade.path +
                     ": a blade file of ElastoDyn has no length; give its main file, too, or --length "
                     "(TipRad - HubRad) and --hub-radius");
  scene.largest_speed = speed_option(
      request, rotor.rotor_speed > 0.0 ? rotor.rotor_speed : usual_speed(scene.hub_radius + scene.length));
  if (blade.damping[0] != 0.0)
    scene.blade_keys += "damping_flap = " + exact_text(blade.damping[0] / 100.0) + "\n";
  if (blade.damping[2] != 0.0)
    scene.blade_keys += "damping_lag = " + exact_text(blade.damping[2] / 100.0) + "\n";

  std::vector<std::string> warnings;
  Imported result = blade_import("Blade of ElastoDyn", scene, stations_of(blade, warnings));
  result.warnings = std::move(warnings);
  result.understood.push_back(std::to_string(blade.columns.at("BlFract").size()) + " stations on " +
                              short_text(scene.length, 6) + " m from a hub radius of " +
                              short_text(scene.hub_radius, 6) + " m; mass times " +
                              short_text(blade.mass_factor, 6));
  result.understood.push_back("rotor speed 0 to " + short_text(scene.largest_speed, 6) + " rpm");
  if (!main_file && !request.options.contains("hub-radius"))
    result.warnings.emplace_back(
        "the hub radius is taken as 0; give --hub-radius, or ElastoDyn's main file, too");
  warn(blade, result.warnings);
  return result;
}

}  // namespace

Importer elastodyn_importer() {
  return {"elastodyn",
          "a blade from ElastoDyn's input files",
          {{"BlFract, StrcTwst, BMassDen, FlpStff, EdgStff", "stations; the twist changes its sign"},
           {"GJStff, EAStff, FlpIner, EdgIner", "the same, where a file has them"},
           {"AdjBlMs, AdjFlSt, AdjEdSt", "factors of the columns"},
           {"BldFlDmp(1), BldEdDmp(1)", "damping ratios of the first flap and lag mode"},
           {"TipRad, HubRad, PreCone(1), RotSpeed, BldFile(1)", "of the main file, if it is given"},
           {"BldFlDmp(2), FlStTunr, mode shapes", "not used"}},
          {{"length", "of the blade, m; default: TipRad - HubRad of the main file"},
           {"hub-radius", "m; default: HubRad of the main file"},
           {"speed", "largest rotor speed of the trace, rpm; default: RotSpeed, or a tip speed of 80 m/s"}},
          read_elastodyn};
}

}  // namespace eigentrail
