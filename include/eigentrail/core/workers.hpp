// Who computes independent pieces of work: threads of this process, or several processes together.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace eigentrail {

/// Computes the piece with this number and returns its result as bytes. The result must depend on the number
/// alone, not on who computes it or when. Called by several threads at once.
using Piece = std::function<std::string(std::size_t)>;

/// Pieces of one kind of a run. Kind and number name a piece.
struct Pieces {
  std::string kind;
  std::vector<std::size_t> numbers;
  Piece compute;
};

/// Called with the number of finished pieces, and the number and the result of the last of them.
using Finished = std::function<void(std::size_t done, std::size_t number, const std::string& result)>;

/// 0, 1, ..., count - 1.
std::vector<std::size_t> numbers_to(std::size_t count);

class Workers {
 public:
  virtual ~Workers() = default;
  Workers() = default;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  /// Results of the pieces, in their order. Pieces are given out one by one, so pieces of different cost are
  /// shared evenly. If several processes work together, each calls this with the same pieces, and each gets
  /// all results. `finished` is called in one process only; calls do not overlap. An exception of a piece or
  /// of `finished` is rethrown when all running pieces have ended; in other processes than the one where it
  /// occurred it is an InputError or a std::runtime_error with its message.
  virtual std::vector<std::string> compute(
      const Pieces& pieces,
      const Finished& finished = [](std::size_t, std::size_t, const std::string&) {}) = 0;

  /// Number of pieces that are computed at the same time.
  virtual std::size_t size() const = 0;
};

/// Threads of this process.
class Threads final : public Workers {
 public:
  /// `jobs` threads; 0: one per core.
  explicit Threads(int jobs);

  std::vector<std::string> compute(const Pieces& pieces, const Finished& finished) override;
  std::size_t size() const override { return threads_; }

 private:
  std::size_t threads_;
};

/// Part `number` of `count` of the pieces of a run, 1 <= number <= count: every count-th piece, because
/// neighbours cost about the same.
struct Part {
  int number = 1;
  int count = 1;

  /// Numbers of its pieces, out of 0 ... n - 1.
  std::vector<std::size_t> pieces(std::size_t n) const;
};

/// Reads "2/5". Throws InputError that names the option --part.
Part read_part(const std::string& text);

}  // namespace eigentrail
