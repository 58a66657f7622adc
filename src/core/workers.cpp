#include "eigentrail/core/workers.hpp"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <thread>

#include "core/parallel.hpp"
#include "core/texts.hpp"
#include "eigentrail/core/errors.hpp"

namespace eigentrail {
namespace {

constexpr int most_parts = 100'000;

}  // namespace

Threads::Threads(int jobs)
    : threads_(jobs > 0 ? static_cast<std::size_t>(jobs)
                        : std::max<std::size_t>(1, std::thread::hardware_concurrency())) {}

std::vector<std::size_t> numbers_to(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

std::vector<std::string> Threads::compute(const Pieces& pieces, const Finished& finished) {
  const std::vector<std::size_t>& numbers = pieces.numbers;
  std::vector<std::string> results(numbers.size());
  std::mutex mutex;
  std::size_t done = 0;
  in_parallel(numbers.size(), static_cast<int>(threads_), [&](std::size_t i) {
    results[i] = pieces.compute(numbers[i]);
    const std::scoped_lock lock(mutex);
    finished(++done, numbers[i], results[i]);
  });
  return results;
}

std::vector<std::size_t> Part::pieces(std::size_t n) const {
  std::vector<std::size_t> numbers;
  for (std::size_t i = static_cast<std::size_t>(number - 1); i < n; i += static_cast<std::size_t>(count))
    numbers.push_back(i);
  return numbers;
}

Part read_part(const std::string& text) {
  const std::vector<std::string> words = split(text, '/');
  const auto number = parsed_number<int>(words[0]);
  const auto count = parsed_number<int>(words.size() == 2 ? words[1] : "");
  if (!number || !count)
    throw InputError("--part: expected i/N, such as 2/5 for the second of five parts; found '" + text + "'");
  if (*count < 1 || *count > most_parts || *number < 1 || *number > *count)
    throw InputError("--part: expected i/N with 1 <= i <= N <= " + std::to_string(most_parts) + "; found '" +
                     text + "'");
  return {*number, *count};
}

}  // namespace eigentrail
