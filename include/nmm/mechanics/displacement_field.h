#ifndef nmm_mechanics_displacement_field_h
#define nmm_mechanics_displacement_field_h

#include <nmm/covers/cover_system.h>
#include <nmm/mechanics/disk_cover.h>
#include <nmm/mechanics/elasticity_problem.h>

#include <deal.II/lac/trilinos_vector.h>
#include <deal.II/lac/vector.h>

#include <utility>
#include <vector>

namespace NMM
{
  /**
   * The displacement u = sum_i w_i u_i of eq. (5), its gradient and the stress, at
   * any point of any manifold element whose unknowns are known to this rank. In disk covers
   * their functions are added.
   * The values are copied from the vector; the cover system must outlive this
   * object.
   */
  class DisplacementField
  {
  public:
    /// Make the field of @p solution, which has the locally relevant unknowns (2 per cover) [m].
    DisplacementField(const CoverSystem                           &covers,
                      const ElasticityProblem                     &problem,
                      const dealii::TrilinosWrappers::MPI::Vector &solution);

    /// Make a field from given values of all covers [m], e.g. to interpolate a known one.
    DisplacementField(const CoverSystem                &covers,
                      const ElasticityProblem          &problem,
                      std::vector<dealii::Tensor<1, 2>> nodal_values);

    /// The same field on each rank, with the values of all covers. Collective.
    DisplacementField
    on_all_ranks() const;

    /// Add the functions of a disk cover, which must outlive this object.
    void
    add_disk(const DiskCover &disk, const dealii::Vector<double> &coefficients);

    /// The cover system given to the constructor.
    const CoverSystem &
    cover_system() const;

    /// Displacement u at reference coordinates @p xi of the element's cell [m].
    dealii::Tensor<1, 2>
    displacement(unsigned int element, const dealii::Point<2> &xi) const;

    /// Displacement gradient du_i/dx_j at reference coordinates @p xi of the element's cell [-].
    dealii::Tensor<2, 2>
    gradient(unsigned int element, const dealii::Point<2> &xi) const;

    /// The part of gradient() that does not come from disk covers [-].
    dealii::Tensor<2, 2>
    gradient_of_covers(unsigned int element, const dealii::Point<2> &xi) const;

    /// The part of gradient() that comes from disk covers [-].
    dealii::Tensor<2, 2>
    gradient_of_disks(unsigned int element, const dealii::Point<2> &xi) const;

    /// Stress sigma_0 + C : eps(u_h) of linear elasticity, evaluated directly, without recovery, at
    /// reference coordinates @p xi of the element's cell [Pa].
    dealii::SymmetricTensor<2, 2>
    stress(unsigned int element, const dealii::Point<2> &xi) const;

    /// The same stress for a given displacement gradient there [Pa].
    dealii::SymmetricTensor<2, 2>
    stress_from_gradient(unsigned int                element,
                         const dealii::Point<2>     &xi,
                         const dealii::Tensor<2, 2> &gradient) const;

    /// Value of a cover [m]: the displacement at its node. If the node lies outside of the solid,
    /// this is the value of the polynomial extension. NaN for a cover that is
    /// not relevant to this rank.
    dealii::Tensor<1, 2>
    nodal_value(unsigned int cover) const;

  private:
    static dealii::Tensor<1, 2>
    unknown_value();

    void
    set_materials(const ElasticityProblem &problem);

    /// Sum of the functions of the disk cover that an element lies in.
    DiskCover::Value
    disk_value(unsigned int element, const dealii::Point<2> &xi) const;

    const CoverSystem                         *covers;
    unsigned int                               degree;
    std::vector<dealii::Tensor<1, 2>>          nodal_values;
    std::vector<PlaneElasticity>               region_to_elasticity;
    std::vector<dealii::SymmetricTensor<2, 2>> region_to_initial_stress;
    /// Material::varying_initial_stress of each region; empty if there is none.
    std::vector<std::shared_ptr<const dealii::Function<2>>> region_to_varying;

    std::vector<std::pair<const DiskCover *, dealii::Vector<double>>> disks;
    /// The disk that each region lies in, or invalid_index; empty if there are no disks.
    std::vector<unsigned int> region_to_disk;
  };
} // namespace NMM

#endif
