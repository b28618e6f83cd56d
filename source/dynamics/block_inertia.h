#ifndef nmm_source_dynamics_block_inertia_h
#define nmm_source_dynamics_block_inertia_h

#include <nmm/dynamics/mechanical_model.h>

#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Masses of blocks, and what forces on them, or momenta, sum up to. One rank, and
    /// a model that tells its blocks apart. All is per unit thickness.
    class BlockInertia
    {
    public:
      using Vector = MechanicalModel::Vector;

      explicit BlockInertia(const MechanicalModel &model);

      unsigned int
      n_blocks() const
      {
        return masses.size();
      }

      /// [kg/m]
      double
      mass(const unsigned int block) const
      {
        return masses[block];
      }

      /// Moment about the centre of mass in the reference configuration [kg m].
      double
      inertia(const unsigned int block) const
      {
        return inertias[block];
      }

      struct Sum
      {
        /// Centre of mass [m].
        dealii::Point<2> center;
        /// sum_k r_k.
        dealii::Tensor<1, 2> resultant;
        /// sum_k (x_k - center) x r_k.
        double moment = 0.;
      };

      /// Of r_k at x_k = X_k + u_k; by block.
      const std::vector<Sum> &
      sum(const Vector &r, const Vector &u);

      /**
       * Moves the blocks for which @p is_meant from @p u as stiff ones fly in a step of
       * @p h: the centre by h p / m, with a turn by 2 atan(h omega / 2), omega = L / I, the one
       * of the conserving scheme for a body that cannot deform; into @p moved.
       * @p momentum: M v.
       */
      void
      fly(const Vector            &momentum,
          const Vector            &u,
          double                   h,
          const std::vector<bool> &is_meant,
          Vector                  &moved);

    private:
      const MechanicalModel           *model;
      const std::vector<unsigned int> *block_of;
      std::vector<double>              masses, inertias;
      /// Mass that an unknown moves in a translation.
      Vector           nodal_mass;
      std::vector<Sum> sums;
    };
  } // namespace internal
} // namespace NMM

#endif
