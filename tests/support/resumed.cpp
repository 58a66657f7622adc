#include "support/resumed.hpp"

#include <algorithm>
#include <cstring>

namespace eigentrail::test {
namespace {

/// Appends the bits of numbers.
class Bits {
 public:
  void add(double value) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    text += std::to_string(bits) + ' ';
  }
  void add(Complex value) {
    add(value.real());
    add(value.imag());
  }
  void add(int value) { text += std::to_string(value) + ' '; }
  template <class Derived>
  void add(const Eigen::MatrixBase<Derived>& values) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      for (Eigen::Index i = 0; i < values.rows(); ++i) add(values(i, j));
    }
  }

  std::string text;
};

std::string bits_of(const TracePoint& point) {
  Bits bits;
  bits.add(point.node.p);
  bits.add(point.node.path.x);
  bits.add(point.node.path.lambda);
  for (const ModeState& mode : point.modes) {
    bits.add(mode.mode);
    bits.add(mode.s);
    bits.add(mode.slope);
    bits.add(mode.shape);
    bits.add(mode.backward_error);
    bits.add(mode.condition);
  }
  if (point.step == nullptr) return bits.text;
  bits.add(point.step->length);
  bits.add(point.step->parameter);
  for (const DenseBlock& block : point.step->blocks) {
    bits.add(static_cast<int>(block.chart));
    for (const int mode : block.modes) bits.add(mode);
    bits.add(block.left);
    bits.add(block.right);
    bits.add(block.certified ? 1 : 0);
  }
  return bits.text;
}

std::string bits_of(const TraceResult& result) {
  Bits bits;
  bits.add(static_cast<int>(result.status));
  bits.text += result.message + ' ';
  for (const std::string& note : result.notes) bits.text += note + ' ';
  for (const int count :
       {result.nodes, result.n_modes, result.n_columns, result.n_available, result.n_infinite, result.order,
        result.rejections.total(), result.regroupings.joined, result.regroupings.parted,
        result.regroupings.charts, result.regroupings.repaired, result.regroupings.planes})
    bits.add(count);
  bits.add(result.reached);
  bits.add(result.s_ref);
  for (const Event& event : result.events) {
    bits.text += event_line(event) + ' ';
    bits.add(event.p);
    bits.add(event.half_width);
    bits.add(event.puiseux);
    bits.add(event.value);
    bits.add(event.direction);
    bits.add(event.retrackings);
    bits.add(event.node);
    bits.add(event.shape);
    bits.add(event.sensitivity);
    bits.add(event.shift);
  }
  const RunCounts& counts = result.counts;
  bits.text += std::to_string(result.mode_steps) + ' ' + std::to_string(result.certified_steps) + ' ';
  for (const std::uint64_t count :
       {counts.modes.factorizations, counts.modes.iterations, counts.modes.solves, counts.modes.modal_bases,
        counts.modes.modal_solves, counts.equilibrium_iterations, counts.equilibrium_factorizations,
        counts.spectra, counts.event_factorizations, counts.certificate_factorizations,
        counts.certificate_bases})
    bits.text += std::to_string(count) + ' ';
  for (const auto* evaluations : {&counts.evaluations.residual, &counts.evaluations.linearization}) {
    for (const std::uint64_t count : *evaluations) bits.text += std::to_string(count) + ' ';
  }
  return bits.text;
}

TraceObserver recording(TraceBits& bits) {
  TraceObserver observer;
  observer.point = [&bits](const TracePoint& point) {
    bits.points.push_back(bits_of(point));
    return true;
  };
  return observer;
}

}  // namespace

SavedRun run_and_save(const Model& model, const TraceOptions& options) {
  SavedRun run;
  TraceObserver observer = recording(run.bits);
  observer.checkpoint = [&run](const Checkpoint& checkpoint) {
    // If a step is rejected, there are several checkpoints without a new point between them.
    run.states.resize(run.bits.points.size());
    run.states.back() = checkpoint.save();
    return true;
  };
  run.result = trace(model, options, observer);
  run.bits.result = bits_of(run.result);
  return run;
}

TraceBits run_from(const Model& model, const TraceOptions& options, const std::string& state) {
  TraceBits bits;
  const TraceObserver observer = recording(bits);
  bits.result = bits_of(resume_trace(model, options, observer, state));
  return bits;
}

std::string first_resumed_difference(const Model& model, const TraceOptions& options, std::size_t most) {
  const SavedRun whole = run_and_save(model, options);
  const std::size_t count = std::min(most, whole.states.size());
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t at = k * whole.states.size() / count;
    if (whole.states[at].empty()) continue;  // nothing was tried from there
    const TraceBits rest = run_from(model, options, whole.states[at]);
    const std::string from = "from point " + std::to_string(at + 1) + ": ";
    if (rest.points.size() + at + 1 != whole.bits.points.size())
      return from + std::to_string(rest.points.size()) + " points instead of " +
             std::to_string(whole.bits.points.size() - at - 1);
    for (std::size_t i = 0; i < rest.points.size(); ++i) {
      if (rest.points[i] != whole.bits.points[at + 1 + i])
        return from + "point " + std::to_string(at + 2 + i) + " differs";
    }
    if (rest.result != whole.bits.result)
      return from + "the result differs:\n" + rest.result + "\n" + whole.bits.result;
  }
  return "";
}

}  // namespace eigentrail::test
