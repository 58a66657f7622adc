// Writing and reading back a loci file.
#include "eigentrail/store/loci_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/hdf5_file.hpp"
#include "eigentrail/store/loci_writer.hpp"
#include "support/scenes.hpp"

namespace eigentrail::test {
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
    observer.node = [&](const PathNode& node) {
      if (!writer) {
        writer.emplace(path, setting.scene, *setting.model, setting.options, *start,
                       static_cast<int>(node.s.rows()));
      }
      writer->append(node);
      return true;
    };
    TraceResult result = trace(*setting.model, setting.options, observer);
    writer->finish(result);
    return result;
  }

  std::string path;
};

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
    EXPECT_EQ(loci.p[i], recorded.nodes[i].p);
    EXPECT_EQ(loci.series[i], recorded.nodes[i].s);
    EXPECT_EQ(loci.equilibrium.row(static_cast<Eigen::Index>(i)).transpose(),
              recorded.nodes[i].path.x.col(0));
  }
  for (const double p : {99.9, 40.0, 12.3, 5.0})
    EXPECT_EQ(loci.eigenvalues_at(p), recorded.eigenvalues_at(p));
}

TEST_F(LociFileTest, ParameterOutsideTheRangeIsRefused) {
  write(scene_setting("pendulum"));
  const LociFile loci = read_loci(path);
  EXPECT_THROW((void)loci.eigenvalues_at(0.49), InputError);
  EXPECT_THROW((void)loci.eigenvalues_at(NAN), InputError);
  EXPECT_EQ(loci.nearest_node(-1e9), 0U);
  EXPECT_EQ(loci.nearest_node(1e9), loci.n_nodes() - 1);
}

/// In a frame that turns faster than the natural frequency, the whirl's member changes the sign of its
/// imaginary part.
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
    const ComplexVector s = loci.eigenvalues_at(w);  // +-j (5 - w) and +-j (5 + w)
    EXPECT_NEAR(s[0].imag(), std::abs(5.0 - w), 1e-5);
    EXPECT_NEAR(s[1].imag(), 5.0 + w, 1e-5);
  }
  const Hdf5File file = Hdf5File::open(path);
  for (const Complex s : file.read_complex("eigenvalue")) EXPECT_GE(s.imag(), 0.0);
}

TEST_F(LociFileTest, AttributesThatSomebodyAddedDoNotDisturb) {
  write(scene_setting("pendulum"));
  const std::string command =
      "/usr/bin/python3 -c \"import h5py; h5py.File('" + path + "','r+').attrs['note'] = [1,2]\"";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_FALSE(read_loci(path).attributes.contains("note"));
}

TEST_F(LociFileTest, OnlyLociFilesMayBeReplaced) {
  write(scene_setting("pendulum"));
  EXPECT_TRUE(may_be_replaced(path));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_FALSE(may_be_replaced(path)) << "damaged: somebody may want to save it";
  std::filesystem::remove(path);
  Hdf5File::create(path).set_attribute("format", std::string("mine"));
  EXPECT_FALSE(may_be_replaced(path));
  std::filesystem::remove(path);
  Hdf5File::create(path).set_attribute("format", 3.0);
  EXPECT_FALSE(may_be_replaced(path));
  std::ofstream(path) << "a text";
  EXPECT_FALSE(may_be_replaced(path));
}

}  // namespace
}  // namespace eigentrail::test
