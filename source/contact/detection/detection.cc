#include <deal.II/base/mpi.h>

#include <algorithm>
#include <contact/detection/detection.h>

namespace NMM
{
  namespace internal
  {
    namespace Parallel = dealii::Utilities::MPI;

    namespace
    {
      /// The largest value of of_law(law) of all laws.
      template <typename OfLaw>
      double
      largest_of_laws(const ContactParameters &parameters, const OfLaw &of_law)
      {
        double result = of_law(*parameters.law);
        for (const ContactPair &pair : parameters.pairs)
          result = std::max(result, of_law(*pair.law));
        return result;
      }
    } // namespace


    Detection::Detection(const ContactSurface    &surface,
                         const ContactParameters &parameters,
                         const Multipliers       &multipliers,
                         ContactMemory           &memory)
      : search(surface,
               parameters.slave_priority,
               parameters.integration == ContactIntegration::points)
      , maker(surface, search, parameters, memory, multipliers)
      , projector(surface, search, maker, memory, parameters)
      , surface(&surface)
      , parameters(&parameters)
      , memory(&memory)
      , largest_initial_closure(bound_initial_closure())
    {
    }


    double
    Detection::bound_initial_closure() const
    {
      double pressure = 0.;
      for (unsigned int e = 0; e < parameters->initial_stress.size(); ++e)
        for (const double s : {0., 0.5, 1.})
        {
          const ContactSurface::Place place = surface->reference_place(e, s);
          const dealii::Tensor<1, 2>  n     = place.normal();
          pressure =
            std::max(pressure,
                     -n * (parameters->initial_stress[e].at(place.x) * n));
        }
      if (pressure == 0.)
        return 0.;
      return std::min(parameters->reach,
                      largest_of_laws(*parameters, [&](const ContactLaw &law) {
                        return law.penetration(pressure);
                      }));
    }


    double
    Detection::largest_opening() const
    {
      if (largest_of_laws(*parameters, [](const ContactLaw &law) {
            return law.dilation;
          }) == 0.)
        return 0.;
      double slip = 0.;
      memory->stick_places.for_each(
        [&](unsigned int, const std::vector<StickPlace> &places) {
          for (const StickPlace &place : places)
            slip = std::max(slip, place.slip);
        });
      slip = Parallel::max(slip, surface->cover_system().communicator());
      return largest_of_laws(*parameters, [&](const ContactLaw &law) {
        return law.opening(slip);
      });
    }


    void
    Detection::find_candidates(const std::vector<double> &least_reaches,
                               const StepStates          &states)
    {
      // What touches is found again, however deep it is and however little moves in the step.
      const double least =
        0.5 * std::max(parameters->reach, memory->touching_reach);
      // Faces that have parted by dilation are still in contact, and so are those that part by less
      // than the initial stress has closed them.
      const double parted = 0.5 * (largest_opening() + largest_initial_closure);
      reaches.assign(surface->n_bodies(), least);
      for (unsigned int body = 0; body < least_reaches.size(); ++body)
        reaches[body] = std::max(least, least_reaches[body]);
      std::vector<double> searched = reaches;
      for (double &reach : searched)
        reach += parted;
      if (search.update(searched))
      {
        memory->searched_nodal   = states.displacements();
        memory->searched_time    = states.time();
        memory->searched_reaches = searched;
      }
      search.begin(!memory->has_accepted_state
                     ? ContactSearch::Begin::reference
                     : ContactSearch::Begin::unchanged);
      n_slaves =
        Parallel::max(static_cast<unsigned int>(search.slaves().size()),
                      surface->cover_system().communicator());
    }


    void
    Detection::make_points(PointSet &set)
    {
      maker.make(/* with_faces_beside = */ projector.admits_any_depth(), set);
      projector.begin_step(2. *
                             *std::max_element(reaches.begin(), reaches.end()),
                           set);
      projector.bound_new_contact();
    }


    double
    Detection::exceeded_reach(const std::vector<double> &motions,
                              const double               factor) const
    {
      for (unsigned int body = 0; body < motions.size(); ++body)
        if (motions[body] > factor * reaches[body])
          return factor * reaches[body];
      return 0.;
    }
  } // namespace internal
} // namespace NMM
