#include "reed/plant/dynamics/beam_shapes.h"

#include <array>

namespace reed::plant {

namespace {

// Gauss-Legendre rule with 8 points on [0, 1]: exact to degree 15, the integrands have degree 10 at most.
constexpr std::array<double, 4> kOffset = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                           0.9602898564975363};
constexpr std::array<double, 4> kWeight = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};

/// Calls visit(ξ, weight) at the points of the rule on [0, end].
template <typename Visit>
void Quadrature(double end, Visit visit) {
  for (std::size_t i = 0; i < kOffset.size(); ++i)
    for (const double side : {-1.0, 1.0})
      visit(0.5 * end * (1.0 + side * kOffset[i]), 0.5 * end * kWeight[i]);
}

/// dN/dξ of the dimensionless shapes.
BendingVec SlopeXi(double x) {
  const double bubble = x * (1.0 - x);
  return {6.0 * bubble,                    //
          x * (3.0 * x - 2.0),             //
          bubble * (1.0 - 2.0 * x),        // ∫P_2(2ξ-1) dξ
          bubble * (1.0 - 5.0 * bubble)};  // -∫P_3(2ξ-1) dξ
}

}  // namespace

BeamShapes ShapesAt(double l, double length) {
  const double x = l / length, y = 1.0 - x, bubble = x * y;
  BeamShapes shapes;
  // Columns scaled so that a_1 is the slope v'(L) itself and every other coordinate is in metres.
  const BendingVec unit(1.0, length, 1.0, 1.0);
  const BendingVec N(x * x * (3.0 - 2.0 * x), -x * x * y, 0.5 * bubble * bubble,
                     0.5 * bubble * bubble * (1.0 - 2.0 * x));
  const BendingVec curvature(6.0 - 12.0 * x, 6.0 * x - 2.0, 6.0 * x * x - 6.0 * x + 1.0,
                             (1.0 - 2.0 * x) * (1.0 - 10.0 * bubble));
  shapes.N = N.cwiseProduct(unit);
  shapes.slope = SlopeXi(x).cwiseProduct(unit) / length;
  shapes.curvature = curvature.cwiseProduct(unit) / (length * length);
  shapes.S.setZero();
  Quadrature(x, [&](double xi, double weight) {
    const BendingVec slope = SlopeXi(xi).cwiseProduct(unit) / length;
    shapes.S += weight * length * slope * slope.transpose();
  });
  return shapes;
}

BeamIntegrals IntegrateShapes(double length) {
  BeamIntegrals sum;
  sum.N.setZero();
  sum.lN.setZero();
  sum.NN.setZero();
  sum.S.setZero();
  sum.lS.setZero();
  sum.curvature.setZero();
  Quadrature(1.0, [&](double xi, double weight) {
    const double l = xi * length, dl = weight * length;
    const BeamShapes at = ShapesAt(l, length);
    sum.N += dl * at.N;
    sum.lN += dl * l * at.N;
    sum.NN += dl * at.N * at.N.transpose();
    sum.S += dl * at.S;
    sum.lS += dl * l * at.S;
    sum.curvature += dl * at.curvature * at.curvature.transpose();
  });
  return sum;
}

}  // namespace reed::plant
