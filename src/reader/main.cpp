// The program that reads a file of HDF5 or MATLAB for another process (core/reader_process.hpp). What it has
// open is its end of a socket and the file.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <exception>

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
  limits.rlim_cur = most < limits.rlim_max ? most : limits.rlim_max;
  limits.rlim_max = limits.rlim_cur;
  setrlimit(resource, &limits);
}

/// After the file is open, wherever links in it lead.
void open_nothing_else() {
  limit(RLIMIT_NOFILE, 0);
}

/// What a request may take: for the contents of usual files, and in proportion to the size of this one.
struct Allowance {
  rlim_t memory = rlim_t{768} << 20U;  ///< bytes
  unsigned seconds = 5;

  explicit Allowance(std::uint64_t file_bytes) {
    memory += 4 * file_bytes;
    seconds += static_cast<unsigned>(file_bytes / 10'000'000);
  }
};

class Server {
 public:
  std::string answer(const std::string& message) {
    try {
      ArchiveReader arguments(message);
      ReaderRequest request{};
      arguments(request);
      return answer(request, arguments);
    } catch (const std::bad_alloc&) {
      return packed(false, std::string("is damaged, or needs more memory than a file of its size may take"));
    } catch (const std::exception& error) {
      return packed(false, std::string(error.what()));
    }
  }

 private:
  std::string answer(ReaderRequest request, ArchiveReader& arguments) {
    std::string name;
    if (request == ReaderRequest::matlab) return packed(true, read_matlab(file_path, open_nothing_else));
    if (request == ReaderRequest::open) {
      hdf5_.emplace(file_path);
      open_nothing_else();
      return packed(true, true);
    }
    arguments(name);
    switch (request) {
      case ReaderRequest::has:
        return packed(true, hdf5_->has(name));
      case ReaderRequest::members:
        return packed(true, hdf5_->members(name));
      case ReaderRequest::layout:
        return packed(true, hdf5_->layout(name));
      case ReaderRequest::attributes:
        return packed(true, hdf5_->attributes(name));
      case ReaderRequest::dimensions:
        return packed(true, hdf5_->dimensions(name));
      default:
        return read(name, arguments);
    }
  }

  std::string read(const std::string& name, ArchiveReader& arguments) {
    ElementType type{};
    std::uint64_t first = 0, rows = 0;
    arguments(type, first, rows);
    return packed(true, hdf5_->read(name, type, first, rows));
  }

  std::optional<Hdf5Source> hdf5_;
};

int serve() {
  struct stat file {};
  if (fstat(reader_file, &file) != 0) return 1;
  const Allowance allowance(static_cast<std::uint64_t>(file.st_size));
  limit(RLIMIT_AS, allowance.memory);
  limit(RLIMIT_CORE, 0);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Server server;
  while (const std::optional<std::string> request = receive_message(reader_socket)) {
    alarm(allowance.seconds);  // ends the process
    const std::string answer = server.answer(*request);
    alarm(0);
    if (!send_message(reader_socket, answer)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace eigentrail::reader

int main() {
  return eigentrail::reader::serve();
}
