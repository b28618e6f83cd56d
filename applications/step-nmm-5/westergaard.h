#ifndef step_nmm_5_westergaard_h
#define step_nmm_5_westergaard_h

#include <nmm/covers/crack_tip.h>
#include <nmm/materials/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <complex>

namespace StepNMM5
{
  /**
   * Westergaard's solution: an infinite plane in equibiaxial tension sigma with a crack of length 2a,
   * in the frame of one of its tips, z = x_1 + i x_2 from there:
   * @f[ Z = \sigma\frac{z+a}{\sqrt{z(z+2a)}},\qquad K_I = \sigma\sqrt{\pi a},\qquad K_{II}=T=0,
       \qquad 2\mu u_1 = \tfrac{\kappa-1}{2}\mathrm{Re}\bar Z - x_2\,\mathrm{Im}Z,\qquad
       2\mu u_2 = \tfrac{\kappa+1}{2}\mathrm{Im}\bar Z - x_2\,\mathrm{Re}Z @f]
   * with the integral Zbar of Z.
   */
  class Westergaard
  {
  public:
    /// Half of the crack's length [m] and the tension [Pa].
    static constexpr double a = 1., sigma = 1.;

    /// The lifetime of neither argument matters.
    Westergaard(const NMM::CrackTip        &tip,
                const NMM::PlaneElasticity &elasticity);

    /// [m]
    dealii::Tensor<1, 2>
    displacement(const dealii::Point<2> &x) const;

    /// [Pa]
    dealii::SymmetricTensor<2, 2>
    stress(const dealii::Point<2> &x) const;

    /// K_I [Pa m^(1/2)]
    static double
    K_I();

  private:
    /// x in the frame of the tip.
    std::complex<double>
    local(const dealii::Point<2> &x) const;

    dealii::Point<2>     tip;
    dealii::Tensor<2, 2> frame;
    NMM::PlaneElasticity elasticity;
  };
} // namespace StepNMM5

#endif
