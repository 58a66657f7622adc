// Independent pieces of work on several processor cores.
#pragma once

#include <cstddef>
#include <functional>

namespace eigentrail {

/// Calls work(0) ... work(count - 1) in no particular order, at most `jobs` at once (0: one per core). After
/// an exception no new call begins; the exception is rethrown when all running calls have ended. `work` may
/// call in_parallel itself.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace eigentrail
