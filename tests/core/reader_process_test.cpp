// Files that are damaged, or lead elsewhere, and files of other programs.
#include "core/reader_process.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>
#include <iterator>

#include "core/hdf5_file.hpp"

namespace eigentrail::test::reader_process_test {
namespace {

const std::string tests = std::string(EIGENTRAIL_DATA_DIR) + "/../tests/";
const std::string families = tests + "fuzz/corpus/matrix_family/";

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Reads every dataset and attribute of a file, and its groups. Returns how many datasets there are.
int read_all(const Hdf5File& file, const std::string& group = "/") {
  int count = 0;
  for (const std::string& name : file.members(group)) {
    const std::string path = group == "/" ? "/" + name : group + "/" + name;
    (void)file.attributes(path);
    count += file.read(path) ? 1 : read_all(file, path);
  }
  return count;
}

/// The error in a file; empty if there is none.
std::string fault(const std::string& path) {
  try {
    read_all(Hdf5File::open(path));
  } catch (const Hdf5Error& error) {
    return error.what();
  }
  return "";
}

TEST(ReaderProcess, ReadsFilesOfOtherProgramsInEveryLayout) {
  for (const char* name : {"contiguous", "chunked", "deflate", "single", "attributes", "latest", "v110"})
    EXPECT_GT(read_all(Hdf5File::open(families + name + ".h5")), 0) << name;
  EXPECT_EQ(Hdf5File::open(families + "latest.h5").read_real("/K/1"), (std::vector<double>{0, 1, -1, 0}));
}

TEST(ReaderProcess, RefusesWhatLeadsToOtherFilesOrDeclaresMoreThanItHolds) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"external_link", "unable to open external file"},
      {"external_data", "are in another file or dataset; copy them into this one"},
      {"virtual", "are in another file or dataset; copy them into this one"},
      {"huge", "is too large: more elements than the file holds"},
      {"wrong_checksum", "incorrect metadata checksum"}};
  for (const auto& [name, expected] : table) {
    const std::string path = families + name + ".h5", found = fault(path);
    EXPECT_TRUE(found.starts_with(path + ": cannot be read: ")) << found;
    EXPECT_NE(found.find(expected), std::string::npos) << found;
  }
}

TEST(ReaderProcess, CrashesAndEndlessSearchesAreErrorsOfTheFile) {
  const std::string crash = tests + "core/data/crash.h5", endless = tests + "core/data/endless.h5";
  EXPECT_EQ(fault(crash),
            crash + ": cannot be read: is damaged: reading it ended in a crash (Segmentation fault)");
  EXPECT_EQ(fault(endless),
            endless + ": cannot be read: is damaged, or its disk does not answer: reading it came to no end");
}

TEST(ReaderProcess, AFileThatCrashedStaysUnreadableAndOthersAreRead) {
  const Hdf5File good = Hdf5File::open(families + "contiguous.h5");
  const Hdf5File damaged = Hdf5File::open(tests + "core/data/crash.h5");
  for (int i = 0; i < 2; ++i) EXPECT_THROW(read_all(damaged), Hdf5Error);
  EXPECT_GT(read_all(good), 1);
}

TEST(ReaderProcess, EveryBeginningOfAFileIsReadWithoutHarm) {
  const std::string bytes = bytes_of(families + "latest.h5");
  for (std::size_t size = 0; size < bytes.size(); size += 37)
    EXPECT_THROW(read_all(Hdf5File::from_image("part", std::string_view(bytes).substr(0, size))), Hdf5Error);
}

TEST(ReaderProcess, AnswersOfAnotherTypeAreNonsense) {
  const ReaderProcess reader(families + "latest.h5");
  EXPECT_THROW(reader.ask<std::vector<std::string>>(ReaderRequest::open, families + "latest.h5"), Hdf5Error);
}

TEST(ReaderProcess, LargeDatasetsComeInParts) {
  const std::string path = testing::TempDir() + "eigentrail_large_dataset.h5";
  const std::string command = "/usr/bin/python3 -c \"import h5py, numpy; h5py.File('" + path +
                              "', 'w')['x'] = numpy.arange(3000001.0 * 2).reshape(-1, 2)\"";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::vector<double> x = Hdf5File::open(path).read_real("x");
  std::remove(path.c_str());
  ASSERT_EQ(x.size(), 6000002U);
  for (std::size_t i = 0; i < x.size(); ++i) ASSERT_EQ(x[i], static_cast<double>(i));
}

TEST(ReaderProcess, EndsWithWhatAskedIt) {
  { (void)Hdf5File::open(families + "latest.h5"); }
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "no process is left";
}

}  // namespace
}  // namespace eigentrail::test::reader_process_test
