#ifndef nmm_source_contact_state_multipliers_h
#define nmm_source_contact_state_multipliers_h

#include <nmm/contact/surface/surface.h>

#include <optional>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Space of the multipliers of the augmented Lagrangian: functions that are continuous and
     * linear along the boundary, on stretches that are about as long as cells, however these are
     * cut. With a multiplier for each cut edge there would be more multipliers than displacements
     * can satisfy, and pressures would oscillate. Multipliers may jump at corners.
     */
    class MultiplierSpace
    {
    public:
      explicit MultiplierSpace(const ContactSurface &surface);

      /// The two functions on an edge: their numbers, and the values of the second one at the ends
      /// of the edge. It is linear in between, and both sum to 1.
      struct OnEdge
      {
        unsigned int first = invalid_index, second = invalid_index;
        double       at_start = 0., at_end = 0.;

        double
        share(const double s) const
        {
          return (1. - s) * at_start + s * at_end;
        }
      };

      const OnEdge &
      operator[](const unsigned int edge) const
      {
        return on_edges[edge];
      }

      unsigned int
      size() const
      {
        return n_functions;
      }

      double
      value(const std::vector<double> &coefficients,
            const unsigned int         edge,
            const double               s) const
      {
        const OnEdge &f = on_edges[edge];
        return (1. - f.share(s)) * coefficients[f.first] +
               f.share(s) * coefficients[f.second];
      }

    private:
      void
      add_stretch(const ContactSurface            &surface,
                  const std::vector<unsigned int> &edges);

      std::vector<OnEdge> on_edges;
      unsigned int        n_functions = 0;
    };


    /**
     * The multipliers of the augmented Lagrangian [Pa], which grow by the pressure of the springs
     * until the penetration that is left is small, see Contact. Springs that are too soft become
     * stiffer. There are no functions with the penalty method, whose multipliers are 0.
     */
    class Multipliers
    {
    public:
      /// Multipliers on @p surface that leave a weighted penetration of at most @p tolerance [m]; 0
      /// stands for the penalty method.
      Multipliers(const ContactSurface &surface, double tolerance);

      /// Whether there are multipliers.
      bool
      are_used() const
      {
        return tolerance > 0.;
      }

      /// Multiplier at a place of a slave [Pa], if they are used.
      double
      value(const unsigned int edge, const double s) const
      {
        return space->value(values, edge, s);
      }

      /// Factor by which the normal spring at a place of a slave is stiffer than its law [-].
      double
      stiffening(const unsigned int edge, const double s) const
      {
        return space->value(factors, edge, s);
      }

      /// Springs are those of their laws from now on. The solution depends on factors within
      /// the tolerance only; a run that continues from a checkpoint takes the same steps without
      /// those of earlier ones.
      void
      forget_stiffening();

      /// Forget which springs have been seen to be stiff enough.
      void
      forget_penetrations();

      /// What a contact point contributes to an update.
      struct Point
      {
        unsigned int slave = invalid_index;
        double       s     = 0.;
        /// Integration weight [m].
        double weight = 0.;
        /// Stiffness of its spring [Pa/m], and its gap without what opens it [m].
        double stiffness = 0., gap = 0.;
        /// Pressure of the initial stress, which is a part of its multiplier [Pa].
        double initial = 0.;
      };

      /// Add the mean pressures of the springs of @p points (of this rank) to the multipliers, where
      /// their sum with the pressure of the initial stress is not negative. @p stiffness is that of
      /// functions without points [Pa/m]. Returns the largest weighted penetration [m].
      double
      update(const std::vector<Point> &points,
             double                    stiffness,
             MPI_Comm                  communicator);

      /// The multipliers, for ContactHistory; empty for the penalty method [Pa].
      const std::vector<double> &
      all() const
      {
        return values;
      }

      /// Take over the multipliers of a history, if they are those of the same functions.
      void
      restore(const std::vector<double> &history);

    private:
      void
      stiffen(const std::vector<double> &penetrations);

      double tolerance;
      /// Empty for the penalty method.
      std::optional<MultiplierSpace> space;
      /// By function: multipliers [Pa], factors on the stiffness [-] and weighted penetrations of
      /// the last update [m]; whether the springs have been seen to be stiff enough.
      std::vector<double> values, factors, last_penetrations;
      std::vector<bool>   is_stiff_enough;
    };
  } // namespace internal
} // namespace NMM

#endif
