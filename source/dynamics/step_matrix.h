#ifndef nmm_source_dynamics_step_matrix_h
#define nmm_source_dynamics_step_matrix_h

#include <nmm/mechanics/mechanical_model.h>

#include <dynamics/scheme_step.h>
#include <linear_algebra/chosen_items.h>

namespace NMM
{
  namespace internal
  {
    /// The sum of the mass M, the damping C and the stiffness K that is the derivative of the
    /// equations of a step, and products in chosen rows.
    class StepMatrix
    {
    public:
      using Vector = MechanicalModel::Vector;
      using Matrix = MechanicalModel::Matrix;

      explicit StepMatrix(const ModelLayout &layout);

      /// Add A x to @p result, in chosen rows.
      void
      add_product(const Matrix &A, const Vector &x, Vector &result);

      /// Sum up the matrix of a step with the tangent of @p forces, in chosen rows.
      void
      assemble(const SchemeStep &step, const AssembledForces &forces);

      const Matrix &
      matrix() const
      {
        return in_place != nullptr ? *in_place : own_matrix;
      }

      /// Rows that products and sums are computed in.
      ChosenItems rows;

    private:
      const ModelLayout *layout;
      Matrix             own_matrix;
      /// Pattern of `own_matrix`, see AssembledForces::pattern_version; invalid_index: none.
      unsigned int own_version = invalid_index;
      /// The model's matrix to which mass and damping are added; null: it has none to add to.
      Matrix *in_place = nullptr;
      Vector  product;
    };
  } // namespace internal
} // namespace NMM

#endif
