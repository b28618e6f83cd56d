#ifndef nmm_source_contact_detection_detection_h
#define nmm_source_contact_detection_detection_h

#include <contact/detection/point_maker.h>
#include <contact/detection/point_projector.h>
#include <contact/detection/search.h>
#include <contact/state/memory.h>
#include <contact/state/multipliers.h>
#include <contact/surface/step_states.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * What may touch in a step: candidate pairs within the reaches of their bodies, contact points on
     * them, and who projects these points. All references must outlive this object.
     */
    class Detection
    {
    public:
      Detection(const ContactSurface    &surface,
                const ContactParameters &parameters,
                const Multipliers       &multipliers,
                ContactMemory           &memory);

      /// Find candidate pairs at the present displacements. @p least_reaches: see Contact::detect().
      /// Collective.
      void
      find_candidates(const std::vector<double> &least_reaches,
                      const StepStates          &states);

      /// Make the contact points on the candidate pairs.
      void
      make_points(PointSet &set);

      /// The largest motions of a face of each body since find_candidates() [m].
      std::vector<double>
      motions() const
      {
        return search.distances(search.step_begin());
      }

      /// The first @p factor times the reach of a body that is less than the motion of the body; 0 if
      /// there is none [m].
      double
      exceeded_reach(const std::vector<double> &motions, double factor) const;

      /// Whether no rank has a candidate pair.
      bool
      is_idle() const
      {
        return n_slaves == 0;
      }

      ContactSearch    search;
      const PointMaker maker;
      PointProjector   projector;

    private:
      /// Upper bound on the closure of springs by the initial stress, over all edges and laws, but at
      /// most the reach [m].
      double
      bound_initial_closure() const;

      /// Upper bound on the opening of all points of all ranks at the last accepted state [m].
      double
      largest_opening() const;

      const ContactSurface    *surface;
      const ContactParameters *parameters;
      ContactMemory           *memory;
      double                   largest_initial_closure;
      /// How far the faces of each body may move until the next search [m].
      std::vector<double> reaches;
      /// Largest number of slaves of a rank.
      unsigned int n_slaves = 0;
    };
  } // namespace internal
} // namespace NMM

#endif
