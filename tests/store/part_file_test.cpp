#include "eigentrail/store/part_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "eigentrail/core/errors.hpp"
#include "store/saved_pieces.hpp"

namespace eigentrail::test::part_file_test {
namespace {

/// The checksum of a record tells nothing of what is in it.
TEST(PartFile, PartsThatCannotBeAreDamaged) {
  const std::string path = testing::TempDir() + "part_that_cannot_be";
  for (const Part part : {Part{5, 2}, Part{0, 2}, Part{-1, 1}}) {
    std::ofstream(path, std::ios::binary) << begin_of_pieces(
        {.command = "map", .scene_path = "s.toml", .settings = {}, .n_pieces = 0, .part = part});
    EXPECT_THROW(read_part_file(path), InputError) << part.number << " of " << part.count;
  }
}

}  // namespace
}  // namespace eigentrail::test::part_file_test
