#include "eigentrail/store/unfinished_run.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/archive.hpp"
#include "core/blas.hpp"
#include "core/fingerprint.hpp"
#include "eigentrail/core/plain_file.hpp"
#include "store/differences.hpp"
#include "store/output_lock.hpp"
#include "store/saved_pieces.hpp"

namespace eigentrail {
namespace {

std::string unfinished_name(const std::string& output) {
  return output + ".unfinished";
}

}  // namespace

std::string run_mark(const SharedRun& run) {
  return "eigentrail-run " + std::to_string(fingerprint(packed(run.all_settings())));
}

void require_run(const std::string& output, const SharedRun& run) {
  if (run.part) {
    require_same_run(output, read_part_file(output).run.all_settings(), run.all_settings());
  } else if (!bytes_of_file(output).ends_with(run_mark(run))) {
    throw InputError(output +
                     ": cannot be resumed: it is of other input; restore that, or begin anew with --force");
  }
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
  if (pieces_format.starts_with(content)) return;  // killed before it was more than begun
  if (!content.starts_with(pieces_format))
    throw InputError(name_ + ": is no file of an interrupted run; rename it");
  SavedPieces saved = saved_pieces(content);
  if (saved.size == 0) return;
  if (before == Before::refuse)
    throw InputError(name_ + ": holds what an interrupted run has computed for " + output_ +
                     "; --resume goes on with it, --force begins anew");
  require_same_run(output_, saved.run.all_settings(), run_.all_settings());
  if (saved.blas_kernel != blas_kernel()) other_kernel_ = saved.blas_kernel;
  pieces_ = std::move(saved.pieces);
  goes_on_ = true;
  end_ = static_cast<std::int64_t>(saved.size);
} catch (const ArchiveError& error) {
  throw InputError(name_ + ": is damaged: " + error.what() + "; begin anew with --force");
}

const std::string* UnfinishedRun::find(const std::string& kind, std::size_t number) const {
  const auto found = pieces_.find({kind, number});
  return found == pieces_.end() ? nullptr : &found->second;
}

void UnfinishedRun::add(const std::string& kind, std::size_t number, const std::string& bytes) {
  if (!file_) begin();
  write(record_of_piece(kind, number, bytes));
}

void UnfinishedRun::begin() {
  file_ = std::make_unique<LockedFile>(name_, output_);
  if (ftruncate(file_->descriptor(), end_) != 0 || lseek(file_->descriptor(), 0, SEEK_END) < 0)
    throw std::system_error(errno, std::generic_category(), name_);
  if (!goes_on_) write(begin_of_pieces(run_));
}

void UnfinishedRun::write(const std::string& record) {
  if (!file_->write(record))
    throw std::runtime_error(name_ + ": cannot be written on: " + std::generic_category().message(errno) +
                             "; make room, then the same command with --resume goes on");
}

void UnfinishedRun::write_part(Existing existing) {
  if (!file_) begin();
  write_durably(output_, {bytes_of_file(name_)}, existing);
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
