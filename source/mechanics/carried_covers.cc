#include <nmm/base/exceptions.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/carried_covers.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <mechanics/nodal_values.h>

namespace NMM
{
  using dealii::Point;

  namespace
  {
    /// The weights at a node of the cell are exactly 0 and 1. Computed from coordinates they
    /// differ from these by rounding, which would make a copy an interpolation.
    void
    remove_rounding(const unsigned int n, double *weights)
    {
      constexpr double rounding = 1e-9;
      for (unsigned int i = 0; i < n; ++i)
        for (const double exact : {0., 1.})
          if (std::abs(weights[i] - exact) < rounding)
            weights[i] = exact;
    }


    /// How far a point lies outside of the reference cell, as a share of the cell; 0 inside.
    double
    distance_outside(const Point<2> &xi)
    {
      constexpr double rounding = 1e-9;
      const double     least    = std::min({xi[0], xi[1], 1. - xi[0] - xi[1]});
      return least > -rounding ? 0. : -least;
    }


    /// A node that lies further outside of its former cell than this is sought in others [-].
    constexpr double most_outside = 0.5;
  } // namespace


  CarriedCovers::CarriedCovers(const CoverSystem          &from,
                               const CoverSystem          &to,
                               const QuadratureCollection &rules)
    : from(&from)
    , to(&to)
  {
    const ManifoldMesh     &mesh         = to.manifold_mesh();
    const ManifoldMesh     &former_mesh  = from.manifold_mesh();
    const MathematicalMesh &former_cells = former_mesh.mathematical_mesh();
    std::vector<Proposal>   best(to.n_covers()),
      of_blocks(mesh.physical_mesh().n_blocks());
    const auto propose = [&](const unsigned int cover,
                             const unsigned int former,
                             const double       area) {
      const Point<2> xi =
        former_cells.real_to_reference(former_mesh.cell(former),
                                       to.node(cover));
      Proposal proposal{distance_outside(xi), area, {former, {}}};
      if (!proposal.is_better_than(best[cover]))
        return;
      WeightFunctions::values(former_cells.degree(),
                              xi,
                              proposal.origin.weights);
      remove_rounding(former_cells.n_covers_per_cell(),
                      proposal.origin.weights);
      best[cover] = proposal;
    };
    // Of equal proposals the first one is taken, on any number of ranks: ranks own ascending elements.
    const auto take_best = [&](std::vector<Proposal> &proposals) {
      const auto all =
        dealii::Utilities::MPI::all_gather(to.communicator(), proposals);
      proposals = all.front();
      for (const std::vector<Proposal> &of_rank : all)
        for (unsigned int i = 0; i < proposals.size(); ++i)
          if (of_rank[i].is_better_than(proposals[i]))
            proposals[i] = of_rank[i];
    };
    const auto [first, last] = to.locally_owned_elements();
    for (unsigned int element = first; element < last; ++element)
    {
      const unsigned int former = find_former(element, rules.rule(element));
      if (former == invalid_index)
        continue;
      const double   area = mesh.area(element);
      const Proposal block{0., area, {former_mesh.block(former), {}}};
      if (block.is_better_than(of_blocks[mesh.block(element)]))
        of_blocks[mesh.block(element)] = block;
      for (const unsigned int cover : to.covers(element))
        propose(cover, former, area);
    }
    take_best(best);
    // Where cells have become larger, another part of an element may be nearer to the node.
    for (unsigned int element = first; element < last; ++element)
    {
      const auto covers = to.covers(element);
      if (std::all_of(covers.begin(), covers.end(), [&](const unsigned int c) {
            return best[c].outside <= most_outside;
          }))
        continue;
      const dealii::Quadrature<2> &rule = rules.rule(element);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const unsigned int former = find_former(element, rule, q);
        if (former != invalid_index)
          for (const unsigned int cover : covers)
            propose(cover, former, mesh.area(element));
      }
    }
    take_best(best);
    take_best(of_blocks);
    for (const Proposal &block : of_blocks)
      former_blocks.push_back(block.origin.element);
    for (unsigned int cover = 0; cover < best.size(); ++cover)
    {
      origins.push_back(best[cover].origin);
      AssertThrow(origins[cover].element != invalid_index,
                  NumericalFailure("A part of the solid was not found in the "
                                   "solid before a crack grew",
                                   "near " + to_string(to.node(cover)),
                                   "choose another 'Fracture/Increment'"));
    }
  }


  bool
  CarriedCovers::Proposal::is_better_than(const Proposal &other) const
  {
    return area >= 0. && (other.area < 0. || outside < other.outside ||
                          (outside == other.outside && area > other.area));
  }


  unsigned int
  CarriedCovers::find_former(const unsigned int           element,
                             const dealii::Quadrature<2> &rule) const
  {
    // An element whose area is within rounding may have no points.
    if (rule.size() == 0)
      return from->manifold_mesh().find_element(
        to->manifold_mesh().reference_point(element));
    // The point of the largest weight is likely to be farthest from the element's edges.
    const auto  &weights = rule.get_weights();
    unsigned int former =
      find_former(element,
                  rule,
                  std::max_element(weights.begin(), weights.end()) -
                    weights.begin());
    for (unsigned int q = 0; former == invalid_index && q < rule.size(); ++q)
      former = find_former(element, rule, q);
    return former;
  }


  unsigned int
  CarriedCovers::find_former(const unsigned int           element,
                             const dealii::Quadrature<2> &rule,
                             const unsigned int           q) const
  {
    const ManifoldMesh &mesh = to->manifold_mesh();
    return from->manifold_mesh().find_element(
      mesh.mathematical_mesh().reference_to_real(mesh.cell(element),
                                                 rule.point(q)));
  }


  CarriedCovers::Vector
  CarriedCovers::carry(const Vector &values) const
  {
    const std::vector<double> former_values =
      internal::of_all_ranks(std::vector<double>(values.begin(), values.end()),
                             from->communicator());
    Vector result(to->locally_owned_dofs(2), to->communicator());
    for (const auto cover : to->locally_owned_covers())
    {
      const Origin &origin = origins[cover];
      const auto    former = from->covers(origin.element);
      for (unsigned int c = 0; c < 2; ++c)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < former.size(); ++i)
          if (origin.weights[i] != 0.)
            sum += origin.weights[i] * former_values[unknown_of(former[i], c)];
        result(unknown_of(cover, c)) = sum;
      }
    }
    result.compress(dealii::VectorOperation::insert);
    return result;
  }


  unsigned int
  CarriedCovers::former_block(const unsigned int block) const
  {
    AssertIndexRange(block, former_blocks.size());
    return former_blocks[block];
  }
} // namespace NMM
