#include "eigentrail/continuation/certificate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "continuation/step/jacobian_change.hpp"
#include "continuation/step/operator_norm.hpp"
#include "continuation/step/shared_basis.hpp"
#include "core/products.hpp"
#include "eigentrail/core/complex_lu.hpp"
#include "eigentrail/modes/invariant_pair.hpp"

namespace eigentrail {
namespace {

/// A step is halved up to this often. More halvings certify longer steps at a higher cost; a shorter step, or
/// a block, is usually cheaper: with six, ten eigenvalues that meet in one point stay single up to there,
/// with thirty factorizations per mode and step.
constexpr int max_depth = 4;
/// Halving is given up if Z1 >= 1 and Z1 of a half exceeds this share of Z1 of the whole piece. Z1 decreases
/// about with the length of a piece that is merely too long, and does not where eigenvalues coincide. A
/// larger value tries more hopeless halvings, a smaller one gives up on pieces that could be certified.
constexpr double falling = 0.75;
/// Power iterations of a norm estimate. Estimates are too small and grow with the iterations; norm_safety
/// makes up for the rest.
constexpr int power_iterations = 4;
constexpr int further_iterations = 2;  ///< if started from the direction that another sample ended with
/// The same within a piece, where Z1 is about half of that at its ends.
constexpr int iterations_within = 1;
/// Directions that the adapted norm scales: those of the largest singular values of I - B J. A larger number
/// costs more solutions, and closes more pieces of sensitive eigenvalues.
constexpr Eigen::Index least_directions = 3;
constexpr Eigen::Index most_directions = 12;
/// One direction for so many unknowns: in a small system the solutions for them would take longer than a few
/// more factorizations.
constexpr Eigen::Index unknowns_per_direction = 16;
/// Factor on a norm estimate. With a larger value fewer steps are certified, with a smaller one the bounds
/// may be too small and the evidence weaker.
constexpr double norm_safety = 1.2;
/// Factor on Z2, which is evaluated at the middle of a piece only and may be larger beside it.
constexpr double curvature_safety = 1.5;
/// Factor on an estimate of Z2 from a single vector.
constexpr double rough_safety = 30.0;

/// Multiplications for one test, about 0.08 s: a large model has few halvings. With a larger value few tests
/// use up what the certificate may cost of all.
constexpr double most_work = 2.5e8;
/// What the vectors of a piece take, in n^2 multiplications at the speed of an LU: about thirty solutions and
/// as many products, which are several times slower, and the shares of the step's energy norm and of the
/// pencils at the samples. Only the budget of the certificate depends on it.
constexpr double vectors_of_piece = 200.0;
/// Multiplications with an entry of a band take so many times as long as those of an LU, all that is done for
/// a piece taken together. The same holds for it.
constexpr double time_of_band_entry = 8.0;

/// Number of unknowns n k + k^2 up to which one LU of the whole Jacobian takes less time than k systems of
/// size n + k. Affects only the time.
constexpr Eigen::Index largest_matrix = 80;

/// B = J^-1 of a pair, in the unknowns (vec Z, vec Lambda / scale), by an LU of J as one matrix. Keeps
/// references to its arguments.
class WholeInverse {
 public:
  WholeInverse(const PairAtPlace& at, const ComplexMatrix& W, double scale)
      : W_(W), scale_(scale), J_(jacobian_matrix(at, W, scale)), lu_(J_) {}

  /// B v and B^H v, of a vector or of the columns of a matrix.
  void apply(Eigen::Ref<ComplexMatrix> v) const { lu_.solve_in_place(v); }
  void apply_adjoint(Eigen::Ref<ComplexMatrix> v) const { lu_.solve_adjoint_in_place(v); }

  struct Change {
    ComplexMatrix matrix;

    template <class Vectors>
    Vectors times(const Vectors& v) const {
      return product(matrix, v);
    }
    template <class Vectors>
    Vectors adjoint_times(const Vectors& v) const {
      return adjoint_product(matrix, v);
    }
  };
  Change change_to(const PairAtPlace& other) const { return {jacobian_matrix(other, W_, scale_) - J_}; }

 private:
  const ComplexMatrix& W_;
  double scale_;
  ComplexMatrix J_;
  ComplexLu lu_;
};

/// The same by one LU of size n + k per column of the pair's Schur form. W1 (n x k): the lower half of W.
class TriangularInverse {
 public:
  TriangularInverse(const PairAtPlace& at, const ComplexMatrix& W, const ComplexMatrix& W1, double scale)
      : at_(at), W1_(W1), scale_(scale), factors_(at.pencil, at.Z, at.Lambda, W) {}

  void apply(Eigen::Ref<ComplexMatrix> v) const {
    factors_.solve_in_place(v);
    v.bottomRows(at_.Lambda.size()) *= 1.0 / scale_;  // the division of complex numbers might underflow
  }
  void apply_adjoint(Eigen::Ref<ComplexMatrix> v) const {
    v.bottomRows(at_.Lambda.size()) *= 1.0 / scale_;
    factors_.solve_adjoint_in_place(v);
  }

  JacobianChange change_to(const PairAtPlace& other) const { return {at_, other, W1_, scale_}; }

 private:
  const PairAtPlace& at_;
  const ComplexMatrix& W1_;
  double scale_;
  PairFactorization factors_;
};

/// The certificate of one track on one step.
class BallTest {
 public:
  BallTest(const StepPencil& pencil, const Track& left, const Track& right, double gap, RunCounts& counts)
      : pencil_(pencil),
        chart_(left.pair.chart),
        W_(left.pair.W),
        W1_(W_.bottomRows(W_.rows() / 2)),
        counts_(counts),
        gap_(gap),
        left_Z_(in_basis_of(pencil.left(), left.series.Z, left.pair.part)),
        left_Lambda_(left.series.Lambda),
        right_Z_(in_basis_of(pencil.left(), right.series.Z, left.pair.part)),
        right_Lambda_(right.series.Lambda) {
    fix_basis(W_, left_Z_, left_Lambda_);
    fix_basis(W_, right_Z_, right_Lambda_);
  }

  bool closes() {
    before_ = counts_.certificate_work;
    return closes(0.0, 1.0, 0, INFINITY);
  }
  /// Whether it would have taken too much work.
  bool gave_up() const { return gave_up_; }

 private:
  /// The interpolated pair and pencil at one value of t.
  struct State {
    State(const BallTest& test, double t)
        : sample(test.pencil_.at(t)),
          pencil(sample->at, test.chart_),
          Z(weighted_sum(test.left_Z_, test.right_Z_, sample->weights)),
          Lambda(weighted_sum(test.left_Lambda_, test.right_Lambda_, sample->weights)),
          place(pencil, Z, Lambda) {}
    State(const State&) = delete;  // refers to itself

    std::shared_ptr<const StepPencil::Sample> sample;
    PencilAtPoint pencil;  ///< of the sample
    ComplexMatrix Z, Lambda;
    PairAtPlace place;
  };

  /// The sum of the coefficients at both ends with Hermite weights.
  static ComplexMatrix weighted_sum(const std::vector<ComplexMatrix>& left,
                                    const std::vector<ComplexMatrix>& right, const Vector& weights) {
    const auto count = static_cast<Eigen::Index>(left.size());
    ComplexMatrix sum = ComplexMatrix::Zero(left[0].rows(), left[0].cols());
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(i);
      sum += weights[i] * left[at] + weights[count + i] * right[at];
    }
    return sum;
  }

  /// F(U): the residual of the pair's equation (n k), then that of the normalization (k^2).
  ComplexVector residual(const State& s) const {
    const Eigen::Index n = s.Z.rows();
    const Eigen::Index k = s.Z.cols();
    const ComplexMatrix R = s.place.residual();
    const ComplexMatrix N =
        W_.topRows(n).adjoint() * s.Z + W1_.adjoint() * (s.Z * s.Lambda) - ComplexMatrix::Identity(k, k);
    ComplexVector F(n * k + k * k);
    F << R.reshaped(), N.reshaped();
    return F;
  }

  /// Whether the test closes between `begin` and `end`, after halvings where needed. `last` is Z1 of the
  /// piece that was halved into this one and another.
  bool closes(double begin, double end, int depth, double last) {
    const double middle = 0.5 * (begin + end);
    double Z1 = 0.0;
    if (piece_closes(begin, middle, end, Z1)) return true;
    // Z1 decreases at best in proportion to the length of the piece.
    if (!(Z1 < std::exp2(max_depth - depth)) || depth == max_depth || (Z1 >= 1.0 && Z1 > falling * last))
      return false;
    if (counts_.certificate_work - before_ > most_work) {
      gave_up_ = true;
      return false;
    }
    return closes(begin, middle, depth + 1, Z1) && closes(middle, end, depth + 1, Z1);
  }

  /// A sample point of a piece.
  struct PlaceOnPiece {
    double t;
    int iterations;  ///< power iterations of the norm estimate there
  };

  /// The same without halving. Sets Z1.
  bool piece_closes(double begin, double middle, double end, double& Z1) {
    const State centre(*this, middle);
    const double scale = unknown_scale(gap_, centre.Lambda.norm());
    const auto samples = samples_of(begin, middle, end);
    const bool is_complex_part = centre.pencil.complex_sign != 0;  // the whole matrix may be singular
    if (!is_complex_part && centre.Z.size() + centre.Lambda.size() <= largest_matrix) {
      count(1, centre.Z.size() + centre.Lambda.size(), centre.pencil);
      return closes_about(centre, WholeInverse(centre.place, W_, scale), scale, samples, Z1);
    }
    count(W_.cols(), (is_complex_part ? centre.Z.rows() / 2 : centre.Z.rows()) + W_.cols(), centre.pencil);
    return closes_about(centre, TriangularInverse(centre.place, W_, W1_, scale), scale, samples, Z1);
  }

  /// Counts LUs of a size, with the solutions for the bounds.
  void count(Eigen::Index factorizations, Eigen::Index size, const PencilAtPoint& pencil) {
    const auto n = static_cast<double>(size);
    const double row =
        pencil.bands ? std::min(n, time_of_band_entry * static_cast<double>(pencil.bands.M->rows())) : n;
    counts_.certificate_factorizations += static_cast<std::uint64_t>(factorizations);
    counts_.certificate_work +=
        static_cast<double>(factorizations) * n * row * (row / 3.0 + vectors_of_piece);
  }

  /// The same with B at the middle. The test closes if (1 - Z1)^2 > 2 Z2 Y with Z1 < 1: then some r satisfies
  /// Y + Z1 r + Z2 r^2/2 <= r. Z1 is set to that of the begin.
  template <class Inverse>
  bool closes_about(const State& centre, const Inverse& B, double scale,
                    const std::array<PlaceOnPiece, 4>& samples, double& Z1) const {
    BallNorm norm(centre.Z.rows(), centre.Z.cols());
    ComplexMatrix residuals(centre.Z.size() + centre.Lambda.size(),
                            1 + static_cast<Eigen::Index>(samples.size()));
    residuals.col(0) = residual(centre);
    ComplexVector direction;
    double largest = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const State s(*this, samples[i].t);
      const auto change = B.change_to(s.place);
      const double size = i == 0 ? choose_norm(centre, B, change, norm, direction)
                                 : norm_safety * estimated_norm(OperatorInNorm(B, change, norm),
                                                                samples[i].iterations, direction);
      if (i == 0) Z1 = size;
      largest = std::max(largest, size);
      if (!(largest < 1.0)) return false;
      residuals.col(static_cast<Eigen::Index>(i) + 1) = residual(s);
    }
    B.apply(residuals);
    norm.apply_inverse(residuals);
    if (!residuals.allFinite()) return false;
    const double Y = residuals.colwise().norm().maxCoeff();
    const double room = 1.0 - largest;
    return curvature_is_below(room * room / (2.0 * Y), centre, scale, B, norm);
  }

  /// The first of the plain, the energy and the adapted norm in which Z1 of a change is below one, or the
  /// last. Returns Z1 and sets the direction of the largest change.
  template <class Inverse, class Change>
  double choose_norm(const State& centre, const Inverse& B, const Change& change, BallNorm& norm,
                     ComplexVector& direction) const {
    const OperatorInNorm in_norm(B, change, norm);
    const auto size_of_change = [&](double enough) {
      direction = start_vector(centre.Z.size() + centre.Lambda.size());
      return norm_safety * estimated_norm(in_norm, power_iterations, direction, enough);
    };
    const double too_large = 1.0 / norm_safety;
    double Z1 = size_of_change(too_large);
    if (Z1 < 1.0) return Z1;
    norm.set_energy(pencil_.energy_norm(), centre.Z);
    Z1 = size_of_change(too_large);
    if (Z1 < 1.0) return Z1;
    const Eigen::Index directions =
        std::clamp(direction.size() / unknowns_per_direction, least_directions, most_directions);
    norm.set_adapted(adapted_norm(in_norm, direction, directions));
    return size_of_change(INFINITY);
  }

  /// The ends come first, because they differ most from the middle. The direction that the operator magnifies
  /// most is about the same at all samples, so the later ones need fewer power iterations.
  static std::array<PlaceOnPiece, 4> samples_of(double begin, double middle, double end) {
    return {{{begin, power_iterations},
             {end, further_iterations},
             {0.5 * (begin + middle), iterations_within},
             {0.5 * (middle + end), iterations_within}}};
  }

  /// Whether Z2 >= |B F''| is below a limit.
  template <class Inverse>
  bool curvature_is_below(double limit, const State& s, double scale, const Inverse& B,
                          const BallNorm& norm) const {
    const Eigen::Index k = s.Z.cols();
    const double both = 2.0 * norm.largest_eigenvalue_part();
    // Far below the limit, as nearly always, one solution tells: |A v| is about |A| / sqrt(n) or more.
    const auto size = static_cast<double>(s.Z.size() + s.Lambda.size());
    for (const bool is_rough : {true, false}) {
      double squares = 0.0;
      for (Eigen::Index i = 0; i < k * k; ++i) {
        const PairCurvature A(s.place, W1_, scale, i % k, i / k);
        const OperatorInNorm in_norm(B, A, norm);
        ComplexVector direction = start_vector(s.Z.size() + s.Lambda.size());
        const double estimate =
            is_rough ? rough_safety * std::sqrt(size) * in_norm.times(direction.normalized().eval()).norm()
                     : curvature_safety * norm_safety * estimated_norm(in_norm, power_iterations, direction);
        squares += estimate * estimate;
      }
      if (both * std::sqrt(squares) < limit) return true;
    }
    return false;
  }

  const StepPencil& pencil_;
  Chart chart_;
  ComplexMatrix W_, W1_;
  RunCounts& counts_;
  double before_ = 0.0;  ///< work before this test
  bool gave_up_ = false;
  double gap_;
  std::vector<ComplexMatrix> left_Z_, left_Lambda_, right_Z_, right_Lambda_;
};

}  // namespace

bool certify_step(const StepPencil& pencil, const Track& left, const Track& right, double gap,
                  RunCounts& counts, bool* gave_up) {
  BallTest test(pencil, left, right, gap, counts);
  const bool closes = test.closes();
  if (gave_up != nullptr) *gave_up = test.gave_up();
  return closes;
}

}  // namespace eigentrail
