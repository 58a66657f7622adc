// What a run has computed before it ends: the file OUTPUT.unfinished, from which the same command with
// --resume goes on.
//
// The file is a line that names its format, and records: what the run is, then each finished piece. A record
// is its size, its fingerprint and its bytes. A killed run may leave a record cut short, which is dropped.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "eigentrail/core/workers.hpp"
#include "eigentrail/store/part_file.hpp"

namespace eigentrail {

class LockedFile;

/// What a command writes behind the data of its output, where readers of HDF5 do not look: by it --resume
/// knows what the output is of.
std::string run_mark(const SharedRun& run);

/// Throws InputError if a file is not the output of the run, or of its part.
void require_run(const std::string& output, const SharedRun& run);

/// Whether a run has left something for --resume.
bool is_unfinished(const std::string& output);

/// What becomes of the pieces of a run that was interrupted.
enum class Before { refuse, resume, discard };

class UnfinishedRun {
 public:
  /// Reads what the run with this output has left. Throws InputError if there is something and it is to be
  /// refused, or does not belong to `run`, which is then said in the words of a trace that cannot be resumed.
  UnfinishedRun(const std::string& output, const SharedRun& run, Before before);
  ~UnfinishedRun();
  UnfinishedRun(const UnfinishedRun&) = delete;
  UnfinishedRun& operator=(const UnfinishedRun&) = delete;

  /// Whether there are results of an interrupted run to go on from.
  bool goes_on() const { return goes_on_; }
  /// With which kernel of BLAS they were computed, if that is not the one of this process; otherwise empty.
  const std::string& other_kernel() const { return other_kernel_; }

  /// The piece if it has been computed; null otherwise.
  const std::string* find(const std::string& kind, std::size_t number) const;

  /// Makes the file, if pieces leave something behind before the first of them is finished. Throws
  /// std::system_error.
  void begin();

  /// Saves a piece; the first one makes the file. Throws std::runtime_error if it cannot be written.
  void add(const std::string& kind, std::size_t number, const std::string& bytes);

  /// Takes pieces that others have computed.
  void take(PiecesByName pieces) { pieces_.merge(pieces); }

  /// Writes the pieces of a part to the output, as write_durably does.
  void write_part(Existing existing);

  /// Removes the file: the output has all.
  void end();

 private:
  void read(Before before);
  void write(const std::string& record);

  std::string output_, name_;
  SharedRun run_;
  bool goes_on_ = false;
  std::string other_kernel_;
  PiecesByName pieces_;
  std::int64_t end_ = 0;  ///< of the records that are whole, in bytes
  std::unique_ptr<LockedFile> file_;
};

/// Workers that compute only what a run has not computed before, and save what they compute.
class SavingWorkers final : public Workers {
 public:
  SavingWorkers(std::unique_ptr<Workers> workers, UnfinishedRun& run)
      : workers_(std::move(workers)), run_(run) {}

  std::vector<std::string> compute(const Pieces& pieces, const Finished& finished) override;
  std::size_t size() const override { return workers_->size(); }

 private:
  std::unique_ptr<Workers> workers_;
  UnfinishedRun& run_;
};

}  // namespace eigentrail
