#ifndef nmm_source_covers_element_exchange_h
#define nmm_source_covers_element_exchange_h

// Private: values of ghost elements from the ranks that own them.

#include <nmm/covers/manifold_mesh.h>
#include <nmm/covers/rank_cells.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <unordered_map>
#include <vector>

namespace NMM
{
  namespace internal
  {
    /**
     * Which elements of a distributed mesh are the same on different ranks, and how
     * their values get from their owner to the others. Ranks may have cut a cell that
     * they have in common in different ways (simply or by an arrangement), so that
     * its pieces are known from each other by region, place and area, to a
     * millionth of the cell.
     */
    class ElementExchange
    {
    public:
      /// Collective. @throws NumericalFailure if the ranks' pieces of a cell differ.
      ElementExchange(const ManifoldMesh &mesh, const RankCells &rank_cells);

      /**
       * @p values: @p n_per_element for each element; those of ghost elements are
       * overwritten by their owners'. Collective.
       */
      template <typename T>
      void
      update_ghosts(std::vector<T> &values, unsigned int n_per_element) const;

      /// An element's name on all ranks: its owner and its number there.
      struct GlobalElement
      {
        unsigned int rank, element;

        bool
        operator<(const GlobalElement &other) const
        {
          return rank != other.rank ? rank < other.rank
                                    : element < other.element;
        }
      };

      GlobalElement
      global(unsigned int element) const;

      /// invalid_index if this rank does not hold it.
      unsigned int
      local(const GlobalElement &element) const;

      /// Is the element a ghost, or do other ranks hold it as one?
      bool
      is_shared(unsigned int element) const;

      MPI_Comm
      communicator() const;

      /// Of ranks with common elements.
      unsigned int
      n_neighbors() const;

    private:
      struct Neighbor
      {
        unsigned int rank;
        /// Elements in an order both ranks agree on.
        std::vector<unsigned int> sent, received;
      };

      void
      match(const ManifoldMesh        &mesh,
            unsigned int               cell,
            const std::vector<double> &message,
            std::size_t               &position,
            std::vector<unsigned int> &received) const;

      MPI_Comm                              mpi_communicator;
      unsigned int                          rank;
      std::vector<Neighbor>                 neighbors;
      std::vector<GlobalElement>            element_to_global;
      std::vector<unsigned char>            shared;
      std::map<GlobalElement, unsigned int> ghost_to_local;
    };


    template <typename T>
    void
    ElementExchange::update_ghosts(std::vector<T>    &values,
                                   const unsigned int n_per_element) const
    {
      std::map<unsigned int, std::vector<T>> messages;
      for (const Neighbor &neighbor : neighbors)
        if (!neighbor.sent.empty())
        {
          std::vector<T> &message = messages[neighbor.rank];
          message.reserve(neighbor.sent.size() * n_per_element);
          for (const unsigned int e : neighbor.sent)
            message.insert(message.end(),
                           values.begin() + e * n_per_element,
                           values.begin() + (e + 1) * n_per_element);
        }
      const auto answers =
        dealii::Utilities::MPI::some_to_some(mpi_communicator, messages);
      for (const Neighbor &neighbor : neighbors)
        if (!neighbor.received.empty())
        {
          auto value = answers.at(neighbor.rank).begin();
          for (const unsigned int e : neighbor.received)
            for (unsigned int i = 0; i < n_per_element; ++i)
              values[e * n_per_element + i] = *value++;
        }
    }
  } // namespace internal
} // namespace NMM

#endif
