#include <algorithm>
#include <cmath>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "import/blade_files.hpp"
#include "import/formats.hpp"
#include "import/input_lines.hpp"
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
  explicit BeamDynImport(const ImportRequest& request) : request_(request) {}

  Imported read() {
    read_files();
    fractions_of_points();
    result_.title = "Blade of BeamDyn";
    result_.parameter = "rotor_speed";
    BladeScene scene;
    scene.hub_radius = number_option(request_, "hub-radius", 0.0);
    scene.length = axis_->points.back().z();
    scene.largest_speed = number_option(request_, "speed", usual_speed(scene.hub_radius + scene.length));
    if (!(scene.largest_speed > 0.0)) throw InputError("--speed: expected a positive number");
    add_damping(scene);
    result_.stations.emplace();
    result_.stations->csv = stations();
    result_.stations->tables = tables_of(scene);
    result_.understood.push_back(std::to_string(blade_->span.size()) + " stations and " +
                                 std::to_string(axis_->points.size()) + " key points on " +
                                 short_text(scene.length) + " m");
    result_.understood.push_back("rotor speed 0 to " + short_text(scene.largest_speed) + " rpm");
    if (!request_.options.contains("hub-radius"))
      result_.warnings.emplace_back(
          "the hub radius is taken as 0; BeamDyn does not know it: give --hub-radius");
    return std::move(result_);
  }

 private:
  void read_files() {
    for (const std::string& path : request_.files) {
      const std::string text = read_text_file(path);
      if (names_value(text, "kp_total")) {
        if (axis_) throw InputError(path + ": a second main file of BeamDyn; give one");
        axis_ = parse_beamdyn_axis(text, path);
      } else {
        if (blade_) throw InputError(path + ": a second blade file; give one, of one blade");
        blade_ = parse_beamdyn_blade(text, path);
      }
    }
    if (!axis_)
      throw InputError(blade_->path +
                       ": is BeamDyn's blade file; give its main file with the key points, too");
    if (blade_) return;
    const std::string path = beside(axis_->path, axis_->blade_file);
    blade_ = parse_beamdyn_blade(read_text_file(path), path);
  }

  /// Places of the key points along the polyline through them, from 0 to 1, as those of the stations.
  void fractions_of_points() {
    fractions_ = {0.0};
    for (std::size_t i = 1; i < axis_->points.size(); ++i)
      fractions_.push_back(fractions_.back() + (axis_->points[i] - axis_->points[i - 1]).norm());
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
    const std::size_t n = blade_->span.size();
    std::vector<double> span, twist, sweep, prebend, mass, centre_y, centre_z, flap, lag, product;
    std::vector<std::vector<double>> entries(21);
    const double length = axis_->points.back().z();
    double misfit = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      const double s = blade_->span[k];
      span.push_back(k == 0 ? 0.0 : at(s, [&](std::size_t i) { return axis_->points[i].z(); }) / length);
      if (k > 0 && !(span[k] > span[k - 1]))
        throw InputError(axis_->path + ": the axis through the key points turns back near station " +
                         std::to_string(k + 1));
      twist.push_back(0.0 - at(s, [&](std::size_t i) { return axis_->twist[i]; }));
      sweep.push_back(k == 0 ? 0.0 : -at(s, [&](std::size_t i) { return axis_->points[i].y(); }));
      prebend.push_back(k == 0 ? 0.0 : at(s, [&](std::size_t i) { return axis_->points[i].x(); }));
      const Matrix6 S = in_blade_axes(blade_->stiffness[k]);
      for (int i = 0, entry = 0; i < 6; ++i) {
        for (int j = 0; j <= i; ++j, ++entry) entries[static_cast<std::size_t>(entry)].push_back(S(i, j));
      }
      // Along x the mass matrix of a section has m; m z and -m y couple it with rotations about y and z.
      const Matrix6 M = in_blade_axes(blade_->mass[k]);
      const double m = M(0, 0), y = -M(0, 5) / m, z = M(0, 4) / m;
      mass.push_back(m);
      centre_y.push_back(y);
      centre_z.push_back(z);
      flap.push_back(std::max(0.0, M(4, 4) - m * z * z));
      lag.push_back(std::max(0.0, M(5, 5) - m * y * y));
      product.push_back(-M(4, 5) - m * y * z);
      misfit = std::max({misfit, std::abs(M(1, 1) / m - 1.0), std::abs(M(2, 2) / m - 1.0),
                         std::abs(M(3, 3) / (M(4, 4) + M(5, 5)) - 1.0)});
    }
    if (misfit > mass_form)
      result_.warnings.push_back(
          "mass matrices are not those of plane sections, by " +
          short_text(std::round(1e4 * misfit) / 100.0) +
          " %: they are taken from the mass along the blade and its moments about x and y");
    std::vector<std::pair<std::string, std::vector<double>>> columns = {
        {"span", span}, {"twist [deg]", twist}, {"mass", mass}, {"inertia_flap", flap}, {"inertia_lag", lag}};
    const auto add = [&](const std::string& name, const std::vector<double>& values, bool always = false) {
      if (always || std::any_of(values.begin(), values.end(), [](double v) { return v != 0.0; }))
        columns.emplace_back(name, values);
    };
    add("sweep", sweep);
    add("prebend", prebend);
    add("centre_y", centre_y);
    add("centre_z", centre_z);
    add("inertia_product", product);
    for (int i = 0, entry = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j, ++entry)
        add("S" + std::to_string(i + 1) + std::to_string(j + 1), entries[static_cast<std::size_t>(entry)],
            i == j);
    }
    return csv_of(columns);
  }

  void add_damping(BladeScene& scene) {
    if (blade_->damping_type == 1) {
      // Extension, shear along y and z, twist, bending about y and z.
      const std::array<std::size_t, 6> order = {2, 1, 0, 5, 4, 3};
      scene.other_tables = "[[beam_damping]]\nbeam = \"blade\"\ntime = [";
      for (std::size_t i = 0; i < 6; ++i)
        scene.other_tables += (i == 0 ? "" : ", ") + exact_text(blade_->mu[order[i]]);
      scene.other_tables += "]\n\n";
    } else if (blade_->damping_type == 2 && !blade_->modal_ratios.empty()) {
      scene.blade_keys += "damping_flap = " + exact_text(blade_->modal_ratios[0]) + "\n";
      if (blade_->modal_ratios.size() > 1)
        scene.blade_keys += "damping_lag = " + exact_text(blade_->modal_ratios[1]) + "\n";
      result_.warnings.emplace_back(
          "damp_type 2: the first two ratios are taken as those of the first flap and the first lag mode; "
          "higher modes are damped in proportion to their frequency");
    }
  }

  const ImportRequest& request_;
  Imported result_;
  std::optional<BeamDynAxis> axis_;
  std::optional<BeamDynBlade> blade_;
  std::vector<double> fractions_;
};

Imported read_beamdyn(const ImportRequest& request) {
  return BeamDynImport(request).read();
}

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
          read_beamdyn};
}

}  // namespace eigentrail
