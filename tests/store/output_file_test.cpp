// Files that commands write: which existing ones may be replaced, and that replacement is atomic.
#include "eigentrail/store/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/hdf5_writer.hpp"
#include "eigentrail/core/errors.hpp"
#include "store/output_lock.hpp"

namespace eigentrail::test::output_file_test {
namespace {

class OutputFileTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::path(testing::TempDir()) / ("eigentrail_output_" + std::string(test->name()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    path = folder / "out.h5";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::size_t files() const {
    const std::filesystem::directory_iterator all(folder);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }
  static void write_text(const std::string& file, const std::string& text) { std::ofstream(file) << text; }
  std::string text() const {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  std::filesystem::path folder;
  std::string path;
};

TEST_F(OutputFileTest, MayBeReplacedByItsOwnFormatOnly) {
  EXPECT_FALSE(may_be_replaced(path, "mine"));
  Hdf5Writer::create(path).set_attribute("format", std::string("mine"));
  EXPECT_TRUE(may_be_replaced(path, "mine"));
  EXPECT_FALSE(may_be_replaced(path, "yours"));
}

TEST_F(OutputFileTest, TryingToCreateLeavesNothingBehindAndTouchesNothing) {
  check_can_create(path);
  EXPECT_EQ(files(), 0u);
  write_text(path, "old");
  check_can_create(path);
  EXPECT_EQ(files(), 1u);
  EXPECT_EQ(text(), "old");
  EXPECT_THROW(check_can_create(folder / "none" / "out.h5"), InputError);
  EXPECT_THROW(check_can_create(folder / std::string(300, 'x')), InputError);
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, WritingReplacesWithAllParts) {
  write_text(path, "old");
  write_durably(path, {"n", "", "ew"}, Existing::replace);
  EXPECT_EQ(text(), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, WhatIsToBeKeptStaysAndTheNewFileBesideIt) {
  write_text(path, "old");
  EXPECT_THROW(write_durably(path, {"new"}), std::runtime_error);
  EXPECT_EQ(text(), "old");
  EXPECT_EQ(files(), 2u);
  std::filesystem::rename(path + ".partial", path);
  EXPECT_EQ(text(), "new");
}

TEST_F(OutputFileTest, FilesThatBelongTogetherAreRenamedOnceAllAreWritten) {
  const std::string other = folder / "none" / "other.h5";
  EXPECT_THROW(write_durably({{path, {"one"}}, {other, {"two"}}}), std::system_error);
  EXPECT_EQ(files(), 0u);
}

TEST_F(OutputFileTest, HalfOfAPairIsReplacedOnlyWhereAKillHasLeftIt) {
  const std::string first = folder / "out.h5", second = folder / "out.toml";
  EXPECT_EQ(existing_pair(first, second, false, ""), Existing::keep);
  write_durably(first, {"one"});
  EXPECT_THROW(existing_pair(first, second, false, ""), InputError);
  EXPECT_EQ(existing_pair(first, second, true, ""), Existing::replace);
  write_durably(second + ".partial", {"two"});
  EXPECT_EQ(existing_pair(first, second, false, ""), Existing::replace);
  write_durably(first + ".partial", {"another one"});
  EXPECT_THROW(existing_pair(first, second, false, ""), InputError);
}

TEST_F(OutputFileTest, ALinkThatLeadsNowhereIsAFileThatIsThere) {
  EXPECT_EQ(existing_pair(path, path, false, ""), Existing::keep);
  std::filesystem::create_symlink("none.h5", path);
  EXPECT_THROW(existing_pair(path, path, false, ""), InputError);
  EXPECT_EQ(existing_pair(path, path, true, ""), Existing::replace);
}

TEST_F(OutputFileTest, PermissionsAndLinksOfTheReplacedFileStay) {
  using std::filesystem::perms;
  const std::string link = folder / "link.h5";
  write_text(path, "old");
  std::filesystem::permissions(path, perms::owner_read | perms::group_read);
  std::filesystem::create_symlink("out.h5", link);
  write_durably(link, {"new"}, Existing::replace);
  EXPECT_EQ(text(), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(std::filesystem::status(path).permissions(), perms::owner_read | perms::group_read);
}

TEST_F(OutputFileTest, WhatAKilledProcessHasLeftIsTaken) {
  write_text(path + ".partial", "longer than what follows");
  write_durably(path, {"new"});
  EXPECT_EQ(text(), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(OutputFileTest, WhatAnotherProcessWritesIsLeftToIt) {
  const LockedFile theirs(path + ".partial", path);
  EXPECT_THROW(write_durably(path, {"new"}), InputError);
  EXPECT_THROW(check_can_create(path), InputError);
  EXPECT_EQ(files(), 1u);
}

/// A limit on the size of files simulates a full disk.
TEST_F(OutputFileTest, FailedWritingKeepsTheOldFile) {
  write_text(path, "old");
  const auto write_too_much = [this] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit few{1000, 1000};
    setrlimit(RLIMIT_FSIZE, &few);
    try {
      write_durably(path, {std::string(600, 'x'), std::string(600, 'y')}, Existing::replace);
    } catch (const std::system_error& error) {
      std::exit(error.code().value() == EFBIG ? 7 : 8);
    }
    std::exit(0);
  };
  EXPECT_EXIT(write_too_much(), testing::ExitedWithCode(7), "");
  EXPECT_EQ(text(), "old");
  EXPECT_EQ(files(), 1u);
  EXPECT_THROW(write_durably(folder / "none" / "out.h5", {"x"}), std::system_error);
}

TEST_F(OutputFileTest, LockIsHeldByOneAndGivenBack) {
  {
    const OutputLock lock(path);
    EXPECT_THROW(OutputLock second(path), InputError);
    EXPECT_NO_THROW(OutputLock(folder / "other.h5"));
  }
  EXPECT_EQ(files(), 0u);
  write_text(path + ".lock", "");  // left by a process that was killed
  EXPECT_NO_THROW(OutputLock{path});
}

}  // namespace
}  // namespace eigentrail::test::output_file_test
