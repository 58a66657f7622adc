// Eigenvalues of a large model at single places, by shift-invert iterations of the whole model. They know
// nothing of a projection, and serve to check one.
#pragma once

#include <memory>
#include <vector>

#include "projection/large_model.hpp"

namespace eigentrail {

class LargeSpectrum {
 public:
  /// `model`: a sparse family or a scene of bodies, as is_large says. What is given must outlive this.
  LargeSpectrum(const Model& model, const TraceOptions& trace);

  /// Eigenvalues (Im s >= 0) at the value p of the traced parameter, among them all that are closest to the
  /// finite ones of `wanted`. `x`, `lambda`: a guess of the equilibrium; a family needs none. Empty if there
  /// is no equilibrium or the iterations do not converge. One factorization, and one for each of `wanted`
  /// that is far from the others.
  std::vector<Complex> beside(const ComplexVector& wanted, double p, const Vector& x, const Vector& lambda);

 private:
  /// Adds the modes nearest to the shift, and those within `cover` of it, to `found`; returns the radius
  /// within which all are known, 0 if there is no answer.
  double add(const SparsePencil& pencil, const Shift& shift, int count, double cover,
             std::vector<Complex>& found);

  const TraceOptions& trace_;
  std::unique_ptr<LargeModel> large_;
  ModeFinder finder_;
};

}  // namespace eigentrail
