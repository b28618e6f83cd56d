#ifndef nmm_source_dynamics_step_matrix_h
#define nmm_source_dynamics_step_matrix_h

#include <nmm/mechanics/mechanical_model.h>

#include <dynamics/scheme_step.h>
#include <linear_algebra/active_items.h>

namespace NMM
{
  namespace internal
  {
    /// Mass M and damping C of the equations of a step, and the sum of M, C and K that is the
    /// derivative of these equations.
    class StepMatrix
    {
    public:
      using Vector = MechanicalModel::Vector;
      using Matrix = MechanicalModel::Matrix;

      /// @throws InputError for negative coefficients of the damping.
      StepMatrix(MechanicalModel       &model,
                 const RayleighDamping &damping,
                 bool                   is_conserving);

      /// Add @p factor M x to @p result, in active rows.
      void
      add_mass(double factor, const Vector &x, Vector &result)
      {
        add_product(factor, *layout->mass, x, result);
      }

      /// Add @p factor C x to @p result, in active rows.
      void
      add_damping(double factor, const Vector &x, Vector &result);

      /// Whether C is not zero. Damping that is a part of the model's forces is not in it.
      bool
      has_damping() const
      {
        return damping.mass > 0. || damping.stiffness > 0.;
      }

      /// Sum up the matrix of a step with the tangent of @p forces, in active rows.
      void
      assemble(const SchemeStep &step, const AssembledForces &forces);

      const Matrix &
      matrix() const
      {
        return in_place != nullptr ? *in_place : own_matrix;
      }

      /// Rows that products and sums are computed in.
      ActiveItems rows;

    private:
      void
      add_product(double        factor,
                  const Matrix &A,
                  const Vector &x,
                  Vector       &result);

      const ModelLayout *layout;
      /// Coefficients of C; that of the stiffness is 0 if the model's forces contain that damping.
      RayleighDamping damping;
      Matrix          stiffness_at_rest, own_matrix;
      /// Pattern of `own_matrix`, see AssembledForces::pattern_version; invalid_index: none.
      unsigned int own_version = invalid_index;
      /// The model's matrix to which mass and damping are added; null: it has none to add to.
      Matrix *in_place = nullptr;
      Vector  product;
    };
  } // namespace internal
} // namespace NMM

#endif
