#include <nmm/base/exceptions.h>
#include <nmm/covers/rank_cells.h>
#include <nmm/geometry/physical_mesh.h>

#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/tria_description.h>

#include "lattice.h"
#include <algorithm>
#include <unordered_map>

namespace NMM
{
  using namespace dealii;
  using internal::Lattice;
  using internal::LatticeBox;
  using internal::LatticeNode;

  namespace
  {
    /// The part of a box that is to be divided among consecutive ranks.
    struct Share
    {
      LatticeBox   box;
      unsigned int first_rank, end_rank;
    };


    /// Direction along which a box is divided.
    unsigned int
    longer_direction(const LatticeBox &box)
    {
      return box.upper[0] - box.lower[0] >= box.upper[1] - box.lower[1] ? 0 : 1;
    }


    /// Divide in two, so that the first part has the same fraction of the parallelograms as of the
    /// ranks. @p counts are the numbers of parallelograms along the longer direction.
    std::pair<Share, Share>
    bisect(const Share &share, const std::uint64_t *counts)
    {
      const unsigned int d       = longer_direction(share.box);
      const std::int64_t n       = share.box.upper[d] - share.box.lower[d];
      const unsigned int n_ranks = share.end_rank - share.first_rank,
                         n_first = n_ranks / 2;
      std::uint64_t total        = 0;
      for (std::int64_t i = 0; i < n; ++i)
        total += counts[i];
      const double  wanted = static_cast<double>(total) * n_first / n_ranks;
      std::uint64_t sum    = 0;
      std::int64_t  cut    = 0;
      while (cut < n && sum + 0.5 * counts[cut] < wanted)
        sum += counts[cut++];
      std::pair<Share, Share> halves(share, share);
      halves.first.box.upper[d] = halves.second.box.lower[d] =
        share.box.lower[d] + cut;
      halves.first.end_rank = halves.second.first_rank =
        share.first_rank + n_first;
      return halves;
    }


    /// Box of each rank, the same result on all ranks.
    std::vector<LatticeBox>
    share_out(const PhysicalMesh          &physical_mesh,
              const Lattice               &lattice,
              const RegularMeshParameters &parameters,
              const MPI_Comm               communicator)
    {
      const unsigned int n_ranks =
                           Utilities::MPI::n_mpi_processes(communicator),
                         rank = Utilities::MPI::this_mpi_process(communicator);
      std::vector<Share> shares(1, {{{{0, 0}}, lattice.n}, 0, n_ranks});
      if (n_ranks == 1)
        return {shares[0].box};

      // Each rank counts some of the rows.
      const auto row = [&](const unsigned int r) {
        return lattice.n[1] * static_cast<std::int64_t>(r) / n_ranks;
      };
      const std::vector<LatticeNode> seen =
        internal::find_needed_parallelograms(physical_mesh,
                                             lattice,
                                             parameters,
                                             {{{0, row(rank)}},
                                              {{lattice.n[0], row(rank + 1)}}});
      std::vector<unsigned int> seen_to_share(seen.size(), 0);

      while (shares.size() < n_ranks)
      {
        std::vector<std::size_t> first(1, 0);
        for (const Share &share : shares)
        {
          const unsigned int d = longer_direction(share.box);
          first.push_back(first.back() + share.box.upper[d] -
                          share.box.lower[d]);
        }
        std::vector<std::uint64_t> counts(first.back(), 0);
        for (std::size_t i = 0; i < seen.size(); ++i)
        {
          const LatticeBox  &box = shares[seen_to_share[i]].box;
          const unsigned int d   = longer_direction(box);
          ++counts[first[seen_to_share[i]] + seen[i][d] - box.lower[d]];
        }
        Utilities::MPI::sum(counts, communicator, counts);

        std::vector<Share>        finer;
        std::vector<unsigned int> share_to_finer;
        for (unsigned int s = 0; s < shares.size(); ++s)
        {
          share_to_finer.push_back(finer.size());
          if (shares[s].end_rank - shares[s].first_rank == 1)
            finer.push_back(shares[s]);
          else
          {
            const auto [a, b] = bisect(shares[s], counts.data() + first[s]);
            finer.push_back(a);
            finer.push_back(b);
          }
        }
        for (std::size_t i = 0; i < seen.size(); ++i)
        {
          const unsigned int s = share_to_finer[seen_to_share[i]];
          seen_to_share[i]     = finer[s].box.contains(seen[i]) ? s : s + 1;
        }
        shares.swap(finer);
      }

      std::vector<LatticeBox> boxes;
      for (const Share &share : shares)
        boxes.push_back(share.box);
      return boxes;
    }


    /// A box with ghost layers around it.
    LatticeBox
    widen(LatticeBox box, const Lattice &lattice)
    {
      constexpr std::int64_t n = RankCells::n_layers;
      for (unsigned int d = 0; d < 2; ++d)
      {
        box.lower[d] = std::max<std::int64_t>(box.lower[d] - n, 0);
        box.upper[d] = std::min(box.upper[d] + n, lattice.n[d]);
      }
      return box;
    }


    bool
    intersect(const LatticeBox &a, const LatticeBox &b)
    {
      return std::max(a.lower[0], b.lower[0]) <
               std::min(a.upper[0], b.upper[0]) &&
             std::max(a.lower[1], b.lower[1]) <
               std::min(a.upper[1], b.upper[1]);
    }


    /// The cells that this rank holds.
    struct LocalLattice
    {
      /// Parallelograms with two cells each, in ascending order of the global numbers.
      std::vector<LatticeNode>                 parallelograms;
      std::vector<Point<2>>                    vertices;
      std::vector<std::array<unsigned int, 3>> cells;

      LocalLattice(const Lattice &lattice, std::vector<LatticeNode> needed)
        : parallelograms(std::move(needed))
      {
        std::unordered_map<std::int64_t, unsigned int> node_to_vertex;
        const auto vertex = [&](const std::int64_t i, const std::int64_t j) {
          const auto [position, is_new] =
            node_to_vertex.emplace(j * (lattice.n[0] + 1) + i, vertices.size());
          if (is_new)
            vertices.push_back(lattice.node(i, j));
          return position->second;
        };
        for (const auto &[i, j] : parallelograms)
        {
          const unsigned int v00 = vertex(i, j), v10 = vertex(i + 1, j),
                             v01 = vertex(i, j + 1), v11 = vertex(i + 1, j + 1);
          cells.push_back({{v00, v10, v01}});
          cells.push_back({{v10, v11, v01}});
        }
      }
    };


    std::unique_ptr<RankCells>
    find_owners(const Lattice                 &lattice,
                const LocalLattice            &local,
                const std::vector<LatticeBox> &boxes,
                const MPI_Comm                 communicator)
    {
      auto result            = std::make_unique<RankCells>();
      result->communicator   = communicator;
      result->rank           = Utilities::MPI::this_mpi_process(communicator);
      const LatticeBox &here = boxes[result->rank];
      const LatticeBox  with_ghosts = widen(here, lattice);

      std::vector<unsigned int> near_ranks;
      for (unsigned int r = 0; r < boxes.size(); ++r)
        if (r != result->rank && (intersect(boxes[r], with_ghosts) ||
                                  intersect(widen(boxes[r], lattice), here)))
        {
          near_ranks.push_back(r);
          result->neighbors.push_back({r, {}, {}});
        }

      std::vector<unsigned char> is_owned_vertex(local.vertices.size(), 0);
      std::uint64_t              n_owned = 0;
      for (std::size_t p = 0; p < local.parallelograms.size(); ++p)
      {
        const LatticeNode &x     = local.parallelograms[p];
        unsigned int       owner = result->rank;
        if (!here.contains(x))
          for (const unsigned int r : near_ranks)
            if (boxes[r].contains(x))
              owner = r;
        for (unsigned int half = 0; half < 2; ++half)
        {
          const unsigned int cell = 2 * p + half;
          result->cell_to_owner.push_back(owner);
          result->cell_to_global.push_back(2 * lattice.index(x[0], x[1]) +
                                           half);
          n_owned += owner == result->rank;
          if (owner == result->rank)
            for (const unsigned int v : local.cells[cell])
              is_owned_vertex[v] = 1;
          for (RankCells::Neighbor &neighbor : result->neighbors)
            if (owner == neighbor.rank)
              neighbor.received.push_back(cell);
            else if (owner == result->rank &&
                     widen(boxes[neighbor.rank], lattice).contains(x))
              neighbor.sent.push_back(cell);
        }
      }
      result->n_global_cells = Utilities::MPI::sum(n_owned, communicator);
      const auto least       = Utilities::MPI::min(n_owned, communicator);
      AssertThrow(least > 0,
                  InputError("a mesh of " +
                               std::to_string(result->n_global_cells) +
                               " cells cannot be shared out among " +
                               std::to_string(boxes.size()) + " ranks",
                             "Mathematical mesh/Cell size",
                             "choose smaller cells or fewer ranks"));
      for (const auto &corners : local.cells)
        result->is_near.push_back(std::any_of(corners.begin(),
                                              corners.end(),
                                              [&](const unsigned int v) {
                                                return is_owned_vertex[v] != 0;
                                              }));
      return result;
    }


    std::unique_ptr<Triangulation<2>>
    make_triangulation(const LocalLattice &local, const RankCells &rank_cells)
    {
      TriangulationDescription::Description<2, 2> description;
      description.comm      = rank_cells.communicator;
      description.settings  = TriangulationDescription::default_setting;
      description.smoothing = Triangulation<2>::none;
      description.coarse_cell_vertices = local.vertices;
      description.cell_infos.resize(1);
      for (unsigned int c = 0; c < local.cells.size(); ++c)
      {
        CellData<2> cell(3);
        for (unsigned int v = 0; v < 3; ++v)
          cell.vertices[v] = local.cells[c][v];
        description.coarse_cells.push_back(std::move(cell));
        const types::coarse_cell_id id = rank_cells.cell_to_global[c];
        description.coarse_cell_index_to_coarse_cell_id.push_back(id);

        TriangulationDescription::CellData<2> info;
        info.id                 = CellId(id, 0, nullptr).to_binary<2>();
        info.subdomain_id       = rank_cells.is_near[c]
                                    ? rank_cells.cell_to_owner[c]
                                    : numbers::artificial_subdomain_id;
        info.level_subdomain_id = info.subdomain_id;
        info.manifold_id        = numbers::flat_manifold_id;
        info.manifold_line_ids.fill(numbers::flat_manifold_id);
        info.manifold_quad_ids.fill(numbers::flat_manifold_id);
        description.cell_infos[0].push_back(std::move(info));
      }
      auto triangulation =
        std::make_unique<parallel::fullydistributed::Triangulation<2>>(
          rank_cells.communicator);
      triangulation->create_triangulation(description);
      return triangulation;
    }
  } // namespace


  MathematicalMesh
  make_distributed_mesh(const PhysicalMesh          &physical_mesh,
                        const RegularMeshParameters &parameters,
                        const unsigned int           degree,
                        const MPI_Comm               communicator)
  {
    const Lattice lattice =
      internal::make_lattice(physical_mesh.bounding_box(), parameters);
    const std::vector<LatticeBox> boxes =
      share_out(physical_mesh, lattice, parameters, communicator);
    const LatticeBox box =
      widen(boxes[Utilities::MPI::this_mpi_process(communicator)], lattice);
    const LocalLattice         local(lattice,
                             internal::find_needed_parallelograms(
                               physical_mesh, lattice, parameters, box));
    std::unique_ptr<RankCells> rank_cells =
      find_owners(lattice, local, boxes, communicator);
    auto triangulation = make_triangulation(local, *rank_cells);
    return MathematicalMesh(std::move(triangulation),
                            degree,
                            std::move(rank_cells));
  }
} // namespace NMM
