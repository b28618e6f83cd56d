// The rotated frame of small strains, and the stress that is conjugate to its stretch.

#include <gtest/gtest.h>
#include <mechanics/model.h>
#include <mechanics/rotated_frame.h>
#include <random>

using namespace NMM;
using namespace NMM::Test;
using internal::RotatedFrame;
using internal::RotatedStress;

namespace
{
  /// Displacement gradients with strains up to 0.1 and rotations up to 3, and stresses that do not
  /// have their directions.
  class RandomStates
  {
  public:
    Tensor<2, 2>
    gradient()
    {
      Tensor<2, 2> U = 0.1 * tensor();
      U              = Tensor<2, 2>(dealii::symmetrize(U));
      U[0][0] += 1.;
      U[1][1] += 1.;
      const double angle = 3. * number(generator);
      Tensor<2, 2> R;
      R[0][0] = R[1][1] = std::cos(angle);
      R[1][0]           = std::sin(angle);
      R[0][1]           = -R[1][0];
      return R * U - Tensor<2, 2>(dealii::unit_symmetric_tensor<2>());
    }

    Tensor<2, 2>
    tensor()
    {
      Tensor<2, 2> result;
      for (unsigned int i = 0; i < 4; ++i)
        result[i / 2][i % 2] = number(generator);
      return result;
    }

  private:
    std::mt19937                           generator{11};
    std::uniform_real_distribution<double> number{-1., 1.};
  };


  RotatedFrame
  frame(const Tensor<2, 2> &gradient)
  {
    RotatedFrame result;
    EXPECT_TRUE(result.reinit(gradient) == Deformation::admissible);
    return result;
  }
} // namespace


/// F = R U, and the work of P on the change of F is that of T on the change of U, in steps of any
/// size. P exerts no moment in the middle. All to rounding.
TEST(RotatedFrame, WorkOfStress)
{
  RandomStates states;
  for (unsigned int i = 0; i < 200; ++i)
  {
    const RotatedFrame begin = frame(states.gradient()),
                       end   = frame(states.gradient());
    EXPECT_LT((end.rotation * Tensor<2, 2>(end.stretch) - end.F).norm(), 1e-14);
    EXPECT_NEAR(dealii::determinant(end.rotation), 1., 1e-14);
    EXPECT_GT(dealii::determinant(end.stretch), 0.);
    EXPECT_GT(dealii::trace(end.stretch), 0.);
    const SymmetricTensor<2, 2> T = dealii::symmetrize(states.tensor());
    const Tensor<2, 2>          P = RotatedStress(begin, end, T).first_stress();
    EXPECT_NEAR(dealii::scalar_product(P, end.F - begin.F),
                T * (end.stretch - begin.stretch),
                1e-14);
    const Tensor<2, 2> kirchhoff =
      P * dealii::transpose(0.5 * (begin.F + end.F));
    EXPECT_NEAR(kirchhoff[0][1], kirchhoff[1][0], 1e-14);
  }
  RotatedFrame turned_over;
  Tensor<2, 2> mirror;
  mirror[0][0] = -2.;
  EXPECT_TRUE(turned_over.reinit(mirror) == Deformation::inverted);
}


/// The moduli against central differences, for T linear in U: of one state, and of the mean in a
/// step, by the mean of F.
TEST(RotatedFrame, ModuliAgainstDifferences)
{
  RandomStates     states;
  constexpr double step = 1e-6;
  for (unsigned int i = 0; i < 100; ++i)
  {
    const bool         is_step = i % 2 == 1;
    const Tensor<2, 2> H_0 = states.gradient(), H_1 = states.gradient();
    const SymmetricTensor<2, 2> T_0 = dealii::symmetrize(states.tensor());
    double                      D[4][4];
    for (unsigned int a = 0; a < 4; ++a)
    {
      const SymmetricTensor<2, 2> row = dealii::symmetrize(states.tensor());
      for (unsigned int b = 0; b < 4; ++b)
        D[a][b] = row[b / 2][b % 2];
    }
    std::copy(D[1], D[1] + 4, D[2]);
    const auto T_of = [&](const RotatedFrame &f) {
      SymmetricTensor<2, 2> T = T_0;
      for (unsigned int a : {0, 1, 3})
        for (unsigned int b = 0; b < 4; ++b)
          T[a / 2][a % 2] += D[a][b] * f.strain()[b / 2][b % 2];
      return T;
    };
    const auto stress = [&](const RotatedFrame &begin,
                            const RotatedFrame &end) {
      return RotatedStress(begin, end, 0.5 * (T_of(begin) + T_of(end)));
    };
    const RotatedFrame first = frame(H_0), last = frame(H_1);
    double             A[4][4];
    stress(is_step ? first : last, last).moduli(D, A);
    for (unsigned int b = 0; b < 4; ++b)
    {
      Tensor<2, 2> change;
      change[b / 2][b % 2]     = step;
      const RotatedFrame plus  = frame(H_1 + change),
                         minus = frame(H_1 - change);
      Tensor<2, 2> difference =
        (stress(is_step ? first : plus, plus).first_stress() -
         stress(is_step ? first : minus, minus).first_stress()) /
        (is_step ? step : 2. * step);
      for (unsigned int a = 0; a < 4; ++a)
        difference[a / 2][a % 2] -= A[a][b];
      // rounding 1e-16 / step, and step^2
      EXPECT_LT(difference.norm(), 1e-8) << i;
    }
  }
}
