// Which faces the search takes for candidates, and what it costs.

#include <contact/contact_model.h>
#include <contact/detection/narrow_phase.h>

using namespace NMM;
using namespace NMM::Test;

namespace
{
  using internal::ContactSearch;
  using internal::NarrowPhase;


  /// A block that moves fast looks further, and so do the others towards it; among themselves they
  /// look no further than before.
  TEST(ContactDetection, FastBlocksAddNoCandidatesAmongOthers)
  {
    Geometry geometry;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        add_named_box(geometry,
                      std::to_string(i) + "-" + std::to_string(j) + " ",
                      Point<2>(1.02 * i, 1.02 * j),
                      Point<2>(1.02 * i + 1., 1.02 * j + 1.));
    Bodies                    bodies(std::move(geometry), Bodies::Options());
    std::vector<Tensor<1, 2>> nodal(bodies.covers.n_covers());
    bodies.surface.set_displacements(&nodal);
    const auto        &edges = bodies.surface.edges();
    const unsigned int fast =
      bodies.mesh.block(bodies.mesh.find_element(Point<2>(0.5, 0.5)));
    const auto masters_of = [&](const double way, const bool of_fast) {
      std::vector<double> reaches(bodies.surface.n_bodies(), 0.025);
      reaches[fast] += way;
      ContactSearch search(bodies.surface, {});
      search.update(reaches);
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
        for (const unsigned int master : search.masters(i))
          if (of_fast == (edges[search.slaves()[i]].body == fast ||
                          edges[master].body == fast))
          {
            result.push_back(search.slaves()[i]);
            result.push_back(search.corner(i));
            result.push_back(master);
          }
      return result;
    };
    EXPECT_GT(masters_of(0., false).size(), 0U);
    EXPECT_EQ(masters_of(0., false), masters_of(2., false));
    EXPECT_GT(masters_of(2., true).size(), 3U * masters_of(0., true).size());

    // The faces of the far block on the diagonal are found as soon as the way leads there.
    const unsigned int far_block =
      bodies.mesh.block(bodies.mesh.find_element(Point<2>(2.54, 2.54)));
    for (const double way : {0.5, 2.})
    {
      std::vector<double> reaches(bodies.surface.n_bodies(), 0.025);
      reaches[fast] += way;
      ContactSearch search(bodies.surface, {});
      search.update(reaches);
      bool is_found = false;
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
        for (const unsigned int master : search.masters(i))
        {
          const unsigned int a = edges[search.slaves()[i]].body,
                             b = edges[master].body;
          is_found = is_found || (std::min(a, b) == std::min(fast, far_block) &&
                                  std::max(a, b) == std::max(fast, far_block));
        }
      EXPECT_EQ(is_found, way > 1.);
    }
  }


  /// Rows of n, 2n and 4n blocks on another row: work grows by the same factors.
  TEST(ContactDetection, CostGrowsLinearly)
  {
    struct Counts
    {
      std::size_t n_edges, n_boxes, n_candidates, n_projections;
    };
    std::vector<Counts> counts;
    for (const unsigned int n : {8U, 16U, 32U})
    {
      Geometry geometry;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          add_named_box(geometry,
                        std::to_string(i) + "-" + std::to_string(j) + " ",
                        Point<2>(1.02 * i + 0.31 * j, 0.52 * j),
                        Point<2>(1.02 * i + 0.31 * j + 1., 0.52 * j + 0.5));
      Bodies::Options options;
      options.cell_size = 0.4;
      Bodies                    bodies(std::move(geometry), options);
      std::vector<Tensor<1, 2>> nodal(bodies.covers.n_covers());
      bodies.surface.set_displacements(&nodal);
      ContactSearch search(bodies.surface, {});
      search.update(std::vector<double>(bodies.surface.n_bodies(), 0.025));
      // one for each master at each division
      std::size_t n_projections = 0;
      for (unsigned int i = 0; i < search.slaves().size(); ++i)
        if (search.corner(i) == 2)
          n_projections +=
            NarrowPhase(bodies.surface, search).divisions(i).size() *
            search.masters(i).size();
      const auto &done = search.statistics();
      counts.push_back({bodies.surface.edges().size(),
                        done.n_boxes,
                        done.n_candidates,
                        n_projections});
      std::cout << n << " blocks in a row: " << counts.back().n_edges
                << " edges, " << done.n_boxes << " boxes, " << done.n_candidates
                << " candidates, " << n_projections << " projections"
                << std::endl;
    }
    ASSERT_GT(counts[0].n_candidates, counts[0].n_edges / 2);
    for (unsigned int i = 0; i < 2; ++i)
    {
      // the ends of the rows do without neighbours, hence a little above 2
      EXPECT_LE(counts[i + 1].n_edges, 2.2 * counts[i].n_edges);
      EXPECT_LE(counts[i + 1].n_boxes, 2.2 * counts[i].n_boxes);
      EXPECT_LE(counts[i + 1].n_candidates, 2.2 * counts[i].n_candidates);
      EXPECT_LE(counts[i + 1].n_projections, 2.2 * counts[i].n_projections);
    }
  }
} // namespace
