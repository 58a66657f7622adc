// Bytes as a file of the Matrix Market, and as a table of files.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/file_table.hpp"
#include "import/market_file.hpp"

EIGENTRAIL_FUZZ(market) {
  try {
    (void)eigentrail::parse_file_table(bytes, "a.csv");
  } catch (const eigentrail::InputError&) {
  }
  try {
    (void)eigentrail::parse_market_file(bytes, "a.mtx");
  } catch (const eigentrail::InputError&) {
  }
}
