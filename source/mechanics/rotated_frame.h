#ifndef nmm_source_mechanics_rotated_frame_h
#define nmm_source_mechanics_rotated_frame_h

#include <nmm/base/assembly.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace NMM
{
  namespace internal
  {
    /**
     * The frame that rotates with the material at a point, F = R U, in which laws for small
     * strains are evaluated in large displacements, with Biot's strain U - I.
     *
     * With J the rotation by 90 degrees, tr U = |(F_00 + F_11, F_10 - F_01)| gives R; a change H
     * of F turns the frame by omega and changes U by V,
     * @f[ G = R^T H, \quad \omega = \frac{G_{10} - G_{01}}{\mathrm{tr}\,U}, \quad
     *     V = \mathrm{sym}(G - \omega J U). @f]
     */
    struct RotatedFrame
    {
      /// The frame of I plus the displacement gradient @p gradient; inverted if det F <= 0.
      Deformation
      reinit(const dealii::Tensor<2, 2> &gradient);

      /// U - I [-].
      dealii::SymmetricTensor<2, 2>
      strain() const;

      /// V for the change @p H of F [-].
      dealii::SymmetricTensor<2, 2>
      change_of_stretch(const dealii::Tensor<2, 2> &H) const;

      /// F, R and U [-].
      dealii::Tensor<2, 2>          F, rotation;
      dealii::SymmetricTensor<2, 2> stretch;
    };


    /**
     * The first Piola-Kirchhoff stress P of a stress T in the rotated frame that is conjugate to U,
     * for one state (0 equal to 1), or for a step between two states. With means (m) of both,
     * @f[ P = F_m S, \qquad S = U_m^{-1}(T - \tau J), \qquad
     *     \tau = \frac{T:JU_m}{\mathrm{tr}\,U_m}. @f]
     * S is symmetric and sym(S U_m) = T. As the Green-Lagrange strain changes by
     * E_1 - E_0 = sym(U_m (U_1 - U_0)), the work is
     * @f[ P:(F_1 - F_0) = S:(E_1 - E_0) = T:(U_1 - U_0) @f]
     * exactly, for a step of any size: rotation alone does no work, P exerts no moment in the middle
     * of the step, and with T = (T_0 + T_1) / 2 a step that is elastic conserves energy. For one
     * state P : dF = T : dU.
     */
    class RotatedStress
    {
    public:
      /// @p T [Pa] between the frames @p begin and @p end, which must outlive the object.
      RotatedStress(const RotatedFrame                  &begin,
                    const RotatedFrame                  &end,
                    const dealii::SymmetricTensor<2, 2> &T);

      /// P [Pa].
      dealii::Tensor<2, 2>
      first_stress() const
      {
        return F * S;
      }

      /// Compute A = dP/dF, in a step the derivative by F_m at fixed F_0, for the moduli @p D by
      /// which T changes with U (in a step the mean T_m with the mean U_m). Both have ij, kl at
      /// [2i + j][2k + l] [Pa].
      void
      moduli(const double (&D)[4][4], double (&A)[4][4]) const;

    private:
      const RotatedFrame           *end;
      dealii::SymmetricTensor<2, 2> T;
      /// F_m, U_m and its inverse, and S.
      dealii::Tensor<2, 2>          F, inverse, S;
      dealii::SymmetricTensor<2, 2> U;
      double                        tau;
    };
  } // namespace internal
} // namespace NMM

#endif
