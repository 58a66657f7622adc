// What an interrupted run has computed is used by the next one, whatever is left of its file.
#include "eigentrail/store/unfinished_run.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "eigentrail/core/errors.hpp"
#include "support/folder.hpp"

namespace eigentrail::test::unfinished_run_test {
namespace {

const SharedRun run{"map", "scene.toml", {{"version", "1"}, {"scene", "a = 1\nb = 2"}, {"--to", "3"}}, 5};

std::string piece(std::size_t number) {
  return std::string(3 * number, static_cast<char>('a' + number));
}

class UnfinishedRuns : public testing::Test {
 protected:
  std::string output() const { return folder_.path() + "/out.h5"; }
  std::string file() const { return output() + ".unfinished"; }

  std::string content() const {
    std::ifstream stream(file(), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  void write(const std::string& content) const { std::ofstream(file(), std::ios::binary) << content; }

  /// The numbers of the pieces that are computed, of five, while the run ends or is left.
  std::vector<std::size_t> computed(Before before, bool ends) const {
    UnfinishedRun unfinished(output(), run, before);
    SavingWorkers workers(std::make_unique<Threads>(1), unfinished);
    std::vector<std::size_t> numbers;
    const auto compute = [&](std::size_t number) {
      numbers.push_back(number);
      return piece(number);
    };
    const std::vector<std::string> results =
        workers.compute({"line", numbers_to(5), compute}, [](auto...) {});
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(results[i], piece(i));
    if (ends) unfinished.end();
    return numbers;
  }

  std::string refusal(const SharedRun& other, Before before = Before::resume) const {
    try {
      const UnfinishedRun unfinished(output(), other, before);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  Folder folder_;
};

TEST_F(UnfinishedRuns, LeaveNothingAtTheirEnd) {
  EXPECT_EQ(computed(Before::refuse, true), numbers_to(5));
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(UnfinishedRuns, GoOnFromWhateverIsLeft) {
  EXPECT_EQ(computed(Before::refuse, false), numbers_to(5));
  const std::string whole = content();
  std::size_t last = 5;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    write(whole.substr(0, size));
    const std::size_t n = computed(Before::resume, false).size();
    EXPECT_LE(n, last);
    last = n;
    EXPECT_EQ(content(), whole) << size;
  }
  EXPECT_EQ(last, 0u);
}

TEST_F(UnfinishedRuns, UseNoDamagedPiece) {
  EXPECT_EQ(computed(Before::refuse, false), numbers_to(5));
  const std::string whole = content();
  for (std::size_t at = whole.find('\n') + 1; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    write(damaged);
    EXPECT_FALSE(computed(Before::resume, false).empty()) << at;
  }
}

TEST_F(UnfinishedRuns, AreNotDiscardedUnasked) {
  EXPECT_EQ(computed(Before::refuse, false), numbers_to(5));
  EXPECT_NE(refusal(run, Before::refuse).find("--resume goes on with it, --force begins anew"),
            std::string::npos);
  EXPECT_EQ(computed(Before::discard, true), numbers_to(5));
}

TEST_F(UnfinishedRuns, OfAnotherRunAreRefusedByWhatDiffers) {
  EXPECT_EQ(computed(Before::refuse, false), numbers_to(5));
  for (const auto& [place, text, words] :
       {std::tuple(0, "2", "version: was '1' and is '2'"),
        std::tuple(1, "a = 1\nb = 3", "scene: line 2 was 'b = 2' and is 'b = 3'"),
        std::tuple(2, "4", "--to: was '3' and is '4'")}) {
    SharedRun other = run;
    other.settings[static_cast<std::size_t>(place)].second = text;
    EXPECT_NE(refusal(other).find(std::string("out.h5: cannot be resumed: ") + words), std::string::npos)
        << refusal(other);
  }
  SharedRun other = run;
  other.command = "boundary";
  EXPECT_NE(refusal(other).find("command: was 'map' and is 'boundary'"), std::string::npos);
}

TEST_F(UnfinishedRuns, FilesOfOthersAreKept) {
  write("my notes\n");
  EXPECT_NE(refusal(run).find("is no file of an interrupted run"), std::string::npos);
  EXPECT_EQ(content(), "my notes\n");
}

TEST_F(UnfinishedRuns, HaveEndedWhereTheOutputIsTheirs) {
  std::ofstream(output(), std::ios::binary) << "data" << run_mark(run);
  EXPECT_FALSE(is_unfinished(output()));
  require_run(output(), run);
  SharedRun other = run;
  other.settings[2].second = "4";
  EXPECT_THROW(require_run(output(), other), InputError);
  std::ofstream(output(), std::ios::binary) << "data of an older version";
  EXPECT_THROW(require_run(output(), run), InputError);
}

}  // namespace
}  // namespace eigentrail::test::unfinished_run_test
