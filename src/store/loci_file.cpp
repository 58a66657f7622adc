#include "eigentrail/store/loci_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "core/hdf5_file.hpp"
#include "eigentrail/continuation/dense_output.hpp"
#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/text.hpp"
#include "eigentrail/store/loci_writer.hpp"

namespace eigentrail {
namespace {

/// Root attributes as text; those that somebody added in a type of their own are left out.
void read_attributes(const Hdf5File& file, LociFile& loci) {
  for (const std::string& name : file.attribute_names()) {
    try {
      if (name.starts_with("count_") || name == "schema_version") {
        loci.attributes[name] = std::to_string(file.integer_attribute(name));
      } else if (name == "tolerance" || name == "reference" || name == "seconds") {
        loci.attributes[name] = exact_text(file.real_attribute(name));
      } else {
        loci.attributes[name] = file.text_attribute(name);
      }
    } catch (const Hdf5Error&) {
      loci.attributes.erase(name);
    }
  }
}

void check_format(const Hdf5File& file, const std::string& path) {
  if (!file.has_attribute("format") || file.text_attribute("format") != "eigentrail-loci") {
    throw InputError(path + ": is an HDF5 file, but no loci file of eigentrail");
  }
  const std::int64_t schema = file.integer_attribute("schema_version");
  if (schema != loci_schema_version) {
    throw InputError(path + ": has schema " + std::to_string(schema) + ", this program reads schema " +
                     std::to_string(loci_schema_version));
  }
}

void read_series(const Hdf5File& file, LociFile& loci) {
  loci.p = file.read_real(loci.parameter);
  const Shape shape = file.shape("eigenvalue_series");
  const bool consistent = shape.size() == 3 && shape[0] == loci.p.size() && shape[1] == loci.modes.size() &&
                          shape[2] >= 2 && shape[2] <= static_cast<std::uint64_t>(max_order) + 1;
  if (!consistent) throw InputError(loci.path + ": eigenvalue_series does not fit the other datasets");
  const std::vector<Complex> data = file.read_complex("eigenvalue_series");
  using RowMajor = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(shape[1]);
  const auto columns = static_cast<Eigen::Index>(shape[2]);
  for (std::size_t node = 0; node < loci.p.size(); ++node) {
    loci.series.emplace_back(
        Eigen::Map<const RowMajor>(data.data() + node * shape[1] * shape[2], rows, columns));
  }
}

/// A node x column array; an empty one when there are no columns.
Matrix read_rows(const Hdf5File& file, const std::string& name, const LociFile& loci, std::size_t columns) {
  if (columns == 0) return Matrix(static_cast<Eigen::Index>(loci.n_nodes()), 0);
  const Shape shape = file.shape(name);
  if (shape.size() != 2 || shape[0] != loci.n_nodes() || shape[1] != columns) {
    throw InputError(loci.path + ": " + name + " does not fit the other datasets");
  }
  const std::vector<double> data = file.read_real(name);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  return Eigen::Map<const RowMajor>(data.data(), static_cast<Eigen::Index>(shape[0]),
                                    static_cast<Eigen::Index>(shape[1]));
}

}  // namespace

double LociFile::lowest() const {
  return p.empty() ? NAN : std::min(p.front(), p.back());
}
double LociFile::highest() const {
  return p.empty() ? NAN : std::max(p.front(), p.back());
}

std::size_t LociFile::nearest_node(double value) const {
  const auto closer = [value](double a, double b) { return std::abs(a - value) < std::abs(b - value); };
  return static_cast<std::size_t>(std::min_element(p.begin(), p.end(), closer) - p.begin());
}

ComplexVector LociFile::eigenvalues_at(double value) const {
  if (p.empty()) throw InputError(path + ": holds no points");
  if (!(value >= lowest() && value <= highest())) {
    throw InputError(path + ": " + parameter + " = " + exact_text(value) + " lies outside the traced range " +
                     exact_text(lowest()) + " ... " + exact_text(highest()));
  }
  const bool ascending = p.back() >= p.front();
  const auto after = [&](double node, double target) { return ascending ? node < target : node > target; };
  const auto found = std::lower_bound(p.begin(), p.end(), value, after);
  const auto right = static_cast<std::size_t>(found - p.begin());
  ComplexVector s = p[right] == value
                        ? ComplexVector(series[right].col(0))
                        : HermiteInterpolant(p[right - 1], series[right - 1], p[right], series[right])(value);
  for (Complex& member : s) {
    if (member.imag() < 0.0) member = std::conj(member);
  }
  return s;
}

LociFile read_loci(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError(path + ": no such file, or not a plain file");
  try {
    const Hdf5File file = Hdf5File::open(path);
    check_format(file, path);
    LociFile loci;
    loci.path = path;
    read_attributes(file, loci);
    loci.parameter = file.text_attribute("parameter");
    loci.parameter_unit = file.text_attribute(loci.parameter, "units");
    loci.modes = file.read_texts("mode");
    loci.coordinates = file.read_texts("coordinate");
    if (file.has("constraint")) loci.constraints = file.read_texts("constraint");
    read_series(file, loci);
    loci.equilibrium = read_rows(file, "equilibrium", loci, loci.coordinates.size());
    loci.multiplier = read_rows(file, "multiplier", loci, loci.constraints.size());
    loci.residual = file.read_real("residual");
    loci.condition = file.read_real("condition");
    const std::size_t expected = loci.n_nodes() * loci.modes.size();
    if (loci.residual.size() != expected || loci.condition.size() != expected) {
      throw InputError(path + ": residual and condition do not fit the other datasets");
    }
    return loci;
  } catch (const Hdf5Error& failure) {
    throw InputError(path + ": cannot be read as a loci file: " + failure.what());
  }
}

}  // namespace eigentrail
