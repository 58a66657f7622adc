#include <Eigen/Cholesky>

#include "core/texts.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/blade_files.hpp"
#include "import/text_lines.hpp"

namespace eigentrail {
namespace {

/// Largest relative difference of entries that mirror each other, for files with few digits.
constexpr double symmetric_to = 1e-4;

class BeamDynBladeReader {
 public:
  BeamDynBladeReader(std::string_view text, const std::string& path) : lines_(text, path) {
    blade_.path = path;
  }

  BeamDynBlade read() {
    std::size_t stations = 0;
    while (true) {
      const std::vector<std::string_view> words = lines_.next();
      if (words.empty())
        lines_.fail("no line 'Distributed Properties' before the stations; is this a blade file of BeamDyn?");
      if (has_name(words, "station_total"))
        stations = lines_.count(words[0], "station_total", limits::list_length);
      if (has_name(words, "damp_type")) read_damping_type(words[0]);
      if (has_name(words, "n_modes") || has_name(words, "n_mode")) read_modal_damping(words[0]);
      if (equal_words(words[0], "mu1")) read_mu();
      if (has_name(words, "Distributed")) break;
    }
    if (stations < 2) lines_.fail("no station_total above the stations, or less than two of them");
    for (std::size_t i = 0; i < stations; ++i)
      read_station("station " + std::to_string(i + 1) + " of station_total = " + std::to_string(stations));
    if (blade_.span.front() != 0.0 || blade_.span.back() != 1.0)
      lines_.fail("stations must begin at 0 and end at 1");
    const auto rest = lines_.next();
    if (!rest.empty() && number_of(rest[0]))
      lines_.fail("more stations than station_total = " + std::to_string(stations));
    return std::move(blade_);
  }

 private:
  void read_damping_type(std::string_view word) {
    const auto type = whole_number_of(word);
    if (!type || *type < 0 || *type > 2) lines_.fail("damp_type: expected 0, 1 or 2");
    blade_.damping_type = static_cast<int>(*type);
  }

  void read_mu() {
    lines_.next();  // units
    const std::vector<double> mu = lines_.row(lines_.next(), 6, "mu1 to mu6");
    for (std::size_t i = 0; i < 6; ++i) {
      if (mu[i] < 0.0) lines_.fail("mu" + std::to_string(i + 1) + " must not be negative");
      blade_.mu[i] = mu[i];
    }
  }

  void read_modal_damping(std::string_view word) {
    const std::size_t count = lines_.count(word, "n_modes", limits::list_length);
    blade_.modal_ratios = lines_.row(lines_.next(), count, "zeta");
    for (const double ratio : blade_.modal_ratios) {
      if (ratio < 0.0) lines_.fail("zeta must not be negative");
    }
  }

  void read_station(const std::string& what) {
    const double at = lines_.row(lines_.next(), 1, what).front();
    if (!blade_.span.empty() && !(at > blade_.span.back()))
      lines_.fail(what + ": stations must increase from root to tip");
    blade_.span.push_back(at);
    blade_.stiffness.push_back(read_matrix(what + ", stiffness"));
    blade_.mass.push_back(read_matrix(what + ", mass"));
  }

  Matrix6 read_matrix(const std::string& what) {
    Matrix6 matrix;
    for (int r = 0; r < 6; ++r) {
      const std::vector<double> row = lines_.row(lines_.next(), 6, what + ", row " + std::to_string(r + 1));
      for (int c = 0; c < 6; ++c) matrix(r, c) = row[static_cast<std::size_t>(c)];
    }
    const Matrix6 symmetric = 0.5 * (matrix + matrix.transpose());
    if (Eigen::LLT<Eigen::MatrixXd>(symmetric).info() != Eigen::Success)
      lines_.fail(what + ": the matrix must be positive definite");
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < r; ++c) {
        const double size = std::sqrt(symmetric(r, r) * symmetric(c, c));
        if (std::abs(matrix(r, c) - matrix(c, r)) > symmetric_to * size)
          lines_.fail(what + ": the matrix must be symmetric; entries " + std::to_string(r + 1) + "," +
                      std::to_string(c + 1) + " differ");
      }
    }
    return symmetric;
  }

  InputLines lines_;
  BeamDynBlade blade_;
};

}  // namespace

BeamDynBlade parse_beamdyn_blade(std::string_view text, const std::string& path) {
  return BeamDynBladeReader(text, path).read();
}

BeamDynAxis parse_beamdyn_axis(std::string_view text, const std::string& path) {
  BeamDynAxis axis;
  axis.path = path;
  InputLines lines(text, path);
  std::size_t count = 0;
  for (auto words = lines.next(); !words.empty(); words = lines.next()) {
    if (has_name(words, "kp_total")) count = lines.count(words[0], "kp_total", limits::list_length);
    if (has_name(words, "BldFile")) axis.blade_file = without_quotes(words[0]);
    if (!equal_words(words[0], "kp_xr")) continue;
    if (count < 2) lines.fail("no kp_total above the key points, or less than two of them");
    lines.next();  // units
    for (std::size_t i = 0; i < count; ++i) {
      const std::string what =
          "key point " + std::to_string(i + 1) + " of kp_total = " + std::to_string(count);
      const std::vector<double> row = lines.row(lines.next(), 4, what);
      axis.points.emplace_back(row[0], row[1], row[2]);
      axis.twist.push_back(row[3]);
      if (i == 0 && axis.points[0].norm() != 0.0)
        lines.fail(what + ": the first one must be 0 0 0, the root");
      if (i > 0 && !(axis.points[i].z() > axis.points[i - 1].z()))
        lines.fail(what + ": kp_zr must increase from root to tip");
    }
  }
  if (axis.points.empty()) lines.fail("no key points kp_xr, kp_yr, kp_zr; is this a main file of BeamDyn?");
  if (axis.blade_file.empty()) lines.fail("no BldFile, the name of the blade's file; the file was cut short");
  return axis;
}

}  // namespace eigentrail
