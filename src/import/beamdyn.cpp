#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/blade_files.hpp"
#include "import/formats.hpp"
#include "import/samples.hpp"
#include "import/station_scene.hpp"
#include "import/text_lines.hpp"
#include "model/beam_axis.hpp"

namespace eigentrail {
namespace {

/// From the axes of BeamDyn (x to the suction side, y to the trailing edge, z along the blade) to those of a
/// [[blade]]: x = z, y = -y, z = x. It is a rotation, so moments and curvatures change like forces.
Matrix6 in_blade_axes(const Matrix6& matrix) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  R(0, 2) = R(2, 0) = 1.0;
  R(1, 1) = -1.0;
  Matrix6 both = Matrix6::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = R;
  return both * matrix * both.transpose();
}

/// Largest share by which a mass matrix may miss the form of that of a section.
constexpr double mass_form = 1e-3;

class BeamDynImport {
 public:
  explicit BeamDynImport(const ImportRequest& request) : request_(request) {
    std::optional<BeamDynAxis> axis;
    std::tie(axis, blade_) =
        read_blade_files(request.files, "BeamDyn", "kp_total", parse_beamdyn_axis, parse_beamdyn_blade);
    if (!axis)
      throw InputError(blade_.path +
                       ": is BeamDyn's blade file; give its main file with the key points, too");
    axis_ = std::move(*axis);
    fractions_of_points();
  }

  Imported read() {
    BladeScene scene;
    scene.hub_radius = number_option(request_, "hub-radius", 0.0, false);
    scene.length = axis_.points.back().z();
    scene.largest_speed = speed_option(request_, usual_speed(scene.hub_radius + scene.length));
    add_damping(scene);
    Imported result = blade_import("Blade of BeamDyn", scene, stations());
    result.warnings = std::move(warnings_);
    result.understood.push_back(std::to_string(blade_.span.size()) + " stations and " +
                                std::to_string(axis_.points.size()) + " key points on " +
                                short_text(scene.length, 6) + " m");
    result.understood.push_back("rotor speed 0 to " + short_text(scene.largest_speed, 6) + " rpm");
    if (!request_.options.contains("hub-radius"))
      result.warnings.emplace_back(
          "the hub radius is taken as 0; BeamDyn does not know it: give --hub-radius");
    return result;
  }

 private:
  /// Places of the key points along the polyline through them, from 0 to 1, as those of the stations.
  void fractions_of_points() {
    fractions_ = {0.0};
    for (std::size_t i = 1; i < axis_.points.size(); ++i)
      fractions_.push_back(fractions_.back() + (axis_.points[i] - axis_.points[i - 1]).norm());
    for (double& fraction : fractions_) fraction /= fractions_.back();
    fractions_.back() = 1.0;
  }

  /// A property of the key points at a place along the blade.
  template <class Value>
  double at(double fraction, Value&& value) const {
    const SmoothWeights weights = smooth_weights(fractions_, fraction);
    double sum = 0.0;
    for (std::size_t i = 0; i < fractions_.size(); ++i) sum += weights.value[i] * value(i);
    return sum;
  }

  std::string stations() {
    // In the order of the file.
    std::vector<std::pair<std::string, std::vector<double>>> columns;
    const auto add = [&](const std::string& name, double value) {
      const auto found = std::ranges::find(columns, name, [](const auto& one) { return one.first; });
      if (found != columns.end())
        found->second.push_back(value);
      else
        columns.push_back({name, {value}});
    };
    const double length = axis_.points.back().z();
    double misfit = 0.0;
    for (std::size_t k = 0; k < blade_.span.size(); ++k) {
      const double s = blade_.span[k];
      add("span", k == 0 ? 0.0 : at(s, [&](std::size_t i) { return axis_.points[i].z(); }) / length);
      const std::vector<double>& span = columns.front().second;
      if (k > 0 && !(span[k] > span[k - 1]))
        throw InputError(axis_.path + ": the axis through the key points turns back near station " +
                         std::to_string(k + 1));
      // Along x the mass matrix of a section has m; m z and -m y couple it with rotations about y and z.
      const Matrix6 M = in_blade_axes(blade_.mass[k]);
      const double m = M(0, 0), y = -M(0, 5) / m, z = M(0, 4) / m;
      add("twist [deg]", 0.0 - at(s, [&](std::size_t i) { return axis_.twist[i]; }));
      add("mass", m);
      add("inertia_flap", std::max(0.0, M(4, 4) - m * z * z));
      add("inertia_lag", std::max(0.0, M(5, 5) - m * y * y));
      add("sweep", k == 0 ? 0.0 : -at(s, [&](std::size_t i) { return axis_.points[i].y(); }));
      add("prebend", k == 0 ? 0.0 : at(s, [&](std::size_t i) { return axis_.points[i].x(); }));
      add("centre_y", y);
      add("centre_z", z);
      add("inertia_product", -M(4, 5) - m * y * z);
      const Matrix6 S = in_blade_axes(blade_.stiffness[k]);
      for (int i = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j) add("S" + std::to_string(i + 1) + std::to_string(j + 1), S(i, j));
      }
      misfit = std::max({misfit, std::abs(M(1, 1) / m - 1.0), std::abs(M(2, 2) / m - 1.0),
                         std::abs(M(3, 3) / (M(4, 4) + M(5, 5)) - 1.0)});
    }
    if (misfit > mass_form)
      warnings_.push_back("mass matrices are not those of plane sections, by " +
                          short_text(std::round(1e4 * misfit) / 100.0, 6) +
                          " %: they are taken from the mass along the blade and its moments about x and y");
    const std::set<std::string> always = {"span", "twist [deg]", "mass", "inertia_flap", "inertia_lag"};
    std::erase_if(columns,
                  [&](const auto& one) { return !always.contains(one.first) && !has_nonzero(one.second); });
    return csv_of(columns);
  }

  void add_damping(BladeScene& scene) {
    if (blade_.damping_type == 1) {
      // Extension, shear along y and z, twist, bending about y and z.
      const std::array<std::size_t, 6> order = {2, 1, 0, 5, 4, 3};
      const auto time = [&](std::size_t i) { return exact_text(blade_.mu[i]); };
      scene.other_tables =
          "[[beam_damping]]\nbeam = \"blade\"\ntime = [" + joined(order, ", ", time) + "]\n\n";
    } else if (blade_.damping_type == 2 && !blade_.modal_ratios.empty()) {
      scene.blade_keys += "damping_flap = " + exact_text(blade_.modal_ratios[0]) + "\n";
      if (blade_.modal_ratios.size() > 1)
        scene.blade_keys += "damping_lag = " + exact_text(blade_.modal_ratios[1]) + "\n";
      warnings_.emplace_back(
          "damp_type 2: the first two ratios are taken as those of the first flap and the first lag mode; "
          "higher modes are damped in proportion to their frequency");
    }
  }

  const ImportRequest& request_;
  std::vector<std::string> warnings_;
  BeamDynAxis axis_;
  BeamDynBlade blade_;
  std::vector<double> fractions_;
};

}  // namespace

Importer beamdyn_importer() {
  return {"beamdyn",
          "a blade from BeamDyn's input files",
          {{"kp_xr, kp_yr, kp_zr, initial_twist", "axis and twist, from the main file"},
           {"BldFile", "the blade file, if it is not given"},
           {"6 x 6 stiffness by station", "columns S11 ... S66, in the axes of [[blade]]"},
           {"6 x 6 mass by station", "mass, its centre and moments of inertia"},
           {"mu1 ... mu6", "[[beam_damping]]; with damp_type 2 the first two ratios, of flap and lag"}},
          {{"hub-radius", "m; default: 0"},
           {"speed", "largest rotor speed of the trace, rpm; default: a tip speed of 80 m/s"}},
          [](const ImportRequest& request) { return BeamDynImport(request).read(); }};
}

}  // namespace eigentrail
