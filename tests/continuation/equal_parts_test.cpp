// Structures with equal parts: the same oscillator or column several times, in coordinates of their own or
// mixed, and rings of equal blades. Their events are those of one part, as often as there are parts.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "eigentrail/continuation/scene_parts.hpp"
#include "eigentrail/core/text.hpp"
#include "support/matrix_text.hpp"
#include "support/resumed.hpp"
#include "support/scenes.hpp"
#include "support/spectra.hpp"

namespace eigentrail::test::equal_parts_test {
namespace {

struct EqualParts {
  std::string name;
  FamilyMatrices matrices;
  double from = 0.0, to = 1.0;
  EventKind kind = EventKind::collision;
  std::vector<double> places;  ///< of the events of that kind, ascending
};

void PrintTo(const EqualParts& parts, std::ostream* out) {
  *out << parts.name;
}

Matrix kronecker(Eigen::Index count, const Matrix& A) {
  Matrix all = Matrix::Zero(count * A.rows(), count * A.cols());
  for (Eigen::Index i = 0; i < count; ++i) all.block(i * A.rows(), i * A.cols(), A.rows(), A.cols()) = A;
  return all;
}

/// s^2 + p s + 1, `count` times: the pairs meet at p = 2.
EqualParts overdamped(Eigen::Index count) {
  const Matrix I = Matrix::Identity(count, count);
  return {"overdamped_" + std::to_string(count),
          {{I}, {0.0 * I, I}, {I}},
          1.0,
          3.0,
          EventKind::collision,
          std::vector<double>(static_cast<std::size_t>(count), 2.0)};
}

/// Ziegler's column under a follower load, `count` times: flutter at 7/2 - sqrt(2), and with the damping c I
/// at the load where the third Hurwitz determinant of its characteristic polynomial vanishes.
EqualParts columns(Eigen::Index count, double c, bool mixed) {
  const Matrix M{{3.0, 1.0}, {1.0, 1.0}};
  const Matrix K{{2.0, -1.0}, {-1.0, 1.0}};
  const Matrix P{{-1.0, 1.0}, {0.0, 0.0}};
  // det = 2 s^4 + 4 c s^3 + (c^2 + 7 - 2 p) s^2 + c (3 - p) s + 1; the third Hurwitz determinant is
  // proportional to 3 p^2 - (20 + 2 c^2) p + 25 + 6 c^2.
  const double b = 20.0 + 2.0 * c * c;
  const double critical =
      c > 0.0 ? (b - std::sqrt(b * b - 12.0 * (25.0 + 6.0 * c * c))) / 6.0 : 3.5 - std::sqrt(2.0);
  EqualParts parts{"columns_" + std::to_string(count) + (c > 0.0 ? "_damped" : "") + (mixed ? "_mixed" : ""),
                   {{kronecker(count, M)}, {}, {kronecker(count, K), kronecker(count, P)}},
                   0.0,
                   4.0,
                   c > 0.0 ? EventKind::flutter : EventKind::collision,
                   std::vector<double>(static_cast<std::size_t>(count), critical)};
  if (c > 0.0) parts.matrices.C = {c * Matrix::Identity(2 * count, 2 * count)};
  if (!mixed) return parts;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  const Matrix random = Matrix::NullaryExpr(2 * count, 2 * count, [&] { return normal(engine); });
  const Matrix Q = random.householderQr().householderQ();
  for (auto* matrices : {&parts.matrices.M, &parts.matrices.K}) {
    for (Matrix& A : *matrices) A = (Q.transpose() * A * Q).eval();
  }
  return parts;
}

/// Equal blades coupled to their neighbours, with drag p: harmonic k has the stiffness 1 + 0.6 (1 - cos
/// (2 pi k / n)), and its pair meets where p is twice the root of that.
EqualParts ring(Eigen::Index n) {
  const Matrix I = Matrix::Identity(n, n);
  Matrix coupling = 2.0 * I;
  EqualParts parts{"ring_" + std::to_string(n), {}, 0.1, 4.0, EventKind::collision, {}};
  for (Eigen::Index k = 0; k < n; ++k) {
    coupling(k, (k + 1) % n) -= 1.0;
    coupling((k + 1) % n, k) -= 1.0;
    const double angle = 2.0 * M_PI * static_cast<double>(k) / static_cast<double>(n);
    parts.places.push_back(2.0 * std::sqrt(1.0 + 0.6 * (1.0 - std::cos(angle))));
  }
  parts.matrices = {{I}, {0.0 * I, I}, {I + 0.3 * coupling}};
  std::sort(parts.places.begin(), parts.places.end());
  return parts;
}

RecordedTrace trace_of(const EqualParts& parts, const OptionTexts& options) {
  return record_trace(make_setting(family_scene(parts.matrices, parts.from, parts.to), options));
}

class Traced : public testing::TestWithParam<EqualParts> {
 protected:
  static RecordedTrace trace(const std::string& tolerance, bool backward) {
    EqualParts parts = GetParam();
    if (backward) std::swap(parts.from, parts.to);
    return trace_of(parts, {{"tolerance", tolerance}});
  }
};

TEST_P(Traced, HaveTheEventsOfOnePartAsOftenAsThereAreParts) {
  for (const std::string tolerance : {"1e-6", "1e-9"}) {
    for (const bool backward : {false, true}) {
      SCOPED_TRACE(tolerance + (backward ? " backward" : " forward"));
      const RecordedTrace found = trace(tolerance, backward);
      ASSERT_EQ(found.result.status, TraceStatus::completed) << found.result.message;
      EXPECT_EQ(found.result.certified_steps, found.result.mode_steps);
      EXPECT_TRUE(found.result.notes.empty());
      const std::vector<double> places = places_of(found.result, GetParam().kind);
      ASSERT_EQ(places.size(), GetParam().places.size());
      for (std::size_t i = 0; i < places.size(); ++i) EXPECT_NEAR(places[i], GetParam().places[i], 1e-9);
    }
  }
}

/// All eigenvalues are there: their sum and the sum of their squares are the traces. Not at the collisions,
/// where rounding tells a pair from two real ones.
TEST_P(Traced, HaveAllEigenvaluesEverywhere) {
  const RecordedTrace found = trace("1e-9", false);
  const EqualParts& c = GetParam();
  for (int i = 1; i < 21; ++i) {
    const double p = c.from + (c.to - c.from) * i / 21.0;
    const auto at = [p, &c](const std::vector<Matrix>& coefficients) {
      Matrix sum = 0.0 * c.matrices.M[0];
      for (std::size_t k = 0; k < coefficients.size(); ++k)
        sum += std::pow(p, static_cast<double>(k)) * coefficients[k];
      return sum;
    };
    const Matrix G = at(c.matrices.M).inverse() * at(c.matrices.C);
    const Matrix H = at(c.matrices.M).inverse() * at(c.matrices.K);
    Complex sum = 0.0;
    Complex squares = 0.0;
    for (const Complex s : found.eigenvalues_at(p)) {
      if (!std::isfinite(s.real())) continue;
      sum += s.imag() > 0.0 ? 2.0 * s.real() : s;
      squares += s.imag() > 0.0 ? 2.0 * (s * s).real() : s * s;
    }
    EXPECT_LT(std::abs(sum + G.trace()), 1e-6);
    EXPECT_LT(std::abs(squares - (G * G).trace() + 2.0 * H.trace()), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(EqualParts, Traced,
                         testing::Values(overdamped(2), overdamped(3), overdamped(6), columns(2, 0.0, false),
                                         columns(3, 0.0, true), columns(6, 0.0, false),
                                         columns(2, 0.05, true), columns(3, 0.05, false),
                                         columns(6, 0.05, true), ring(3), ring(6), ring(12), ring(24)),
                         [](const auto& test) { return test.param.name; });

const OptionTexts usual{{"tolerance", "1e-8"}, {"order", "3"}};

/// One column is traced and stands for the others: points and factorizations are those of two, however many
/// there are.
TEST(EqualParts, CostWhatOneOfThemCosts) {
  const RecordedTrace two = trace_of(columns(2, 0.05, true), usual);
  for (const Eigen::Index count : {3, 6, 12}) {
    const RecordedTrace many = trace_of(columns(count, 0.05, true), usual);
    EXPECT_EQ(many.result.n_modes, 2 * count);
    EXPECT_EQ(many.result.n_available, 2 * count);
    EXPECT_EQ(many.result.n_independent, 2 * count);
    EXPECT_EQ(many.result.nodes, two.result.nodes);
    EXPECT_EQ(many.result.counts.modes.factorizations, two.result.counts.modes.factorizations);
    EXPECT_EQ(many.result.counts.certificate_factorizations, two.result.counts.certificate_factorizations);
    EXPECT_EQ(many.result.counts.certificate_bases, two.result.counts.certificate_bases);
    EXPECT_EQ(many.result.mode_steps, count * (two.result.mode_steps / 2));
  }
}

/// Every mode that is handed out, those of copies included, is an eigenpair of the whole, and the shapes of
/// equal modes are independent.
TEST(EqualParts, HaveShapesOfTheWhole) {
  constexpr Eigen::Index count = 3;
  const EqualParts parts = columns(count, 0.05, true);
  const auto& [M, C, K, A] = parts.matrices;
  const RecordedTrace found = trace_of(parts, usual);
  ASSERT_EQ(found.result.status, TraceStatus::completed) << found.result.message;
  for (std::size_t node = 0; node < found.nodes.size(); ++node) {
    const Matrix stiffness = K[0] + found.nodes[node].p * K[1];
    const auto& modes = found.modes[node];
    ASSERT_EQ(modes.size(), static_cast<std::size_t>(2 * count));
    ComplexMatrix shapes(2 * count, 2 * count);
    for (const ModeState& mode : modes) {
      const ComplexVector v = mode.shape.normalized();
      const ComplexVector residual = mode.s * (mode.s * (M[0] * v) + C[0] * v) + stiffness * v;
      EXPECT_LT(residual.norm(), 1e-12 * stiffness.norm());
      shapes.col(mode.mode) = v;
    }
    EXPECT_GT(Eigen::JacobiSVD<ComplexMatrix>(shapes).singularValues().minCoeff(), 1e-2);
  }
}

/// Of six modes of three columns four are followed: the three equal first ones, and one of the second.
TEST(EqualParts, AreFollowedAsFarAsAskedFor) {
  const RecordedTrace found =
      trace_of(columns(3, 0.05, false), {{"tolerance", "1e-8"}, {"order", "3"}, {"modes", "4"}});
  ASSERT_EQ(found.result.status, TraceStatus::completed) << found.result.message;
  EXPECT_EQ(found.result.n_modes, 4);
  EXPECT_EQ(found.result.n_columns, 4);
  const ComplexVector s = found.eigenvalues_at(1.0);
  ASSERT_EQ(s.size(), 4);
  EXPECT_EQ(s[0], s[1]);
  EXPECT_EQ(s[0], s[2]);
  EXPECT_GT(std::abs(s[3] - s[0]), 0.5);
}

/// A parameter that changes one of two equal oscillators moves the event of that one only: the damping ratio
/// p / (2 sqrt(k)) is 0.1 at p = 0.2 sqrt(k).
TEST(EqualParts, HaveSensitivitiesOfTheirOwn) {
  const RecordedTrace found = completed_trace(make_setting(R"(
parameters = { k1 = 4.0, k2 = 4.0 }
trace = { parameter = "p", from = 0.1, to = 1, tolerance = 1e-9 }
events = { damping_ratio = 0.1 }
[matrix_family]
M = [[[1, 0], [0, 1]]]
C = [[[0, 0], [0, 0]], [[1, 0], [0, 1]]]
K = [[["k1", 0], [0, "k2"]]]
)"));
  ASSERT_EQ(found.result.events.size(), 2U);
  Vector moved = Vector::Zero(2);
  for (const Event& event : found.result.events) {
    EXPECT_NEAR(event.p, 0.4, 1e-10);
    const Eigen::Index own = std::abs(event.shape[0]) > std::abs(event.shape[1]) ? 0 : 1;
    EXPECT_NEAR(event.shift[own], 0.05, 1e-9);
    EXPECT_NEAR(event.shift[1 - own], 0.0, 1e-12);
    moved[own] += 1.0;
  }
  EXPECT_EQ(moved, Vector::Ones(2));
}

/// Two harmonics of a ring pass each other, and all of them meet where the blades are uncoupled.
TEST(PartCrossings, OfAllPartsAtOncePlaceAreOneEvent) {
  const RecordedTrace trace = completed_trace(make_setting(
      "[trace]\nparameter = \"p\"\nfrom = -0.2\nto = 0.4\n[matrix_family]\n"
      "M = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]]]\nC = [[[0.02, 0, 0], [0, 0.02, 0], [0, 0, 0.02]]]\n"
      "K = [[[1, 0, 0], [0, 1, 0], [0, 0, 1]], [[1, -1, 0], [-1, 2, -1], [0, -1, 1]]]\n"));
  ASSERT_EQ(trace.result.events.size(), 1U);
  const Event& crossing = trace.result.events.front();
  EXPECT_EQ(crossing.kind, EventKind::crossing);
  EXPECT_NEAR(crossing.p, 0.0, 1e-11);
  EXPECT_EQ(crossing.modes, (std::vector<int>{0, 1, 2}));
  EXPECT_NEAR(crossing.s.imag(), std::sqrt(1.0 - 1e-4), 1e-10);
}

/// A mass on equal springs with drag: s = -d/2 +- sqrt(d^2/4 - 1), each twice. A scene gives no coefficients
/// from which its parts could be found; those are found from its matrices at a few places.
RecordedTrace mass_on_equal_springs(const std::string& from, const std::string& to,
                                    const std::string& tolerance = "1e-9") {
  return record_trace(make_setting(R"(
parameters = { drag = 1.0 }
trace = { parameter = "drag" }
point = [{ name = "disc", mass = 1, position = [0, 0, 0] }]
guided_spring = [
  { point = "disc", direction = [1, 0, 0], stiffness = 1 },
  { point = "disc", direction = [0, 1, 0], stiffness = 1 },
]
fixed = [{ point = "disc", coordinate = "z" }]
drag = [{ point = "disc", coefficient = "drag" }]
)",
                                   {{"from", from}, {"to", to}, {"tolerance", tolerance}}));
}

/// The drag grows through critical damping, wherever the trace begins and however accurate it is.
TEST(EqualPartsOfAScene, AllFourRealEigenvaluesAreModes) {
  for (const auto& [from, to] :
       {std::pair{"1", "3"}, std::pair{"3", "1"}, std::pair{"1.5", "2.5"}, std::pair{"0.1", "4"}}) {
    for (const char* tolerance : {"1e-4", "1e-6", "1e-8", "1e-10"}) {
      SCOPED_TRACE(std::string(from) + " at " + tolerance);
      const RecordedTrace trace = mass_on_equal_springs(from, to, tolerance);
      ASSERT_EQ(trace.result.status, TraceStatus::completed) << trace.result.message;
      EXPECT_EQ(trace.result.n_columns, 4);
      EXPECT_TRUE(trace.result.notes.empty());
      ASSERT_EQ(trace.result.events.size(), 2U);
      for (const Event& collision : trace.result.events) {
        EXPECT_EQ(collision.kind, EventKind::collision);
        EXPECT_NEAR(collision.p, 2.0, 1e-10);
        EXPECT_EQ(collision.modes.size(), 2U);
        EXPECT_NEAR(std::abs(collision.puiseux), 1.0, 1e-6);
      }
    }
  }
}

/// A spherical pendulum with drag: two equal parts within the tangent space of the rod. Its damping ratio is
/// 0.1 at d* = 0.2 m sqrt(g/L); the length changes the constraint, the equilibrium and the tangent space.
TEST(EqualPartsOfAScene, MoveWithParametersThatMoveTheirTangentSpace) {
  const RecordedTrace trace = completed_trace(make_setting(R"(
parameters = { drag = 0.1, length = 2.0, mass = 3.0, g = 9.0 }
trace = { parameter = "drag", from = 0.1, to = 5, tolerance = 1e-9 }
events = { damping_ratio = 0.1 }
gravity = { acceleration = [0, 0, "-g"] }
point = [{ name = "bob", mass = "mass", position = [0, 0, "-length"] }]
rod = [{ from = [0, 0, 0], to = "bob", length = "length" }]
drag = [{ point = "bob", coefficient = "drag" }]
)"));
  ASSERT_EQ(trace.result.events.size(), 2U);
  const double place = 0.2 * 3.0 * std::sqrt(9.0 / 2.0);
  for (const Event& event : trace.result.events) {
    EXPECT_EQ(event.kind, EventKind::damping_ratio);
    EXPECT_NEAR(event.p, place, 1e-10);
    const std::array<double, 4> expected{NAN, -place / (2.0 * 2.0), place / 3.0, place / (2.0 * 9.0)};
    for (Eigen::Index q = 1; q < 4; ++q)
      EXPECT_NEAR(event.shift[q], expected[static_cast<std::size_t>(q)], 1e-8) << q;
  }
}

/// "[x, y, z]" of a place that is given in a part's own directions; the parts stand at thirds of a turn.
std::string place(int part, double along, double across, double up) {
  const double angle = 2.0 * M_PI * part / 3.0;
  const double c = std::cos(angle), s = std::sin(angle);
  return "[" + exact_text(c * along - s * across) + ", " + exact_text(s * along + c * across) + ", " +
         exact_text(up) + "]";
}

const std::string rotating_frame =
    "[parameters]\nomega = 1.0\n[trace]\nparameter = \"omega\"\ntolerance = 1e-9\n"
    "[frame]\nangular_velocity = [0, 0, \"omega\"]\n";

/// Masses on three springs each, at equal angles about the axis of a rotating frame: they move outwards as it
/// turns faster, and nothing connects them. `stiffness` of the first spring of the last mass, 1000 N/m.
std::string masses_in_a_rotating_frame(int count, const std::string& mass_of_last = "1",
                                       const std::string& stiffness_of_last = "1000") {
  std::string scene = rotating_frame;
  for (int i = 0; i < count; ++i) {
    const bool last = i + 1 == count;
    const std::string name = "mass " + std::to_string(i + 1);
    scene += "[[point]]\nname = \"" + name + "\"\nmass = " + (last ? mass_of_last : "1") +
             "\nposition = " + place(i, 1.0, 0.0, 0.0) + "\n";
    const auto spring = [&](const std::string& from, const std::string& stiffness, double length) {
      scene += "[[spring]]\nfrom = " + from + "\nto = \"" + name + "\"\nstiffness = " + stiffness +
               "\nfree_length = " + exact_text(length) + "\n";
    };
    spring(place(i, 0.0, 0.0, 0.0), last ? '"' + stiffness_of_last + '"' : "1000", 1.0);
    spring(place(i, 0.5, 0.8, 0.1), "300", 0.9);
    spring(place(i, 0.7, -0.2, 1.0), "200", 1.0);
  }
  return scene;
}
RecordedTrace trace_in_a_rotating_frame(const std::string& scene, double from = 1.0, double to = 12.0) {
  return record_trace(make_setting(scene, {{"from", exact_text(from)}, {"to", exact_text(to)}}));
}

/// The number of copies of every part of a trace.
std::vector<std::size_t> copies_in(const RecordedTrace& trace) {
  std::vector<std::size_t> copies;
  if (!trace.nodes.front().basis.parts) return copies;
  for (const auto& range : trace.nodes.front().basis.parts->ranges) copies.push_back(range.copies.size());
  std::sort(copies.begin(), copies.end());
  return copies;
}

std::vector<Complex> modes_at(const RecordedTrace& trace, double p) {
  const ComplexVector s = trace.eigenvalues_at(p);
  return {s.begin(), s.end()};
}

/// A stiffness that differs only on a small part of the range is no accident: expressions are known. The two
/// masses without it remain copies.
TEST(EqualPartsOfAScene, ThatMovesAreLookedAtWhereAnExpressionHasABump) {
  const std::string bump = "1000 * (1 + 0.01 * exp(-((omega - 7.77) / 0.01)^2))";
  const RecordedTrace one = trace_in_a_rotating_frame(masses_in_a_rotating_frame(1));
  const RecordedTrace other = trace_in_a_rotating_frame(masses_in_a_rotating_frame(1, "1", bump));
  const RecordedTrace found = trace_in_a_rotating_frame(masses_in_a_rotating_frame(3, "1", bump));
  ASSERT_EQ(found.result.status, TraceStatus::completed) << found.result.message;
  EXPECT_EQ(copies_in(found), (std::vector<std::size_t>{0, 1}));
  for (const double omega : {3.0, 7.765, 7.77, 7.775, 11.0}) {
    std::vector<Complex> expected = modes_at(other, omega);
    for (int i = 0; i < 2; ++i)
      for (const Complex s : modes_at(one, omega)) expected.push_back(s);
    EXPECT_LT(matched_distance(modes_at(found, omega), expected), 1e-8) << omega;
  }
  EXPECT_GT(matched_distance(modes_at(one, 7.77), modes_at(other, 7.77)), 1e-4);
}

/// Equations that do not have the parts of the problem are no point of the path.
TEST(EqualPartsOfAScene, ThatMovesAreTestedAtEveryPoint) {
  std::string scene = masses_in_a_rotating_frame(3, "1", "k");
  scene.replace(scene.find("omega = 1.0"), 11, "omega = 1.0\nk = 1000.0");
  const Setting setting = make_setting(scene, {{"from", "1"}, {"to", "12"}});
  PathProblem problem = setting.problem();
  problem.parts = scene_at_start(problem, setting.options).parts;
  ASSERT_TRUE(problem.parts);
  RunCounts counts;
  const auto at_three = [&] {
    const Vector guess = problem.model.initial_guess(parameters_at(problem, 3.0));
    return reduce_at(problem, 3.0, {guess, Vector()}, Matrix(), counts);
  };
  EXPECT_EQ(at_three().status, PointStatus::computed);
  problem.parameters[1] = 1000.1;
  const PathPoint point = at_three();
  EXPECT_EQ(point.status, PointStatus::no_equilibrium);
  EXPECT_NE(point.message.find("do not fall apart"), std::string::npos) << point.message;
}

/// Masses on rods that hang from a hub in a rotating frame and rise as it turns faster. Nothing connects
/// them. `stiffness_of_last`: of the spring of the last mass, 20 N/m.
std::string pendulums_in_a_rotating_frame(int count, const std::string& stiffness_of_last = "20") {
  std::string scene = rotating_frame + "[gravity]\nacceleration = [0, 0, -9.81]\n";
  for (int i = 0; i < count; ++i) {
    const std::string name = "mass " + std::to_string(i + 1);
    scene += "[[point]]\nname = \"" + name + "\"\nmass = 2\nposition = " + place(i, 0.93, -0.21, -0.45) +
             "\n[[rod]]\nfrom = " + place(i, 0.3, 0.0, 0.0) + "\nto = \"" + name +
             "\"\nlength = 0.8\n[[spring]]\nfrom = " + place(i, 0.5, 0.4, 0.1) + "\nto = \"" + name +
             "\"\nfree_length = 0.6\nstiffness = " + (i + 1 == count ? stiffness_of_last : "20") +
             "\n[[damper]]\nfrom = " + place(i, 0.5, -0.4, 0.1) + "\nto = \"" + name +
             "\"\ncoefficient = 0.3\n";
  }
  return scene;
}

/// One part, three of them, three of which one differs by 1e-10, and how far one moves.
struct MovingParts {
  std::string one, three, mistuned;
  double from, to, moved;
};
class PartsThatMove : public testing::TestWithParam<MovingParts> {};

/// The eigenvalues are those of one, three times.
TEST_P(PartsThatMove, AreTracedOnce) {
  const auto& [scene_of_one, scene_of_three, mistuned, from, to, moved] = GetParam();
  const RecordedTrace one = trace_in_a_rotating_frame(scene_of_one, from, to);
  const RecordedTrace three = trace_in_a_rotating_frame(scene_of_three, from, to);
  ASSERT_EQ(one.result.status, TraceStatus::completed) << one.result.message;
  ASSERT_EQ(three.result.status, TraceStatus::completed) << three.result.message;
  EXPECT_GT((one.nodes.back().path.x.col(0) - one.nodes.front().path.x.col(0)).norm(), moved);
  EXPECT_EQ(copies_in(three), (std::vector<std::size_t>{2}));
  EXPECT_EQ(three.result.n_columns, 3 * one.result.n_columns);
  EXPECT_EQ(three.result.certified_steps, three.result.mode_steps);
  for (int i = 1; i < 20; ++i) {
    const double omega = from + (to - from) * i / 20.0;
    const ComplexVector expected = one.eigenvalues_at(omega);
    const ComplexVector found = three.eigenvalues_at(omega);
    for (Eigen::Index mode = 0; mode < found.size(); ++mode)
      EXPECT_LT(std::abs(found[mode] - expected[mode / 3]), 2e-9 * std::abs(expected[mode / 3]));
  }
}

/// The last is a part of its own.
TEST_P(PartsThatMove, AreNoCopiesWhereTheyAreMistuned) {
  const RecordedTrace found = trace_in_a_rotating_frame(GetParam().mistuned, GetParam().from, GetParam().to);
  ASSERT_EQ(found.result.status, TraceStatus::completed) << found.result.message;
  EXPECT_EQ(copies_in(found), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(found.result.events.empty());
}

/// Equilibria that move, by a tenth of the length, and rods that turn, and with them the space of the motions
/// that they allow.
INSTANTIATE_TEST_SUITE_P(
    InARotatingFrame, PartsThatMove,
    testing::Values(MovingParts{masses_in_a_rotating_frame(1), masses_in_a_rotating_frame(3),
                                masses_in_a_rotating_frame(3, "1.0000000001"), 1.0, 12.0, 0.05},
                    MovingParts{pendulums_in_a_rotating_frame(1), pendulums_in_a_rotating_frame(3),
                                pendulums_in_a_rotating_frame(3, "20.000000002"), 2.0, 9.0, 0.3},
                    MovingParts{pendulums_in_a_rotating_frame(1), pendulums_in_a_rotating_frame(3),
                                pendulums_in_a_rotating_frame(3, "20.000000002"), 9.0, 2.0, 0.3}),
    [](const auto& test) {
      return std::string(std::array{"Masses", "PendulumsUp", "PendulumsDown"}[test.index]);
    });

/// Through critical damping, where pairs become real modes, and with an equilibrium that moves.
TEST(EqualParts, ResumedTracesAreTheSame) {
  const auto difference = [](const std::string& scene, const OptionTexts& options) {
    const Setting setting = make_setting(scene, options);
    return first_resumed_difference(*setting.model, setting.options, 8);
  };
  const EqualParts three = overdamped(3);
  for (const char* modes : {"all", "2"})
    EXPECT_EQ(difference(family_scene(three.matrices, three.from, three.to), {{"modes", modes}}), "");
  EXPECT_EQ(difference(masses_in_a_rotating_frame(2), {{"from", "1"}, {"to", "12"}}), "");
}

/// The drag becomes a drive: both modes flutter at once, and say in which direction.
TEST(EqualPartsOfAScene, BothFluttersHaveADirection) {
  for (const auto& [from, to] : {std::pair{"-0.3", "0.5"}, std::pair{"0.5", "-0.3"}}) {
    SCOPED_TRACE(from);
    const RecordedTrace trace = mass_on_equal_springs(from, to);
    ASSERT_EQ(trace.result.events.size(), 2U);
    for (const Event& event : trace.result.events) {
      EXPECT_EQ(event.kind, EventKind::flutter);
      EXPECT_NEAR(event.p, 0.0, 1e-9);
      EXPECT_EQ(event.direction, -1);
    }
    EXPECT_TRUE(trace.result.notes.empty()) << trace.result.notes.front();
  }
}

}  // namespace
}  // namespace eigentrail::test::equal_parts_test
