#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "accuracy/spectrum_distance.hpp"
#include "accuracy/verify/comparisons.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/text.hpp"

namespace eigentrail {
namespace {

constexpr int usual_samples = 100;
constexpr int samples_of_large_model = 10;

/// Largest magnitude of an eigenvalue at the stored points, 1/s.
double largest_stored(const LociFile& loci) {
  double largest = 0.0;
  for (const Complex s : loci.eigenvalues.reshaped()) {
    if (std::isfinite(s.real())) largest = std::max(largest, std::abs(s));
  }
  return largest;
}

/// Number of exact eigenvalues, up to a magnitude, that no mode of the file has. A mode that is zero to
/// `zero` may have two: whether those of a rigid-body motion are a pair or real is rounding.
std::ptrdiff_t missing_modes(const ComplexVector& s, const std::vector<Complex>& exact, double largest,
                             double zero) {
  const auto up_to = [](const auto& values, double limit) {
    return std::count_if(values.begin(), values.end(), [limit](Complex value) {
      return std::isfinite(value.real()) && std::abs(value) <= limit;
    });
  };
  constexpr double margin = 1.1;  // beside the limit an eigenvalue may count here and not there
  const auto zeros = up_to(s, zero);
  return up_to(exact, largest) - up_to(s, margin * largest) -
         std::clamp<std::ptrdiff_t>(up_to(exact, zero) - zeros, 0, zeros);
}

/// The spectrum with zeros in the place of what QZ makes of those that the structure of the equations tells:
/// as many of its smallest eigenvalues as modes of the file are exactly zero, both members of pairs, up to
/// the root of rounding of a double zero.
std::vector<Complex> with_exact_zeros(const ComplexVector& s, std::vector<Complex> exact, double largest) {
  constexpr double rounding_of_double_zero = 1.5e-7;  // of the largest eigenvalue, with a margin of ten
  auto zeros = (s.array() == 0.0).count();
  std::ranges::stable_sort(exact, {}, [](Complex value) { return std::abs(value); });
  std::vector<Complex> result;
  for (const Complex value : exact) {
    const Eigen::Index members = value.imag() != 0.0 ? 2 : 1;
    const bool is_zero = members <= zeros && std::abs(value) <= rounding_of_double_zero * largest;
    result.insert(result.end(), is_zero ? static_cast<std::size_t>(members) : 1U,
                  is_zero ? Complex(0.0) : value);
    if (is_zero) zeros -= members;
  }
  return result;
}

class SpectrumComparison {
 public:
  SpectrumComparison(const CheckedFile& file, FreshSolver& solver)
      : file_(file),
        solver_(solver),
        largest_(largest_stored(file.loci)),
        follows_all_(file.setup.options.modes.is_all()) {}

  /// Compares at one place; whether all is right there.
  bool compare(const PathPosition& place) {
    const double p = file_.loci.p.size() == 1 ? file_.loci.p[0] : file_.loci.parameter_at(place);
    const ComplexVector s = file_.loci.eigenvalues_at(place);
    const std::vector<Complex> exact = with_exact_zeros(s, solver_.spectrum_at(place, s), largest_);
    if (exact.empty()) return wrong("the scene cannot be solved at " + file_.at(p));
    ++solved_;
    Vector off = discrepancies(file_.loci, place, s, exact, file_.accuracy);
    if (off.maxCoeff() > file_.accuracy.tolerance) off = refined(place, s, std::move(off));
    Eigen::Index mode = 0;
    const double worst = off.maxCoeff(&mode);
    if (worst >= worst_) {
      worst_ = worst;
      worst_place_ = file_.mode_at(mode, p);
    }
    if (worst > file_.accuracy.tolerance)
      return wrong("eigenvalue of " + file_.mode_at(mode, p) + " is off by " + short_text(worst, 3) +
                   " of its magnitude, " + of_tolerance(worst));
    const std::ptrdiff_t missing = follows_all_ ? missing_modes(s, exact, largest_, zero_at(place, s)) : 0;
    if (missing > 0)
      return wrong(count_of(static_cast<std::size_t>(missing), "eigenvalue") + " of the spectrum at " +
                   file_.at(p) + (missing == 1 ? " has" : " have") + " no mode");
    return true;
  }

  Comparison result(const std::string& places) && {
    std::string text = places + ", each solved afresh " +
                       (solver_.is_of_large_model() ? "by shift-invert of the whole model" : "by QR or QZ");
    if (refined_ > 0) text += ", at " + std::to_string(refined_) + " of them refined";
    if (solved_ > 0)
      text +=
          ": worst discrepancy " + short_text(worst_, 3) + ", " + of_tolerance(worst_) + ": " + worst_place_;
    else
      faults_.push_back("nothing was compared with a spectrum");
    return {std::move(text), std::move(faults_)};
  }

 private:
  bool wrong(std::string fault) {
    faults_.push_back(std::move(fault));
    return false;
  }

  /// Up to which magnitude eigenvalues are zero: what the tolerance allows, or rounding of those that are.
  double zero_at(const PathPosition& place, const ComplexVector& s) const {
    double zero = file_.accuracy.tolerance * file_.accuracy.reference;
    const Matrix& rounding = file_.loci.rounding;
    for (std::size_t node = place.step; node < place.step + 2; ++node) {
      for (Eigen::Index i = 0; static_cast<Eigen::Index>(node) < rounding.rows() && i < s.size(); ++i) {
        const double error = rounding(static_cast<Eigen::Index>(node), i);
        if (std::abs(s[i]) <= error) zero = std::max(zero, error);
      }
    }
    return zero;
  }

  std::string of_tolerance(double error) const {
    return short_text(error / file_.accuracy.tolerance, 3) + " of the tolerance " +
           exact_text(file_.accuracy.tolerance);
  }

  Vector refined(const PathPosition& place, const ComplexVector& s, Vector off) {
    const std::vector<Complex> exact = with_exact_zeros(s, solver_.refined_spectrum_at(place, s), largest_);
    if (exact.empty()) return off;
    ++refined_;
    return discrepancies(file_.loci, place, s, exact, file_.accuracy);
  }

  const CheckedFile& file_;
  FreshSolver& solver_;
  double largest_;
  bool follows_all_;
  int solved_ = 0, refined_ = 0;
  double worst_ = 0.0;
  std::string worst_place_;
  std::vector<std::string> faults_;
};

/// The separate file of matrices, with its folder; empty if there is none.
std::string matrices_beside(const Scene& scene) {
  const std::string matrices = file_of_matrices(scene);
  if (matrices.empty()) return "";
  return (std::filesystem::path(scene.path).parent_path() / matrices).string();
}

}  // namespace

std::size_t samples_of(const VerifyOptions& options, const FreshSolver& solver) {
  return static_cast<std::size_t>(
      options.samples.value_or(solver.is_of_large_model() ? samples_of_large_model : usual_samples));
}

Comparison compare_spectra(const CheckedFile& file, const VerifyOptions& options, FreshSolver& solver) {
  const LociFile& loci = file.loci;
  const std::size_t samples = samples_of(options, solver);
  SpectrumComparison comparison(file, solver);
  std::string places;
  if (file.has_steps()) {
    places = count_of(samples, "random value") + " of " + loci.parameter + " and ";
    std::mt19937_64 engine(options.seed);
    std::uniform_real_distribution<double> uniform(loci.lowest(), loci.highest());
    for (std::size_t i = 0; i < samples; ++i) {
      for (const PathPosition& place : loci.positions(uniform(engine))) comparison.compare(place);
    }
  }
  bool points_fit = true;
  const std::vector<std::size_t> nodes = file.plain_nodes(samples);
  for (const std::size_t node : nodes) points_fit = comparison.compare(file.loci.at_node(node)) && points_fit;
  Comparison result =
      std::move(comparison)
          .result(places + std::to_string(nodes.size()) + " of " + count_of(loci.n_nodes(), "stored point"));
  const std::string matrices = matrices_beside(file.setup.scene);
  if (!points_fit && !matrices.empty())
    result.faults.insert(result.faults.begin(),
                         "the stored points do not fit the matrices in " + matrices +
                             ": has this file changed since the trace? Trace again, or restore it");
  return result;
}

}  // namespace eigentrail
