#ifndef nmm_materials_inelastic_law_h
#define nmm_materials_inelastic_law_h

#include <nmm/base/assembly.h>
#include <nmm/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

namespace NMM
{
  /// What the material remembers at a quadrature point.
  struct MaterialState
  {
    /// epsilon^p in the plane and across it [-].
    dealii::SymmetricTensor<2, 2> plastic_strain;
    double                        plastic_strain_zz = 0.;
    /// Integral of sqrt(2/3 e : e) over the history, e the deviator of the plastic strain rate
    /// [-].
    double equivalent_plastic_strain = 0.;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &plastic_strain[0][0] & plastic_strain[1][1] &
        plastic_strain[0][1];
      archive &plastic_strain_zz &equivalent_plastic_strain;
    }
  };


  /**
   * A law for small strains whose stress depends on what the material has been through:
   * @f[ \sigma_{n+1} = \sigma(\varepsilon_{n+1}, s_n), \qquad s_{n+1} = s(\varepsilon_{n+1},
   *     s_n), @f]
   * s being the state at the last step that was accepted. Evaluating it changes nothing, so that
   * a step may be tried again.
   */
  class InelasticLaw
  {
  public:
    struct Response
    {
      /// sigma in the plane and across it, initial stress included [Pa].
      dealii::SymmetricTensor<2, 2> stress;
      double                        stress_zz = 0.;
      /// d sigma_ij / d epsilon_kl at [2i + j][2k + l], symmetric in i, j and in k, l [Pa]; not
      /// set if the step is elastic.
      double tangent[4][4];
      /// Energy stored in elastic strains e: e : C : e / 2 + sigma_0 : e [Pa].
      double energy = 0.;
      /// sigma : Delta epsilon^p of the step from the given state, all components [Pa].
      double dissipated = 0.;
      /// Whether the step from the given state is elastic, with the tangent of Hooke's law.
      bool          is_elastic = true;
      MaterialState state;
    };

    virtual ~InelasticLaw() = default;

    /// At the strain @p strain in the plane, coming from @p state. With @c inverted there is no
    /// stress for it, and the response is undefined.
    virtual Deformation
    evaluate(const dealii::SymmetricTensor<2, 2> &strain,
             const MaterialState                 &state,
             Response                            &response) const = 0;
  };
} // namespace NMM

#endif
