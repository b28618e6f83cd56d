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
     * Exchanges data of elements between the ranks of a distributed mesh, from the owner of an
     * element to the ranks that hold it as a ghost. Ranks may have cut a common cell in different
     * ways (divided or arranged), so that its elements are identified by region, position and area,
     * to a millionth of the cell.
     */
    class ElementExchange
    {
    public:
      /// Match the elements. Collective. @throws NumericalFailure if the elements of a cell differ
      /// between ranks.
      ElementExchange(const ManifoldMesh &mesh, const RankCells &rank_cells);

      /**
       * Overwrite the values of ghost elements by those of their owners. @p values has @p
       * n_per_element entries for each element. Collective.
       */
      template <typename T>
      void
      update_ghosts(std::vector<T> &values, unsigned int n_per_element) const;

      /// Global identification of an element: its owner and its number there.
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

      /// Number of a global element on this rank; invalid_index if this rank does not hold it.
      unsigned int
      local(const GlobalElement &element) const;

      /// Whether the element is a ghost, or a ghost of another rank.
      bool
      is_shared(unsigned int element) const;

      MPI_Comm
      communicator() const;

    private:
      struct Neighbor
      {
        unsigned int rank;
        /// Elements to be sent and received, in an order on which both ranks agree.
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
