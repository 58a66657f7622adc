// A library to be loaded before others (LD_PRELOAD) that lets calls of the system fail.
//
//   FAULT_CALL    which: allocate, open, write, sync, rename, truncate, map, lock
//   FAULT_AT      number of the call that fails, from 1; 0: none
//   FAULT_FROM    set: all later ones fail, too
//   FAULT_COUNT   file to which the number of calls of the program `eigentrail` is written in the end
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Call { allocate, open_file, write_file, sync_file, rename_file, truncate_file, map, lock, none };
constexpr const char* names[] = {"allocate", "open", "write", "sync", "rename", "truncate", "map", "lock"};

Call chosen = none;  // until the program begins
long failing = 0;
bool from_then_on = false;
std::atomic<long> count{0};

/// Whether this call fails; errno is then set.
bool fails(Call call, int error) {
  if (call != chosen) return false;
  // OpenBLAS repeats a map that fails for ever.
  constexpr long longest_fault = 100'000;
  const long number = ++count;
  if (failing == 0 || number < failing || number > failing + (from_then_on ? longest_fault : 0)) return false;
  errno = error;
  return true;
}

__attribute__((constructor)) void begin() {
  const char* name = std::getenv("FAULT_CALL");
  const char* at = std::getenv("FAULT_AT");
  if (name == nullptr || at == nullptr) return;
  failing = std::atol(at);
  from_then_on = std::getenv("FAULT_FROM") != nullptr;
  for (int i = 0; i < none; ++i) {
    if (std::strcmp(name, names[i]) == 0) chosen = static_cast<Call>(i);
  }
}

__attribute__((destructor)) void end() {
  const char* path = std::getenv("FAULT_COUNT");
  if (path == nullptr || std::strcmp(program_invocation_short_name, "eigentrail") != 0) return;
  char text[32];
  const int size = std::snprintf(text, sizeof text, "%ld", count.load());
  const long file = syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  syscall(SYS_write, file, text, size);
}

template <class Function>
Function* next(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

mode_t mode_of(int flags, std::va_list list) {
  return (flags & (O_CREAT | O_TMPFILE)) != 0 ? va_arg(list, mode_t) : 0;
}

}  // namespace

// NOLINTBEGIN: named by the system
extern "C" {

// The program itself allocates by the second names.
void* __libc_malloc(std::size_t size) {
  return fails(allocate, ENOMEM) ? nullptr : next(&__libc_malloc, "__libc_malloc")(size);
}
void* __libc_calloc(std::size_t n, std::size_t size) {
  return fails(allocate, ENOMEM) ? nullptr : next(&__libc_calloc, "__libc_calloc")(n, size);
}
void* __libc_realloc(void* memory, std::size_t size) {
  return fails(allocate, ENOMEM) ? nullptr : next(&__libc_realloc, "__libc_realloc")(memory, size);
}
void* __libc_memalign(std::size_t alignment, std::size_t size) {
  return fails(allocate, ENOMEM) ? nullptr : next(&__libc_memalign, "__libc_memalign")(alignment, size);
}
void* malloc(std::size_t size) {
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  return __libc_calloc(n, size);
}
void* realloc(void* memory, std::size_t size) {
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}

int open(const char* path, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return fails(open_file, EMFILE) ? -1 : next(&open, "open")(path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  std::va_list list;
  va_start(list, flags);
  const mode_t mode = mode_of(flags, list);
  va_end(list);
  return fails(open_file, EMFILE) ? -1 : next(&open64, "open64")(path, flags, mode);
}
std::FILE* fopen(const char* path, const char* mode) {
  return fails(open_file, EMFILE) ? nullptr : next(&fopen, "fopen")(path, mode);
}
std::FILE* fopen64(const char* path, const char* mode) {
  return fails(open_file, EMFILE) ? nullptr : next(&fopen64, "fopen64")(path, mode);
}
ssize_t write(int file, const void* bytes, std::size_t size) {
  return fails(write_file, ENOSPC) ? -1 : next(&write, "write")(file, bytes, size);
}
int fsync(int file) {
  return fails(sync_file, EIO) ? -1 : next(&fsync, "fsync")(file);
}
int rename(const char* from, const char* to) noexcept {
  return fails(rename_file, EIO) ? -1 : next(&rename, "rename")(from, to);
}
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  return fails(rename_file, EIO) ? -1
                                 : next(&renameat2, "renameat2")(from_folder, from, to_folder, to, flags);
}
int ftruncate(int file, off_t size) noexcept {
  return fails(truncate_file, EIO) ? -1 : next(&ftruncate, "ftruncate")(file, size);
}
int ftruncate64(int file, off64_t size) noexcept {
  return fails(truncate_file, EIO) ? -1 : next(&ftruncate64, "ftruncate64")(file, size);
}
void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset) noexcept {
  return fails(map, ENOMEM) ? MAP_FAILED : next(&mmap, "mmap")(at, size, protection, flags, file, offset);
}
void* mmap64(void* at, std::size_t size, int protection, int flags, int file, off64_t offset) noexcept {
  return fails(map, ENOMEM) ? MAP_FAILED : next(&mmap64, "mmap64")(at, size, protection, flags, file, offset);
}
int flock(int file, int operation) noexcept {
  return fails(lock, ENOLCK) ? -1 : next(&flock, "flock")(file, operation);
}
}
// NOLINTEND
