#ifndef nmm_source_mechanics_nodal_values_h
#define nmm_source_mechanics_nodal_values_h

#include <nmm/covers/cover_system.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/trilinos_vector.h>

#include <linear_algebra/chosen_items.h>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /// The items of all ranks, one rank after the other, on each rank. Collective.
    template <typename Item>
    std::vector<Item>
    of_all_ranks(const std::vector<Item> &own, const MPI_Comm communicator)
    {
      std::vector<Item> all;
      for (const auto &part :
           dealii::Utilities::MPI::all_gather(communicator, own))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }


    /// Copy the locally relevant values of @p vector into an array with the displacement of each cover
    /// [m]. Entries of covers that are not relevant remain unchanged.
    inline void
    read_nodal_values(const CoverSystem                           &covers,
                      const dealii::TrilinosWrappers::MPI::Vector &vector,
                      std::vector<dealii::Tensor<1, 2>>           &nodal)
    {
      nodal.resize(covers.n_covers());
      if (covers.locally_owned_covers().n_elements() == covers.n_covers())
      {
        auto value = vector.begin();
        for (dealii::Tensor<1, 2> &u : nodal)
          for (unsigned int c = 0; c < 2; ++c)
            u[c] = *value++;
        return;
      }
      for (const auto cover : covers.locally_relevant_covers())
        for (unsigned int c = 0; c < 2; ++c)
          nodal[cover][c] = vector(unknown_of(cover, c));
    }


    /// The same for @p chosen covers alone, where one rank owns all covers.
    inline void
    read_nodal_values(const CoverSystem                           &covers,
                      const dealii::TrilinosWrappers::MPI::Vector &vector,
                      const ChosenItems                           &chosen,
                      std::vector<dealii::Tensor<1, 2>>           &nodal)
    {
      if (chosen.all() || nodal.size() != covers.n_covers() ||
          covers.locally_owned_covers().n_elements() != covers.n_covers())
      {
        read_nodal_values(covers, vector, nodal);
        return;
      }
      const auto values = vector.begin();
      for (const unsigned int k : chosen.chosen())
        for (unsigned int c = 0; c < 2; ++c)
          nodal[k][c] = values[unknown_of(k, c)];
    }
  } // namespace internal
} // namespace NMM

#endif
