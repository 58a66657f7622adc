// Files that are rejected before the HDF5 library opens them.
#include "core/hdf5_check/check.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "core/hdf5_check/checksum.hpp"
#include "core/hdf5_file.hpp"

namespace eigentrail {
namespace {

const std::string corpus = std::string(EIGENTRAIL_DATA_DIR) + "/../tests/fuzz/corpus/";

std::string bytes_of(const std::string& name) {
  std::ifstream stream(corpus + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The error in a file; empty if there is none.
std::string fault(std::string_view bytes) {
  try {
    check_hdf5_bytes(bytes);
  } catch (const Hdf5Error& error) {
    return error.what();
  }
  return "";
}

TEST(Hdf5Check, AcceptsFilesOfOtherProgramsInEveryLayout) {
  for (const char* name :
       {"contiguous", "chunked", "deflate", "single", "attributes", "latest", "v110", "empty"}) {
    const std::string bytes = bytes_of(std::string("matrix_family/") + name + ".h5");
    ASSERT_FALSE(bytes.empty()) << name;
    EXPECT_EQ(fault(bytes), "") << name;
  }
}

TEST(Hdf5Check, RefusesWhatLeadsToOtherFilesOrDeclaresMoreThanItHolds) {
  const std::vector<std::pair<std::string, std::string>> table = {
      {"soft_link", "a link to another place or file; copy what it leads to"},
      {"external_link", "a link to another place or file; copy what it leads to"},
      {"external_data", "a dataset whose data are in another file; copy them into this one"},
      {"virtual", "a dataset whose data are those of others (virtual); copy them"},
      {"huge", "a dataset of 200000000 bytes, of which the file holds 0"},
      {"wrong_checksum", "wrong checksum"}};
  for (const auto& [name, expected] : table) {
    const std::string found = fault(bytes_of("matrix_family/" + name + ".h5"));
    EXPECT_NE(found.find(expected), std::string::npos) << name << ": " << found;
    EXPECT_NE(found.find("at byte "), std::string::npos) << name << ": " << found;
  }
}

TEST(Hdf5Check, RefusesCompoundsWhoseMembersLieInEachOther) {
  EXPECT_NE(fault(bytes_of("loci/members_in_each_other.h5")).find("in each other"), std::string::npos);
}

// HDF5 1.10.8 leaks the first block of such an object.
TEST(Hdf5Check, RefusesObjectsThatGoOnNowhere) {
  EXPECT_NE(fault(bytes_of("loci/continuation_of_nothing.h5")).find("a block too small for a message"),
            std::string::npos);
}

TEST(Hdf5Check, RefusesEveryBeginningOfAFile) {
  for (const char* name :
       {"matrix_family/contiguous.h5", "matrix_family/latest.h5", "matrix_family/deflate.h5"}) {
    const std::string bytes = bytes_of(name);
    for (std::size_t size = 0; size < bytes.size(); ++size)
      ASSERT_NE(fault(std::string_view(bytes).substr(0, size)), "") << name << " " << size;
  }
}

TEST(Hdf5Check, GoesThroughEveryDamagedByteWithoutHarm) {
  for (const char* name :
       {"matrix_family/chunked.h5", "matrix_family/attributes.h5", "matrix_family/v110.h5"}) {
    std::string bytes = bytes_of(name);
    for (char& byte : bytes) {
      const char whole = byte;
      for (const int change : {0x01, 0x80, 0xff}) {
        byte = static_cast<char>(whole ^ change);
        (void)fault(bytes);
      }
      byte = whole;
    }
    EXPECT_EQ(fault(bytes), "");
  }
}

TEST(Hdf5Check, SaysHowMuchOfAFileIsThere) {
  const std::string bytes = bytes_of("matrix_family/contiguous.h5");
  const std::string_view half = std::string_view(bytes).substr(0, 3000);
  EXPECT_EQ(fault(half), "is cut off: 3000 bytes of " + std::to_string(bytes.size()));
  EXPECT_EQ(fault("[trace]\nparameter = \"p\"\n"), "is no HDF5 file");
}

TEST(Checksum, IsThatOfItsPaper) {
  EXPECT_EQ(hdf5_check::checksum(""), 0xdeadbeefU);
  EXPECT_EQ(hdf5_check::checksum("Four score and seven years ago"), 0x17770551U);
}

}  // namespace
}  // namespace eigentrail
