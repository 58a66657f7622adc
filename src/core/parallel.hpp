// Independent pieces of work on all cores.
#pragma once

#include <cstddef>
#include <functional>

namespace eigentrail {

/// Calls work(0) ... work(count - 1), in no particular order and `jobs` at once (0: one per core). After an
/// exception nothing new is begun; it is rethrown when all have ended. Work may call it, too.
void in_parallel(std::size_t count, int jobs, const std::function<void(std::size_t)>& work);

}  // namespace eigentrail
