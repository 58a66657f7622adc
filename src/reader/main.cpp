// The program that reads a file of HDF5 or MATLAB for another process (core/reader_process.hpp). What it has
// open is its end of a socket and the file.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <new>

#include "core/archive.hpp"
#include "core/reader_requests.hpp"
#include "reader/hdf5_source.hpp"
#include "reader/matlab_source.hpp"

namespace eigentrail::reader {
namespace {

const char* const file_path = "/proc/self/fd/3";  // reader_file

void limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit limits{};
  getrlimit(resource, &limits);
  limits.rlim_cur = limits.rlim_max = std::min(most, limits.rlim_max);
  setrlimit(resource, &limits);
}

/// After the file is open, wherever links in it lead.
void open_nothing_else() {
  limit(RLIMIT_NOFILE, 0);
}

std::string answer(std::optional<Hdf5Source>& file, const std::string& message) {
  ReaderRequest request{};
  std::string name;
  std::uint64_t first = 0, rows = 0;
  unpack(message, request, name, first, rows);
  switch (request) {
    case ReaderRequest::matlab:
      return packed(true, read_matlab(file_path, open_nothing_else));
    case ReaderRequest::open:
      file.emplace(file_path);
      open_nothing_else();
      return packed(true, true);
    case ReaderRequest::has:
      return packed(true, file->has(name));
    case ReaderRequest::members:
      return packed(true, file->members(name));
    case ReaderRequest::attributes:
      return packed(true, file->attributes(name));
    default:
      return packed(true, file->read(name, first, rows));
  }
}

std::string answer_or_reason(std::optional<Hdf5Source>& file, const std::string& message) {
  try {
    return answer(file, message);
  } catch (const std::bad_alloc&) {
    return packed(false, std::string("is damaged, or needs more memory than a file of its size may take"));
  } catch (const std::exception& error) {
    return packed(false, std::string(error.what()));
  }
}

/// What a request may take: for the contents of usual files, and in proportion to the size of this one.
int serve() {
  struct stat status {};
  if (fstat(reader_file, &status) != 0) return 1;
  const auto bytes = static_cast<std::uint64_t>(status.st_size);
  limit(RLIMIT_AS, (768U << 20U) + 4 * bytes);
  limit(RLIMIT_CORE, 0);
  const auto seconds = static_cast<unsigned>(5 + bytes / 10'000'000);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  std::optional<Hdf5Source> file;
  while (const std::optional<std::string> request = receive_message(reader_socket)) {
    alarm(seconds);  // ends the process
    const std::string found = answer_or_reason(file, *request);
    alarm(0);
    if (!send_message(reader_socket, found)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace eigentrail::reader

int main() {
  return eigentrail::reader::serve();
}
