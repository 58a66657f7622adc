#include "eigentrail/store/unfinished_run.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "core/fingerprint.hpp"
#include "store/differences.hpp"
#include "store/output_lock.hpp"

namespace eigentrail {
namespace {

constexpr std::string_view format = "eigentrail-unfinished 1\n";

using RecordHead = std::array<std::uint64_t, 2>;  ///< size and fingerprint of the bytes that follow

std::string record_of(const std::string& bytes) {
  const RecordHead head{bytes.size(), fingerprint(bytes)};
  return std::string(reinterpret_cast<const char*>(head.data()), sizeof head) + bytes;
}

std::string unfinished_name(const std::string& output) {
  return output + ".unfinished";
}

[[noreturn]] void refuse_other_run(const std::string& output) {
  throw InputError(output +
                   ": cannot be resumed: it is of other input; restore that, or begin anew with --force");
}

/// Takes the first record from `left`; empty if none is whole.
std::string_view take_record(std::string_view& left) {
  RecordHead head{};
  if (left.size() < sizeof head) return {};
  std::memcpy(head.data(), left.data(), sizeof head);
  const std::string_view bytes = left.substr(sizeof head, head[0]);
  if (bytes.size() < head[0] || fingerprint(bytes) != head[1]) return {};
  left.remove_prefix(sizeof head + bytes.size());
  return bytes;
}

}  // namespace

std::string run_mark(const SharedRun& run) {
  return "eigentrail-run " + std::to_string(fingerprint(packed(run.all_settings())));
}

void require_run(const std::string& output, const SharedRun& run) {
  if (!bytes_of_file(output).ends_with(run_mark(run))) refuse_other_run(output);
}

void require_part(const std::string& output, const SharedRun& run, const Part& part) {
  const PartFile file = read_part_file(output);
  require_same_run(output, file.run.all_settings(), run.all_settings());
  if (file.part.number != part.number || file.part.count != part.count) refuse_other_run(output);
}

bool is_unfinished(const std::string& output) {
  std::error_code error;
  return std::filesystem::exists(unfinished_name(output), error);
}

UnfinishedRun::UnfinishedRun(const std::string& output, const SharedRun& run, Before before)
    : output_(output), name_(unfinished_name(output)), run_(run) {
  if (before != Before::discard && is_unfinished(output)) read(before);
}

UnfinishedRun::~UnfinishedRun() = default;

void UnfinishedRun::read(Before before) try {
  const std::string content = bytes_of_file(name_);
  std::string_view left = content;
  if (format.starts_with(left)) return;  // killed before it was more than begun
  if (!left.starts_with(format)) throw InputError(name_ + ": is no file of an interrupted run; rename it");
  left.remove_prefix(format.size());
  const std::string_view first = take_record(left);
  if (first.empty()) return;
  if (before == Before::refuse)
    throw InputError(name_ + ": holds what an interrupted run has computed for " + output_ +
                     "; --resume goes on with it, --force begins anew");
  std::string kernel;
  Settings settings;
  unpack(first, settings, kernel);
  require_same_run(output_, settings, run_.all_settings());
  if (kernel != blas_kernel()) other_kernel_ = kernel;
  for (std::string_view bytes = take_record(left); !bytes.empty(); bytes = take_record(left)) {
    std::pair<std::string, std::uint64_t> key;
    std::string piece;
    unpack(bytes, key, piece);
    pieces_.insert_or_assign(key, std::move(piece));
  }
  goes_on_ = true;
  end_ = static_cast<std::int64_t>(content.size() - left.size());
} catch (const ArchiveError& error) {
  throw InputError(name_ + ": is damaged: " + error.what() + "; begin anew with --force");
}

const std::string* UnfinishedRun::find(const std::string& kind, std::size_t number) const {
  const auto found = pieces_.find({kind, number});
  return found == pieces_.end() ? nullptr : &found->second;
}

void UnfinishedRun::add(const std::string& kind, std::size_t number, const std::string& bytes) {
  if (!file_) begin();
  write(record_of(packed(std::pair(kind, static_cast<std::uint64_t>(number)), bytes)));
}

void UnfinishedRun::begin() {
  file_ = std::make_unique<LockedFile>(name_, output_);
  if (ftruncate(file_->descriptor(), end_) != 0 || lseek(file_->descriptor(), 0, SEEK_END) < 0)
    throw std::system_error(errno, std::generic_category(), name_);
  if (!goes_on_) write(std::string(format) + record_of(packed(run_.all_settings(), blas_kernel())));
}

void UnfinishedRun::write(const std::string& record) {
  for (std::string_view left = record; !left.empty();) {
    const ssize_t written = ::write(file_->descriptor(), left.data(), left.size());
    if (written < 0 && errno != EINTR)
      throw std::runtime_error(name_ + ": cannot be written on: " + std::generic_category().message(errno) +
                               "; make room, then the same command with --resume goes on");
    if (written > 0) left.remove_prefix(static_cast<std::size_t>(written));
  }
}

void UnfinishedRun::end() {
  if (file_ || goes_on_) std::remove(name_.c_str());
  file_.reset();
}

std::vector<std::string> SavingWorkers::compute(const Pieces& pieces, const Finished& finished) {
  const Pieces missing{pieces.kind, pieces.numbers, [&](std::size_t number) {
                         const std::string* saved = run_.find(pieces.kind, number);
                         return saved != nullptr ? *saved : pieces.compute(number);
                       }};
  return workers_->compute(missing, [&](std::size_t done, std::size_t number, const std::string& bytes) {
    if (run_.find(pieces.kind, number) == nullptr) run_.add(pieces.kind, number, bytes);
    finished(done, number, bytes);
  });
}

}  // namespace eigentrail
