// Reasons why a step must not be accepted.
#include <nmm/contact/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <contact/contact.h>
#include <sstream>

namespace NMM
{
  using namespace internal;
  namespace Parallel = dealii::Utilities::MPI;

  namespace
  {
    using EdgePair = ContactCrossings::Pair;


    /// Concatenate the pairs of all ranks.
    std::vector<EdgePair>
    all_pairs(const MPI_Comm communicator, std::vector<EdgePair> pairs)
    {
      if (Parallel::n_mpi_processes(communicator) == 1)
        return pairs;
      std::vector<EdgePair> result;
      for (const auto &part : Parallel::all_gather(communicator, pairs))
        result.insert(result.end(), part.begin(), part.end());
      return result;
    }


    /// Edges that are near each other and whose bodies may cross, in both orders.
    std::vector<EdgePair>
    find_near(const ContactSearch    &search,
              const ContactCrossings &crossings,
              const double            depth)
    {
      std::vector<EdgePair> result;
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
      {
        const unsigned int slave = search.slaves()[i];
        for (const unsigned int master : search.masters(i))
          if (crossings.may_cross(slave, master, depth))
          {
            result.emplace_back(slave, master);
            result.emplace_back(master, slave);
          }
      }
      return result;
    }
  } // namespace


  StepFault
  Contact::Data::find_crossing(const std::vector<double> &motions)
  {
    if (crossings == nullptr)
      crossings =
        std::make_unique<ContactCrossings>(*surface, parameters.reach);
    const double motion =
      2. * *std::max_element(motions.begin(), motions.end());
    const double depth =
      std::max(sums.deepest(), sums.report().largest_penetration);
    if (!crossings->may_cross(motion + depth))
      return {};

    const ContactSearch &search = detection.search;
    crossings->set_step(search.step_begin(), search.positions());
    std::vector<EdgePair> near;
    if (detection.exceeded_reach(motions, 1.) == 0.)
      near = find_near(search, *crossings, depth);
    else
    {
      // The step went further than the reach of the search.
      ContactSearch further(*surface,
                            parameters.slave_priority,
                            parameters.integration ==
                              ContactIntegration::points);
      states.move_to_begin(true);
      further.search(motions);
      near = find_near(further, *crossings, depth);
      states.move_to_begin(false);
    }
    near = all_pairs(communicator(), std::move(near));
    if (near.empty())
      return {};

    // Pairs of an edge and a body that it is in contact with.
    std::vector<EdgePair> in_contact;
    bool                  is_known = false;
    return crossings->find(
      std::move(near), [&](const unsigned int edge, const unsigned int body) {
        if (!is_known)
        {
          const auto &edges = surface->edges();
          for (const ContactPoint &point : set.points)
            if (point.state != ContactState::open)
            {
              in_contact.emplace_back(point.edge, edges[point.master].body);
              in_contact.emplace_back(point.master, edges[point.edge].body);
            }
          in_contact = all_pairs(communicator(), std::move(in_contact));
          std::sort(in_contact.begin(), in_contact.end());
          is_known = true;
        }
        return std::binary_search(in_contact.begin(),
                                  in_contact.end(),
                                  EdgePair(edge, body));
      });
  }


  StepFault
  Contact::find_fault(const Vector &end)
  {
    Data &d = *data;
    d.states.move_to(end);
    const std::vector<double> motions = d.detection.motions();
    const double              reach   = d.detection.projector.search_reach();
    std::ostringstream        text;
    if (!is_idle() && d.sums.deepest() > 0.5 * reach)
    {
      text << "a penetration of " << d.sums.deepest()
           << " m, more than half of the distance of " << reach
           << " m within which faces are looked for";
      return {
        text.str(),
        "choose a higher 'Contact/Normal stiffness', or a 'Contact/Reach' "
        "of more than twice the penetration; smaller steps help against "
        "impacts only",
        0.};
    }
    // A body that is struck moves further than was expected of it, while what struck it slows down.
    if (const double way = d.detection.exceeded_reach(motions, 2.); way > 0.)
    {
      text << "a point of a face that moved further than the distance of "
           << way << " m within which faces are looked for";
      return {text.str(), "", 0.};
    }
    return d.find_crossing(motions);
  }


  StepFault
  Contact::find_crossing(const Vector &end)
  {
    data->states.move_to(end);
    return data->find_crossing(data->detection.motions());
  }
} // namespace NMM
