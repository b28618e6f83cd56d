#ifndef nmm_source_dynamics_sleeping_blocks_h
#define nmm_source_dynamics_sleeping_blocks_h

#include <nmm/dynamics/dynamic_state.h>
#include <nmm/mechanics/mechanical_model.h>

#include <array>
#include <dynamics/block_inertia.h>
#include <limits>
#include <optional>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Decides which blocks fall asleep and wake; see SleepParameters. One rank only.
    class SleepingBlocks
    {
    public:
      using Vector = MechanicalModel::Vector;

      /// Value in DynamicState::rest that marks a sleeping block, instead of its time at rest.
      static constexpr double asleep = std::numeric_limits<double>::infinity();

      SleepingBlocks(const ModelLayout     &layout,
                     const SleepParameters &parameters);

      /// For each block, whether it sleeps; empty: none does.
      const std::vector<bool> &
      mask() const
      {
        return is_asleep;
      }

      /// See DynamicState::rest.
      using Rest = std::vector<std::array<double, 4>>;

      void
      set_rest(const Rest &rest);

      /**
       * Wake the sleeping blocks that @p forces (r at @p u) would accelerate by more than
       * SleepParameters::acceleration. Returns whether there are any. For a block with the mass m,
       * the moment of inertia I about its centre c and nodes at x_k the acceleration is
       * @f[ |\sum_k \Delta r_k| / m
       *     + |\Delta\sum_k (x_k - c)\times r_k| / \sqrt{I m}, @f]
       * where differences are those from the forces when it fell asleep.
       */
      bool
      wake(const Vector &forces, const Vector &u, Rest &rest);

      /// Update the times of rest after a step of @p step [s], and let blocks fall asleep that have
      /// been at rest long enough. Returns whether there are any.
      bool
      let_sleep(double        step,
                const Vector &momentum,
                const Vector &v,
                const Vector &forces,
                const Vector &u,
                Rest         &rest);

      /// Set the unknowns of sleeping blocks to zero.
      void
      set_zero(Vector &vector) const;

    private:
      SleepParameters                  parameters;
      const std::vector<unsigned int> *block_of;
      std::vector<bool>                is_asleep;
      std::optional<BlockInertia>      inertia;
      /// Kinetic energy of each block [J/m].
      std::vector<double> kinetic;
    };
  } // namespace internal
} // namespace NMM

#endif
