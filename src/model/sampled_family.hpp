// A model given by samples of its matrices at values of one parameter, interpolated between them.
#pragma once

#include "core/hdf5_file.hpp"
#include "eigentrail/model/matrix_model.hpp"
#include "eigentrail/model/sample_errors.hpp"
#include "eigentrail/model/sampled_data.hpp"
#include "model/sample_interpolation.hpp"

namespace eigentrail {

class SampledFamily final : public MatrixModel {
 public:
  /// `variable`: index of the parameter of the samples. `data`: samples in ascending order, checked; their
  /// values are in the SI unit of the variable.
  SampledFamily(ModelDescription description, int variable, const SampledData& data,
                std::vector<SamplePiece> pieces);

  Structure structure(int traced_parameter) const override;
  EvaluationFault linearize(const Path& path, int order, Linearization& result,
                            EvaluationCounts& counts) const override;
  CoefficientMatrices coefficient_matrices(const Vector&, int) const override;
  std::vector<double> kinks(int traced_parameter) const override;
  const SampleErrors* sample_errors() const override { return &errors_; }
  EvaluationFault extended_linearization(const BasicPath<Extended>& path,
                                         BasicLinearization<Extended>& result) const override;

 private:
  SampledFamily(ModelDescription description, int variable, const SampledData& data,
                std::vector<SamplePiece> pieces, std::array<PencilSamples, 3> samples);

  template <class Real, int Q>
  EvaluationFault evaluate_all(const BasicPath<Real>& path, int order, BasicLinearization<Real>& result,
                               EvaluationCounts& counts) const;

  int variable_;
  std::vector<double> values_;
  std::vector<SamplePiece> pieces_;
  std::array<PencilSamples, 3> samples_;  ///< of s^2 M + s C + K
  InterpolationErrors errors_;
};

/// Reads samples as read_samples does with a path.
SampledData read_samples(const Hdf5File& file);

}  // namespace eigentrail
