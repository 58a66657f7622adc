// What counts as infinite at the stored points of a path.
#pragma once

namespace eigentrail {

/// An eigenvalue larger than this multiple of the reference counts as passing through infinity.
constexpr double infinite_size = 1e9;
/// A mode that begins or ends and is larger than this multiple of the reference comes from infinity or runs
/// there: typical eigenvalues are a thousand references, and modes that run to infinity end a hundred times
/// above the largest one at the start.
constexpr double large_size = 1e4;

}  // namespace eigentrail
