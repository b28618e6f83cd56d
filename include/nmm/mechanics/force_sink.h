#ifndef nmm_mechanics_force_sink_h
#define nmm_mechanics_force_sink_h

#include <nmm/mechanics/material_vector.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace NMM
{
  /// Takes the forces of terms with ForceTerm::couplings(), one local system after the other, and
  /// adds them to those of all terms. So it does not matter which terms come before or after.
  class ForceSink
  {
  public:
    virtual ~ForceSink() = default;

    /**
     * Add @p forces on @p unknowns to r [N/m], and their derivative @p tangent with respect to
     * these unknowns (that of conserving forces with respect to the mean displacement) to K [Pa].
     * The unknowns are free ones, in pairs 2k and 2k + 1, and lie within one of the couplings. The
     * tangent is not read, and may be empty, if none is assembled. All ranks add the same.
     */
    virtual void
    add(const std::vector<dealii::types::global_dof_index> &unknowns,
        const dealii::Vector<double>                       &forces,
        const dealii::FullMatrix<double>                   &tangent) = 0;

    /// Add a @p force [N/m] that works on the vector @p d, so that its power is F . d', and its
    /// derivative @p stiffness = dF/dd [Pa].
    virtual void
    add(const MaterialVector       &d,
        const dealii::Tensor<1, 2> &force,
        const dealii::Tensor<2, 2> &stiffness) = 0;
  };
} // namespace NMM

#endif
