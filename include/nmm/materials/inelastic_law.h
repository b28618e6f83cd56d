#ifndef nmm_materials_inelastic_law_h
#define nmm_materials_inelastic_law_h

#include <nmm/base/assembly.h>
#include <nmm/materials/material.h>

#include <deal.II/base/symmetric_tensor.h>

namespace NMM
{
  /// The history variables of the material at a point: a quadrature point of an element, or one side
  /// of a point of a displacement condition or tie. A new point has zeros. All inelastic laws share
  /// this struct: what a new law needs beside it is added here and to serialize(). That changes what
  /// checkpoints contain: raise the version in source/dynamics/checkpoint_file.cc, and let
  /// InelasticTerms::restore_internal_state() check that the new member is finite.
  struct MaterialState
  {
    /// In-plane plastic strain epsilon^p [-].
    dealii::SymmetricTensor<2, 2> plastic_strain;
    /// Plastic strain epsilon^p_zz across the plane [-].
    double plastic_strain_zz = 0.;
    /// Time integral of sqrt(2/3 e : e), where e is the deviator of the plastic strain rate [-].
    double equivalent_plastic_strain = 0.;

    /// Writes or reads the state by one of Boost's archives, for checkpoints.
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
   * A law for small strains whose stress depends on the history of the material:
   * @f[ \sigma_{n+1} = \sigma(\varepsilon_{n+1}, s_n), \qquad s_{n+1} = s(\varepsilon_{n+1},
   *     s_n), @f]
   * where s_n is the state after the last accepted step. An evaluation does not change s_n, so
   * that a step can be repeated. In large displacements InelasticTerms evaluates the law in the
   * frame that rotates with the material.
   */
  class InelasticLaw
  {
  public:
    /// The stress at the end of a step, and what follows from it.
    struct Response
    {
      /// In-plane stress sigma, initial stress included [Pa].
      dealii::SymmetricTensor<2, 2> stress;
      /// Stress sigma_zz across the plane, initial stress included [Pa].
      double stress_zz = 0.;
      /// Strain across the plane [-]; 0 in plane strain.
      double strain_zz = 0.;
      /// d sigma_ij / d epsilon_kl at [2i + j][2k + l], symmetric in i, j and in k, l [Pa]; not
      /// set if the step is elastic.
      double tangent[4][4];
      /// Energy stored in the elastic strain e, e : C : e / 2 + sigma_0 : e, where C is Hooke's
      /// tensor and sigma_0 the initial stress, components across the plane included [Pa].
      double energy = 0.;
      /// sigma : Delta epsilon^p, the energy that the step dissipates, all components [Pa].
      double dissipated = 0.;
      /// Whether the step from the given state is elastic; the tangent is then that of Hooke's
      /// law. If it is false at any point, the global matrix is factorized as unsymmetric.
      bool is_elastic = true;
      /// The state at the end of the step.
      MaterialState state;
    };

    virtual ~InelasticLaw() = default;

    /// Computes the response for the in-plane strain @p strain [-] at the end of a step that
    /// began in @p state. It sets all members, but for the tangent of an elastic step; @p response
    /// may hold those of another point. If no admissible stress was found it returns
    /// Deformation::inverted, as for elements that are turned inside out: the response is undefined,
    /// and the step is cut.
    virtual Deformation
    evaluate(const dealii::SymmetricTensor<2, 2> &strain,
             const MaterialState                 &state,
             Response                            &response) const = 0;
  };
} // namespace NMM

#endif
