#include "element_exchange.h"

#include <nmm/base/exceptions.h>

#include <cmath>

namespace NMM
{
  namespace internal
  {
    using namespace dealii;

    namespace
    {
      constexpr unsigned int n_numbers = 4;

      /// Numbers that identify an element: region, a characteristic point, and area.
      std::array<double, n_numbers>
      signature(const ManifoldMesh &mesh, const unsigned int element)
      {
        const Point<2> x = mesh.reference_point(element);
        return {{static_cast<double>(mesh.region(element)),
                 x[0],
                 x[1],
                 mesh.area(element)}};
      }
    } // namespace


    ElementExchange::ElementExchange(const ManifoldMesh &mesh,
                                     const RankCells    &rank_cells)
      : mpi_communicator(rank_cells.communicator)
      , rank(rank_cells.rank)
      , shared(mesh.n_elements(), 0)
    {
      std::map<unsigned int, std::vector<double>> messages;
      for (const RankCells::Neighbor &cells : rank_cells.neighbors)
      {
        neighbors.push_back({cells.rank, {}, {}});
        std::vector<double> &message = messages[cells.rank];
        for (const unsigned int c : cells.sent)
        {
          message.push_back(mesh.cell_elements(c).size());
          for (const unsigned int e : mesh.cell_elements(c))
          {
            neighbors.back().sent.push_back(e);
            shared[e]     = 1;
            const auto it = signature(mesh, e);
            message.insert(message.end(), it.begin(), it.end());
          }
        }
      }
      const auto answers =
        Utilities::MPI::some_to_some(mpi_communicator, messages);
      for (unsigned int n = 0; n < neighbors.size(); ++n)
      {
        const std::vector<double> &message  = answers.at(neighbors[n].rank);
        std::size_t                position = 0;
        for (const unsigned int c : rank_cells.neighbors[n].received)
          match(mesh, c, message, position, neighbors[n].received);
        for (const unsigned int e : neighbors[n].received)
          shared[e] = 1;
      }

      std::vector<unsigned int> names(2 * mesh.n_elements());
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        names[2 * e]     = rank;
        names[2 * e + 1] = e;
      }
      update_ghosts(names, 2);
      for (unsigned int e = 0; e < mesh.n_elements(); ++e)
      {
        element_to_global.push_back({names[2 * e], names[2 * e + 1]});
        if (names[2 * e] != rank)
          ghost_to_local[element_to_global.back()] = e;
      }
    }


    void
    ElementExchange::match(const ManifoldMesh        &mesh,
                           const unsigned int         cell,
                           const std::vector<double> &message,
                           std::size_t               &position,
                           std::vector<unsigned int> &received) const
    {
      const auto         here = mesh.cell_elements(cell);
      const unsigned int n    = static_cast<unsigned int>(message[position++]);
      const double       size = mesh.mathematical_mesh().cell_diameter(cell);
      bool               fits = n == here.size();
      std::vector<unsigned char> is_taken(here.size(), 0);
      for (unsigned int i = 0; i < n && fits; ++i, position += n_numbers)
      {
        const double *there = message.data() + position;
        double        best  = 1e-6;
        unsigned int  found = invalid_index;
        for (unsigned int j = 0; j < n; ++j)
        {
          const auto it = signature(mesh, here[j]);
          if (is_taken[j] || it[0] != there[0])
            continue;
          const double difference = std::abs(it[1] - there[1]) / size +
                                    std::abs(it[2] - there[2]) / size +
                                    std::abs(it[3] - there[3]) / (size * size);
          if (difference < best)
          {
            best  = difference;
            found = j;
          }
        }
        fits = found != invalid_index;
        if (fits)
        {
          is_taken[found] = 1;
          received.push_back(here[found]);
        }
      }
      AssertThrow(
        fits,
        NumericalFailure(
          "Two ranks have cut a cell in different ways",
          to_string(
            mesh.mathematical_mesh()
              .vertices()[mesh.mathematical_mesh().cell_vertices(cell)[0]]),
          "move the mathematical mesh a little, or let "
          "all ranks hold all of it"));
    }


    ElementExchange::GlobalElement
    ElementExchange::global(const unsigned int element) const
    {
      return element_to_global[element];
    }


    unsigned int
    ElementExchange::local(const GlobalElement &element) const
    {
      if (element.rank == rank)
        return element.element;
      const auto position = ghost_to_local.find(element);
      return position == ghost_to_local.end() ? invalid_index
                                              : position->second;
    }


    bool
    ElementExchange::is_shared(const unsigned int element) const
    {
      return shared[element] != 0;
    }


    MPI_Comm
    ElementExchange::communicator() const
    {
      return mpi_communicator;
    }
  } // namespace internal
} // namespace NMM
