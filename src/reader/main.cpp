// The program that reads a file of HDF5 or MATLAB for another process (core/reader_process.hpp). What it has
// open is its end of a socket and the file.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>

#include "core/ending_allocation.hpp"
#include "core/reader_requests.hpp"
#include "reader/hdf5_source.hpp"
#include "reader/matlab_source.hpp"

namespace eigentrail::reader {
namespace {

/// How the process ends where memory does: until it has a limit of its own, the memory of the machine or of
/// the user ends.
int end_of_memory = reader_without_memory;

/// Whether the limit is not one that was there before.
bool limit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit limits{};
  getrlimit(resource, &limits);
  const bool is_ours = most < limits.rlim_cur;
  limits.rlim_cur = limits.rlim_max = std::min({most, limits.rlim_cur, limits.rlim_max});
  setrlimit(resource, &limits);
  return is_ours;
}

/// After the file is open, wherever links in it lead.
void open_nothing_else() {
  limit(RLIMIT_NOFILE, 0);
}

class Server {
 public:
  /// Answers requests until the other process has gone.
  void run() {
    while (const std::optional<std::string> request = receive_message(reader_socket)) {
      alarm(seconds_);  // ends the process
      const std::string found = answer(*request);
      alarm(0);
      if (!send_message(reader_socket, found)) return;
    }
  }

 private:
  /// What requests may take: for the contents of usual files, and in proportion to the size of this one.
  void allow_for(std::uint64_t bytes) {
    if (limit(RLIMIT_AS, (768U << 20U) + 4 * bytes)) end_of_memory = reader_at_limit;
    seconds_ += static_cast<unsigned>(bytes / 10'000'000);
    alarm(seconds_);
  }

  /// What was asked for, or why there is none.
  std::string answer(const std::string& message) try {
    ReaderRequest request{};
    std::string name;
    std::uint64_t first = 0, rows = 0;
    unpack(message, request, name, first, rows);
    const bool is_image = request == ReaderRequest::open_image;
    switch (request) {
      case ReaderRequest::matlab:
        allow_for(std::filesystem::file_size(name));
        return packed(true, read_matlab(name.c_str(), open_nothing_else));
      case ReaderRequest::open:
      case ReaderRequest::open_image:
        allow_for(is_image ? name.size() : std::filesystem::file_size(name));
        file_.emplace(name, is_image);
        open_nothing_else();
        return packed(true, true);
      case ReaderRequest::has:
        return packed(true, file_->has(name));
      case ReaderRequest::members:
        return packed(true, file_->members(name));
      case ReaderRequest::attributes:
        return packed(true, file_->attributes(name));
      default:
        return packed(true, file_->read(name, first, rows));
    }
  } catch (const std::exception& error) {
    return packed(false, std::string(error.what()));
  }

  unsigned seconds_ = 5;
  std::optional<Hdf5Source> file_;
};

}  // namespace
}  // namespace eigentrail::reader

void eigentrail::end_without_memory(std::size_t /*size*/) {
  _exit(reader::end_of_memory);
}

int main() {
  eigentrail::reader::limit(RLIMIT_CORE, 0);
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);  // not all file systems offer locks, and our files are whole
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  H5PLset_loading_state(0);  // no filters but those of HDF5
  eigentrail::reader::Server().run();
}
