#include <nmm/materials/hyperelastic_law.h>

#include <cmath>
#include <mechanics/conserving_terms.h>
#include <mechanics/rotated_frame.h>

namespace NMM
{
  namespace internal
  {
    using dealii::SymmetricTensor;
    using dealii::Tensor;

    namespace
    {
      /// A : J B, which is 0 if A and B have the same principal directions.
      double
      cross(const SymmetricTensor<2, 2> &A, const SymmetricTensor<2, 2> &B)
      {
        return A[0][1] * (B[0][0] - B[1][1]) - (A[0][0] - A[1][1]) * B[0][1];
      }


      /// A - t J.
      Tensor<2, 2>
      minus_skew(const Tensor<2, 2> &A, const double t)
      {
        Tensor<2, 2> result = A;
        result[0][1] += t;
        result[1][0] -= t;
        return result;
      }
    } // namespace


    Deformation
    RotatedFrame::reinit(const Tensor<2, 2> &gradient)
    {
      F = deformation_gradient(gradient);
      if (!(dealii::determinant(F) > 0.))
        return Deformation::inverted;
      const double c = F[0][0] + F[1][1], s = F[1][0] - F[0][1],
                   length = std::hypot(c, s);
      rotation[0][0] = rotation[1][1] = c / length;
      rotation[1][0]                  = s / length;
      rotation[0][1]                  = -s / length;
      stretch = dealii::symmetrize(dealii::transpose(rotation) * F);
      return Deformation::admissible;
    }


    SymmetricTensor<2, 2>
    RotatedFrame::strain() const
    {
      return stretch - dealii::unit_symmetric_tensor<2>();
    }


    SymmetricTensor<2, 2>
    RotatedFrame::change_of_stretch(const Tensor<2, 2> &H) const
    {
      const Tensor<2, 2> G     = dealii::transpose(rotation) * H;
      const double       omega = (G[1][0] - G[0][1]) / dealii::trace(stretch);
      SymmetricTensor<2, 2> V  = dealii::symmetrize(G);
      V[0][0] += omega * stretch[0][1];
      V[1][1] -= omega * stretch[0][1];
      V[0][1] -= 0.5 * omega * (stretch[0][0] - stretch[1][1]);
      return V;
    }


    RotatedStress::RotatedStress(const RotatedFrame          &begin,
                                 const RotatedFrame          &end,
                                 const SymmetricTensor<2, 2> &T)
      : end(&end)
      , T(T)
      , F(0.5 * (begin.F + end.F))
      , U(0.5 * (begin.stretch + end.stretch))
      , tau(cross(T, U) / dealii::trace(U))
    {
      inverse = dealii::invert(Tensor<2, 2>(U));
      S       = inverse * minus_skew(Tensor<2, 2>(T), tau);
    }


    void
    RotatedStress::moduli(const double (&D)[4][4], double (&A)[4][4]) const
    {
      for (unsigned int b = 0; b < 4; ++b)
      {
        Tensor<2, 2> H;
        H[b / 2][b % 2]                 = 1.;
        const SymmetricTensor<2, 2> V   = end->change_of_stretch(H);
        const Tensor<2, 2>          T_H = multiply(D, Tensor<2, 2>(V));
        const double tau_H = (cross(dealii::symmetrize(T_H), U) + cross(T, V) -
                              tau * dealii::trace(V)) /
                             dealii::trace(U);
        const Tensor<2, 2> P_H =
          H * S + F * inverse * (minus_skew(T_H, tau_H) - Tensor<2, 2>(V) * S);
        for (unsigned int a = 0; a < 4; ++a)
          A[a][b] = P_H[a / 2][a % 2];
      }
    }
  } // namespace internal
} // namespace NMM
