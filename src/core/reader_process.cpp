#include "core/reader_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <system_error>
#include <utility>

#include "eigentrail/core/text.hpp"

extern char** environ;  // NOLINT: of POSIX
/// The program of src/reader.
extern "C" const char eigentrail_reader_program[];      // NOLINT: named by the assembler
extern "C" const char eigentrail_reader_program_end[];  // NOLINT

namespace eigentrail {

/// A descriptor that is closed with its owner. It stands above those that the reading process gets.
class ReaderDescriptor {
 public:
  explicit ReaderDescriptor(int number)
      : number_(number < 0 ? -1 : fcntl(number, F_DUPFD_CLOEXEC, reader_file + 1)) {
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

ReaderDescriptor file_in_memory(const char* name, std::string_view bytes) {
  ReaderDescriptor file(memfd_create(name, MFD_CLOEXEC));
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category());
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return file;
}

/// The program as a file, made once.
int reader_program() {
  static const ReaderDescriptor file =
      file_in_memory("eigentrail-reader",
                     {eigentrail_reader_program,
                      static_cast<std::size_t>(eigentrail_reader_program_end - eigentrail_reader_program)});
  return file;
}

/// Starts the program with a socket and a file. It is in a process group of its own, so that Ctrl-C in a
/// terminal does not end it before the process that asks.
pid_t start_reader(int socket, int file) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, socket, reader_socket);
  posix_spawn_file_actions_adddup2(&actions, file, reader_file);
  for (const int output : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  const std::string program = "/proc/self/fd/" + std::to_string(reader_program());
  std::string name = "eigentrail-reader";
  char* const arguments[] = {name.data(), nullptr};
  pid_t process = 0;
  const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0)
    throw std::system_error(error, std::generic_category(), "no process can be started to read it");
  return process;
}

/// Why a process has ended, for a message about its file.
std::string end_of(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    return "is damaged, or its disk does not answer: reading it came to no end";
  std::string why = "code " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
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

ReaderProcess::ReaderProcess(const std::string& path) : name_(path) {
  try {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      throw Hdf5Error(path + ": no such file, or not a plain file");
    start(ReaderDescriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC)));
  } catch (const std::system_error& error) {
    fail(error.what());
  }
}

ReaderProcess::ReaderProcess(const std::string& name, std::string_view image) : name_(name) {
  try {
    start(file_in_memory("eigentrail-file", image));
  } catch (const std::system_error& error) {
    fail(error.what());
  }
}

void ReaderProcess::start(int file) {
  int ends[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category());
  ReaderDescriptor ours(ends[0]);
  const ReaderDescriptor theirs(ends[1]);
  const pid_t process = start_reader(theirs, file);
  connection_.reset(new Connection{std::move(ours), process});
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
