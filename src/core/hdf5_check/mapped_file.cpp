#include "core/hdf5_check/mapped_file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/hdf5_file.hpp"

namespace eigentrail::hdf5_check {

MappedFile::MappedFile(const std::string& path) {
  // O_NONBLOCK: opening a pipe would otherwise wait forever for its other end.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // NOLINT: as POSIX has it
  if (file < 0) throw Hdf5Error(std::strerror(errno));
  struct stat status {};
  const bool plain = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode);
  size_ = plain ? static_cast<std::size_t>(status.st_size) : 0;
  void* data = size_ > 0 ? ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0) : nullptr;
  ::close(file);
  if (!plain) throw Hdf5Error("is no plain file");
  if (data == MAP_FAILED) throw Hdf5Error("cannot be read");  // NOLINT: as POSIX has it
  data_ = data;
}

MappedFile::~MappedFile() {
  if (data_ != nullptr) ::munmap(data_, size_);
}

}  // namespace eigentrail::hdf5_check
