// Interrupts and resumes traces, and compares them bit for bit with uninterrupted ones.
#pragma once

#include <string>
#include <vector>

#include "eigentrail/continuation/trace.hpp"

namespace eigentrail::test {

/// All numbers of a trace as text that represents every bit: a line per point, and the result without times.
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

/// The part of a trace that is resumed from a state: the points after it, and the result.
TraceBits run_from(const Model& model, const TraceOptions& options, const std::string& state);

/// Compares the traces that are resumed from at most `most` states, spread over the whole trace, with the
/// whole. Returns the first difference in words; empty if there is none.
std::string first_resumed_difference(const Model& model, const TraceOptions& options, std::size_t most);

}  // namespace eigentrail::test
