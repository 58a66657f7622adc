// Archives of NumPy (.npz, made by numpy.savez or savez_compressed): a zip file with one array per entry.
#include <zip.h>

#include <memory>

#include "eigentrail/core/errors.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "eigentrail/scene/limits.hpp"
#include "import/formats.hpp"
#include "import/npy.hpp"

namespace eigentrail {
namespace {

constexpr zip_int64_t most_arrays = 10000;
/// Bytes of all arrays together.
constexpr std::size_t most_bytes = 8 * limits::matrix_numbers;

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;
using Entry = std::unique_ptr<zip_file_t, decltype(&zip_fclose)>;

Archive open_archive(const std::string& path) {
  require_plain_file(path);
  int code = 0;
  Archive archive(zip_open(path.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code), &zip_discard);
  if (archive) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string message = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw InputError(path + ": cannot be read as an archive of NumPy (.npz): " + message);
}

/// The bytes of an entry, unpacked; its checksum is checked by the library. `budget` is what may still be
/// read. An entry that announces more, or unpacks to more than it announces, is given up at once.
std::string entry_bytes(zip_t* archive, zip_uint64_t index, const std::string& where, std::size_t& budget) {
  const Entry entry(zip_fopen_index(archive, index, 0), &zip_fclose);
  if (!entry) throw InputError(where + ": cannot be read: " + zip_strerror(archive));
  std::string bytes;
  std::string block(1U << 16U, '\0');
  std::size_t announced = 0;
  while (true) {
    const zip_int64_t count = zip_fread(entry.get(), block.data(), block.size());
    if (count < 0)
      throw InputError(where + ": is damaged: " + zip_error_strerror(zip_file_get_error(entry.get())));
    if (count == 0) return bytes;
    const auto read = static_cast<std::size_t>(count);
    if (bytes.empty()) {
      announced = announced_npy_bytes(std::string_view(block).substr(0, read), where);
      if (announced > budget)
        throw InputError(where + ": more than " + std::to_string(limits::matrix_numbers) +
                         " numbers in all arrays together");
      budget -= announced;
      bytes.reserve(announced);
    }
    if (bytes.size() + read > announced)
      throw InputError(where + ": has more bytes than its header announces, " + std::to_string(announced));
    bytes.append(block, 0, read);
  }
}

std::vector<NamedArray> read_archive(const std::string& path) {
  const Archive archive = open_archive(path);
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  if (count > most_arrays)
    throw InputError(path + ": has more than " + std::to_string(most_arrays) + " arrays");
  std::vector<NamedArray> arrays;
  std::size_t budget = most_bytes;
  for (zip_int64_t i = 0; i < count; ++i) {
    const auto index = static_cast<zip_uint64_t>(i);
    const char* name = zip_get_name(archive.get(), index, 0);
    std::string own = name == nullptr ? "" : name;
    if (!own.ends_with(".npy")) continue;
    own.resize(own.size() - 4);
    const std::string where = path + ": array " + own;
    arrays.push_back(read_npy(entry_bytes(archive.get(), index, where, budget), where));
    arrays.back().name = own;
  }
  return arrays;
}

Imported read_numpy(const ImportRequest& request) {
  if (request.files.size() != 1) throw InputError("numpy: expected one .npz file with all samples");
  return from_arrays(read_archive(request.files.front()), request, true);
}

}  // namespace

Importer numpy_importer() {
  return {"numpy", "matrices from an archive of NumPy (.npz)", array_items("k x n x n"), array_options(),
          read_numpy};
}

}  // namespace eigentrail
