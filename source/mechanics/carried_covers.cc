#include <nmm/base/exceptions.h>
#include <nmm/covers/weight_functions.h>
#include <nmm/mechanics/carried_covers.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

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
    , origins(to.n_covers())
  {
    Assert(dealii::Utilities::MPI::n_mpi_processes(to.communicator()) == 1,
           dealii::ExcMessage("Covers are carried over on one rank only."));
    const ManifoldMesh     &mesh         = to.manifold_mesh();
    const ManifoldMesh     &former_mesh  = from.manifold_mesh();
    const MathematicalMesh &former_cells = former_mesh.mathematical_mesh();
    former_blocks.assign(mesh.physical_mesh().n_blocks(), invalid_index);
    struct Rank
    {
      double outside = 0., area = -1.;
    };
    std::vector<Rank>   best(to.n_covers());
    std::vector<double> largest(former_blocks.size(), -1.);
    const auto          propose = [&](const unsigned int cover,
                             const unsigned int former,
                             const double       area) {
      const Point<2> xi =
        former_cells.real_to_reference(former_mesh.cell(former),
                                       to.node(cover));
      // Interpolation is better than extrapolation, and large elements are located best.
      const Rank rank{distance_outside(xi), area};
      Rank      &other = best[cover];
      if (other.area >= 0. &&
          (rank.outside > other.outside ||
           (rank.outside == other.outside && rank.area <= other.area)))
        return;
      other                  = rank;
      origins[cover].element = former;
      WeightFunctions::values(former_cells.degree(),
                              xi,
                              origins[cover].weights);
      remove_rounding(former_cells.n_covers_per_cell(), origins[cover].weights);
    };
    for (unsigned int element = 0; element < mesh.n_elements(); ++element)
    {
      const unsigned int former = find_former(element, rules.rule(element));
      if (former == invalid_index)
        continue;
      const double       area  = mesh.area(element);
      const unsigned int block = mesh.block(element);
      if (area > largest[block])
      {
        largest[block]       = area;
        former_blocks[block] = former_mesh.block(former);
      }
      for (const unsigned int cover : to.covers(element))
        propose(cover, former, area);
    }
    // Where cells have become larger, another part of an element may be nearer to the node.
    for (unsigned int element = 0; element < mesh.n_elements(); ++element)
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
    for (unsigned int cover = 0; cover < origins.size(); ++cover)
      AssertThrow(origins[cover].element != invalid_index,
                  NumericalFailure("A part of the solid was not found in the "
                                   "solid before a crack grew",
                                   "near " + to_string(to.node(cover)),
                                   "choose another 'Fracture/Increment'"));
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
    Vector result(to->locally_owned_dofs(2), to->communicator());
    for (unsigned int cover = 0; cover < origins.size(); ++cover)
    {
      const Origin &origin = origins[cover];
      const auto    former = from->covers(origin.element);
      for (unsigned int c = 0; c < 2; ++c)
      {
        double sum = 0.;
        for (unsigned int i = 0; i < former.size(); ++i)
          if (origin.weights[i] != 0.)
            sum += origin.weights[i] * values(unknown_of(former[i], c));
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
