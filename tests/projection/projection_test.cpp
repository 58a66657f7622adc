// Projected families against their large ones, by solvers that know nothing of projections.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "eigentrail/projection/project.hpp"
#include "eigentrail/projection/route.hpp"
#include "support/large_families.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::projection_test {
namespace {

const SparseFamily& family_of(const TraceSetup& setup) {
  return dynamic_cast<const SparseFamily&>(*setup.model);
}

Vector at(double omega) {
  return Vector::Constant(1, omega);
}

struct Traced {
  std::unique_ptr<ProjectedFamily> model;
  std::vector<double> places;
  std::vector<ComplexVector> eigenvalues;  ///< of the followed modes at the places
  TraceResult result;
};

/// Projects and traces; the dense output at random places.
Traced run(const TraceSetup& setup, int n_places, const ProjectionOptions& options = {}) {
  Traced traced;
  Setting setting;
  setting.scene = setup.scene;
  setting.options = setup.options;
  setting.model = projected_family(setup, setup.options, options);
  const RecordedTrace record = record_trace(setting);
  traced.result = record.result;
  traced.model.reset(dynamic_cast<ProjectedFamily*>(setting.model.release()));
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> places(setup.options.from, setup.options.to);
  for (int i = 0; i < n_places; ++i) {
    traced.places.push_back(places(engine));
    traced.eigenvalues.push_back(record.eigenvalues_at(traced.places.back()));
  }
  return traced;
}

/// Largest relative distance of the traced eigenvalues from those of the large pencil.
double error(const TraceSetup& setup, const Traced& traced) {
  double largest = 0.0;
  for (std::size_t i = 0; i < traced.places.size(); ++i) {
    const AffinePencil<SparseMatrix> pencil = family_of(setup).at(at(traced.places[i]));
    for (const Complex s : traced.eigenvalues[i]) {
      if (std::isnan(s.real())) continue;
      const Complex beside = s * Complex(1.0 + 1e-4, 1e-4);
      const Complex exact = eigenvalues_near(pencil, beside, 1).front();
      largest = std::max(largest, std::abs(s - exact) / std::abs(s));
    }
  }
  return largest;
}

TEST(Projection, ErrorsAreWithinTheToleranceOfTheLargeModel) {
  for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
    const TraceSetup setup = large_setup(rotating_plate({16}), 0.0, 3.0, 4, tolerance);
    const Traced traced = run(setup, 10);
    EXPECT_EQ(traced.result.status, TraceStatus::completed);
    EXPECT_LT(error(setup, traced), tolerance) << tolerance;
    EXPECT_LE(traced.model->projection()->factorizations, 12) << tolerance;
    EXPECT_LT(traced.model->n_coordinates(), 100);
  }
}

/// n = 5000 freedoms without coupling but for a sparse transformation x = T z: eigenvalues are known exactly.
/// s^2 = -k of the first two, k = 4 + 0.2 (omega - 0.3) and 4 - 0.2 (omega - 0.3), cross at omega = 0.3.
/// Modes 3 and 4, of k near 9, are coupled by 1e-6 of the slope of their k: they veer at omega = 0.6 with a
/// half-width of 1e-6. Mode 5 has the damping 0.05 (0.45 - omega), and flutters at omega = 0.45.
AffinePencil<SparseMatrix> planted_meetings(Eigen::Index n) {
  using Entries = std::vector<Eigen::Triplet<double>>;
  const auto matrix = [n](const Entries& entries) {
    SparseMatrix A(n, n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  };
  Entries transformation, K0, K1, C0{{4, 4, 0.05 * 0.45}}, C1{{4, 4, -0.05}};
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> entry(-0.3, 0.3);
  for (Eigen::Index i = 0; i < n; ++i) {
    transformation.emplace_back(i, i, 1.0);
    for (const Eigen::Index beside : {Eigen::Index{1}, Eigen::Index{7}})
      transformation.emplace_back(i, (i + beside) % n, entry(engine));
    if (i < 5) continue;
    K0.emplace_back(i, i, 30.0 + 0.1 * static_cast<double>(i));
    C0.emplace_back(i, i, 0.01);
  }
  const std::array<double, 5> k{4.0, 4.0, 9.0, 9.0, 16.0}, slope{0.2, -0.2, 1.0, -1.0, 0.0},
      meeting{0.3, 0.3, 0.6, 0.6, 0.0};
  for (std::size_t i = 0; i < 5; ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    K0.emplace_back(at, at, k[i] - slope[i] * meeting[i]);
    K1.emplace_back(at, at, slope[i]);
  }
  K0.emplace_back(2, 3, 1e-6);
  K0.emplace_back(3, 2, 1e-6);
  const SparseMatrix T = matrix(transformation);
  const auto transformed = [&T](const SparseMatrix& A) {
    const SparseMatrix product = T.transpose() * A * T;
    return SparseMatrix(0.5 * (product + SparseMatrix(product.transpose())));
  };
  SparseMatrix identity(n, n);
  identity.setIdentity();
  const Expression omega = Expression::of_parameter(0);
  return {{{1.0, transformed(identity)}},
          {{1.0, transformed(matrix(C0))}, {omega, transformed(matrix(C1))}},
          {{1.0, transformed(matrix(K0))}, {omega, transformed(matrix(K1))}}};
}

TEST(Projection, CrossingNarrowVeeringAndFlutterOfALargeModelAreToldApart) {
  const TraceSetup setup = large_setup(planted_meetings(5000), 0.0, 1.0, 5, 1e-10);
  const std::unique_ptr<ProjectedFamily> model = projected_family(setup, setup.options);
  const TraceResult result = trace(*model, setup.options, TraceObserver{});
  EXPECT_EQ(result.status, TraceStatus::completed);
  EXPECT_NEAR(only_event(result, EventKind::crossing).p, 0.3, 1e-9);
  EXPECT_NEAR(only_event(result, EventKind::veering).p, 0.6, 1e-9);
  EXPECT_NEAR(only_event(result, EventKind::veering).half_width, 1e-6, 1e-9);
  EXPECT_NEAR(only_event(result, EventKind::flutter).p, 0.45, 1e-9);
}

/// x' = A x, as a chain of first order: infinite eigenvalues are a matter of the form with velocities, and
/// nobody misses them.
TEST(Projection, FirstOrderFamiliesHaveNoInfiniteEigenvalues) {
  constexpr Eigen::Index n = 300;
  SparseMatrix E(n, n), A(n, n), B(n, n);
  E.setIdentity();
  for (Eigen::Index i = 0; i < n; ++i) {
    A.insert(i, i) = 2.0 + 0.01 * static_cast<double>(i);
    B.insert(i, i) = 1.0;
    if (i > 0) A.insert(i, i - 1) = -1.2;
    if (i + 1 < n) A.insert(i, i + 1) = -0.8;
  }
  const TraceSetup setup =
      large_setup({{}, {{1.0, E}}, {{1.0, A}, {Expression::of_parameter(0), B}}}, 0.0, 1.0, 4, 1e-6);
  const Traced traced = run(setup, 5);
  EXPECT_EQ(traced.result.status, TraceStatus::completed);
  EXPECT_EQ(traced.result.n_infinite, 0);
  EXPECT_LT(error(setup, traced), 1e-6);
}

TEST(Projection, UndampedModelsNeedNoLeftVectors) {
  const TraceSetup setup = large_setup(rotating_plate({16, 0.0}), 0.0, 3.0, 4, 1e-8);
  const Traced traced = run(setup, 10);
  EXPECT_LT(error(setup, traced), 1e-8);
  EXPECT_EQ(traced.model->projection()->method, "Cholesky (CHOLMOD)");
}

/// Largest relative distance of the lowest eigenvalues of a projected family from those of the large one.
double error_at(const TraceSetup& setup, const ProjectedFamily& model, double p) {
  const AffinePencil<Matrix> small = model.at(at(p));
  const AffinePencil<SparseMatrix> large = family_of(setup).at(at(p));
  const Spectrum spectrum =
      compute_eigenvalues(small.M.front().matrix, small.C.front().matrix, small.K.front().matrix);
  double largest = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(*setup.options.modes.count); ++i) {
    const Complex s = spectrum.modes[i].s;
    const Complex exact = eigenvalues_near(large, s * Complex(1.0 + 1e-5, 1e-5), 1).front();
    largest = std::max(largest, std::abs(s - exact) / std::abs(s));
  }
  return largest;
}

/// With left vectors the error is of second order: without them as many samples leave a hundred times more.
TEST(Projection, CirculatoryModelsNeedLeftVectors) {
  RotatingPlate plate;
  plate.convection = 10.0;
  const TraceSetup setup = large_setup(rotating_plate(plate), 0.0, 2.0, 4, 1e-9);
  ProjectionOptions options;
  options.first_samples = 3;
  options.max_factorizations = 4;  // and one more: five samples, with which neither is done
  const auto both = projected_family(setup, setup.options, options);
  options.left_vectors = false;
  const auto right = projected_family(setup, setup.options, options);
  for (const double p : {0.3, 0.7, 1.2, 1.7}) {
    const double small = error_at(setup, *both, p);
    EXPECT_LT(small, 1e-10) << p;
    EXPECT_GT(error_at(setup, *right, p), 100.0 * small) << p;
  }
  EXPECT_GT(error_at(setup, *right, 0.3), 1e-8);  // what a tolerance of 1e-6 asks for
  EXPECT_NE(right->projection()->notes.front().find("leaves an error"), std::string::npos);
}

/// What is cut off from the space, and what lies between the samples, leave no more than what is asked for.
/// Where exact eigenvalues were computed errors are below the target; elsewhere the estimate bounds them. By
/// how much they exceed the target, a hundredth of the tolerance, depends on the places that a rough trace
/// chooses.
TEST(Projection, ErrorsBetweenTheSamplesAreWithinTheEstimate) {
  RotatingPlate plate;
  plate.convection = 10.0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    const TraceSetup setup = large_setup(rotating_plate(plate), 0.0, 2.0, 4, tolerance);
    const auto model = projected_family(setup, setup.options);
    const Projection& projection = *model->projection();
    EXPECT_LE(projection.factorizations, 6) << tolerance;
    EXPECT_LE(projection.error, 30.0 * projection.target) << tolerance;
    for (const double p : {0.13, 0.4, 0.71, 1.0, 1.27, 1.6, 1.9})
      EXPECT_LT(error_at(setup, *model, p), std::min(projection.error, 2.0 * projection.target))
          << tolerance << " at " << p;
  }
}

TEST(Projection, AModeThatComesAmongTheFollowedOnesIsNoted) {
  const TraceSetup setup = large_setup(rotating_plate({16}), 0.0, 6.0, 6, 1e-6);
  const auto model = projected_family(setup, setup.options);
  ASSERT_EQ(model->projection()->notes.size(), 1U);
  EXPECT_NE(model->projection()->notes.front().find("not followed come among the followed ones"),
            std::string::npos);
  const TraceSetup lowest = large_setup(rotating_plate({16}), 0.0, 0.3, 6, 1e-6);
  EXPECT_TRUE(projected_family(lowest, lowest.options)->projection()->notes.empty());
}

/// What explain says of the memory of the factors is near the truth, with left vectors as well: the bound
/// over all choices of pivots that UMFPACK gives is many times too large.
TEST(Projection, EstimatesOfFactorsAreNearTheFactors) {
  for (const double convection : {0.0, 10.0}) {
    RotatingPlate plate;
    plate.cells = 40;
    plate.convection = convection;
    const TraceSetup setup = large_setup(rotating_plate(plate), 0.0, 2.0, 4, 1e-4);
    const ProjectionEstimate estimate = estimate_projection(family_of(setup), setup.options);
    const auto model = projected_family(setup, setup.options);
    EXPECT_EQ(estimate.two_sided, true);
    const double bytes = static_cast<double>(model->projection()->peak_bytes);
    EXPECT_LT(estimate.factor_bytes, 2.0 * bytes) << convection;
    EXPECT_GT(estimate.factor_bytes, 0.5 * bytes) << convection;
  }
}

/// A chain of n masses with springs between them, scaled so that the frequencies of a free one are 1, 2, 3
/// ... rad/s and zero.
SparseMatrix free_chain(Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> springs;
  const double stiffness = std::pow(static_cast<double>(n) / M_PI, 2);
  for (Eigen::Index i = 1; i < n; ++i) {
    for (const Eigen::Index at : {i - 1, i}) springs.emplace_back(at, at, stiffness);
    springs.emplace_back(i, i - 1, -stiffness);
    springs.emplace_back(i - 1, i, -stiffness);
  }
  SparseMatrix K(n, n);
  K.setFromTriplets(springs.begin(), springs.end());
  return K;
}

SparseMatrix diagonal(const Vector& entries) {
  SparseMatrix A(entries.size(), entries.size());
  for (Eigen::Index i = 0; i < entries.size(); ++i) A.insert(i, i) = entries[i];
  A.makeCompressed();
  return A;
}

/// The lowest pair meets on the real axis, at -0.025, and one of it becomes unstable soon after. Where it
/// meets the eigenvalues move by the root of rounding, which no number of factorizations can change.
TEST(Projection, ACollisionOnTheRealAxisTakesFewFactorizations) {
  constexpr Eigen::Index n = 2000;
  const SparseMatrix unit = diagonal(Vector::Ones(n));
  const SparseMatrix softening = diagonal(-Vector::LinSpaced(n, 1.0, 1.5));
  AffinePencil<SparseMatrix> chain{{{1.0, unit}},
                                   {{1.0, 0.05 * unit}},
                                   {{1.0, free_chain(n) + unit}, {Expression::of_parameter(0), softening}}};
  for (const double tolerance : {1e-4, 1e-6, 1e-9}) {
    const TraceSetup setup = large_setup(chain, 0.0, 1.5, 4, tolerance);
    const Traced traced = run(setup, 10);
    EXPECT_EQ(traced.result.status, TraceStatus::completed);
    // At 1e-9 rounding of the stiffness, whose entries are a million times its lowest eigenvalue, is told;
    // how soon it is seen that more do not help depends on the kernel of BLAS: 12 or 15.
    EXPECT_LE(traced.model->projection()->factorizations, tolerance > 1e-9 ? 12 : 16) << tolerance;
    EXPECT_EQ(traced.model->projection()->notes.empty(), tolerance > 1e-9);
    EXPECT_LT(error(setup, traced), std::max(tolerance, 1e-8));
    EXPECT_EQ(events_of(traced.result, EventKind::collision).size(), 1U) << tolerance;
    EXPECT_EQ(events_of(traced.result, EventKind::divergence).size(), 1U) << tolerance;
  }
}

/// Free chains whose rigid-body motions make K singular. Zero is a double eigenvalue; with damping of the
/// masses it is a simple one.
TEST(Projection, FreeModelsAreProjected) {
  constexpr Eigen::Index n = 1000;
  const SparseMatrix K = free_chain(n), unit = diagonal(Vector::Ones(n));
  const auto fields = [n](const SparseMatrix& first, const SparseMatrix& second, double turn) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index j = 0; j < n; ++j) {
      for (SparseMatrix::InnerIterator it(first, j); it; ++it) entries.emplace_back(it.row(), j, it.value());
      for (SparseMatrix::InnerIterator it(second, j); it; ++it)
        entries.emplace_back(n + it.row(), n + j, it.value());
      if (turn == 0.0) continue;
      entries.emplace_back(j, n + j, -turn);
      entries.emplace_back(n + j, j, turn);
    }
    SparseMatrix A(2 * n, 2 * n);
    A.setFromTriplets(entries.begin(), entries.end());
    return A;
  };
  const SparseMatrix none(n, n);
  const std::vector<std::pair<std::string, SparseMatrix>> dampings{
      {"nothing", none}, {"springs", 0.01 * K}, {"masses", 0.02 * unit}};
  for (const auto& [damped, damping] : dampings) {
    for (const double gyroscopic : {0.0, 0.3}) {
      AffinePencil<SparseMatrix> pencil{
          {{1.0, fields(unit, unit, 0.0)}},
          {{1.0, fields(damping, damping, 0.0)}},
          {{1.0, fields(K, 1.3 * K, 0.0)}, {Expression::of_parameter(0), fields(0.2 * K, 0.1 * K, 0.0)}}};
      if (gyroscopic > 0.0)
        pencil.C.emplace_back(Expression::of_parameter(0), fields(none, none, gyroscopic));
      const TraceSetup setup = large_setup(std::move(pencil), 0.0, 1.0, 6, 1e-6);
      SCOPED_TRACE(damped + " damped, gyroscopic " + std::to_string(gyroscopic));
      try {
        const Traced traced = run(setup, 3);
        EXPECT_EQ(traced.result.status, TraceStatus::completed) << traced.result.message;
        EXPECT_LE(traced.model->projection()->factorizations, 12);
        for (std::size_t i = 0; i < traced.places.size(); ++i) {
          const AffinePencil<SparseMatrix> there = family_of(setup).at(at(traced.places[i]));
          int moving = 0;
          for (const Complex s : traced.eigenvalues[i]) {
            if (std::isnan(s.real()) || std::abs(s) < 0.1) continue;
            ++moving;
            const Complex exact = eigenvalues_near(there, s * Complex(1.0 + 1e-4, 1e-4), 1).front();
            EXPECT_LT(std::abs(s - exact), 1e-6 * std::abs(s)) << s;
          }
          EXPECT_GE(moving, 2);
        }
      } catch (const std::exception& failure) {
        ADD_FAILURE() << failure.what();
      }
    }
  }
}

TEST(Projection, SingleValuesAreExact) {
  const TraceSetup setup = large_setup(rotating_plate({16, 0.02, 1.0}), 0.0, 3.0, 4, 1e-6);
  const auto model = project_at(shared_model(setup), setup.options, {1.0});
  EXPECT_EQ(model->projection()->factorizations, 1);
  const AffinePencil<Matrix> reduced = dynamic_cast<const ProjectedFamily&>(*model).at(at(1.0));
  const Spectrum spectrum =
      compute_spectrum(reduced.M.front().matrix, reduced.C.front().matrix, reduced.K.front().matrix);
  for (int i = 0; i < 4; ++i) {
    const Complex s = spectrum.modes[static_cast<std::size_t>(i)].s;
    const Complex exact = eigenvalues_near(family_of(setup).at(at(1.0)), s * Complex(1.0, 1e-4), 1).front();
    EXPECT_LT(std::abs(s - exact), 1e-9 * std::abs(s));
  }
}

TEST(Projection, AllModesOfALargeModelAreRefused) {
  TraceSetup setup = large_setup(rotating_plate({16}), 0.0, 3.0, 4, 1e-6);
  setup.options.modes = {};
  EXPECT_THROW((void)projected_family(setup, setup.options), InputError);
}

TEST(Projection, ModesInABandAreAllThere) {
  TraceSetup setup = large_setup(rotating_plate({16}), 0.0, 1.0, 4, 1e-6);
  setup.options.modes = {};
  setup.options.modes.band = FrequencyBand{5.0, 8.0};
  const auto model = projected_family(setup, setup.options);
  const AffinePencil<Matrix> reduced = model->at(at(0.0));
  const Spectrum small =
      compute_spectrum(reduced.M.front().matrix, reduced.C.front().matrix, reduced.K.front().matrix);
  const AffinePencil<SparseMatrix> large = family_of(setup).at(at(0.0));
  const Spectrum whole = compute_eigenvalues(Matrix(large.M.front().matrix), Matrix(large.C.front().matrix),
                                             Matrix(large.K.front().matrix));
  int in_band = 0;
  for (const StartingMode& mode : whole.modes) {
    if (!setup.options.modes.wants(mode.s)) continue;
    ++in_band;
    double nearest = 1e300;
    for (const StartingMode& other : small.modes) nearest = std::min(nearest, std::abs(other.s - mode.s));
    EXPECT_LT(nearest, 1e-7 * std::abs(mode.s)) << mode.s;
  }
  EXPECT_GE(in_band, 3);
}

}  // namespace
}  // namespace eigentrail::test::projection_test
