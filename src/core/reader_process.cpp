#include "core/reader_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "eigentrail/core/text.hpp"

extern char** environ;  // NOLINT: of POSIX
/// The program of src/reader.
extern "C" const char eigentrail_reader_program[];      // NOLINT: named by the assembler
extern "C" const char eigentrail_reader_program_end[];  // NOLINT

namespace eigentrail {

/// A descriptor that is closed with its owner. It is none of the standard ones, which the reading process
/// replaces.
class ReaderDescriptor {
 public:
  explicit ReaderDescriptor(int number)
      : number_(number < 0 ? -1 : fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
    if (number_ < 0) {
      const int error = errno;
      if (number >= 0) close(number);
      throw std::system_error(error, std::generic_category());
    }
    close(number);
  }
  ReaderDescriptor(ReaderDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  ReaderDescriptor& operator=(ReaderDescriptor&&) = delete;
  ~ReaderDescriptor() {
    if (number_ >= 0) close(number_);
  }
  operator int() const { return number_; }  // NOLINT: used wherever the system takes a descriptor

 private:
  int number_;
};

namespace {

ReaderDescriptor program_in_memory() {
  ReaderDescriptor file(memfd_create("eigentrail-reader", MFD_CLOEXEC));
  for (const char* at = eigentrail_reader_program; at != eigentrail_reader_program_end;) {
    const ssize_t written = write(file, at, static_cast<std::size_t>(eigentrail_reader_program_end - at));
    if (written < 0) throw std::system_error(errno, std::generic_category());
    at += written;
  }
  return file;
}

/// Starts the program with a socket. It is in a process group of its own, so that Ctrl-C in a terminal does
/// not end it before the process that asks.
pid_t start_reader(int socket) {
  static const ReaderDescriptor program = program_in_memory();
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, socket, reader_socket);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const std::string path = "/proc/self/fd/" + std::to_string(program);
  std::string name = "eigentrail-reader";
  char* const arguments[] = {name.data(), nullptr};
  pid_t process = 0;
  const int error = posix_spawn(&process, path.c_str(), &actions, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) throw std::system_error(error, std::generic_category());
  return process;
}

/// Why a process has ended, for a message about its file.
std::string end_of(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return "is damaged, or its disk does not answer: reading it came to no end";
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == reader_without_memory) return "there is not enough memory to read it";
  if (code == reader_at_limit) return "is damaged, or needs more memory than a file of its size may take";
  std::string why = "code " + std::to_string(code);
  if (WIFSIGNALED(status)) why = strsignal(WTERMSIG(status));
  return "is damaged: reading it ended in a crash (" + why + ")";
}

}  // namespace

struct ReaderProcess::Connection {
  ReaderDescriptor socket;
  pid_t process = 0;
  int status = 0;  ///< of the process that has ended

  void end() {
    if (process == 0) return;
    kill(process, SIGKILL);
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    process = 0;
  }
  ~Connection() { end(); }
};

ReaderProcess::ReaderProcess(const std::string& name) : name_(name) {
  try {
    int ends[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
      throw std::system_error(errno, std::generic_category());
    ReaderDescriptor ours(ends[0]);
    const ReaderDescriptor theirs(ends[1]);
    connection_.reset(new Connection{std::move(ours), start_reader(theirs)});
  } catch (const std::system_error& error) {
    throw std::runtime_error(name_ + ": no process can be started to read it: " + error.what());
  }
}

std::string ReaderProcess::exchange(const std::string& request) const {
  if (connection_->process != 0 && send_message(connection_->socket, request)) {
    if (std::optional<std::string> answer = receive_message(connection_->socket)) return std::move(*answer);
  }
  connection_->end();
  fail(end_of(connection_->status));
}

void ReaderProcess::fail(const std::string& reason) const {
  throw Hdf5Error(name_ + ": cannot be read: " + printable(reason));
}

}  // namespace eigentrail
