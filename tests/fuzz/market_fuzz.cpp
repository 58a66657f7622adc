// Bytes as a file of the Matrix Market, and as a table of files.
#include "eigentrail/core/errors.hpp"
#include "fuzz/entry.hpp"
#include "import/file_table.hpp"
#include "import/market_file.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = eigentrail::fuzz::as_text(data, size);
  try {
    (void)eigentrail::parse_file_table(text, "a.csv");
  } catch (const eigentrail::InputError&) {
  }
  try {
    (void)eigentrail::parse_market_file(text, "a.mtx");
  } catch (const eigentrail::InputError&) {
  }
  return 0;
}
