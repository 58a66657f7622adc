#include "eigentrail/model/function_family.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/texts.hpp"
#include "core/transposition.hpp"
#include "eigentrail/core/series.hpp"
#include "eigentrail/core/text.hpp"
#include "model/family_tables.hpp"
#include "model/piecewise_chebyshev.hpp"
#include "model/series_sum.hpp"

namespace eigentrail {
namespace {

/// Errors of an entry up to this share of the entries beside it are rounding of the caller's function.
constexpr double rounding_share = 1e-14;
/// A smooth feature takes fewer pieces than this; shorter ones are there for something sharper.
constexpr double pieces_per_feature = 32.0;
/// How far beside the range, relative to its length, values of the parameter may be by rounding.
constexpr double at_the_ends = 1e-12;

/// A matrix that the function may return, and what it is in M x'' + C x' + K x = 0.
struct Given {
  const char* name;
  Matrix MatricesAt::*matrix;
  std::vector<Matrix> FamilyPiece::*series;
  double factor;
};
constexpr std::array<Given, 5> all_matrices = {{{"M", &MatricesAt::M, &FamilyPiece::M, 1.0},
                                                {"C", &MatricesAt::C, &FamilyPiece::C, 1.0},
                                                {"K", &MatricesAt::K, &FamilyPiece::K, 1.0},
                                                {"E", &MatricesAt::E, &FamilyPiece::C, 1.0},
                                                {"A", &MatricesAt::A, &FamilyPiece::K, -1.0}}};

[[noreturn]] void fail(const std::string& message) {
  throw std::invalid_argument("FunctionFamily: " + message);
}

std::string at(const std::string& parameter, double p) {
  return parameter + " = " + exact_text(p);
}

void check(const FunctionFamilyOptions& options) {
  if (options.parameter.empty()) fail("parameter: expected a name, got an empty text");
  if (!std::isfinite(options.from) || !std::isfinite(options.to) || !(options.from < options.to))
    fail("from, to: expected finite numbers with from < to, got " + exact_text(options.from) + " and " +
         exact_text(options.to));
  if (!(options.tolerance >= rounding_share && options.tolerance < 1.0))
    fail("tolerance: expected 1e-14 <= tolerance < 1, got " + exact_text(options.tolerance));
  if (options.max_calls < 2) fail("max_calls: expected at least 2, got " + std::to_string(options.max_calls));
  if (!(options.resolution > 0.0 && options.resolution <= 1.0))
    fail("resolution: expected a share of the range, above 0 and at most 1, got " +
         exact_text(options.resolution));
  for (const double place : options.breaks) {
    if (!(place > options.from && place < options.to))
      fail("breaks: expected places between from and to, got " + exact_text(place));
  }
}

/// What is rounding of the entries of a matrix, from their largest magnitudes: a share of the geometric mean
/// of the largest ones in the row and in the column, in which units cancel.
Matrix rounding_of_entries(const Matrix& largest) {
  const Vector rows = largest.rowwise().maxCoeff(), columns = largest.colwise().maxCoeff();
  return rounding_share * (rows * columns.transpose()).cwiseSqrt();
}

/// Which matrices the function returns, and their size.
class Layout {
 public:
  /// From the first call.
  Layout(const MatricesAt& first, const std::string& where) {
    const bool first_order = first.A.size() > 0;
    for (const Given& given : all_matrices) {
      if ((first.*given.matrix).size() > 0) given_.push_back(given);
    }
    n_ = (first_order ? first.A : first.K).rows();
    if (first_order && (first.M.size() > 0 || first.C.size() > 0 || first.K.size() > 0))
      fail("at " + where + " the function returned A of E x' = A x beside M, C or K");
    if (!first_order && first.E.size() > 0) fail("at " + where + " the function returned E without A");
    if (!first_order && (n_ == 0 || (first.M.size() == 0 && first.C.size() == 0)))
      fail("at " + where + " the function returned neither A nor K with M or C");
  }

  Eigen::Index n() const { return n_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(given_.size()) * n_ * n_; }

  /// All entries, one matrix after the other, each by columns.
  Vector entries(const MatricesAt& matrices, const std::string& where) const {
    for (const Given& given : all_matrices) check_size(given, matrices.*given.matrix, where);
    Vector entries(size());
    Eigen::Index next = 0;
    for (const Given& given : given_) {
      const Matrix& matrix = matrices.*given.matrix;
      for (Eigen::Index i = 0; i < matrix.size(); ++i) {
        if (!std::isfinite(matrix(i)))
          fail("at " + where + " entry " + name(next + i) + " is not a finite number; it is " +
               exact_text(matrix(i)));
      }
      entries.segment(next, n_ * n_) = matrix.reshaped();
      next += n_ * n_;
    }
    return entries;
  }

  /// "K(0, 2)", for an index into the entries.
  std::string name(Eigen::Index entry) const {
    const Eigen::Index own = entry % (n_ * n_);
    return std::string(given_[static_cast<std::size_t>(entry / (n_ * n_))].name) + "(" +
           std::to_string(own % n_) + ", " + std::to_string(own / n_) + ")";
  }

  /// What is rounding, from the largest magnitudes of all entries.
  Vector rounding(const Vector& largest) const {
    Vector result(largest.size());
    for (Eigen::Index next = 0; next < largest.size(); next += n_ * n_)
      result.segment(next, n_ * n_) =
          rounding_of_entries(largest.segment(next, n_ * n_).reshaped(n_, n_)).reshaped();
    return result;
  }

  /// The matrices of a family from their entries: M, C, K, or zero, E and -A.
  FamilyPiece piece(const ChebyshevPiece& of) const {
    FamilyPiece piece{of.from, of.to, static_cast<int>(of.coefficients.cols()) - 1, {}, {}, {}};
    Eigen::Index next = 0;
    for (const Given& given : given_) {
      std::vector<Matrix>& series = piece.*given.series;
      for (Eigen::Index j = 0; j < of.coefficients.cols(); ++j)
        series.push_back(given.factor * of.coefficients.col(j).segment(next, n_ * n_).reshaped(n_, n_));
      while (series.size() > 1 && series.back().isZero(0.0)) series.pop_back();
      next += n_ * n_;
    }
    const bool first_order = given_.back().matrix == &MatricesAt::A;
    if (piece.M.empty()) piece.M.push_back(Matrix::Zero(n_, n_));
    if (piece.C.empty())
      piece.C.push_back(first_order ? Matrix(Matrix::Identity(n_, n_)) : Matrix(Matrix::Zero(n_, n_)));
    return piece;
  }

 private:
  void check_size(const Given& given, const Matrix& matrix, const std::string& where) const {
    const bool expected = std::any_of(given_.begin(), given_.end(),
                                      [&](const Given& known) { return known.matrix == given.matrix; });
    if (matrix.rows() == (expected ? n_ : 0) && matrix.cols() == (expected ? n_ : 0)) return;
    fail("at " + where + " the function returned " + given.name + " of " + std::to_string(matrix.rows()) +
         " x " + std::to_string(matrix.cols()) + "; expected " +
         (expected ? std::to_string(n_) + " x " + std::to_string(n_) : std::string("none")));
  }

  std::vector<Given> given_;
  Eigen::Index n_ = 0;
};

std::string unresolved_text(const FunctionFamilyOptions& options, const Layout& layout,
                            const Unresolved& what, int calls) {
  const bool out_of_calls = calls >= options.max_calls;
  if (out_of_calls && what.error == 0.0)
    return "FunctionFamily: " + std::to_string(calls) + " calls are not enough to look for features of " +
           short_text(options.resolution, 3) +
           " of the range: allow more calls (max_calls), or a larger resolution";
  return "FunctionFamily: " +
         (out_of_calls ? std::to_string(calls) + " calls are not enough for the tolerance "
                       : std::string("no pieces are short enough for the tolerance ")) +
         exact_text(options.tolerance) + ": between " + at(options.parameter, what.from) + " and " +
         exact_text(what.to) + " the entry " + layout.name(what.worst) + " is off by " +
         short_text(what.error, 3) +
         " of its largest magnitude. Is there a kink? Name the place in breaks. Does it jump? Then the two "
         "sides are two families. Else allow a larger tolerance" +
         (out_of_calls ? " or more calls" : "");
}

/// Whether all coefficients of one of the matrices are symmetric (sign 1) or skew-symmetric (-1).
bool pieces_equal_transposes(const std::vector<FamilyPiece>& pieces, std::vector<Matrix> FamilyPiece::*matrix,
                             double sign) {
  return std::all_of(pieces.begin(), pieces.end(),
                     [&](const FamilyPiece& piece) { return all_equal_transposes(piece.*matrix, sign); });
}

/// Makes a matrix exactly symmetric, or skew, if it is so but for rounding of the caller's function.
void remove_asymmetry(std::vector<Matrix> FamilyPiece::*matrix, std::vector<FamilyPiece>& pieces) {
  Matrix largest = (pieces.front().*matrix).front().cwiseAbs();
  for (const FamilyPiece& piece : pieces) {
    for (const Matrix& c : piece.*matrix) largest = largest.cwiseMax(c.cwiseAbs());
  }
  const Matrix rounding = rounding_of_entries(largest);
  for (const double sign : {1.0, -1.0}) {
    const bool is_so = std::all_of(pieces.begin(), pieces.end(), [&](const FamilyPiece& piece) {
      return std::all_of((piece.*matrix).begin(), (piece.*matrix).end(), [&](const Matrix& c) {
        return ((c - sign * c.transpose()).cwiseAbs().array() <= rounding.array()).all();
      });
    });
    for (FamilyPiece& piece : pieces) {
      for (Matrix& c : piece.*matrix) c = is_so ? Matrix(0.5 * (c + sign * c.transpose())) : c;
    }
  }
}

bool is_constant(const std::vector<FamilyPiece>& pieces, std::vector<Matrix> FamilyPiece::*matrix) {
  return pieces.size() == 1 && (pieces.front().*matrix).size() == 1;
}

void check_texts(const std::vector<std::string>& given, const char* what, Eigen::Index n) {
  if (!given.empty() && static_cast<Eigen::Index>(given.size()) != n)
    fail(std::string(what) + ": expected " + std::to_string(n) + " texts, one for each coordinate, got " +
         std::to_string(given.size()));
}

/// The shortest piece of every run of pieces that are too short for a feature of the width `resolved`: at a
/// kink, or where the function changes more quickly.
std::vector<FamilyPiece> sharp_pieces(const std::vector<FamilyPiece>& pieces, double resolved) {
  std::vector<FamilyPiece> sharp;
  const auto length = [](const FamilyPiece& piece) { return piece.to - piece.from; };
  bool in_run = false;
  for (const FamilyPiece& piece : pieces) {
    const bool is_short = length(piece) * pieces_per_feature < resolved;
    if (is_short && !in_run) sharp.push_back(piece);
    if (is_short && length(piece) < length(sharp.back())) sharp.back() = piece;
    in_run = is_short;
  }
  return sharp;
}

/// The width of the features that were looked for, and the places where there are narrower ones, in words.
std::string resolution_text(const FunctionFamilyOptions& options, const std::vector<FamilyPiece>& pieces) {
  const double resolved = options.resolution * (options.to - options.from);
  const std::string unit = options.unit.empty() ? "" : " " + options.unit;
  std::string text =
      "features of the function down to " + short_text(resolved, 3) + unit + " were looked for";
  const std::string places = joined(sharp_pieces(pieces, resolved), ", ", [](const FamilyPiece& piece) {
    return short_text(0.5 * (piece.from + piece.to), 6);
  });
  return places.empty() ? text
                        : text + "; sharper, perhaps kinks: at " + options.parameter + " = " + places + unit;
}

ModelDescription describe(const FunctionFamilyOptions& options, const std::vector<FamilyPiece>& pieces,
                          int calls) {
  const Eigen::Index n = pieces.front().K.front().rows();
  check_texts(options.state_names, "state_names", n);
  check_texts(options.state_units, "state_units", n);
  ModelDescription description = describe_states(n, options.state_names);
  if (!options.state_units.empty()) description.coordinate_units = options.state_units;
  Contribution parts{.inertia = true, .conservative = true};
  parts.circulatory = !pieces_equal_transposes(pieces, &FamilyPiece::K, 1.0);
  parts.dissipative = !pieces_equal_transposes(pieces, &FamilyPiece::C, -1.0);
  parts.gyroscopic = !pieces_equal_transposes(pieces, &FamilyPiece::C, 1.0);
  description.effects = {{"function",
                          "a function of the caller's: " + std::to_string(calls) + " calls, " +
                              std::to_string(pieces.size()) + (pieces.size() == 1 ? " piece" : " pieces"),
                          1, parts, 1}};
  Parameter parameter;
  parameter.name = options.parameter;
  parameter.value = options.from;
  parameter.unit = options.unit;
  description.parameters = Parameters({parameter});
  description.data = {{"resolution", resolution_text(options, pieces)}};
  return description;
}

template <class Interpolated>
Interpolated interpolate(const FunctionFamily::Function& function, const FunctionFamilyOptions& options) {
  check(options);
  std::optional<Layout> layout;
  const auto entries = [&](double p) {
    const MatricesAt matrices = function(p);
    const std::string where = at(options.parameter, p);
    if (!layout) layout.emplace(matrices, where);
    return layout->entries(matrices, where);
  };
  PiecewiseOptions wanted{{options.from}, options.tolerance, options.max_calls, options.resolution};
  wanted.ends.insert(wanted.ends.end(), options.breaks.begin(), options.breaks.end());
  wanted.ends.push_back(options.to);
  std::sort(wanted.ends.begin(), wanted.ends.end());
  wanted.ends.erase(std::unique(wanted.ends.begin(), wanted.ends.end()), wanted.ends.end());
  const PiecewiseResult result =
      interpolate_in_pieces(entries, wanted, [&](const Vector& v) { return layout->rounding(v); });
  for (const Unresolved& what : result.unresolved)
    throw NotResolved(unresolved_text(options, *layout, what, result.calls), what.from, what.to);
  std::vector<FamilyPiece> pieces;
  for (const ChebyshevPiece& piece : result.pieces) pieces.push_back(layout->piece(piece));
  for (const auto matrix : {&FamilyPiece::M, &FamilyPiece::C, &FamilyPiece::K})
    remove_asymmetry(matrix, pieces);
  ModelDescription description = describe(options, pieces, result.calls);
  return {std::move(description), std::move(pieces), result.calls,
          options.resolution * (options.to - options.from)};
}

}  // namespace

FunctionFamily::FunctionFamily(const Function& function, const FunctionFamilyOptions& options)
    : FunctionFamily(interpolate<Interpolated>(function, options)) {}

FunctionFamily::FunctionFamily(Interpolated interpolated)
    : MatrixModel(std::move(interpolated.description)),
      calls_(interpolated.calls),
      resolved_(interpolated.resolved),
      pieces_(std::move(interpolated.pieces)) {}

Structure FunctionFamily::structure(int) const {
  Structure structure = structure_of_effects();
  structure.symmetric_mass = pieces_equal_transposes(pieces_, &FamilyPiece::M, 1.0);
  structure.constant_mass = is_constant(pieces_, &FamilyPiece::M);
  structure.constant_damping = is_constant(pieces_, &FamilyPiece::C);
  structure.constant_stiffness = is_constant(pieces_, &FamilyPiece::K);
  return structure;
}

std::vector<double> FunctionFamily::landings(int) const {
  std::vector<double> places;
  for (std::size_t i = 1; i < pieces_.size(); ++i) {
    if (pieces_[i].from - (places.empty() ? pieces_.front().from : places.back()) >= 0.5 * resolved_)
      places.push_back(pieces_[i].from);
  }
  for (const FamilyPiece& piece : sharp_pieces(pieces_, resolved_)) {
    places.push_back(piece.from);
    places.push_back(piece.to);
  }
  std::sort(places.begin(), places.end());
  return places;
}

/// The piece of a value of the parameter; where two meet, the one ahead. Null beside the range.
const FamilyPiece* FunctionFamily::piece_at(double p, double slope) const {
  const double beside = at_the_ends * (pieces_.back().to - pieces_.front().from);
  if (!(p >= pieces_.front().from - beside && p <= pieces_.back().to + beside)) return nullptr;
  const auto found = std::find_if(pieces_.begin(), pieces_.end() - 1, [&](const FamilyPiece& piece) {
    return p < piece.to || (p == piece.to && slope < 0.0);
  });
  return &*found;
}

namespace {

/// sum_j coefficients[j] T_j(x(h)) up to h^order.
template <class Real, int Q>
auto chebyshev_sum(const std::vector<Matrix>& coefficients, const Series<Real, Q>& x, int order) {
  DenseSum<Real, Q> sum(coefficients.front().rows(), coefficients.front().cols(), order);
  Series<Real, Q> T(1.0), before = x;  // T_{-1} = T_1
  for (const Matrix& matrix : coefficients) {
    sum.add(T, matrix);
    Series<Real, Q> next = 2.0 * x * T - before;
    before = std::move(T);
    T = std::move(next);
  }
  return sum.take();
}

/// The values at the Chebyshev points. Common structure is exact to rounding in them, but not in the last
/// coefficients, which are little more than rounding themselves.
void append_values(const std::vector<Matrix>& coefficients, std::vector<Matrix>& values) {
  const int count = static_cast<int>(coefficients.size()), degree = std::max(1, count - 1);
  for (int j = 0; j < count; ++j) {
    const Series<double, 0> x(chebyshev_point(j, degree));
    values.push_back(chebyshev_sum<double, 0>(coefficients, x, 0).front().dense());
  }
}

}  // namespace

CoefficientMatrices FunctionFamily::coefficient_matrices(const Vector&, int) const {
  CoefficientMatrices all;
  for (const FamilyPiece& piece : pieces_) {
    append_values(piece.M, all.M);
    append_values(piece.C, all.C);
    append_values(piece.K, all.K);
  }
  return all;
}

template <class Real, int Q>
EvaluationFault FunctionFamily::evaluate_all(const BasicPath<Real>& path, int order,
                                             BasicLinearization<Real>& result,
                                             EvaluationCounts& counts) const {
  Series<Real, Q> p;
  for (int k = 0; k <= Q; ++k) p[k] = coefficient(path.parameters, 0, k);
  double slope = 0.0;
  if constexpr (Q > 0) slope = static_cast<double>(p[1]);
  const FamilyPiece* piece = piece_at(static_cast<double>(p[0]), slope);
  if (piece == nullptr)
    return {"the function family, which ends at " +
            at(description().parameters[0].name, pieces_.front().from) + " and " +
            exact_text(pieces_.back().to)};
  // p to x: -1 at the beginning of the piece, 1 at its end
  const Real from(piece->from), to(piece->to);
  Series<Real, Q> x = p + p - Series<Real, Q>(from + to);
  for (int k = 0; k <= Q; ++k) x[k] = x[k] / (to - from);
  result.M = chebyshev_sum<Real, Q>(piece->M, x, order);
  result.C = chebyshev_sum<Real, Q>(piece->C, x, order);
  result.K = chebyshev_sum<Real, Q>(piece->K, x, order);
  result.A = {typename BasicSystemMatrix<Real>::Dense(0, n_coordinates())};
  ++counts.linearization[0];
  return {};
}

EvaluationFault FunctionFamily::linearize(const Path& path, int order, Linearization& result,
                                          EvaluationCounts& counts) const {
  return evaluate_all<double, max_order>(path, order, result, counts);
}

EvaluationFault FunctionFamily::extended_linearization(const BasicPath<Extended>& path,
                                                       BasicLinearization<Extended>& result) const {
  EvaluationCounts counts = new_counts();
  return evaluate_all<Extended, 0>(path, 0, result, counts);
}

}  // namespace eigentrail
