// Writing and reading back a loci file.
#include "eigentrail/store/loci_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/hdf5_file.hpp"
#include "core/hdf5_writer.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "eigentrail/store/output_file.hpp"
#include "scene/input_error.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test::loci_file_test {
namespace {

class LociFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path = testing::TempDir() + "eigentrail_loci_" + test->name() + ".h5";
    std::filesystem::remove(path);
  }
  void TearDown() override { std::filesystem::remove(path); }

  /// Traces into `path`.
  TraceResult write(const Setting& setting) {
    std::optional<LociWriter> writer;
    std::optional<TraceStart> start;
    TraceObserver observer;
    observer.started = [&](const TraceStart& known) { start = known; };
    observer.point = [&](const TracePoint& point) {
      if (!writer)
        writer.emplace(path, setting.scene, *setting.model, setting.options, *start, point,
                       SaveOptions{2.0, Existing::replace});
      writer->append(point);
      recorder.append(point);
      return true;
    };
    TraceResult result = trace(*setting.model, setting.options, observer);
    ranges = stable_ranges(recorder.path(), result.events, {setting.options.tolerance, result.s_ref});
    writer->finish(result, ranges);
    return result;
  }

  std::string path;
  PathRecorder recorder;
  std::vector<StableRange> ranges;  ///< that were written
};

/// Equal, or both not a number.
bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}
bool same(Complex a, Complex b) {
  return same(a.real(), b.real()) && same(a.imag(), b.imag());
}
bool same(const ComplexVector& a, const ComplexVector& b) {
  if (a.size() != b.size()) return false;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (!same(a[i], b[i])) return false;
  }
  return true;
}

void expect_equal_steps(const std::vector<PathStep>& found, const std::vector<PathStep>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].length, expected[i].length);
    EXPECT_EQ(found[i].parameter, expected[i].parameter);
    ASSERT_EQ(found[i].blocks.size(), expected[i].blocks.size());
    for (std::size_t j = 0; j < found[i].blocks.size(); ++j) {
      const DenseBlock& a = found[i].blocks[j];
      const DenseBlock& b = expected[i].blocks[j];
      EXPECT_EQ(a.chart, b.chart);
      EXPECT_EQ(a.left, b.left);
      EXPECT_EQ(a.right, b.right);
      EXPECT_EQ(a.certified, b.certified);
      std::vector<int> modes = b.modes;
      std::sort(modes.begin(), modes.end());
      EXPECT_EQ(a.modes, modes);
    }
  }
}

void expect_equal_events(const std::vector<LociEvent>& found, const std::vector<Event>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Event& event = expected[i];
    EXPECT_EQ(found[i].kind, event_name(event.kind));
    EXPECT_EQ(found[i].parameter, event.p);
    EXPECT_TRUE(same(found[i].s, event.s));
    std::string modes;
    for (const int mode : event.modes) modes += (modes.empty() ? "" : ";") + std::to_string(mode + 1);
    EXPECT_EQ(found[i].modes, modes);
    const bool veers = event.kind == EventKind::veering;
    EXPECT_TRUE(veers ? found[i].half_width == event.half_width : std::isnan(found[i].half_width));
    const bool branches = event.puiseux != 0.0;
    EXPECT_TRUE(branches ? found[i].puiseux == event.puiseux : std::isnan(found[i].puiseux.real()));
  }
}

void expect_equal_ends(const RangeEnd& found, const RangeEnd& expected) {
  EXPECT_EQ(found.p, expected.p);
  EXPECT_EQ(found.cause, expected.cause);
  EXPECT_EQ(found.margin, expected.margin);
  EXPECT_EQ(found.mode, expected.mode);
}

/// s^2 + p s + 1 = 0, a pair that meets on the real axis at p = 2, beside two modes that coalesce at p = 1.
const std::string meeting_modes =
    "[trace]\nparameter = \"p\"\nfrom = 0.5\nto = 3\n[matrix_family]\n"
    "M = [ [[1, 0, 0], [0, 1, 0], [0, 0, 1]] ]\nC = [ [[0, 0, 0], [0, 0, 0], [0, 0, 0]], [[1, 0, 0], [0, 0, "
    "0], [0, "
    "0, 0]] ]\nK = [ [[1, 0, 0], [0, 20, 0], [0, 0, 22]], [[0, 0, 0], [0, 0, 1], [0, -1, 0]] ]\n";

/// Heights of the von Mises truss at a load, by bisection between and beyond its limit heights.
std::vector<double> truss_heights(double load) {
  const auto miss = [load](double w) { return 2.0 * w * (std::sqrt(1.04 / (1.0 + w * w)) - 1.0) - load; };
  const double limit = std::sqrt(std::cbrt(1.04) - 1.0);
  const std::vector<double> ends{-2.0, -limit, limit, 2.0};
  std::vector<double> heights;
  for (std::size_t i = 0; i < 3; ++i) {
    double a = ends[i];
    double b = ends[i + 1];
    if (miss(a) * miss(b) > 0.0) continue;
    for (int k = 0; k < 200; ++k) {
      const double middle = 0.5 * (a + b);
      (miss(a) * miss(middle) > 0.0 ? a : b) = middle;
    }
    heights.push_back(0.5 * (a + b));
  }
  return heights;
}

/// Largest distance of the modes that exist from s^2 = -2 (1 + e w^2) / L^2 and s^2 = -2 (w^2 + e) / L^2,
/// where e = 1 - L0 / L; a growing mode is real and comes with its opposite.
double truss_distance(const ComplexVector& s, double w) {
  const double square = 1.0 + w * w;
  const double strain = 1.0 - std::sqrt(1.04 / square);
  double worst = 0.0;
  int present = 0;
  for (const Complex value : s) {
    if (std::isnan(value.real())) continue;
    ++present;
    double nearest = INFINITY;
    for (const double stiffness : {2.0 * (1.0 + strain * w * w) / square, 2.0 * (w * w + strain) / square})
      nearest = std::min(nearest, std::abs(value * value + stiffness));
    worst = std::max(worst, nearest);
  }
  return present >= 2 ? worst : INFINITY;
}

TEST_F(LociFileTest, ReadsBackWhatTheTraceComputed) {
  const Setting setting = scene_setting("rotating_mass");
  const RecordedTrace recorded = record_trace(setting);
  EXPECT_EQ(write(setting).status, TraceStatus::completed);
  const LociFile loci = read_loci(path);
  ASSERT_EQ(loci.n_nodes(), recorded.nodes.size());
  EXPECT_EQ(loci.parameter, "omega");
  EXPECT_EQ(loci.parameter_unit, "rad/s");
  EXPECT_EQ(loci.constraints, std::vector<std::string>{"rod 1"});
  for (std::size_t i = 0; i < loci.n_nodes(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_EQ(loci.p[i], recorded.nodes[i].p);
    EXPECT_EQ(loci.eigenvalues.row(row).transpose(), recorded.eigenvalues_of_node(i));
    EXPECT_EQ(loci.equilibrium.row(row).transpose(), recorded.nodes[i].path.x.col(0));
    EXPECT_EQ(loci.multiplier.row(row).transpose(), recorded.nodes[i].path.lambda.col(0));
  }
  expect_equal_steps(loci.steps, recorded.steps);
  expect_equal_events(loci.events, recorded.result.events);
  for (const double p : {99.9, 40.0, 12.3, 5.0}) {
    const std::vector<ComplexVector> found = loci.eigenvalues_at(p);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0], recorded.eigenvalues_at(p));
  }
}

/// Modes that meet, leave the real axis and change their number: blocks of every kind.
TEST_F(LociFileTest, ReadsBackBlocksAndEvents) {
  const Setting setting = make_setting(meeting_modes);
  const RecordedTrace recorded = record_trace(setting);
  ASSERT_EQ(write(setting).status, TraceStatus::completed);
  const LociFile loci = read_loci(path);
  ASSERT_EQ(loci.n_nodes(), recorded.nodes.size());
  ASSERT_EQ(static_cast<int>(loci.modes.size()), recorded.result.n_columns);
  EXPECT_GT(recorded.result.n_columns, recorded.result.n_modes) << "a mode is born";
  bool has_block = false;
  for (const PathStep& step : loci.steps) {
    for (const DenseBlock& block : step.blocks) has_block = has_block || block.size() > 1;
  }
  EXPECT_TRUE(has_block);
  expect_equal_steps(loci.steps, recorded.steps);
  EXPECT_FALSE(loci.events.empty());
  expect_equal_events(loci.events, recorded.result.events);
  for (int i = 0; i <= 100; ++i) {
    const double p = 0.5 + 2.5 * (i + 0.37) / 101.0;  // between the nodes
    const std::vector<ComplexVector> found = loci.eigenvalues_at(p);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(same(found[0], recorded.eigenvalues_at(p))) << "at " << p;
  }
}

/// The damping p of one mode vanishes at p = 0; undamped ones are marginal beside.
TEST_F(LociFileTest, ReadsBackStableRanges) {
  const std::string oscillator =
      "[trace]\nparameter = \"p\"\nfrom = -1\nto = 1\n[matrix_family]\n"
      "M = [ [[1]] ]\nC = [ [[0]], [[1]] ]\nK = [ [[1]] ]\n";
  for (const std::string& scene : {oscillator, meeting_modes}) {
    recorder = {};
    ASSERT_EQ(write(make_setting(scene)).status, TraceStatus::completed);
    const LociFile loci = read_loci(path);
    ASSERT_TRUE(loci.ranges);
    ASSERT_EQ(loci.ranges->size(), ranges.size());
    ASSERT_EQ(ranges.size(), 1U);
    const StableRange& found = loci.ranges->front();
    EXPECT_EQ(found.kind, scene == oscillator ? Stability::stable : Stability::marginal);
    EXPECT_EQ(found.kind, ranges[0].kind);
    expect_equal_ends(found.from, ranges[0].from);
    expect_equal_ends(found.to, ranges[0].to);
    EXPECT_EQ(found.least_margin, ranges[0].least_margin);
    EXPECT_EQ(found.largest_margin, ranges[0].largest_margin);
    EXPECT_EQ(found.largest_at, ranges[0].largest_at);
  }
}

TEST_F(LociFileTest, ModesThatDoNotExistAreNotANumber) {
  // s^2 + p s + 1 = 0 is a pair up to p = 2 and two real roots behind; the second is born there.
  ASSERT_EQ(write(make_setting(meeting_modes)).status, TraceStatus::completed);
  const LociFile loci = read_loci(path);
  const auto missing_at = [&](double p) {
    const ComplexVector s = loci.eigenvalues_at(p).at(0);
    return std::count_if(s.begin(), s.end(), [](Complex value) { return std::isnan(value.real()); });
  };
  EXPECT_EQ(missing_at(1.9), 1);
  EXPECT_EQ(missing_at(2.1), 0);
}

/// If every step is certified, the certified share of each mode is one; without certificate it is zero.
TEST_F(LociFileTest, KnowsWhatIsCertified) {
  ASSERT_EQ(write(scene_setting("rotating_mass")).status, TraceStatus::completed);
  const LociFile certified = read_loci(path);
  for (std::size_t mode = 0; mode < certified.modes.size(); ++mode)
    EXPECT_EQ(certified.certified_share(mode), 1.0);
  ASSERT_EQ(write(scene_setting("rotating_mass", {{"certify", "false"}})).status, TraceStatus::completed);
  const LociFile taken = read_loci(path);
  for (std::size_t mode = 0; mode < taken.modes.size(); ++mode) EXPECT_EQ(taken.certified_share(mode), 0.0);
}

/// Beyond a fold the path passes a parameter value again: von Mises truss, whose load rises, falls and rises.
TEST_F(LociFileTest, ParameterThatThePathPassesAgainHasSeveralSpectra) {
  const Setting setting = make_setting(
      "[parameters]\nload = 0.0\n[trace]\nparameter = \"load\"\nfrom = -0.004\nto = 0.004\n"
      "[[point]]\nname = \"apex\"\nmass = 1.0\nposition = [0, 0, 0.2]\n"
      "[[spring]]\nfrom = [-1, 0, 0]\nto = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(1.04)\"\n"
      "[[spring]]\nfrom = [1, 0, 0]\nto = \"apex\"\nstiffness = 1.0\nfree_length = \"sqrt(1.04)\"\n"
      "[[force]]\npoint = \"apex\"\ncomponents = [0, 0, \"-load\"]\n"
      "[[fixed]]\npoint = \"apex\"\ncoordinate = \"y\"\n");
  ASSERT_EQ(write(setting).status, TraceStatus::completed);
  const LociFile loci = read_loci(path);
  for (const double load : {-0.0035, -0.003, -0.001, 0.0, 0.0017, 0.0029, 0.0035}) {
    const bool between = std::abs(load) < 0.0030191474033251500073;  // the limit load
    const std::vector<ComplexVector> found = loci.eigenvalues_at(load);
    ASSERT_EQ(found.size(), between ? 3U : 1U) << "load " << load;
    const std::vector<LociFile::Position> positions = loci.positions(load);
    ASSERT_EQ(positions.size(), found.size());
    for (std::size_t i = 1; i < positions.size(); ++i) EXPECT_GE(positions[i].step, positions[i - 1].step);
    for (std::size_t i = 0; i < found.size(); ++i) {  // the spectrum of one of the heights at that load
      double nearest = INFINITY;
      for (const double w : truss_heights(load)) nearest = std::min(nearest, truss_distance(found[i], w));
      EXPECT_LT(nearest, 1e-6) << "load " << load << ", passage " << i;
    }
  }
}

TEST_F(LociFileTest, ParameterOutsideTheRangeIsRefused) {
  ASSERT_EQ(write(scene_setting("pendulum")).status, TraceStatus::completed);
  const LociFile loci = read_loci(path);
  EXPECT_THROW((void)loci.eigenvalues_at(0.49), InputError);
  EXPECT_THROW((void)loci.eigenvalues_at(NAN), InputError);
}

/// In a frame that turns faster than the natural frequency, the eigenvalue of a whirl mode has the imaginary
/// part of other sign.
TEST_F(LociFileTest, PairsAreReportedByTheMemberInTheUpperHalfPlane) {
  const std::string spring_at_origin = "[[guided_spring]]\npoint = \"disc\"\nstiffness = 25\n";
  const Setting setting = make_setting(
      "[parameters]\nw = 1\n[trace]\nparameter = \"w\"\nfrom = 1\nto = 12\n"
      "[frame]\nangular_velocity = [0, 0, \"w\"]\n[[point]]\nname = \"disc\"\nmass = 1\nposition = [0, 0, "
      "0]\n"
      "[[fixed]]\npoint = \"disc\"\ncoordinate = \"z\"\n" +
      spring_at_origin + "direction = [1, 0, 0]\n" + spring_at_origin + "direction = [0, 1, 0]\n");
  ASSERT_EQ(write(setting).status, TraceStatus::completed);
  const LociFile loci = read_loci(path);
  for (int i = 0; i <= 50; ++i) {
    const double w = 1.0 + 11.0 * i / 50.0;
    const ComplexVector s = loci.eigenvalues_at(w).at(0);  // +-j (5 - w) and +-j (5 + w)
    EXPECT_NEAR(s[0].imag(), std::abs(5.0 - w), 1e-5);
    EXPECT_NEAR(s[1].imag(), 5.0 + w, 1e-5);
  }
  const Hdf5File file = Hdf5File::open(path);
  for (const Complex s : file.read_complex("eigenvalue")) EXPECT_GE(s.imag(), 0.0);
}

TEST_F(LociFileTest, AttributesThatSomebodyAddedDoNotDisturb) {
  ASSERT_EQ(write(scene_setting("pendulum")).status, TraceStatus::completed);
  const std::string command =
      "/usr/bin/python3 -c \"import h5py; h5py.File('" + path + "','r+').attrs['note'] = [1,2]\"";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_FALSE(read_loci(path).attributes.contains("note"));
}

TEST_F(LociFileTest, ContentsThatContradictEachOtherAreRefused) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"f['length'][1] = float('nan')", "length holds nan as its number 2 where a finite number is needed"},
      {"f['step_length'][0] = float('inf')", "step_length holds inf"},
      {"f['mode_block'][0] = 7", "mode_block does not fit"},
      {"f['dense_block'][0] = -1", "mode_block does not fit"},
      {"f['event_direction'].resize((1,)); f['event_direction'][0] = 5", "events does not fit"},
      {"f['stable_mode'][0] = 9", "stable_mode names mode 9 of 1"},
      {"del f['coordinate']; f['coordinate'] = 3.0", "cannot be read: "}};
  for (const auto& [change, expected] : table) {
    std::filesystem::remove(path);
    ASSERT_EQ(write(scene_setting("pendulum")).status, TraceStatus::completed);
    const std::string command =
        "/usr/bin/python3 -c \"import h5py; f = h5py.File('" + path + "','r+'); " + change + "\"";
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    const std::string found = input_error([&] { (void)read_loci(path); });
    EXPECT_TRUE(contains(found, expected)) << change << ": " << found;
  }
}

TEST_F(LociFileTest, OnlyLociFilesMayBeReplaced) {
  ASSERT_EQ(write(scene_setting("pendulum")).status, TraceStatus::completed);
  EXPECT_TRUE(may_be_replaced(path, loci_format));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_FALSE(may_be_replaced(path, loci_format)) << "damaged: somebody may want to save it";
  std::filesystem::remove(path);
  Hdf5Writer::create(path).set_attribute("format", std::string("mine"));
  EXPECT_FALSE(may_be_replaced(path, loci_format));
  std::filesystem::remove(path);
  Hdf5Writer::create(path).set_attribute("format", 3.0);
  EXPECT_FALSE(may_be_replaced(path, loci_format));
  std::ofstream(path) << "a text";
  EXPECT_FALSE(may_be_replaced(path, loci_format));
}

}  // namespace
}  // namespace eigentrail::test::loci_file_test
