// Leaving a trace and going on with it, compared bit for bit with one that was never left.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"

namespace eigentrail::test {

/// All numbers of a trace as text that tells every bit: a line per point, and the result without times.
struct TraceBits {
  std::vector<std::string> points;
  std::string result;
};

/// A trace with the states at its checkpoints: states[i] is that before point i + 1.
struct SavedRun {
  TraceBits bits;
  std::vector<std::string> states;
  TraceResult result;
};

SavedRun run_and_save(const Model& model, const TraceOptions& options);

/// What a trace that goes on from a state adds: the points after it, and the result.
TraceBits run_from(const Model& model, const TraceOptions& options, const std::string& state);

/// Compares the traces that go on from at most `most` states, spread over the whole, with the whole; returns
/// the first difference in words, or nothing.
std::string first_resumed_difference(const Model& model, const TraceOptions& options, std::size_t most);

}  // namespace eigentrail::test
