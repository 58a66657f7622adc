// Files of HDF5 and MATLAB are read in another process, because the libraries that read them trust the
// contents of a file: a damaged one can make them crash, hang or take all memory. That process, src/reader,
// has the file open and answers requests for names, attributes and parts of arrays. Its memory and time are
// limited, and it can open no other file. Its program is embedded into this library.
#pragma once

#include <memory>
#include <string>

#include "core/hdf5_types.hpp"
#include "core/reader_requests.hpp"

namespace eigentrail {

/// A process that has one file open. Not thread-safe. Its functions throw Hdf5Error; its message begins with
/// the name of the file.
class ReaderProcess {
 public:
  /// For the file called `name` in messages, which is opened by the first request. Throws std::runtime_error
  /// if no process can be started.
  explicit ReaderProcess(const std::string& name);

  /// The answer to a request. Throws Hdf5Error with the reason if there is none: the file has not what was
  /// asked for, or the process crashed, met a limit or answered nonsense.
  template <class Answer>
  Answer ask(ReaderRequest request, const std::string& name = "", std::uint64_t first = 0,
             std::uint64_t rows = 0) const {
    const std::string message = exchange(packed(request, name, first, rows));
    try {
      bool done = false;
      ArchiveReader archive(message);
      archive(done);
      Answer answer{};
      std::string reason;
      done ? archive(answer) : archive(reason);
      archive.finish();
      if (done) return answer;
      fail(reason);
    } catch (const ArchiveError&) {
      fail("is damaged: reading it led to nonsense");
    }
  }

  [[noreturn]] void fail(const std::string& reason) const;

 private:
  std::string exchange(const std::string& request) const;

  struct Connection;
  std::string name_;
  std::shared_ptr<Connection> connection_;
};

}  // namespace eigentrail
