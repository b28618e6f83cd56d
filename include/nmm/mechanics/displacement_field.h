#ifndef nmm_mechanics_displacement_field_h
#define nmm_mechanics_displacement_field_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace NMM
{
  /**
   * The displacement u = sum_i w_i u_i of eq. (5) and what follows from it, at
   * any point of any manifold element this rank knows the unknowns of.
   * The values are copied out of the vector; the cover system must outlive this
   * object.
   */
  class DisplacementField
  {
  public:
    /// @p solution holds the locally relevant unknowns (2 per cover) [m].
    DisplacementField(const CoverSystem                           &covers,
                      const ElasticityProblem                     &problem,
                      const dealii::TrilinosWrappers::MPI::Vector &solution);

    /// Make a field from given values of all covers [m], e.g. to interpolate a known one.
    DisplacementField(const CoverSystem                &covers,
                      const ElasticityProblem          &problem,
                      std::vector<dealii::Tensor<1, 2>> nodal_values);

    const CoverSystem &
    cover_system() const;

    /// u [m] at reference coordinates @p xi of the element's cell.
    dealii::Tensor<1, 2>
    displacement(unsigned int element, const dealii::Point<2> &xi) const;

    /// du_i/dx_j [-].
    dealii::Tensor<2, 2>
    gradient(unsigned int element, const dealii::Point<2> &xi) const;

    /// Direct stress sigma_0 + C : eps(u_h) [Pa].
    dealii::SymmetricTensor<2, 2>
    stress(unsigned int element, const dealii::Point<2> &xi) const;

    /// The same from a given displacement gradient.
    dealii::SymmetricTensor<2, 2>
    stress_from_gradient(unsigned int                element,
                         const dealii::Tensor<2, 2> &gradient) const;

    /// Value of a cover [m]: the displacement at its node, continued
    /// polynomially if the node lies outside the solid. NaN for a cover that is
    /// not relevant to this rank.
    dealii::Tensor<1, 2>
    nodal_value(unsigned int cover) const;

  private:
    static dealii::Tensor<1, 2>
    unknown_value();

    void
    set_materials(const ElasticityProblem &problem);

    const CoverSystem                         *covers;
    unsigned int                               degree;
    std::vector<dealii::Tensor<1, 2>>          nodal_values;
    std::vector<PlaneElasticity>               region_to_elasticity;
    std::vector<dealii::SymmetricTensor<2, 2>> region_to_initial_stress;
  };
} // namespace NMM

#endif
