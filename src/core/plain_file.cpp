#include "eigentrail/core/plain_file.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "eigentrail/core/errors.hpp"

namespace eigentrail {

void require_plain_file(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::regular) return;
  if (type == std::filesystem::file_type::not_found) throw InputError(path + ": no such file");
  if (type == std::filesystem::file_type::none)
    throw InputError(path + ": cannot be read (" + error.message() + ")");
  throw InputError(path + (type == std::filesystem::file_type::directory
                               ? ": is a folder; give the name of a file"
                               : ": is not a plain file; pipes and devices are not read"));
}

std::string bytes_of_file(const std::string& path) {
  require_plain_file(path);
  std::ifstream stream(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(path + ": cannot be read");
  return bytes;
}

std::string read_text(const std::string& path, std::uintmax_t most_bytes) {
  require_plain_file(path);
  const std::uintmax_t size = std::filesystem::file_size(path);
  if (size > most_bytes)
    throw InputError(path + ": is " + std::to_string(size) + " bytes; expected a text of at most " +
                     std::to_string(most_bytes));
  std::string text = bytes_of_file(path);
  if (text.find('\0') != std::string::npos)
    throw InputError(path + ": is not a text file in UTF-8: it has bytes that are zero");
  return text;
}

}  // namespace eigentrail
