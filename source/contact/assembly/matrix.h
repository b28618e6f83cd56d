#ifndef nmm_source_contact_assembly_matrix_h
#define nmm_source_contact_assembly_matrix_h

#include <nmm/linear_algebra/body_matrix.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <contact/assembly/point_terms.h>
#include <contact/detection/points.h>
#include <contact/detection/search.h>
#include <contact/surface/chosen_bodies.h>
#include <linear_algebra/cover_matrix_assembler.h>
#include <memory>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Forces and tangent of contact, and the sparsity pattern of the tangent. The pattern has the
     * couplings of slaves (positions in ContactSearch::slaves()) with their masters and with the
     * edges of their anchors, and all couplings of the elasticity, so that its tangent can be
     * added.
     *
     * Making a pattern costs more than an assembly, and most candidate pairs never touch. Hence a
     * slave is in the pattern only if one of these functions has put it there: couple_all() in
     * statics, couple_step() and couple() in time steps. On several ranks the pattern always has
     * all slaves.
     *
     * Order of calls: update_candidates() after each search; one of the functions that couple
     * before an assembly with a tangent; then begin_assembly(), add() for each point,
     * end_assembly(). All references must outlive this object.
     */
    class ContactMatrix
    {
    public:
      using Vector = dealii::TrilinosWrappers::MPI::Vector;
      using Matrix = dealii::TrilinosWrappers::SparseMatrix;

      ContactMatrix(const ContactSurface                    &surface,
                    const dealii::AffineConstraints<double> &constraints,
                    const ContactSearch                     &search,
                    const StickPlaces                       &stick_places,
                    const ChosenBodies                      &chosen);

      /// Update after a search that found new candidate pairs, or after a change of anchors.
      void
      update_candidates();

      void
      couple_all();

      /// Set the pattern of a time step: the slaves that are expected to touch.
      void
      couple_step(const std::vector<unsigned int> &slaves);

      /// Begin a time step: couple_step() is to be called before its first tangent.
      void
      begin_step()
      {
        has_step_pattern = false;
      }

      bool
      is_step_coupled() const
      {
        return has_step_pattern;
      }

      /// Add slaves to the pattern. On one rank only.
      void
      couple(const std::vector<unsigned int> &slaves);

      /// Begin an assembly. @p body_matrix: matrix to which the tangent is added instead of tangent(),
      /// or null.
      void
      begin_assembly(bool with_tangent, BodyMatrix *body_matrix = nullptr);

      /// Add the terms of one point; @p local is changed.
      void
      add(ContactLocalSystem &local);

      void
      end_assembly();

      /// Set all forces to zero.
      void
      clear_forces()
      {
        forces = 0.;
      }

      void
      add_to_tangent(const Matrix &other);

      const Vector &
      residual() const
      {
        return forces;
      }

      Matrix &
      tangent()
      {
        return matrix;
      }

      /// Grows whenever the pattern of tangent() changes.
      unsigned int
      pattern_version() const
      {
        return version;
      }

    private:
      void
      look_at_candidates();

      void
      append_couplings(unsigned int               position,
                       std::vector<unsigned int> &couplings) const;

      void
      couple_ties();

      void
      make_pattern();

      const ContactSurface                    *surface;
      const dealii::AffineConstraints<double> *constraints;
      const ContactSearch                     *search;
      const StickPlaces                       *stick_places;
      const ChosenBodies                      *chosen;
      MPI_Comm                                 communicator;

      /// Couplings by append_couplings(): at the current positions, and when the pattern was begun.
      std::vector<unsigned int> candidates, coupled_candidates;
      bool                      are_candidates_known = false;
      /// For each slave, whether it has to be in the sparsity pattern, and whether it is.
      std::vector<bool>                     is_coupled, is_in_pattern;
      bool                                  has_pattern      = false;
      bool                                  has_step_pattern = false;
      unsigned int                          version          = 0;
      std::unique_ptr<CoverMatrixAssembler> assembler;

      Matrix matrix;
      Vector forces;

      /// Arguments of begin_assembly() for the present assembly.
      bool        with_tangent = false;
      BodyMatrix *body_matrix  = nullptr;
    };
  } // namespace internal
} // namespace NMM

#endif
