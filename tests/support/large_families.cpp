#include "support/large_families.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "eigentrail/scene/scene.hpp"

namespace eigentrail::test {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

Expression omega() {
  return Expression::of_parameter(0);
}

SparseMatrix from_triplets(Eigen::Index n, const Triplets& entries) {
  SparseMatrix A(n, n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Second differences on the grid, times `a` in x and `b` in y, at the rows and columns from `offset` on.
void add_laplacian(int m, double a, double b, Eigen::Index offset, Triplets& entries) {
  const double h2 = static_cast<double>(m + 1) * (m + 1);
  const auto at = [&](int i, int j) { return offset + static_cast<Eigen::Index>(i) * m + j; };
  for (int i = 0; i < m; ++i) {
    for (int j = 0; j < m; ++j) {
      entries.emplace_back(at(i, j), at(i, j), 2.0 * (a + b) * h2);
      if (i > 0) entries.emplace_back(at(i, j), at(i - 1, j), -a * h2);
      if (i + 1 < m) entries.emplace_back(at(i, j), at(i + 1, j), -a * h2);
      if (j > 0) entries.emplace_back(at(i, j), at(i, j - 1), -b * h2);
      if (j + 1 < m) entries.emplace_back(at(i, j), at(i, j + 1), -b * h2);
    }
  }
}

/// Mass per place of the plate.
double mass(int m, Eigen::Index place) {
  const double x = static_cast<double>(place % m) / (m - 1), y = static_cast<double>(place / m) / (m - 1);
  return 1.0 + 0.5 * x + 0.3 * y * y;
}

using Matrix24 = Eigen::Matrix<double, 24, 24>;

/// Stiffness and mass of a brick of eight nodes with edges along the axes, by 2 x 2 x 2 Gauss points.
struct Brick {
  Matrix24 K = Matrix24::Zero();
  Eigen::Matrix<double, 8, 8> M = Eigen::Matrix<double, 8, 8>::Zero();

  explicit Brick(const Eigen::Vector3d& edges) {
    constexpr double E = 2.1e11, nu = 0.3, rho = 7850.0;
    const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
    Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
    D.topLeftCorner<3, 3>().setConstant(lambda);
    D.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
    const double g = 1.0 / std::sqrt(3.0);
    for (int q = 0; q < 8; ++q) {
      const Eigen::Vector3d point((q & 1) != 0 ? g : -g, (q & 2) != 0 ? g : -g, (q & 4) != 0 ? g : -g);
      Eigen::Matrix<double, 8, 1> N;
      Eigen::Matrix<double, 6, 24> B = Eigen::Matrix<double, 6, 24>::Zero();
      for (int node = 0; node < 8; ++node) {
        const Eigen::Vector3d sign((node & 1) != 0 ? 1 : -1, (node & 2) != 0 ? 1 : -1,
                                   (node & 4) != 0 ? 1 : -1);
        const Eigen::Vector3d f = Eigen::Vector3d::Ones() + sign.cwiseProduct(point);
        N[node] = f.prod() / 8.0;
        const Eigen::Vector3d d =
            Eigen::Vector3d(sign[0] * f[1] * f[2], sign[1] * f[0] * f[2], sign[2] * f[0] * f[1])
                .cwiseQuotient(4.0 * edges);
        const int c = 3 * node;
        B(0, c) = B(3, c + 1) = B(5, c + 2) = d[0];
        B(1, c + 1) = B(3, c) = B(4, c + 2) = d[1];
        B(2, c + 2) = B(4, c + 1) = B(5, c) = d[2];
      }
      const double volume = edges.prod() / 8.0;
      K += volume * B.transpose() * D * B;
      M += volume * rho * N * N.transpose();
    }
    K = 0.5 * (K + K.transpose()).eval();
  }
};

}  // namespace

AffinePencil<SparseMatrix> rotating_plate(const RotatingPlate& plate) {
  const int m = plate.cells;
  const Eigen::Index fields = static_cast<Eigen::Index>(m) * m, n = 2 * fields;
  Triplets M, G, K0, K2, S, D;
  add_laplacian(m, 1.0, 1.1, 0, K0);
  add_laplacian(m, 1.0, 1.6, fields, K0);
  add_laplacian(m, 0.01, 0.01, 0, K2);
  add_laplacian(m, 0.02, 0.01, fields, K2);
  for (Eigen::Index i = 0; i + 1 < fields; ++i) {
    if ((i + 1) % m == 0) continue;
    D.emplace_back(i, i + 1, 0.5 * (m + 1));
    D.emplace_back(i + 1, i, -0.5 * (m + 1));
  }
  for (Eigen::Index i = 0; i < fields; ++i) {
    const double w = mass(m, i);
    for (const Eigen::Index at : {i, i + fields}) M.emplace_back(at, at, w);
    K2.emplace_back(i, i, 0.4 * w);
    K2.emplace_back(i + fields, i + fields, -0.6 * w);
    G.emplace_back(i, i + fields, -2.0 * w);
    G.emplace_back(i + fields, i, 2.0 * w);
    S.emplace_back(i, i + fields, w);
    S.emplace_back(i + fields, i, -w);
  }
  AffinePencil<SparseMatrix> pencil;
  pencil.M = {{1.0, from_triplets(n, M)}};
  pencil.C = {{omega(), from_triplets(n, G)}};
  if (plate.damping != 0.0) pencil.C.push_back({plate.damping, from_triplets(n, M)});
  pencil.K = {{1.0, from_triplets(n, K0)}, {omega() * omega(), from_triplets(n, K2)}};
  if (plate.circulatory != 0.0) pencil.K.push_back({plate.circulatory, from_triplets(n, S)});
  if (plate.convection != 0.0) pencil.K.push_back({plate.convection * omega(), from_triplets(n, D)});
  return pencil;
}

AffinePencil<SparseMatrix> solid_shaft(const SolidShaft& shaft) {
  const int wide = shaft.disc_width, margin = (wide - shaft.width) / 2;
  const auto is_solid = [&](int i, int j, int k) {
    const bool in_disc = std::any_of(shaft.discs.begin(), shaft.discs.end(),
                                     [&](int first) { return k == first || k == first + 1; });
    const int low = in_disc ? 0 : margin, high = in_disc ? wide : wide - margin;
    return i >= low && i < high && j >= low && j < high;
  };
  std::map<std::array<int, 3>, Eigen::Index> nodes;
  const auto node = [&](int i, int j, int k) {
    return nodes.try_emplace({k, i, j}, static_cast<Eigen::Index>(nodes.size())).first->second;
  };
  const Brick brick({shaft.cell, shaft.flatness * shaft.cell, shaft.cell});
  Triplets M, G, K0, softening;
  for (int k = 0; k < shaft.length; ++k) {
    for (int i = 0; i < wide; ++i) {
      for (int j = 0; j < wide; ++j) {
        if (!is_solid(i, j, k)) continue;
        std::array<Eigen::Index, 8> at{};
        for (int c = 0; c < 8; ++c)
          at[static_cast<std::size_t>(c)] = 3 * node(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
        for (int a = 0; a < 8; ++a) {
          for (int b = 0; b < 8; ++b) {
            const Eigen::Index r = at[static_cast<std::size_t>(a)], s = at[static_cast<std::size_t>(b)];
            const double m = brick.M(a, b);
            for (int d = 0; d < 3; ++d) M.emplace_back(r + d, s + d, m);
            for (int d = 0; d < 2; ++d) softening.emplace_back(r + d, s + d, -m);
            G.emplace_back(r, s + 1, -2.0 * m);
            G.emplace_back(r + 1, s, 2.0 * m);
            for (int d = 0; d < 3; ++d) {
              for (int e = 0; e < 3; ++e) K0.emplace_back(r + d, s + e, brick.K(3 * a + d, 3 * b + e));
            }
          }
        }
      }
    }
  }
  // Bearings hold the nodes of a section one element from the ends, the first one the axis, too. Torsion is
  // held at both: without prestress, centrifugal softening of a free torsion is no physics.
  Triplets B, J;
  const double share = 1.0 / ((shaft.width + 1.0) * (shaft.width + 1.0));
  for (const int k : {1, shaft.length - 1}) {
    std::vector<std::pair<Eigen::Index, double>> turn;
    for (int i = margin; i <= margin + shaft.width; ++i) {
      for (int j = margin; j <= margin + shaft.width; ++j) {
        const Eigen::Index at = 3 * node(i, j, k);
        for (int d = 0; d < 2; ++d) B.emplace_back(at + d, at + d, share);
        J.emplace_back(at, at + 1, -share);
        J.emplace_back(at + 1, at, share);
        if (k == 1) K0.emplace_back(at + 2, at + 2, share * shaft.bearing_stiffness);
        const double x = i - 0.5 * wide, y = shaft.flatness * (j - 0.5 * wide);
        turn.emplace_back(at, -y);
        turn.emplace_back(at + 1, x);
      }
    }
    for (const auto& [a, ta] : turn) {
      for (const auto& [b, tb] : turn)
        K0.emplace_back(a, b, 100.0 * share * shaft.bearing_stiffness * ta * tb);
    }
  }
  const auto n = static_cast<Eigen::Index>(3 * nodes.size());
  const SparseMatrix bearings = from_triplets(n, B), stiffness = from_triplets(n, K0);
  AffinePencil<SparseMatrix> pencil;
  pencil.M = {{1.0, from_triplets(n, M)}};
  pencil.C = {{1.0, shaft.internal_damping * stiffness + shaft.bearing_damping * bearings},
              {omega(), from_triplets(n, G)}};
  pencil.K = {{1.0, stiffness + shaft.bearing_stiffness * bearings},
              {omega(), shaft.bearing_damping * from_triplets(n, J)},
              {omega() * omega(), from_triplets(n, softening)}};
  return pencil;
}

TraceSetup large_setup(AffinePencil<SparseMatrix> pencil, double from, double to, int modes,
                       double tolerance) {
  TraceSetup setup;
  setup.scene =
      parse_scene("[parameters]\nomega = 0\n[trace]\nparameter = \"omega\"\n[matrix_family]\nM = [[[1]]]\n",
                  "large.toml");
  setup.options.parameter = "omega";
  setup.options.from = from;
  setup.options.to = to;
  setup.options.modes.count = modes;
  setup.options.tolerance = tolerance;
  ModelDescription description;
  const auto n = static_cast<std::size_t>(pencil.K.front().matrix.rows());
  for (std::size_t i = 0; i < n; ++i) description.coordinate_names.push_back("x" + std::to_string(i + 1));
  description.coordinate_units.assign(n, "1");
  description.parameters = setup.scene.parameters;
  setup.model = std::make_unique<SparseFamily>(std::move(description), std::move(pencil));
  return setup;
}

std::shared_ptr<const Model> shared_model(const TraceSetup& setup) {
  return {std::shared_ptr<const Model>(), setup.model.get()};
}

std::unique_ptr<ProjectedFamily> projected_family(const TraceSetup& setup, const TraceOptions& trace,
                                                  const ProjectionOptions& options) {
  std::unique_ptr<Model> model = project(shared_model(setup), trace, {}, options);
  return std::unique_ptr<ProjectedFamily>(dynamic_cast<ProjectedFamily*>(model.release()));
}

std::vector<Complex> eigenvalues_near(const AffinePencil<SparseMatrix>& at, Complex near, int count) {
  using Sparse = Eigen::SparseMatrix<Complex>;
  const Sparse M = at.M.front().matrix.cast<Complex>(), C = at.C.front().matrix.cast<Complex>(),
               K = at.K.front().matrix.cast<Complex>();
  const Eigen::Index n = K.rows(), k = count + 4;
  Sparse P = near * near * M + near * C + K;
  P.makeCompressed();
  const Eigen::SparseLU<Sparse> lu(P);
  // Subspace iteration with (x, v = s x): a = -P^-1 (M v + C x + s0 M x), b = x + s0 a.
  ComplexMatrix X = ComplexMatrix::Random(n, k), V = near * X;
  std::vector<Complex> eigenvalues, before;
  for (int iteration = 0; iteration < 200; ++iteration) {
    ComplexMatrix stacked(2 * n, k);
    stacked << X, V / std::abs(near);
    const ComplexMatrix Q =
        Eigen::HouseholderQR<ComplexMatrix>(stacked).householderQ() * ComplexMatrix::Identity(2 * n, k);
    const ComplexMatrix Y = Q.topRows(n), W = Q.bottomRows(n) * std::abs(near);
    X = -lu.solve(M * W + C * Y + near * (M * Y));
    V = Y + near * X;
    ComplexMatrix image(2 * n, k);
    image << X, V / std::abs(near);
    const ComplexVector nu = (Q.adjoint() * image).eval().eigenvalues();
    eigenvalues.clear();
    for (const Complex one : nu) eigenvalues.push_back(near + 1.0 / one);
    std::sort(eigenvalues.begin(), eigenvalues.end(),
              [&](Complex a, Complex b) { return std::abs(a - near) < std::abs(b - near); });
    eigenvalues.resize(static_cast<std::size_t>(count));
    double change = before.empty() ? 1.0 : 0.0;
    for (std::size_t i = 0; i < before.size(); ++i)
      change = std::max(change, std::abs(before[i] - eigenvalues[i]) / std::abs(eigenvalues[i]));
    if (change < 1e-12) break;
    before = eigenvalues;
  }
  return eigenvalues;
}

}  // namespace eigentrail::test
