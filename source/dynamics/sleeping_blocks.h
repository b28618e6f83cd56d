#ifndef nmm_source_dynamics_sleeping_blocks_h
#define nmm_source_dynamics_sleeping_blocks_h

#include <nmm/dynamics/mechanical_model.h>
#include <nmm/dynamics/time_integrator.h>

#include <array>
#include <dynamics/block_inertia.h>
#include <limits>
#include <optional>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// Which blocks are at rest, and for how long; see SleepParameters. One rank.
    class SleepingBlocks
    {
    public:
      using Vector = MechanicalModel::Vector;

      /// Instead of how long a block has been at rest.
      static constexpr double asleep = std::numeric_limits<double>::infinity();

      SleepingBlocks(const MechanicalModel &model,
                     const SleepParameters &parameters);

      /// By block; empty: none sleeps.
      const std::vector<bool> &
      mask() const
      {
        return is_asleep;
      }

      /// DynamicState::rest.
      using Rest = std::vector<std::array<double, 4>>;

      void
      set_rest(const Rest &rest);

      /**
       * Those asleep that @p forces (r of @p u) would move wake: true if there are any.
       * Of a block with the mass m, its moment of inertia I about its centre c and
       * nodes at x_k these are accelerations
       * @f[ |\sum_k \Delta r_k| / m
       *     + |\Delta\sum_k (x_k - c)\times r_k| / \sqrt{I m}, @f]
       * differences being those from the forces when it fell asleep.
       */
      bool
      wake(const Vector &forces, const Vector &u, Rest &rest);

      /// After a step of @p step: count how long blocks have been at rest. True if any
      /// falls asleep.
      bool
      let_sleep(double        step,
                const Vector &momentum,
                const Vector &v,
                const Vector &forces,
                const Vector &u,
                Rest         &rest);

      /// Zero in all unknowns of those asleep.
      void
      set_zero(Vector &vector) const;

    private:
      SleepParameters                  parameters;
      const std::vector<unsigned int> *block_of;
      std::vector<bool>                is_asleep;
      std::optional<BlockInertia>      inertia;
      /// By block [J/m].
      std::vector<double> kinetic;
    };
  } // namespace internal
} // namespace NMM

#endif
