// Linearizations of OpenFAST (.lin): one file per operating point and azimuth. The states of the blades
// become multiblade coordinates, the azimuths of an operating point are averaged.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/formats.hpp"
#include "import/lin_file.hpp"
#include "import/lin_states.hpp"
#include "import/multiblade.hpp"
#include "import/openfast_states.hpp"
#include "import/samples.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

/// Files belong to one operating point if wind speed and rotor speed agree to this share of the largest; the
/// rotor speed varies a little with the azimuth.
constexpr double same_operating_point = 0.01;
constexpr double to_rpm = 9.549296585513721;  // 30 / pi
/// What is left of the dependence on the azimuth is worth a warning from here.
constexpr double large_periodicity = 0.05;

std::string rounded_text(double x) {
  constexpr double digits = 1e6;
  return exact_text(std::round(x * digits) / digits);
}

/// Bounds of the rounding of the entries to `digits` significant digits.
Matrix rounding_of(const Matrix& A, int digits) {
  return A.unaryExpr([digits](double x) {
    const bool exact = x == 0.0 || std::abs(x) == 1.0;
    return exact ? 0.0 : 0.5 * std::pow(10.0, std::floor(std::log10(std::abs(x))) - digits + 1);
  });
}

/// Files of one operating point, as indices.
struct OperatingPointFiles {
  std::vector<std::size_t> files;
  double parameter = 0.0;
};

struct Parameter {
  std::string name, unit, text;
  std::vector<double> values;  ///< per file
};

class OpenFastImport {
 public:
  explicit OpenFastImport(const ImportRequest& request) : request_(request) {
    for (const std::string& path : request.files)
      files_.push_back(parse_lin_file(read_text_file(path), path));
  }

  Imported read() {
    const LinStates states(files_);
    const Parameter parameter = chosen_parameter();
    std::vector<OperatingPointFiles> points = operating_points(parameter);
    Imported result;
    const std::string first = std::filesystem::path(files_[0].path).stem().stem().string();
    const std::string common = files_.size() == 1 ? first : common_name(request_.files);
    result.title = (common.empty() ? first : common) + ", OpenFAST";
    result.parameter = parameter.name;
    SampledData& data = result.samples;
    data.parameter_unit = parameter.unit;
    data.source = "OpenFAST, " + count_of(files_.size(), "linearization");
    double periodicity = 0.0;
    for (const OperatingPointFiles& point : points) {
      data.values.push_back(point.parameter);
      periodicity = std::max(periodicity, add_average(point, states, data));
    }
    states.describe(data);
    require_fit(data, files_[0].path);
    result.warnings = states.warnings();
    describe(states, parameter, points, periodicity, result);
    return result;
  }

 private:
  /// Wind speed, else rotor speed; or the operating value whose description has the text that is asked for.
  Parameter chosen_parameter() const {
    const std::string asked = request_.option("parameter", "either");
    if (asked != "either" && asked != "wind_speed" && asked != "rotor_speed") return operating_value(asked);
    Parameter wind{"wind_speed", "m/s", "wind speed", {}}, rotor{"rotor_speed", "rpm", "rotor speed", {}};
    for (const LinFile& file : files_) {
      if (file.wind_speed) wind.values.push_back(*file.wind_speed);
      rotor.values.push_back(file.rotor_speed * to_rpm);
    }
    const bool has_wind = wind.values.size() == files_.size();
    if (asked == "wind_speed" && !has_wind)
      throw InputError("openfast: not all files state a wind speed; use --parameter rotor_speed");
    const bool rotor_varies = varies(rotor.values) && !varies(wind.values);
    return asked == "rotor_speed" || !has_wind || rotor_varies ? rotor : wind;
  }

  static bool varies(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax_element(values);
    return *most - *least > same_operating_point * std::max(std::abs(*least), std::abs(*most));
  }

  Parameter operating_value(const std::string& text) const {
    Parameter result;
    for (const LinFile& file : files_) {
      std::vector<const LinQuantity*> found;
      for (const std::vector<LinQuantity>* table : {&file.states, &file.operating_values}) {
        for (const LinQuantity& one : *table) {
          if (lower_case(one.description).find(lower_case(text)) != std::string::npos) found.push_back(&one);
        }
      }
      if (found.empty())
        throw InputError(file.path + ": --parameter: no state, input or output has '" + printable(text) +
                         "' in its description; expected wind_speed, rotor_speed or a part of a description");
      if (!std::isfinite(found[0]->value))
        throw InputError(file.path + ": --parameter: the operating value of '" +
                         printable(found[0]->description) + "' is not finite");
      result.values.push_back(found[0]->value);
      const OpenFastState parsed = openfast_state(found[0]->description);
      result.unit = parsed.unit;
      result.text = parsed.motion;
    }
    for (const char c : result.text)
      result.name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    if (result.name.empty() || std::isalpha(static_cast<unsigned char>(result.name[0])) == 0)
      result.name = "p_" + result.name;
    return result;
  }

  bool same_point(std::size_t a, std::size_t b) const {
    const auto close = [](double x, double y) {
      return std::abs(x - y) <= same_operating_point * std::max({std::abs(x), std::abs(y), 1e-6});
    };
    return close(files_[a].wind_speed.value_or(0.0), files_[b].wind_speed.value_or(0.0)) &&
           close(files_[a].rotor_speed, files_[b].rotor_speed);
  }

  std::vector<OperatingPointFiles> operating_points(const Parameter& parameter) const {
    std::vector<OperatingPointFiles> points;
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const auto found = std::ranges::find_if(
          points, [&](const OperatingPointFiles& point) { return same_point(point.files[0], i); });
      if (found == points.end()) {
        points.push_back({{i}, 0.0});
      } else {
        check_azimuth(*found, i);
        found->files.push_back(i);
      }
    }
    for (OperatingPointFiles& point : points) {
      for (const std::size_t i : point.files)
        point.parameter += parameter.values[i] / static_cast<double>(point.files.size());
    }
    std::ranges::sort(points, [](const auto& a, const auto& b) { return a.parameter < b.parameter; });
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i].parameter == points[i - 1].parameter)
        throw InputError("openfast: " + files_[points[i - 1].files[0]].path + " and " +
                         files_[points[i].files[0]].path +
                         " are different operating points, but have the same " + parameter.text + " " +
                         rounded_text(points[i].parameter) +
                         "; choose another parameter, such as --parameter rotor_speed");
    }
    return points;
  }

  /// The same azimuth twice would count twice in the average.
  void check_azimuth(const OperatingPointFiles& point, std::size_t file) const {
    constexpr double same_azimuth = 1e-3;  // rad; azimuths are printed with four decimals
    for (const std::size_t other : point.files) {
      const double difference = std::remainder(files_[file].azimuth - files_[other].azimuth, 2.0 * M_PI);
      if (std::abs(difference) < same_azimuth)
        throw InputError(files_[file].path + ": has the operating point and the azimuth of " +
                         files_[other].path + "; give each azimuth once");
    }
  }

  /// Adds the average of the A of an operating point. Returns the largest deviation of one of them from it,
  /// as a share.
  double add_average(const OperatingPointFiles& point, const LinStates& states, SampledData& data) const {
    const Eigen::Index n = states.size();
    Matrix sum = Matrix::Zero(n, n), error = sum;
    std::vector<Matrix> all;
    const auto count = static_cast<double>(point.files.size());
    for (const std::size_t i : point.files) {
      const Matrix A = states.matrix(i);
      const double speed = files_[i].rotor_speed;
      const MultibladeTransformation transformation =
          multiblade(n, states.tuples(), files_[i].azimuth, speed);
      all.push_back(in_multiblade_coordinates(A, transformation, speed));
      sum += all.back() / count;
      // Rounding of the entries, carried through the transformation. The deviations between azimuths are no
      // errors of the data: they are what the average leaves out, and are reported apart.
      error += transformation.T.inverse().cwiseAbs() * rounding_of(A, files_[i].digits) *
               transformation.T.cwiseAbs() / count;
    }
    double deviation = 0.0;
    for (const Matrix& one : all) deviation = std::max(deviation, (one - sum).norm() / sum.norm());
    data.A.push_back(sum);
    data.A_error.push_back(error);
    return deviation;
  }

  void describe(const LinStates& states, const Parameter& parameter,
                const std::vector<OperatingPointFiles>& points, double periodicity, Imported& result) const {
    const auto azimuths = [](const OperatingPointFiles& point) { return point.files.size(); };
    const std::size_t fewest = azimuths(*std::ranges::min_element(points, {}, azimuths));
    const std::size_t most = azimuths(*std::ranges::max_element(points, {}, azimuths));
    const int digits = std::ranges::min_element(files_, {}, &LinFile::digits)->digits;
    std::string range = rounded_text(points.front().parameter);
    if (points.size() > 1) range += " to " + rounded_text(points.back().parameter);
    result.understood.push_back(count_of(points.size(), "operating point") + " from " +
                                count_of(files_.size(), "file") + ": " + parameter.text + " " + range + " " +
                                parameter.unit);
    result.understood.push_back(std::to_string(states.size()) + " states" +
                                (states.tuples().empty()
                                     ? std::string(", none of them in the rotating frame")
                                     : "; " + std::to_string(states.tuples().size()) + " motions of " +
                                           std::to_string(states.n_blades()) +
                                           " blades in multiblade coordinates"));
    result.understood.push_back("entries known to " + std::to_string(digits) + " digits");
    const std::string percent = rounded_text(std::round(periodicity * 1e4) / 1e2) + " %";
    if (most > 1)
      result.understood.push_back(
          "averaged over " + (fewest < most ? std::to_string(fewest) + " to " : std::string()) +
          count_of(most, "azimuth") + "; single azimuths differ from the average by up to " + percent);
    if (fewest == 1 && (!states.tuples().empty() || states.rotating_states_left()) && turning(points))
      result.warnings.emplace_back(
          "an operating point has one azimuth only; an average over several, evenly spread, "
          "leaves out what is left of the dependence on the azimuth");
    if (periodicity > large_periodicity)
      result.warnings.push_back(
          "the equations depend on the azimuth by " + percent +
          " in multiblade coordinates (gravity, shear, unequal blades); modes of the average "
          "are an approximation");
  }

  bool turning(const std::vector<OperatingPointFiles>& points) const {
    return std::ranges::any_of(points, [this](const OperatingPointFiles& point) {
      return point.files.size() == 1 && files_[point.files[0]].rotor_speed != 0.0;
    });
  }

  const ImportRequest& request_;
  std::vector<LinFile> files_;
};

}  // namespace

Importer openfast_importer() {
  return {"openfast",
          "a turbine from OpenFAST's linearizations (.lin)",
          {{"Rotor Speed, Azimuth, Wind Speed",
            "operating point; files of one point are averaged over the azimuths"},
           {"Order of continuous states", "names, units, frames and derivative orders of the states"},
           {"A: n x n", "state matrix, in multiblade coordinates for three or more blades"},
           {"Order of inputs, of outputs", "operating values that can be the parameter"},
           {"B, C, D, Jacobians", "not read"}},
          {{"parameter",
            "wind_speed, rotor_speed, or a part of the description of a state, input or output; "
            "default: wind_speed, or rotor_speed if the wind does not vary"}},
          [](const ImportRequest& request) { return OpenFastImport(request).read(); }};
}

}  // namespace eigentrail
