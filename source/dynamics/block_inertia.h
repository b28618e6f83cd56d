#ifndef nmm_source_dynamics_block_inertia_h
#define nmm_source_dynamics_block_inertia_h

#include <nmm/mechanics/mechanical_model.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Masses and moments of inertia of blocks, and resultants of forces or momenta on each block.
    /// Requires one rank and several blocks. All quantities are per unit
    /// thickness.
    class BlockInertia
    {
    public:
      using Vector = MechanicalModel::Vector;

      explicit BlockInertia(const ModelLayout &layout);

      unsigned int
      n_blocks() const
      {
        return masses.size();
      }

      /// Mass of a block [kg/m].
      double
      mass(const unsigned int block) const
      {
        return masses[block];
      }

      /// Moment of inertia about the centre of mass in the reference configuration [kg m].
      double
      inertia(const unsigned int block) const
      {
        return inertias[block];
      }

      /// Resultant of the nodal forces (or momenta) r_k of a block.
      struct Sum
      {
        /// Centre of mass at the current positions x_k, relative to the reference position of the first
        /// unknown of the block [m].
        dealii::Point<2> center;
        /// Sum of r_k.
        dealii::Tensor<1, 2> resultant;
        /// Moment about the centre, the sum of (x_k - center) x r_k.
        double moment = 0.;
      };

      /// Resultants of r_k at x_k = X_k + u_k for each block.
      const std::vector<Sum> &
      sum(const Vector &r, const Vector &u);

      /**
       * Move the blocks for which @p is_meant is true from the displacements @p u like rigid
       * bodies without forces in a step of @p h [s], and write the result into @p moved. The centre
       * moves by h p / m and the block rotates by 2 atan(h omega / 2) with omega = L / I, which is
       * the rotation of a rigid body in the conserving scheme. Linear momentum p and angular
       * momentum L are those of @p momentum = M v.
       */
      void
      fly(const Vector            &momentum,
          const Vector            &u,
          double                   h,
          const std::vector<bool> &is_meant,
          Vector                  &moved);

    private:
      const std::vector<unsigned int> *block_of;
      std::vector<double>              masses, inertias;
      /// Reference positions of the unknowns, relative to that of the first one of their block [m].
      Vector positions;
      /// Mass that belongs to each unknown in a translation, i.e. the row sums of M [kg/m].
      Vector           nodal_mass;
      std::vector<Sum> sums;
    };
  } // namespace internal
} // namespace NMM

#endif
