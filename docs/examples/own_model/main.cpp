// A bead on a hoop that spins about its vertical diameter: a model of one's own, and its trace.
#include <cmath>
#include <cstdio>

#include "eigentrail/continuation/trace.hpp"
#include "eigentrail/model/force_model.hpp"

using namespace eigentrail;

/// x: angle of the bead from the lowest point. Divided by mass times radius squared its equation reads
///   x'' = (speed^2 cos x - g / radius) sin x - damping x'
struct BeadOnHoop {
  static constexpr int freedoms = 1;
  static constexpr Contribution contribution{.inertia = true, .conservative = true, .dissipative = true};
  enum { speed, radius, damping };  // the parameters, in this order

  template <class Scalar>
  GeneralizedMass<Scalar, 1> mass(const GeneralizedState<Scalar, 1>&) const {
    return GeneralizedMass<Scalar, 1>(Scalar(1.0));
  }

  template <class Scalar>
  GeneralizedForce<Scalar, 1> force(const GeneralizedState<Scalar, 1>& at) const {
    using std::cos, std::sin;
    const Scalar& x = at.x[0];
    const Scalar pull = at.p[speed] * at.p[speed] * cos(x) - 9.81 / at.p[radius];
    return GeneralizedForce<Scalar, 1>(pull * sin(x) - at.p[damping] * at.rate[0]);
  }
};

int main() {
  const Parameters parameters(
      {{"speed", 100.0, "rpm", M_PI / 30.0}, {"radius", 0.5, "m"}, {"damping", 0.2, "1/s"}});
  const ForceModel<BeadOnHoop> model({}, parameters, {"angle"}, Vector::Constant(1, 1.4));

  TraceOptions options;
  options.parameter = "speed";
  options.from = 100.0;  // rpm: the bead has swung out
  options.to = 50.0;
  options.tolerance = 1e-8;

  std::printf("%10s  %10s  %12s  %12s\n", "speed/rpm", "angle/rad", "Re s", "Im s");
  TraceObserver observer;
  observer.point = [](const TracePoint& point) {
    const Complex s = point.modes.front().s;
    std::printf("%10.4f  %10.6f  %12.8f  %12.8f\n", point.node.p, point.node.path.x(0, 0), s.real(),
                s.imag());
    return true;  // go on
  };
  const TraceResult result = trace(model, options, observer);
  std::printf("%s after %d points\n",
              result.status == TraceStatus::completed ? "complete" : result.message.c_str(), result.nodes);
  return result.status == TraceStatus::completed ? 0 : 1;
}
